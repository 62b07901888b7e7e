"""Bands of a built-in scene, known without a study: shown while nothing of it was changed."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import changed, slow_without_jit

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.account.shift_record import record_of
from thrustwasher.shift.account.what_happened import headline, known_texts
from thrustwasher.shift.scene.scene_file import known_bands
from thrustwasher.studio.report.shift.shift_report import _cards
from thrustwasher.studio.report.shift.usual import usual_table
from thrustwasher.studio.scatter.propagate import propagate
from thrustwasher.units import format_quantity


@pytest.fixture(scope="module")
def found():
    scene = load_scene("planetary")
    parts = scene.parts.items()
    return cosimulate(
        scene, {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in parts}
    )


@slow_without_jit
def test_the_first_screen_shows_the_median_and_the_nominal_jerk_beside(found):
    """What real units do is the headline: the nominal run alone may lie outside of the band."""
    record = record_of(found)
    low, middle, high = known_bands(found.scene)["peak_jerk"].quantiles.values()
    nominal = found.figures["peak_jerk"]
    low_, middle_, high_, own = (
        format_quantity(x, "m/s3", digits=3) for x in (low, middle, high, nominal)
    )
    words = f"is {middle_} (median; {low_} to {high_} from 5 to 95 %), {own} with nominal values"
    assert words in headline(record) and words in known_texts(record)[0]
    (card,) = [c for c in _cards(record) if "change of acceleration" in c.name]
    value, note = (str(x).replace("\N{NO-BREAK SPACE}", " ") for x in (card.value, card.note))
    assert value == middle_ and not card.figure  # no script writes the nominal value over it
    assert f"5 .. 95 %: {low_} .. {high_}<br>nominal values: {own}" in note
    (row,) = [row for row in usual_table(record).rows if row[0].startswith("jerk of the vehicle")]
    assert row[4] == ("▲\N{NO-BREAK SPACE}above" if middle > 15.0 else "")
    assert found.to_dict()["known_bands"]["peak_jerk"]["quantiles"]["0.5"] == middle


@slow_without_jit
def test_what_is_known_is_of_this_version(found):
    """Else: python -m lab.benchmarks.scatter_scene bands FILE, which is known_bands.toml."""
    for name, band in known_bands(found.scene).items():
        now = found.figures.get(name)
        assert now is None or now == pytest.approx(band.nominal, rel=0.02), name


def test_nothing_is_known_of_a_changed_scene(tmp_path):
    scene = load_scene("planetary")
    assert known_bands(scene)
    assert known_bands(scene.with_options(step=5e-4, master="jacobi"))
    other = changed(tmp_path, "[clutch]\nfriction_scale = 0.98\n")
    assert known_bands(replace(other, name="planetary")) == {}
    assert known_bands(load_scene("planetary-cold")) == {}


def test_profiles_are_tuned_for_the_scatter():
    """The profiles that suit nominal values: 12 m/s3 with them, 112 in the worst twentieth."""
    jerk = known_bands(load_scene("planetary"))["peak_jerk"]
    low, middle, high = jerk.quantiles.values()
    assert low < jerk.nominal < middle * 1.1 and high < 0.5 * 112.0


@pytest.mark.slow
def test_a_study_finds_the_known_bands_and_the_nominal_run_in_their_middle():
    """Not so what washers take and how hot they get: share and oil lie low in their ranges."""
    scene = load_scene("planetary")
    study = propagate(scene, runs=64, workers=1, indices=False)
    figures = study.figures
    for name in known_bands(scene).keys() - {"washer_torque", "peak_washer_temperature_max"}:
        low, high = np.nanquantile(study.sample[name], [0.25, 0.75])
        assert low <= figures[name].nominal <= high, name
    for name, known in known_bands(scene).items():
        for level, value in known.quantiles.items():
            low, high = figures[name].confidence[level]
            room = 0.1 * abs(known.quantiles[0.95] - known.quantiles[0.05])
            assert low - room <= value <= high + room or not np.isfinite([low, high]).all(), name
