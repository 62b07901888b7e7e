"""Recordings of engagements: parameters found again with honest intervals, or what stops it."""

import json
import sys
import tracemalloc
from dataclasses import replace
from functools import partial
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from rigs import OIL, PACK, TRUTH, WORN, advances_by, history, recorded
from scipy.stats import binom

from thrustwasher import ClutchParams, ParameterError, calibrate_traces, engage_clutch
from thrustwasher.studio.calibration.engagement import trace_fit
from thrustwasher.studio.calibration.engagement.pack_history import walk_pack
from thrustwasher.studio.calibration.engagement.traced_pack import traced_pack
from thrustwasher.studio.calibration.identifiability import information
from thrustwasher.studio.calibration.traces.binned import binned, smoothed
from thrustwasher.studio.calibration.traces.recording import Recording, pieces, row_scatter
from thrustwasher.studio.calibration.traces.trace_problem import input_shifts

EXAMPLES = Path(__file__).parents[3] / "examples"
sys.path.insert(0, str(EXAMPLES))
import ex17_engagement as rig  # noqa: E402


def wheel(n=601, seed=1, **around):
    """Return a recording of a wheel that a pack stops; its slip comes out of the balance."""
    way = history(n) | {"speed": np.full(n, 300.0)}
    rig = replace(traced_pack(WORN), inertia=0.25, **around)
    inputs = {n: np.broadcast_to(x, way["time"].shape) for n, x in way.items() if n != "time"}
    inputs |= {"oil_temperature": np.full(n, OIL), "drum_speed": np.zeros(n)}
    run = binned(Recording("wheel", way["time"], inputs, {}), n, "load", 5000.0)
    out, rng = walk_pack(rig, "field", run), np.random.default_rng(seed)
    noisy = {
        "speed": out["slip"] + 0.3 * rng.standard_normal(n),
        "friction_torque": out["friction_torque"] + 1.5 * rng.standard_normal(n),
    }
    return {**way, "oil_temperature": OIL, **noisy}


def values(found):
    return {e.name: e.value for e in found.estimates}


def holds(found, truth):
    """Return by parameter whether its interval holds the truth."""
    ends = {name: found[name].interval for name in truth}
    return {name: ends[name][0] <= truth[name] <= ends[name][1] for name in truth}


def test_a_recording_without_noise_gives_the_parameters_back():
    found = calibrate_traces(PACK, recorded(noise=0.0, way=history(201)), fit=tuple(TRUTH))
    assert values(found) == pytest.approx(TRUTH, rel=1e-5)
    assert {name: getattr(found.params, name) for name in TRUTH} == values(found)
    assert type(found.params) is ClutchParams and not found.warnings


def test_a_start_far_away_finds_the_same():
    start = replace(PACK, permeability=1e-14, friction_scale=1.4)
    found = calibrate_traces(start, recorded(), fit=tuple(TRUTH))
    assert values(found) == pytest.approx(TRUTH, rel=0.1)


def without(name, **changes):
    """Return the recording of a wheel with a drag that lacks a column."""
    return {n: x for n, x in wheel(drag_torque=2.0, **changes).items() if n != name}


def rough(seed):
    """Return the rig's recording with scatter of its pressure."""
    with patch.dict(rig.NOISE, pressure=2e3):
        return rig.rows(seed)


AREA = {"piston_area": rig.AREA}
BY_TORQUE = {"inertia": 0.25, "drag_torque": 2.0, "at": {"speed": 300.0}}
INTERVALS = {  # recording by seed, how many, truth, the test rig
    "the piston's fill": (rig.rows, 10, rig.TRUTH, AREA),  # the next one has all of its claims
    "scatter of the pressure": (rough, 30, rig.TRUTH, AREA),
    "slip that comes out": (lambda seed: wheel(151, seed), 30, TRUTH, {"inertia": 0.25}),
    "slip by the torque": (lambda seed: without("speed", seed=seed), 30, TRUTH, BY_TORQUE),
}


