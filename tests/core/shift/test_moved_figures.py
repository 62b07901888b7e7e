"""Key figures of a shift have names that earlier versions had otherwise; those are read still."""

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.shift import load_scene
from thrustwasher.shift.key_figures.figure_list import FIGURES, RENAMED, Figures, current


def test_every_name_of_before_leads_to_a_figure():
    assert {RENAMED[n] for n in RENAMED} <= set(FIGURES) and not set(RENAMED) & set(FIGURES)
    assert RENAMED["least_pitting_safety"] == "minimum_pitting_safety"
    assert RENAMED["greatest_slip"] == "maximum_slip"


def test_a_result_is_read_by_the_name_of_before_with_a_warning():
    figures = Figures({"maximum_slip": 12.0})
    with pytest.warns(FutureWarning, match="greatest_slip is now maximum_slip"):
        assert figures["greatest_slip"] == 12.0
    with pytest.warns(FutureWarning):
        assert figures.get("greatest_slip") == 12.0 and "greatest_slip" in figures
    assert figures.get("no_such_figure") is None and "no_such_figure" not in figures
    with pytest.raises(KeyError):
        figures["least_pitting_safety_of_all"]


def test_a_name_of_today_is_taken_without_a_warning(recwarn):
    assert current("lock_time") == "lock_time" and not recwarn.list


def test_a_scene_may_name_published_figures_as_before(tmp_path):
    file = tmp_path / "mine.toml"
    text = 'base = "brake-test"\n[published]\nsource = "a paper"\ngreatest_slip = "3000 rpm"\n'
    file.write_text(text)
    with pytest.warns(FutureWarning, match="maximum_slip"):
        scene = load_scene(str(file))
    assert list(scene.published.figures) == ["maximum_slip"]
    file.write_text(text + "maximum_slip = 1.0\n")
    with pytest.raises(ParameterError, match="allowed: one of the two"):
        load_scene(str(file))
