"""What all evaluators promise: a part, an engagement, a function, a gearbox, a gear shift."""

import json
import math
import pickle
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest
from stopping import Stop, stopping_after

from thrustwasher import (
    ParameterError,
    SolveError,
    engagements,
    load_part,
    load_scene,
    run_shift,
    run_sweep,
)
from thrustwasher.cli import main
from thrustwasher.studio.evaluators.make import evaluator, gearbox


def picky(a=10.0, b=20.0):
    if a > 13.0:
        raise SolveError("too much")
    return {"sum": a + b, "product": a * b}


class Case(NamedTuple):
    """What is evaluated, rows that are sound, one that fails, and figures."""

    make: Callable[[], Any]
    rows: list[dict[str, float]]
    wrong: dict[str, float]
    figures: tuple[str, ...]
    slope: str | None = None
    """A parameter over which derivatives are known; None: they are not."""
    warm: float = 0.0
    """What a row may move by, relative, where neighbours start one another."""


FUNCTION = {"a": {"normal": 1.0}, "b": {"normal": 2.0}}
CASES = {
    "washer": Case(
        lambda: evaluator("washer", at={"load": 200.0, "speed": 545.0, "tilt": 0.002}),
        [{"roughness": x, "load": y} for x, y in ((4e-7, 200.0), (6e-7, 300.0), (5e-7, 900.0))],
        {"inner_radius": 0.2},
        ("friction_torque", "temperature"),
        "roughness",
        1e-6,
    ),
    "clutch": Case(
        lambda: evaluator("clutch", at={"load": 3000.0, "speed": 10.0}),
        [{"friction_scale": x, "load": y} for x, y in ((0.9, 3e3), (1.0, 2e3), (1.1, 4e3))],
        {"inner_radius": 0.2},
        ("friction_torque", "temperature"),
        "friction_scale",
    ),
    "gearmesh": Case(
        lambda: evaluator("gearmesh"),
        [{"load": x, "face_width": y} for x, y in ((50.0, 0.012), (20.0, 0.01), (120.0, 0.02))],
        {"addendum": 0.4},
        ("friction_torque", "film_ratio"),
        "face_width",
    ),
    "losses": Case(
        lambda: evaluator("losses", at={"input_speed": 200.0}),
        [{"oil_density": x} for x in (820.0, 850.0, 880.0)],
        {"oil_density": 1.0},
        ("input_torque", "churning_power"),
        "oil_density",
    ),
    "train": Case(
        lambda: evaluator("train"),
        [{"mesh_1_face_width": x, "torque": y} for x, y in ((0.02, 80.0), (0.03, 20.0))],
        {"mesh_1_addendum": 0.1},
        ("efficiency", "mesh_loss"),
        "mesh_1_face_width",
    ),
    "engagement": Case(
        lambda: engagements("clutch", at={"load": 4000.0, "speed": 100.0}),
        [{"inertia": x, "ramp": y} for x, y in ((0.2, 0.1), (0.0, 0.05), (0.4, 0.0))],
        {"speed": -5.0},
        ("energy", "peak_temperature", "slip_time"),
    ),
    "function": Case(
        lambda: evaluator(picky, table=FUNCTION),
        [{"a": 9.0}, {"a": 10.0, "b": 1.0}, {"b": 3.0}],
        {"a": 14.0},
        ("sum", "product"),
    ),
    "gearbox": Case(
        lambda: gearbox("planetary", "first"),
        [{"torque": 50.0, "speed": 200.0, "oil_temperature": x} for x in (330.0, 360.0)]
        + [{"torque": 90.0, "speed": 120.0, "washer.roughness": 5e-7}],
        {"torque": 5e6, "speed": 200.0, "oil_temperature": 330.0},
        ("efficiency", "mesh_loss", "washer_loss"),
    ),
    "shift": Case(
        lambda: evaluator("msl"),
        [{"clutch.friction_scale": x} for x in (0.9, 1.0, 1.1)],
        {"clutch.inner_radius": 0.9},
        ("lock_time", "slip_energy"),
    ),
}


PARTS = [kind for kind, case in CASES.items() if case.slope]
SLOW = ("gearbox", "shift")  # half a second for what the others show
each = pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.slow] * (kind in SLOW)) for kind in CASES]
)


@pytest.fixture(scope="module", params=[*CASES])
def case(request):
    """Return a case whose evaluator is made."""
    found = CASES[request.param]
    return found._replace(make=found.make())


def test_answers_do_not_depend_on_the_order_of_rows_or_figures(case):
    made, rows, _, figures, _, warm = case
    values, codes, _ = made.evaluate(rows, figures, "shown")
    back = made.evaluate(rows[::-1], figures[::-1], "shown")
    assert np.isfinite(values).all() and not set(codes.tolist()) & set(made.reasons)
    assert np.array_equal(back.values[::-1, ::-1], values)
    alone = [made.evaluate([row], figures, "shown").values[0] for row in rows]
    assert np.allclose(alone, values, rtol=warm, atol=0.0)