@pytest.mark.slow
@pytest.mark.parametrize("case", INTERVALS)
def test_95_percent_intervals_hold_in_95_percent_of_recordings(case):
    """Between the 0.05 % and 99.95 % quantiles of the binomial distribution."""
    made, n, truth, around = INTERVALS[case]
    held = dict.fromkeys(truth, 0)
    for seed in range(n):
        found = calibrate_traces(PACK, made(seed), fit=tuple(truth), **around)
        if made is rig.rows:
            assert found.engagements == 2 and not found.warnings
            assert all(e.identifiable for e in found.estimates)
        held = {name: held[name] + inside for name, inside in holds(found, truth).items()}
    low, high = binom.interval(0.999, n, 0.95)
    assert all(low <= count <= high for count in held.values()), held


@pytest.mark.slow
def test_noise_that_is_in_slip_and_torque_widens_the_interval():
    """By some percent: a higher torque makes slip lower, and a lower slip friction higher."""
    found = calibrate_traces(PACK, without("speed"), fit=tuple(TRUTH), **BY_TORQUE)
    alone = partial(input_shifts, replace(found.points, follows=None))
    exact = replace(found._problem, input_shifts=alone)
    narrow = information(exact, found._best, 0.95)
    friction = np.array([1.0, 0.0])
    ratio = found._learned.error_of(friction) / narrow.error_of(friction)
    assert 1.04 < ratio < 1.12


def test_the_shipped_recording_is_what_its_script_makes():
    found = trace_fit.COLUMNS
    from thrustwasher.studio.calibration.traces.trace_file import read_trace

    runs, passed, _ = read_trace(rig.TRACE, found, trace_fit.MEASURED)
    (columns,), made = runs.values(), rig.rows()
    assert columns.keys() == made.keys() and not passed
    digits = {"pressure": 60.0, "speed": 0.006, "friction_torque": 0.006}  # as written, rounded
    for name, close in digits.items():
        assert np.abs(columns[name] - made[name]).max() < close
    assert "no rig" in rig.TRACE.read_text("utf-8").splitlines()[0]


@pytest.mark.slow
def test_a_law_that_does_not_fit_is_found_out_by_its_residuals():
    """Friction that falls with slip, fitted by a constant coefficient."""
    falls = ClutchParams.preset("paper", **TRUTH)
    start = replace(falls, friction_law="constant", friction_scale=1.0)
    fit = ("constant_friction", "permeability")
    wrong = calibrate_traces(start, recorded(falls), fit=fit)
    right = calibrate_traces(replace(falls, friction_scale=1.0), recorded(falls), fit=tuple(TRUTH))
    words = "The model does not describe the time history of friction_torque"
    assert wrong.warnings[0].startswith(words)
    assert wrong.patterns[0].is_found and wrong.patterns[0].chi_square > 5.0
    assert not right.warnings and right.patterns[0].p_value > 1e-4


@pytest.mark.slow
def test_the_right_law_is_not_suspected():
    """Residuals of independent scatter do not hang together."""
    for seed in range(5):
        found = calibrate_traces(PACK, recorded(seed=seed), fit=["friction_scale", "permeability"])
        assert not found.warnings and 0.7 < found.patterns[0].chi_square < 1.4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lacking", "told", "around"),
    [
        ("friction_torque", "slip", {"inertia": "0.25 kg.m2", "drag_torque": "2 N.m"}),
        ("speed", "friction_torque", BY_TORQUE),
    ],
)
def test_slip_or_torque_alone_tells_friction_where_the_inertia_is_known(lacking, told, around):
    found = calibrate_traces(PACK, without(lacking), fit=tuple(TRUTH), **around)
    assert found.points.names == (told,)
    assert lacking == "speed" or all(holds(found, TRUTH).values())
    assert values(found) == pytest.approx(TRUTH, rel=0.05)
    by_torque = any("by the recorded torque" in note for note in found.notes)
    assert by_torque == (lacking == "speed")


@pytest.mark.slow
def test_torque_and_slip_together_tell_the_drag_too():
    found = calibrate_traces(
        PACK, wheel(drag_torque=6.0), fit=(*TRUTH, "drag_torque"), inertia=0.25
    )
    assert found["drag_torque"].value == pytest.approx(6.0, abs=1.0)
    assert all(holds(found, {**TRUTH, "drag_torque": 6.0}).values())


