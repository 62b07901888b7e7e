"""What all evaluators promise: a part, an engagement, a function, a gearbox, a gear shift."""

import json
import math
import pickle

import numpy as np
import pytest

from thrustwasher import SolveError, engagements, load_part, load_scene, run_shift, run_sweep
from thrustwasher.cli import main
from thrustwasher.studio.evaluators.make import evaluator, gearbox


def picky(a=10.0, b=20.0):
    if a > 13.0:
        raise SolveError("too much")
    return {"sum": a + b, "product": a * b}


FUNCTION = {"a": {"normal": 1.0}, "b": {"normal": 2.0}}
# What is evaluated, rows that are sound, one that is none, figures.
CASES = {
    "clutch": (
        lambda: evaluator("clutch", at={"load": 3000.0, "speed": 10.0}),
        [{"friction_scale": x, "load": y} for x, y in ((0.9, 3e3), (1.0, 2e3), (1.1, 4e3))],
        {"inner_radius": 0.2},
        ("friction_torque", "temperature"),
    ),
    "gearmesh": (
        lambda: evaluator("gearmesh"),
        [{"load": x} for x in (50.0, 20.0, 120.0)],
        {"addendum": 0.4},
        ("friction_torque", "film_ratio"),
    ),
    "engagement": (
        lambda: engagements("clutch", at={"load": 4000.0, "speed": 100.0}),
        [{"inertia": x, "ramp": y} for x, y in ((0.2, 0.1), (0.0, 0.05), (0.4, 0.0))],
        {"speed": -5.0},
        ("energy", "peak_temperature", "slip_time"),
    ),
    "function": (
        lambda: evaluator(picky, table=FUNCTION),
        [{"a": 9.0}, {"a": 10.0, "b": 1.0}, {"b": 3.0}],
        {"a": 14.0},
        ("sum", "product"),
    ),
    "gearbox": (
        lambda: gearbox("planetary", "first"),
        [{"torque": 50.0, "speed": 200.0, "oil_temperature": x} for x in (330.0, 360.0)]
        + [{"torque": 90.0, "speed": 120.0, "washer.roughness": 5e-7}],
        {"torque": 5e6, "speed": 200.0, "oil_temperature": 330.0},
        ("efficiency", "mesh_loss", "washer_loss"),
    ),
    "shift": (
        lambda: evaluator("msl"),
        [{"clutch.friction_scale": x} for x in (0.9, 1.0, 1.1)],
        {"clutch.inner_radius": 0.9},
        ("lock_time", "slip_energy"),
    ),
}


@pytest.fixture(scope="module", params=[*CASES])
def case(request):
    """Return an evaluator with its rows, one that fails, and figures."""
    make, *rest = CASES[request.param]
    return make(), *rest


def test_answers_do_not_depend_on_the_order_of_rows_or_figures(case):
    made, rows, _, figures = case
    values, codes, _ = made.evaluate(rows, figures, "shown")
    back = made.evaluate(rows[::-1], figures[::-1], "shown")
    assert np.isfinite(values).all() and not set(codes.tolist()) & set(made.reasons)
    assert np.array_equal(back.values[::-1, ::-1], values)
    alone = [made.evaluate([row], figures, "shown").values[0] for row in rows]
    assert np.array_equal(alone, values)


def test_a_copy_in_another_process_answers_the_same(case):
    made, rows, _, figures = case
    sent = pickle.loads(pickle.dumps(made))
    assert sent.identity == made.identity
    own, other = (x.evaluate(rows, figures, "shown") for x in (made, sent))
    assert np.array_equal(own.values, other.values) and np.array_equal(own.codes, other.codes)


def test_a_row_that_fails_is_nan_with_a_code_and_leaves_no_trace(case):
    made, rows, wrong, figures = case
    values, codes, _ = made.evaluate([wrong, rows[0]], figures, "shown")
    assert np.isnan(values[0]).all() and made.reasons[codes[0]]
    assert np.array_equal(values[1], made.evaluate(rows[:1], figures, "shown").values[0])


def test_all_that_a_row_names_is_a_quantity_with_a_range_and_all_asked_a_figure(case):
    made, rows, _, figures = case
    for name in {name for row in rows for name in row}:
        q = made.quantities[name]
        assert q.low <= q.nominal <= q.high and q.name == name
    assert all(made.figures[name].name == name for name in figures)