def test_a_copy_in_another_process_answers_the_same(case):
    made, rows, _, figures, *_ = case
    sent = pickle.loads(pickle.dumps(made))
    assert sent.identity == made.identity
    own, other = (x.evaluate(rows, figures, "shown") for x in (made, sent))
    assert np.array_equal(own.values, other.values) and np.array_equal(own.codes, other.codes)


def test_a_row_that_fails_is_nan_with_a_code_and_leaves_no_trace(case):
    made, rows, wrong, figures, *_ = case
    values, codes, _ = made.evaluate([wrong, rows[0]], figures, "shown")
    assert np.isnan(values[0]).all() and made.reasons[codes[0]]
    assert np.array_equal(values[1], made.evaluate(rows[:1], figures, "shown").values[0])


def test_all_that_a_row_names_is_a_quantity_with_a_range_and_all_asked_a_figure(case):
    made, rows, _, figures, *_ = case
    for name in {name for row in rows for name in row}:
        q = made.quantities[name]
        assert q.low <= q.nominal <= q.high and q.name == name
    assert all(made.figures[name].name == name for name in figures)


def test_a_gradient_is_the_difference_of_rows_or_not_known(case):
    made, rows, _, figures, name, _ = case
    if name is None:
        assert made.gradient(rows[0], figures, [*rows[0]][:1]) is None
        return
    found, x = made.gradient(rows[0], figures, [name]), rows[0][name]
    ends = made.evaluate([{**rows[0], name: x * s} for s in (1.0 - 1e-4, 1.0 + 1e-4)], figures)
    slopes = (ends.values[1] - ends.values[0]) / (2e-4 * x)
    assert found.slopes[:, 0] == pytest.approx(slopes, rel=1e-3)
    assert found.values == pytest.approx(made.evaluate(rows[:1], figures).values[0], rel=1e-9)


@pytest.mark.parametrize("kind", PARTS)
def test_the_file_of_a_parts_row_runs_and_gives_the_same(kind, tmp_path):
    make, rows, _, figures, *_ = CASES[kind]
    made, path = make(), tmp_path / "part.toml"
    row = {**made.inputs, **rows[0]}
    path.write_text(made.file(row), "utf-8")
    found = load_part(path).solve()
    values = made.evaluate([row], figures).values[0]
    assert [getattr(found, n) for n in figures] == pytest.approx(values.tolist(), rel=1e-12)


def test_a_function_has_no_file():
    with pytest.raises(ParameterError, match="picky: a function has no file"):
        CASES["function"].make().file({"a": 9.0})


@pytest.mark.parametrize(
    ("kind", "more"), [("engagement", ["--workers", "1"]), ("gearbox", ["--json"])]
)
def test_the_file_of_a_row_runs_by_the_command_it_names(kind, more, tmp_path, capsys):
    make, rows, _, figures, *_ = CASES[kind]
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
    make, rows, _, figures, *_ = CASES["shift"]
    made, path = make(), tmp_path / "scene.toml"
    path.write_text(made.file(rows[0]), "utf-8")
    found = run_shift(load_scene(path)).figures
    values = made.evaluate(rows[:1], figures, "shown").values[0]
    assert [found[n] for n in figures] == pytest.approx(values.tolist(), rel=1e-9)


def swept(kind, **how):
    """Return a sweep of the rows of a case, each complete."""
    made, rows = CASES[kind].make(), CASES[kind].rows
    usual = {n: made.quantities[n].nominal for row in rows for n in row}
    columns = {n: [{**usual, **row}[n] for row in rows] for n in usual}
    if kind not in PARTS:
        return run_sweep(made, points=columns, **how)
    at = {name: x for name, x in made.inputs.items() if name not in columns}
    return run_sweep(made.part, points=columns, at=at, **how)


def are_same(one, two):
    def equal(a, b):  # where a row has no such figure neither has a number
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")

    names = [*one.columns]
    return names == [*two.columns] and all(equal(one[n], two[n]) for n in names)


@pytest.mark.parametrize(
    "kind", [k if k == "engagement" else pytest.param(k, marks=pytest.mark.slow) for k in CASES]
)
def test_a_sweep_is_the_same_for_any_workers(kind):
    assert are_same(swept(kind, workers=2), swept(kind, workers=1))


@each
def test_a_sweep_that_was_stopped_goes_on_and_ends_the_same(kind, tmp_path):
    out = tmp_path / "rows.csv"
    with pytest.raises(Stop):
        swept(kind, workers=1, out=out, progress=stopping_after(1))
    assert not out.exists()
    counts = []
    again = swept(kind, workers=1, out=out, progress=lambda done, _: counts.append(done))
    assert 0 < counts[0] < len(again) and are_same(again, swept(kind, workers=1))


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