@pytest.mark.slow
def test_a_noisy_first_temperature_does_not_shift_all_that_follow():
    way, truth, held = history(), {"friction_scale": 0.92}, 0
    exact = engage_clutch(WORN, **way, oil_temperature=OIL).temperature
    for seed in range(5):
        noisy = exact + 0.3 * np.random.default_rng(seed).standard_normal(301)
        data = {**way, "oil_temperature": OIL, "temperature": noisy}
        at = {"permeability": 3e-13}
        held += holds(calibrate_traces(PACK, data, fit=tuple(truth), at=at), truth)[
            "friction_scale"
        ]
    assert held >= 4


def test_slip_from_the_balance_of_torques_converges_with_the_square_of_the_step():
    rig = replace(traced_pack(WORN), inertia=0.25)

    def slip(n):
        time = np.linspace(0.1, 0.4, n)
        inputs = {"load": np.full(n, 4e3), "speed": np.full(n, 300.0)}
        inputs |= {"oil_temperature": np.full(n, OIL), "drum_speed": np.zeros(n)}
        whole = Recording("wheel", time, inputs, {})
        return walk_pack(rig, "field", binned(whole, n, "load", 4e3))["slip"][-1]

    fine = slip(4801)
    errors = [abs(slip(n) - fine) for n in (76, 151, 301)]
    assert errors[0] / errors[1] > 3.0 and errors[1] / errors[2] > 3.0


def test_energy_of_the_wheel_goes_into_the_pack_and_the_drag():
    """Inertia times slip squared, halved, is the work of both torques."""
    way = wheel(n=1201, drag_torque=3.0)
    exact = replace(traced_pack(WORN), inertia=0.25, drag_torque=3.0)
    inputs = {n: np.asarray(way[n]) for n in ("load",)} | {"speed": np.full(1201, 300.0)}
    inputs |= {"oil_temperature": np.full(1201, OIL), "drum_speed": np.zeros(1201)}
    run = binned(Recording("wheel", way["time"], inputs, {}), 1201, "load", 5000.0)
    out = walk_pack(exact, "field", run)
    free = (run.engaged > 0) & (out["slip"] > 5.0)
    slip, torque, time = out["slip"][free], out["friction_torque"][free] + 3.0, run.time[free]
    work = float(np.sum(0.25 * np.diff(time) * (torque[1:] + torque[:-1]) * (slip[1:] + slip[:-1])))
    assert work == pytest.approx(0.5 * 0.25 * (slip[0] ** 2 - slip[-1] ** 2), rel=1e-4)


def test_torque_at_the_hub_has_its_inertia_times_acceleration():
    way = history()
    hub = recorded(noise=0.0, way=way)
    hub["friction_torque"] = hub["friction_torque"] - 0.005 * 300.0 / 0.6
    at_hub = calibrate_traces(
        PACK, hub, fit=["friction_scale"], at={"permeability": 3e-13}, torque_at="hub",
        inertia_between="0.005 kg.m2",
    )  # fmt: skip
    as_pack = calibrate_traces(PACK, hub, fit=["friction_scale"], at={"permeability": 3e-13})
    assert at_hub.params.friction_scale == pytest.approx(0.92, rel=1e-4)
    assert as_pack.params.friction_scale < 0.915
    assert any("hub" in note for note in at_hub.notes)


@pytest.mark.slow
def test_temperature_and_torque_are_fitted_together():
    way = history()
    made = engage_clutch(replace(WORN, heat_transfer=3000.0), **way, oil_temperature=OIL)
    rng = np.random.default_rng(3)
    data = {
        **way,
        "oil_temperature": OIL,
        "friction_torque": made.friction_torque + 1.5 * rng.standard_normal(301),
        "temperature": made.temperature + 0.5 * rng.standard_normal(301),
    }
    fit = ("friction_scale", "steel_thickness")
    start = replace(WORN, heat_transfer=3000.0, steel_thickness=1.6e-3, friction_scale=1.0)
    errors = {"friction_torque": "1.5 N.m", "temperature": "0.5 K"}
    found = calibrate_traces(start, data, fit=fit, errors=errors)
    assert found.params.steel_thickness == pytest.approx(2e-3, rel=0.02)
    assert found.reduced_chi_square == pytest.approx(1.0, abs=0.3)
    by_rows = calibrate_traces(start, data, fit=fit)
    assert any("scatter of rows" in note for note in by_rows.notes)
    assert by_rows.params.steel_thickness == pytest.approx(2e-3, rel=0.02)