def test_a_gradient_is_the_difference_of_rows(case):
    made, rows, _, figures = case
    names = ["friction_scale"] if "friction_scale" in rows[0] else list(rows[0])[:1]
    slopes = made.gradient(rows[0], figures, names)
    if slopes is None:  # not known: of functions, shifts, engagements, over inputs
        assert "friction_scale" not in rows[0]
        return
    x, h = rows[0][names[0]], 1e-4 * rows[0][names[0]]
    ends = made.evaluate([{**rows[0], names[0]: x + s} for s in (-h, h)], figures).values
    assert slopes.slopes[:, 0] == pytest.approx((ends[1] - ends[0]) / (2.0 * h), rel=1e-3)


@pytest.mark.parametrize("model", ["clutch", "gearmesh"])
def test_the_file_of_a_parts_row_runs_and_gives_the_same(model, tmp_path):
    make, rows, _, figures = CASES[model]
    made, path = make(), tmp_path / "part.toml"
    row = {**made.inputs, **rows[0]}
    path.write_text(made.file(row), "utf-8")
    found = load_part(path).solve()
    values = made.evaluate([row], figures).values[0]
    assert [getattr(found, n) for n in figures] == pytest.approx(values.tolist(), rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "more"), [("engagement", ["--workers", "1"]), ("gearbox", ["--json"])]
)
def test_the_file_of_a_row_runs_by_the_command_it_names(kind, more, tmp_path, capsys):
    make, rows, _, figures = CASES[kind]
    made, path = make(), tmp_path / "row.toml"
    text = made.file(rows[0])
    path.write_text(text, "utf-8")
    words = text.partition("\n")[0].removeprefix("# thrustwasher ").replace("FILE", str(path))
    assert main([*words.split(), *more]) == 0
    told = capsys.readouterr().out.strip()
    if kind == "gearbox":
        found = json.loads(told)["points"][0]
    else:
        head, line = told.splitlines()
        names = (h.split(" [")[0] for h in head.split(","))
        found = dict(zip(names, line.split(","), strict=True))
    values = made.evaluate(rows[:1], figures).values[0]
    assert [float(found[n]) for n in figures] == values.tolist()


def test_the_file_of_a_shifts_row_runs_and_gives_the_same(tmp_path):
    make, rows, _, figures = CASES["shift"]
    made, path = make(), tmp_path / "scene.toml"
    path.write_text(made.file(rows[0]), "utf-8")
    found = run_shift(load_scene(path)).figures
    values = made.evaluate(rows[:1], figures, "shown").values[0]
    assert [found[n] for n in figures] == pytest.approx(values.tolist(), rel=1e-9)


class Stop(Exception):
    pass


def test_a_sweep_of_engagements_is_the_same_for_any_workers_and_after_a_stop(tmp_path):
    over = {"inertia": [0.1, 0.2, 0.3], "load": "2 kN:4 kN:n8"}
    made, at = engagements("clutch"), {"speed": 100.0, "duration": "2 s"}
    one = run_sweep(made, over, at=at, workers=1)
    two = run_sweep(made, over, at=at, workers=2)
    assert all(np.array_equal(one[name], two[name]) for name in one.columns)

    def stop(done, _total):
        if done >= 5:
            raise Stop

    out = tmp_path / "engagements.csv"
    with pytest.raises(Stop):
        run_sweep(made, over, at=at, workers=1, out=out, progress=stop)
    assert not out.exists()
    again = run_sweep(made, over, at=at, workers=1, out=out)
    assert all(np.array_equal(one[name], again[name]) for name in one.columns)


def test_a_sweep_of_shifts_is_what_each_shift_gives():
    scene = load_scene("msl")
    table = run_sweep(scene, {"clutch.friction_scale": [0.9, 1.0]}, workers=1)
    assert table["status"].tolist() == ["OK", "OK"] and table.units["slip_energy"] == "J"
    assert table["slip_energy"][1] == pytest.approx(run_shift(scene).figures["slip_energy"])
    assert not math.isclose(*table["lock_time"])


def test_an_engagement_whose_slip_does_not_run_out_is_told():
    """J omega^2/2 = 1.5 kJ; a tenth of the force is not enough in half a second."""
    at = {"inertia": 0.3, "speed": 100.0}
    table = run_sweep(engagements("clutch"), {"load": [300.0, 3000.0]}, at=at)
    assert np.isnan(table["slip_time"]).tolist() == [True, False]
    assert table["energy"][1] == pytest.approx(1500.0, rel=1e-4)
    (told,) = table.warnings
    assert told.startswith("1 of 2 points, at worst slip_left = ") and "longer duration" in told
