"""The page of a study says what its result says, and nothing that is no number."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scatter_stand_in import LEVELS, NOTHING, SOURCES, band, study

from thrustwasher.studio.report.html import Plot, Section, Table, render, themed
from thrustwasher.studio.report.scatter import scatter_page
from thrustwasher.studio.report.scatter.decides import RANK, leading, shares, verdict
from thrustwasher.studio.report.scatter.scatter_plots import bar_figure, decided_over_time
from thrustwasher.studio.report.scatter.scatter_tables import (
    error_table,
    figure_table,
    matrix_table,
)
from thrustwasher.studio.report.scatter.words import band_words, named, percent, short_title
from thrustwasher.studio.scatter.result import Probability

FILM = "minimum_washer_film_ratio"
MINUS = "\N{MINUS SIGN}"


def section(page, anchor):
    return next(s for s in page.sections if s.anchor == anchor)


def words_of(page):
    """Return what a reader sees of the page, without drawings."""
    text = re.sub(r"<(svg|script|style)\b.*?</\1>", "", render(page), flags=re.DOTALL)
    return re.sub(r"<[^>]+>", " ", text)


def test_the_picture_comes_first_then_what_it_rests_on():
    anchors = [s.anchor for s in scatter_page(study()).sections]
    assert anchors == [
        *("bands", "spread", "figures", "decides", "over-time", "sources", "errors", "nearest"),
        "runs",
    ]
    of_a_part = scatter_page(study(kind="part", series={}))
    assert of_a_part.sections[0].anchor == "spread"


def test_a_train_leads_with_the_power_lost_and_has_lives_in_hours():
    """Efficiencies of 97.6 to 97.72 % differ in the third digit of the loss."""
    share = 0.976 + 0.0012 * np.linspace(0.0, 1.0, 64)
    figures = {
        "efficiency": band(share, "1", "what comes out over what goes in (-1: nothing)", 0.9),
        "bearing_life": band(3.6e7 * (1.0 + np.linspace(0.0, 1.0, 64)), "s", "minimum life", 0.9),
    }
    sample = {name: share for name in figures} | {s.name: share for s in SOURCES}
    page = scatter_page(
        study(kind="part", series={}, model="train", figures=figures, sample=sample, nearest={})
    )
    lost, life = page.cards[0], page.cards[1]
    assert (lost.name, lost.value) == ("loss, of the power in", "2.29 .. 2.39 %")
    assert life.value == "10500 .. 19500 h"


def test_a_figure_stands_with_band_range_and_probability():
    row = figure_table(study()).rows[0]
    assert row[0] == "shift duration, start until clutch locks [s]"
    low, middle, high = (float(x) for x in row[2:5])
    assert low < middle < high and middle == pytest.approx(0.84, abs=2e-3)
    assert row[5:] == ("0.3 .. 0.8 s", "0 % below, 100 % above (20 .. 44 %)")


def test_probabilities_are_at_the_top_with_their_confidence():
    page = scatter_page(study())
    assert ("probability: film lost", "25 %") in [(c.name, c.value) for c in page.cards]
    assert any("Film lost: probability 25 % (16 .. 36 %)" in text for text in page.summary)


def test_each_source_says_what_it_rests_on():
    rows = section(scatter_page(study()), "sources").tables[0].rows
    assert rows[0] == ("transmission: thrust share", "0.1", "uniform 0.04 .. 0.16", "estimate")
    assert rows[1][1:] == ("80 °C", "normal, standard deviation 3 K", "ISO 0815")
    assert rows[2][1:] == ("cyclic", "either cyclic or none", "given")


def test_a_part_s_point_correlations_and_command_are_there():
    pair = ("oil_temperature", "transmission.thrust_share", -0.5)
    setting = {"fidelity level": "field", "speed": "545 rad/s"}
    changes = {"kind": "part", "setting": setting, "model": "washer", "correlations": (pair,)}
    page = scatter_page(study(**changes), {"slip_energy": {0.5: "heat-50.toml"}})
    assert "Part made-up (fidelity level field, speed 545 rad/s), 3 inputs" in page.subtitle
    texts = section(page, "sources").texts
    assert texts[1:] == [
        "Held: fidelity level field, speed 545 rad/s.",
        "Correlated, by their normal scores: oil temperature and transmission: thrust share "
        f"{MINUS}0.50.",
    ]
    assert "thrustwasher washer --part FILE solves it" in section(page, "nearest").texts[0]


def test_a_nominal_value_outside_its_band_is_said_first():
    found = study()
    heat = replace(found.figures["slip_energy"], nominal=9e3)
    page = scatter_page(replace(found, figures={**found.figures, "slip_energy": heat}))
    assert page.summary[-1] == (
        "The nominal value is not what to expect: heat in the clutch 9 kJ against 10.9 .. 11.1 kJ "
        "in nine of ten runs, median 11 kJ."
    )
    assert not any("not what to expect" in text for text in scatter_page(found).summary)


def test_a_probability_has_no_more_digits_than_its_runs_tell():
    assert [percent(x, 64) for x in (5 / 64, 0.0, 63.9 / 64)] == ["8 %", "0 %", "above 99 %"]
    assert [percent(x, 1024) for x in (1 / 1024, 80 / 1024)] == ["0.1 %", "7.8 %"]


def test_a_loose_quantile_shows_its_confidence_on_the_card():
    found = study()
    film = found.figures["minimum_washer_film_ratio"]
    loose = replace(film, confidence=film.confidence | {0.95: (5.0, np.inf)})
    figures = {**found.figures, "minimum_washer_film_ratio": loose}
    notes = {c.name: c.note for c in scatter_page(replace(found, figures=figures)).cards}
    own = notes["minimum film ratio of the washers"]
    assert own.endswith("95 % quantile by 95 % confidence: 5 or more")
    assert "confidence" not in notes["heat in the clutch"]


def test_errors_are_compared_only_where_more_than_the_inputs_is_known():
    """A choice of the model, or a numerical error; else notes stand with the runs."""
    found = study()
    bare = {name: replace(own, error=None) for name, own in found.figures.items()}
    known = tuple(s for s in found.sources if not isinstance(s.nominal, str))
    alone = scatter_page(replace(found, figures=bare, sources=known, notes=("a note",)))
    assert "errors" not in [s.anchor for s in alone.sections]
    assert section(alone, "runs").texts[-1] == "A note."
    assert section(scatter_page(found), "errors").tables


def test_a_title_above_a_small_picture_is_short():
    lock, long = study().figures["slip_energy"], "minimum separation of the mean surfaces"
    assert short_title("slip_energy", lock) == "heat in the clutch"
    assert short_title("film_thickness", replace(lock, help=long)) == "film thickness"


def test_what_stays_folded_alone_is_not_printed():
    folded = Table(["a"], [["1"]], folded=True, stays=True)
    assert Section("s", "S", texts=["words"], tables=[folded]).unprinted
    assert not Section("s", "S", tables=[folded, replace(folded, stays=False)]).unprinted
    assert not Section("s", "S", texts=["words"]).unprinted


def test_both_ends_of_a_band_have_as_many_digits():
    at = dict(zip(LEVELS, (0.1923, 0.999, 0.9999), strict=True))
    assert band_words(replace(study().figures["slip_energy"], unit="1", quantiles=at)) == (
        "0.192 .. 1.00"
    )


def test_a_lost_film_is_defined_once_and_its_group_is_counted():
    text = " ".join(scatter_page(study()).summary)
    assert (
        text.count("“Film lost” means: in contact (distress) at any instant while it turns.") == 1
    )
    assert "In 16 of 64 base runs the film is lost; they form a second group" in text
    of_a_part = " ".join(scatter_page(study(kind="part")).summary)
    assert "“Film lost” means: the asperities carry: the contact branch" in of_a_part


def test_failed_runs_stand_by_their_reason():
    page = scatter_page(study(failed={"the film is lost": 3, "no solution": 1}))
    runs = section(page, "runs")
    assert "4 of 320 runs (1.25 %) have no solution" in runs.texts[0]
    assert runs.tables[0].rows == [("the film is lost", "3"), ("no solution", "1")]
    sound = section(scatter_page(study()), "runs")
    assert sound.texts[0] == "All 320 runs have a solution." and not sound.tables


def test_nothing_that_is_no_number_is_shown():
    hole = {level: np.nan for level in LEVELS}
    empty = replace(
        band(np.arange(4.0), "K", "never there"),
        **{"nominal": np.nan, "quantiles": hole, "mean": np.nan, "standard_deviation": np.nan},
        confidence={level: (-np.inf, np.inf) for level in LEVELS},
        outside=Probability(value=np.nan, low=0.0, high=1.0),
    )
    found = study()
    page = scatter_page(replace(found, figures={**found.figures, "empty": empty}))
    assert not re.search(r"\bnan\b|\binf\b|\bNone\b", words_of(page))
    assert "never there" in words_of(page)


def test_a_figure_without_variance_has_no_index():
    found = study()
    assert shares(found, "peak_jerk") == []
    matrix = matrix_table(found, list(found.figures))
    assert [row[0] for row in matrix.rows] == [
        "shift duration, start until clutch locks",
        "heat in the clutch",
    ]
    only = replace(
        found.figures["slip_energy"], indices=dict.fromkeys(["oil_temperature"], NOTHING)
    )
    assert matrix_table(replace(found, figures={"slip_energy": only}), ["slip_energy"]) is None


def test_small_sources_leave_the_matrix_and_are_named():
    found = study()
    assert matrix_table(found, ["slip_energy"]).heads == ("", "oil temperature")
    texts = section(scatter_page(found), "decides").texts
    assert texts[-1] == "Below 0.02 for every figure that has indices: washer: cavity shear."


def test_a_cell_is_as_dark_as_its_index():
    table = matrix_table(study(), ["slip_energy"])
    page = replace(scatter_page(study()), sections=[])
    assert table.shades == [(None, 0.99)]
    from thrustwasher.studio.report.html import Section

    text = render(replace(page, sections=[Section("m", "m", tables=[table])]))
    assert text.count('style="--share: 0.990"') == 1


def test_without_indices_ranks_decide():
    of = shares(study(), "minimum_washer_film_ratio")
    assert of[0].source == "transmission.thrust_share" and of[0].by == RANK
    assert of[0].value == pytest.approx(-1.0) and of[0].half < 0.05
    assert all(abs(s.value) < 0.4 for s in of[1:])


def with_film(film, **changes):
    """Return a study with another minimum film ratio (N,)."""
    found = study(**changes)
    return replace(found, sample=found.sample | {"minimum_washer_film_ratio": film})


def test_a_choice_that_decides_is_found_by_its_ranks():
    of_choice = np.where(np.array(study().sample["washer.cavity_shear"]) == "none", 1.0, 9.0)
    of = shares(with_film(of_choice + 0.01 * np.arange(64)), "minimum_washer_film_ratio")
    assert of[0].source == "washer.cavity_shear" and of[0].weight > 0.7


def test_an_input_that_only_seems_to_decide_is_not_named():
    oil = study().sample["oil_temperature"] - 353.15
    echo = study().sample["transmission.thrust_share"] - 0.02 * oil  # correlated in the sample
    sample = {"transmission.thrust_share": echo, "minimum_washer_film_ratio": oil}
    found = study()
    found = replace(found, sample=found.sample | sample)
    assert abs(np.corrcoef(echo, oil)[0, 1]) > 0.5
    assert [s.source for s in leading(shares(found, "minimum_washer_film_ratio"))] == [
        "oil_temperature"
    ]


def test_what_is_not_told_apart_is_named_together():
    found = study()
    share, oil = (found.sample[s.name] for s in SOURCES[:2])
    film = (share - 0.1) / share.std() + (oil - 353.15) / oil.std()
    noise = np.random.default_rng(1).normal(size=64)
    (text,) = verdict(with_film(film + noise), "the washers", ["minimum_washer_film_ratio"])
    assert "transmission: thrust share" in text and "oil temperature" in text
    assert "not distinguished by so few runs" in text
    (text,) = verdict(with_film(noise), "the washers", ["minimum_washer_film_ratio"])
    assert text == "These runs are too few to say which input decides the figures of the washers."


def test_correlated_inputs_are_named_together_without_a_sign():
    both = "transmission.thrust_share + oil_temperature"
    found = study(groups=(both, "washer.cavity_shear"))
    of = shares(found, "minimum_washer_film_ratio")
    assert of[0].source == both and of[0].value == pytest.approx(1.0)


def test_too_few_runs_for_a_regression_name_nothing():
    found = study()
    few = {name: column[:6] for name, column in found.sample.items()}
    found = replace(found, sample=few)
    assert shares(found, "minimum_washer_film_ratio") == []
    (text,) = verdict(found, "the washers", ["minimum_washer_film_ratio"])
    assert text.startswith("These runs are too few to say which input decides")
    of_a_part = replace(found, kind="part", figures={"film": found.figures[FILM]})
    few["film"] = few[FILM]
    assert "these runs are too few to say what decides it" in scatter_page(of_a_part).summary[0]


def test_the_verdict_names_what_it_rests_on():
    (text,) = verdict(study(), "the washers", ["minimum_washer_film_ratio"])
    assert text.startswith(
        "The verdict on the washers rests most on transmission: thrust share, an "
    )
    assert "an estimate: its" in text
    assert (
        f"rank regression coefficient for “minimum film ratio of the washers” is {MINUS}1.00"
        in text
    )
    (text,) = verdict(study(), "the shift", ["slip_energy", "lock_after_ramp_start", "absent"])
    assert "oil temperature: alone or with others it makes 99 % of the variance of “heat" in text
    assert verdict(study(), "the shift", ["peak_jerk"]) == []


def test_mesh_model_and_inputs_stand_side_by_side():
    found = study()
    lock, film = error_table(found, ["lock_after_ramp_start", "minimum_washer_film_ratio"]).rows
    assert lock[1] == "± 0.2 %" and film[1] == "not known"
    minus = re.fullmatch(rf"washer: cavity shear: none {MINUS}(.+) against cyclic", film[2])
    turned = replace(found, sources=(*SOURCES[:2], SOURCES[2]._replace(nominal="none")))
    plus = error_table(turned, ["minimum_washer_film_ratio"]).rows[0][2]
    assert minus and plus.startswith("washer: cavity shear: cyclic +")
    assert re.fullmatch(rf"{MINUS}\d+ % .. \+\d+ %", film[3])
    plain = replace(found, sources=SOURCES[:2])
    assert error_table(plain, ["slip_energy"]).rows[0][2] == "none scatters"


def test_runs_near_quantiles_are_links_with_their_inputs():
    files = {"minimum_washer_film_ratio": {level: f"film-{level}.toml" for level in LEVELS}}
    tables = section(scatter_page(study(), files), "nearest").tables
    assert str(tables[0].rows[1][1]) == '<a href="film-0.05.toml">film-0.05.toml</a>'
    assert tables[2].rows[0] == ("transmission: thrust share", "0.1", "0.04094", "0.1009", "0.1591")
    without = section(scatter_page(study()), "nearest")
    assert all(table.folded for table in without.tables) and "file" not in without.texts[0]


def test_bars_are_the_largest_indices_with_their_confidence():
    found = shares(study(), "lock_after_ramp_start")
    axis = bar_figure(found, "lock").axes[0]
    assert [bar.get_width() for bar in axis.patches] == [0.97]
    (line,) = axis.collections
    np.testing.assert_allclose(line.get_segments()[0][:, 0], [0.93, 1.01])


def test_indices_over_time_are_not_drawn_where_nothing_scatters():
    series = study().series["clutch.torque_capacity"]
    line = decided_over_time("x", series).axes[0].get_lines()[0]
    assert np.isnan(line.get_ydata()[0]) and line.get_ydata()[-1] == 0.8
    flat = dict.fromkeys(LEVELS, np.ones(21))
    assert decided_over_time("x", replace(series, quantiles=flat)) is None


def test_tiles_have_the_colours_of_the_page():
    assert themed('fill: #0072b2; stroke: #222222; x: #123456; href="#a0"') == (
        'fill: var(--blue); stroke: var(--black); x: #123456; href="#a0"'
    )
    for plot in (p for s in scatter_page(study()).sections for p in s.plots):
        assert isinstance(plot, Plot) and plot.tiles and "#ffffff" not in plot.markup


def test_names_and_shares_are_words():
    assert named("pressure.clutch.points.3") == "pressure.clutch.points.3"
    assert named("oil_temperature") == "oil temperature"
    assert (percent(0.9996), percent(1.0), percent(2e-4)) == (
        "above 99.9 %",
        "100 %",
        "below 0.1 %",
    )


def test_a_study_without_indices_or_outcomes_has_a_page():
    found = study()
    bare = {n: replace(b, indices={}) for n, b in found.figures.items()}
    page = scatter_page(replace(found, figures=bare, probabilities={}, series={}, nearest={}))
    anchors = [s.anchor for s in page.sections]
    assert "decides" in anchors and "nearest" not in anchors and "bands" not in anchors
    assert not any(isinstance(t, Table) and t.shades for s in page.sections for t in s.tables)