@pytest.mark.slow
def test_several_recordings_count_like_one_another():
    light = history()
    light["load"] = 0.4 * light["load"]
    both = calibrate_traces(PACK, [recorded(), recorded(seed=2, way=light)], fit=tuple(TRUTH))
    alone = calibrate_traces(PACK, recorded(), fit=tuple(TRUTH))
    assert both.engagements == 2 and "2 engagements in 2 recordings" in str(both)
    for name in TRUTH:
        assert both[name].standard_error < alone[name].standard_error
    histories = both.histories()
    assert [c.recording for c in histories] == ["recording 1", "recording 2"]
    assert all(len(c.time) == len(c.measured) == len(c.computed) for c in histories)


@pytest.mark.slow
@pytest.mark.parametrize("gap", [-0.6, 5.0], ids=["time returns", "time leaps"])
def test_engagements_written_one_after_the_other_are_parted(gap):
    one, two = recorded(), recorded(seed=2)
    shift = one["time"][-1] + gap
    joined = {n: np.append(one[n], two[n]) for n in ("load", "speed", "friction_torque")}
    joined |= {"time": np.append(one["time"], two["time"] + shift), "oil_temperature": OIL}
    found = calibrate_traces(PACK, joined, fit=tuple(TRUTH))
    apart = calibrate_traces(PACK, [one, two], fit=tuple(TRUTH))
    assert found.engagements == 2 and any("where time jumps" in note for note in found.notes)
    assert values(found) == pytest.approx(values(apart), rel=1e-9)


def test_a_pack_that_stays_pressed_starts_settled():
    way = {n: x[100:] for n, x in history().items()}
    made = engage_clutch(replace(WORN, starts_pressed=True), **way, oil_temperature=OIL)
    data = {**way, "oil_temperature": OIL, "friction_torque": made.friction_torque}
    found = calibrate_traces(PACK, data, fit=["friction_scale"], at={"permeability": 3e-13})
    assert found.params.friction_scale == pytest.approx(0.92, rel=1e-4)


@pytest.mark.slow
def test_what_torque_cannot_tell_is_named():
    found = calibrate_traces(PACK, recorded(), fit=[*TRUTH, "oil_density"])
    assert not found["oil_density"].identifiable and found["oil_density"].reason
    assert found["friction_scale"].identifiable
    assert "one product of friction, force and radius" in str(found)


@pytest.mark.slow
def test_means_follow_the_history_and_not_the_number_of_rows(monkeypatch):
    sizes, steps = [], []
    recordings = {n: recorded(way=history(n)) for n in (20_001, 200_001)}

    def counted(advance):
        def call(*words):
            steps[-1] += 1
            return advance(*words)

        return call

    advances_by(monkeypatch, counted)
    for n, data in recordings.items():
        steps.append(0)
        found = calibrate_traces(PACK, data, fit=["friction_scale"], at={"permeability": 3e-13})
        sizes.append(len(found.points.runs[0].time))
        assert found.params.friction_scale == pytest.approx(0.92, rel=1e-3)
        assert f"{n} rows are fitted as" in str(found)
    assert max(sizes) <= trace_fit.MOST_MEANS
    assert steps[1] < 1.5 * steps[0]


@pytest.mark.slow
def test_a_long_recording_takes_the_memory_of_a_few_copies_of_its_rows():
    few, many = history(10_001), history(110_001)
    peaks = []
    for way in (few, many):
        data = {**way, "oil_temperature": OIL, "friction_torque": way["load"] / 30.0}
        calibrate_traces(PACK, data, fit=["friction_scale"])
        tracemalloc.start()
        calibrate_traces(PACK, data, fit=["friction_scale"])
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    column = 8 * 100_000
    assert peaks[1] - peaks[0] < 30 * column


@pytest.mark.slow
def test_rows_closer_in_time_than_the_clock_tells_are_taken_together():
    data = recorded(way=history(2401))
    data["time"] = np.round(data["time"], 3)  # four rows to a tick
    found = calibrate_traces(PACK, data, fit=tuple(TRUTH))
    assert values(found) == pytest.approx(TRUTH, rel=0.1)


