"""How a part scatters, as its page is told: fixed draws that follow the values that are set."""

from dataclasses import asdict, fields

import numpy as np
import pytest
from pages import about, answers, node

from thrustwasher import ParameterError, WasherParams, solve_washer
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.part_file import find_part
from thrustwasher.studio.explore.draws import DRAWS, draws_of, fixed_points

POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
POINT |= {"far_face_temperature": 0.0}
NAMES = {f.name for f in fields(WasherParams)} | POINT.keys()
LOADS = [20.0 * 150.0 ** (i / 23) for i in range(24)]


def part(tmp_path, *lines, parameters=""):
    file = tmp_path / "mine.toml"
    head = 'model = "washer"\nname = "Mine"\n[parameters]\n'
    file.write_text(f"{head}{parameters}\n[scatter]\n" + "\n".join(lines))
    return find_part(str(file))


def changes(one):
    """Return all changes of a part's draws by name."""
    found = draws_of(one, POINT, NAMES, "load")
    return {c["name"]: c for s in found["sources"] for c in s["changes"]}


def applied(change, value, k):
    how, x = change["how"], change["values"][k]
    return {"times": value * x, "plus": value + x, "set": x}[how] if how != "set" else x


def test_the_points_are_one_in_each_32nd_of_every_axis():
    points = fixed_points(12)
    for axis in points.T:
        assert sorted((axis * DRAWS).astype(int)) == list(range(DRAWS))
    assert points.min() > 0.0 and points.max() < 1.0
    assert len(np.unique(points, axis=1).T) == 12


def test_at_the_start_the_draws_are_those_of_the_part():
    washer = find_part("washer")
    told, known = about("washer")["scatter"], washer.scattered(inputs=POINT)
    assert [s["name"] for s in told["sources"]] == list(known.names)
    assert [s["law"] for s in told["sources"]] == [s.law.words() for s in known.sources]
    assert all(s["reason"] for s in told["sources"]) and told["draws"] == DRAWS
    rows = known.values(fixed_points(len(known.sources)))
    now = {**asdict(washer.params), **POINT}
    for source in told["sources"]:
        (change,) = source["changes"]
        for k, row in enumerate(rows):
            here = applied(change, now[change["name"]], k)
            assert here == pytest.approx(row[source["name"]], rel=1e-13)


@pytest.mark.parametrize(
    ("line", "name", "how"),
    [
        ('roughness = "10 %"', "roughness", "times"),
        ("tilt = { lognormal = 1.6 }", "tilt", "times"),
        ('oil_temperature = "3 K"', "oil_temperature", "plus"),
        ("heat_split = { uniform = [0.4, 0.6] }", "heat_split", "set"),
        ('conduction = { either = ["carrier", "all"] }', "conduction", "set"),
        ('load = { uniform = ["200 N", "400 N"] }', "load", "times"),
        ('load = "20 N"', "load", "plus"),
    ],
)
def test_a_law_says_whether_its_draws_follow_the_value(tmp_path, line, name, how):
    change = changes(part(tmp_path, line))[name]
    assert change["how"] == how and len(change["values"]) == DRAWS
    assert len(set(map(str, change["values"]))) > 1


def test_a_load_of_even_chances_scales_the_loads_that_the_page_goes_over(tmp_path):
    values = changes(part(tmp_path, 'load = { uniform = ["150 N", "450 N"] }'))["load"]["values"]
    assert 0.5 < min(values) < 0.55 and 1.45 < max(values) < 1.5


def test_a_value_taken_from_another_one_scatters_about_that(tmp_path):
    change = changes(part(tmp_path, 'roughness_washer = "10 %"'))["roughness_washer"]
    assert change["how"] == "times" and change["at_zero"] == "roughness"
    own = changes(part(tmp_path, 'heat_split = "10 %"'))["heat_split"]
    assert own["at_zero"] == 0.0


def test_a_parameter_of_an_earlier_form_scatters_as_those_in_its_place(tmp_path):
    found = changes(part(tmp_path, 'friction_constant = "10 %"'))
    assert found and found.keys() <= NAMES and "friction_constant" not in found
    assert {c["how"] for c in found.values()} == {"set"}


def test_a_part_that_gives_no_scatter_has_no_draws(tmp_path):
    assert draws_of(part(tmp_path), POINT, NAMES, "load") is None


@node
@pytest.mark.slow
def test_a_draw_of_the_worker_is_what_python_solves_load_by_load():
    washer = find_part("washer")
    known = washer.scattered(inputs=POINT)
    rows = [known.values(fixed_points(len(known.sources)))[k] for k in (4, 31)]
    fallen = []
    for row in rows:
        params, drawn = washer.varied(row)
        inputs = {**POINT, **drawn}
        loads = [load * inputs["load"] / POINT["load"] for load in LOADS]
        task = ["draw", as_numbers(params), "field", list(inputs.values()), loads]
        (got,), _ = answers("washer", [task])
        for load, here in zip(loads, got["up"], strict=True):
            wanted = solve_washer(params, **{**inputs, "load": load})
            assert here["branch"] == wanted.branch
            assert here["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-5)
            assert here["temperature_max"] == pytest.approx(wanted.temperature_max, rel=1e-5)
        down = {i: o for i, o in enumerate(got["down"]) if o}
        fallen.append(len(down))
        assert all(got["up"][i]["branch"] == "film" for i in down)
        for i, here in down.items():
            wanted = solve_washer(params, **{**inputs, "load": loads[i]}, branch="contact")
            assert here["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-5)
    assert fallen[0] > 0 and fallen[1] == 0  # with folds and without


@node
def test_a_draw_that_breaks_a_rule_says_which():
    numbers = as_numbers(WasherParams())
    at = [f.name for f in fields(WasherParams)].index("gear_inner_radius")
    with pytest.raises(ParameterError):
        WasherParams(gear_inner_radius=0.03)
    numbers[at] = 0.03
    (got,), _ = answers("washer", [["draw", numbers, "field", list(POINT.values()), LOADS]])
    assert about("washer")["rules"][got["broken"] - 1].startswith("gear_inner_radius")
