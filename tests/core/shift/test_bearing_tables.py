"""The tables [sun_bearing] and [ring_bearing], and the bearings' place in the balance."""

from scene_runs import changed, real_shift, shift


def test_a_table_is_a_needle_bearing_unless_it_says_otherwise(tmp_path):
    given = '[sun_bearing]\n[ring_bearing]\nbetween = ["carrier", "case"]\nmean_radius = "40 mm"'
    p = changed(tmp_path, given, "planetary-sun").parts["transmission"].params
    assert (p.sun_bearing_shaft_1, p.sun_bearing_shaft_2) == ("sun", "carrier")
    assert (p.ring_bearing_shaft_1, p.ring_bearing_shaft_2) == ("carrier", "case")
    assert p.sun_bearing_coefficient == p.ring_bearing_coefficient == 0.004
    assert p.ring_bearing_mean_radius == 0.04


def test_bearings_are_in_the_book_which_closes():
    run = real_shift("planetary")
    loss = run.figures["bearing_loss"]
    assert loss == run.energy["bearings"] == run.signals["transmission.bearing_heat"][-1]
    assert 60.0 < loss < 100.0 and 80.0 < run.figures["peak_bearing_power"] < 130.0
    assert run.energy["residual_share"] < 1e-12
    assert not any("rests on no bearing" in line for line in run.messages)


def test_a_thrust_without_a_bearing_is_said():
    run = shift("planetary-sun", stop_time=0.02, parts={"mesh": None, "washer": None})
    assert "bearing_loss" not in run.figures and run.energy["bearings"] == 0.0
    for words in ("the sun's and the ring's thrust", "gear mesh", "without drag"):
        assert any(words in line for line in run.messages)
    assert not any("thrust" in line for line in shift("msl", stop_time=0.02).messages)