def test_scatter_of_rows_is_told_beside_their_history():
    x = np.linspace(0.0, 1.0, 5001)
    noise = np.random.default_rng(5).standard_normal(5001)
    assert row_scatter(np.exp(x) + 0.01 * noise) == pytest.approx(0.01, rel=0.05)
    assert row_scatter(np.exp(x)) < 1e-6


@pytest.mark.slow
def test_scatter_of_the_recorded_force_widens_the_intervals():
    exact, fit = recorded(), (*TRUTH, "fill_time")
    rng = np.random.default_rng(2)
    rough = {**exact, "load": np.maximum(exact["load"] + 60.0 * rng.standard_normal(301), 0.0)}
    found, doubtful = (calibrate_traces(PACK, data, fit=fit) for data in (exact, rough))
    for name in fit:
        assert doubtful[name].standard_error > found[name].standard_error
    again = calibrate_traces(PACK, rough, fit=fit)
    assert values(again) == values(doubtful)
    assert again["fill_time"].interval == doubtful["fill_time"].interval


def test_recorded_inputs_are_smoothed_where_they_scatter_and_only_there():
    """A straight line stays, corners of an exact history too; scatter is averaged."""
    time = np.sort(np.random.default_rng(1).uniform(0.0, 1.0, 4001))
    even = np.linspace(0.0, 1.0, 4001)
    noise = np.random.default_rng(2).standard_normal(4001)
    corner = np.maximum(even - 0.3, 0.0)
    np.testing.assert_array_equal(smoothed(even, corner), corner)
    np.testing.assert_allclose(smoothed(time, 3.0 * time), 3.0 * time, atol=1e-12)
    found = smoothed(even, corner + 0.01 * noise) - corner
    assert found.std() == pytest.approx(0.01 * (6.0 / 16.0) ** 0.5, rel=0.05)


def test_a_pressure_in_another_unit_is_doubted():
    data = {n: x for n, x in recorded().items() if n != "load"}
    data["pressure"] = recorded()["load"] / 6e-3 / 1e5  # bar, and called Pa
    found = calibrate_traces(PACK, data, fit=["friction_scale"], piston_area=6e-3)
    assert any("if the column is in another unit" in text for text in found.warnings)


def test_jumps_of_time_part_a_recording():
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 100.0, 101.0, 102.0, 103.0, 104.0, 50.0, 51.0,
                     52.0, 53.0, 54.0])  # fmt: skip
    whole = Recording("a", time, {"load": time}, {"x": time})
    assert [len(piece.time) for piece in pieces(whole, "load")] == [6, 5, 5]


def test_the_result_is_plain_data_a_table_and_a_picture():
    found = calibrate_traces(PACK, recorded(), fit=tuple(TRUTH))
    record = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert record["engagements"] == 1 and len(record["time"]) == len(record["measured"])
    assert record["patterns"][0]["is_found"] is False
    assert len(found.plot().axes) == 2
    assert {"time", "recording", "load", "measured"} <= {*found.to_pandas().columns}
    assert "permeability" in found._repr_html_()


def offset(shift):
    """Return a recording that begins and ends with an open pack, its torque off by an offset."""
    way = history()
    way["load"] = np.where(way["time"] < 0.1, 0.0, way["load"])
    data = recorded(way=way)
    return data | {"friction_torque": data["friction_torque"] + shift}


@pytest.mark.slow
def test_a_zero_offset_of_the_torque_is_a_hint_and_stops_nothing():
    """With the pack open the sensor shows -15 N m, 7 % of the largest torque."""
    found = calibrate_traces(PACK, offset(-15.0), errors={"friction_torque": "1.5 N.m"})
    (hint,) = [text for text in found.warnings if "zero offset" in text]
    assert "With the open pack the recorded torque lies -1" in hint
    sound = calibrate_traces(PACK, offset(0.0), errors={"friction_torque": "1.5 N.m"})
    assert not [text for text in sound.warnings if "zero offset" in text]


@pytest.mark.slow
def test_an_offset_of_the_torque_is_fitted_with_its_interval_or_held():
    """Fitted it is found within 1 N m; held, the others are those of a recording without one."""
    data = recorded()
    shown = data | {"friction_torque": data["friction_torque"] - 4.0}
    found = calibrate_traces(PACK, shown, fit=(*TRUTH, "torque_offset"))
    own = {e.name: e for e in found.estimates}
    low, high = own["torque_offset"].interval
    assert low < -4.0 < high and high - low < 2.0 and own["torque_offset"].identifiable
    assert values(found)["friction_scale"] == pytest.approx(TRUTH["friction_scale"], rel=0.01)
    held = calibrate_traces(PACK, shown, fit=tuple(TRUTH), torque_offset="-4 N.m")
    sound = calibrate_traces(PACK, data, fit=tuple(TRUTH))
    assert values(held) == pytest.approx(values(sound), rel=1e-4)
    assert type(found.params) is ClutchParams


def test_a_pressed_pack_may_have_torque_on_the_wrong_side_as_its_error_says():
    data = recorded()
    row = int(np.argmax(data["load"] > 500.0))  # pressed, its torque still small
    data["friction_torque"][row] = -25.0
    with pytest.raises(ParameterError, match="against the sign of the others"):
        calibrate_traces(PACK, data)
    found = calibrate_traces(PACK, data, errors={"friction_torque": "15 N.m"})
    assert found.params.friction_scale == pytest.approx(0.92, rel=0.1)


def followed(seed, share=0.7):
    """Return a recording whose noise follows itself from row to row, and its truth."""
    rng, data = np.random.default_rng(seed), recorded(noise=0.0)
    noise = np.zeros(len(data["time"]))
    for i, x in enumerate(rng.standard_normal(len(noise))):
        noise[i] = (share * noise[i - 1] if i else 0.0) + 1.5 * x
    return data | {"friction_torque": data["friction_torque"] + noise}


@pytest.mark.slow
def test_residuals_that_follow_each_other_widen_the_intervals():
    """Noise with a correlation of 0.7 from row to row: a factor of 2.4, and coverage holds."""
    inside = 0
    for seed in range(8):
        found = calibrate_traces(WORN, followed(seed), fit=["friction_scale"])
        inside += holds(found, {"friction_scale": 0.92})["friction_scale"]
    assert inside >= 6
    assert "of 299 values counted" in str(found)
    assert found.to_dict()["residual_correlation"] == pytest.approx(0.7, abs=0.15)
    plain = calibrate_traces(WORN, recorded(), fit=["friction_scale"])
    assert plain.to_dict()["residual_correlation"] == 0.0
    assert found["friction_scale"].standard_error > 2.0 * plain["friction_scale"].standard_error


@pytest.mark.parametrize("head", ["speed [rpm]", "sliding_speed [mm/s]"])
def test_its_picture_has_the_units_of_the_file(head, tmp_path):
    data, file = wheel(101), tmp_path / "stop.csv"
    size = {"speed [rpm]": np.pi / 30.0, "sliding_speed [mm/s]": 1e-3 / WORN.friction_radius}[head]
    columns = [
        1e3 * data["time"],
        data["load"] / (1e5 * 6e-3),
        data["speed"] / size,
        1e-3 * data["friction_torque"],
    ]
    rows = [",".join(map(repr, row)) for row in np.column_stack(columns).tolist()]
    file.write_text("\n".join([f"time [ms],pressure [bar],{head},friction_torque [kNm]", *rows]))
    found = calibrate_traces(
        PACK,
        file,
        fit=["friction_scale"],
        inertia=0.25,
        piston_area=6e-3,
        at={"permeability": 3e-13},
    )
    unit = head.partition("[")[2]
    torque, off, slip, off_slip = found.plot().axes
    assert [a.get_xlabel() for a in (torque, off, slip, off_slip)] == 4 * ["time [ms]"]
    assert (torque.get_ylabel(), off.get_ylabel()) == ("[kNm]", "measured - fitted [kNm]")
    assert (slip.get_ylabel(), off_slip.get_ylabel()) == (f"[{unit}", f"measured - fitted [{unit}")
    for axis, column in ((torque, columns[3]), (slip, columns[2])):
        time, values = axis.lines[0].get_data()
        there = np.interp(time, columns[0], column)
        assert values == pytest.approx(there, rel=1e-9, abs=1e-9 * np.abs(column).max())
