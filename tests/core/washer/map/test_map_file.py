"""Map files: whole or refused; a build that was stopped goes on."""

import os
import zipfile
import zlib
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.washer.kernels.map import map_layout as L
from thrustwasher.washer.map import map_build, map_file
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_build import build_lines, find_reach, journal_for, make_map, survey
from thrustwasher.washer.map.map_file import (
    METADATA,
    NUMBERS,
    all_maps,
    pack,
    plain,
    read_map,
    unpack,
)
from thrustwasher.washer.map.map_mesh import NotSmooth
from thrustwasher.washer.map.map_plan import plan_map
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

TINY = {
    "load": (300.0, 400.0),
    "speed": (540.0, 550.0),
    "tilt": (0.002, 0.002),
    "oil_temperature": (297.15, 297.15),
}


def test_what_is_packed_is_read_again(map_path, tmp_path):
    first = read_map(map_path)
    copy = tmp_path / "copy.twm"
    copy.write_bytes(pack(first.data, first.metadata))
    second = read_map(copy)
    assert np.array_equal(first.data, second.data) and first.metadata == second.metadata
    assert copy.read_bytes() == map_path.read_bytes()  # the same bytes for the same map


def test_the_card_says_what_the_map_is_worth(map_path):
    metadata = read_map(map_path).metadata
    held, allowed = metadata["held_out"], metadata["tolerance"] / 3.0
    assert held["torque"] < allowed and held["fold_load"] < allowed and held["folds"] > 0
    assert metadata["built_from"] == "field" and metadata["params"]["roughness"] == 5.15e-7


def test_the_resource_of_an_fmu_holds_the_same_numbers(map_path):
    file = read_map(map_path)
    numbers, check = plain(file)[:-4], plain(file)[-4:]
    assert np.array_equal(unpack(numbers), file.data)
    assert int.from_bytes(check, "little") == zlib.crc32(numbers)


def damaged(path, change):
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in (NUMBERS, METADATA)}
    change(parts)
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)


def cut(parts):
    parts[NUMBERS] = parts[NUMBERS][:-4]


def other_version(parts):
    parts[NUMBERS] = np.float64(1.0).tobytes() + parts[NUMBERS][8:]


def not_finite(parts):
    parts[NUMBERS] = parts[NUMBERS][:-4] + np.float32(np.nan).tobytes()


def wrong_shape(parts):
    numbers = bytearray(parts[NUMBERS])
    numbers[8 * (L.AXES + 2) : 8 * (L.AXES + 3)] = np.float64(7.0).tobytes()
    parts[NUMBERS] = bytes(numbers)


def no_card(parts):
    parts[METADATA] = b"[1, 2]"


def empty(parts):
    parts[NUMBERS] = b""


@pytest.mark.parametrize("change", [cut, other_version, not_finite, wrong_shape, no_card, empty])
def test_a_damaged_file_is_refused_by_name(map_path, tmp_path, change, monkeypatch):
    path = tmp_path / "damaged.twm"
    path.write_bytes(map_path.read_bytes())
    damaged(path, change)
    with pytest.raises(ParameterError, match=r"damaged\.twm"):
        read_map(path)
    monkeypatch.setenv("THRUSTWASHER_MAPS", str(tmp_path))
    assert path not in [m.path for m in all_maps()]


def test_what_is_no_archive_is_refused(tmp_path):
    path = tmp_path / "text.twm"
    for content in (b"", b"hello", b"PK\x03\x04 half"):
        path.write_bytes(content)
        with pytest.raises(ParameterError, match="thrustwasher map build"):
            read_map(path)


def with_journal(plan, path, **options):
    with closing(journal_for(path, plan, "field")) as journal:
        return build_lines(plan, find_reach(plan), fidelity="field", journal=journal, **options)


def test_a_build_that_was_stopped_goes_on_with_what_it_had(tmp_path, monkeypatch):
    from thrustwasher.washer.map import map_build

    monkeypatch.setattr(map_build, "BATCH", 1)
    plan, journal = plan_map(WasherParams(), TINY), tmp_path / "lines"
    whole = build_lines(plan, find_reach(plan), fidelity="field")
    solved = []

    def solve(tasks):
        solved.append(tasks)
        if len(solved) == 3:
            raise KeyboardInterrupt
        return real(tasks)

    real = map_build.solve_lines
    monkeypatch.setattr(map_build, "solve_lines", solve)
    with pytest.raises(KeyboardInterrupt):
        with_journal(plan, journal)
    monkeypatch.setattr(map_build, "solve_lines", real)
    done = []
    again = with_journal(plan, journal, progress=lambda k, _n: done.append(k))
    assert np.array_equal(again, whole) and done == [3, 4]


def test_lines_of_another_map_are_neither_taken_nor_harmed(tmp_path):
    plan, journal = plan_map(WasherParams(), TINY), tmp_path / "lines"
    with_journal(plan, journal)
    before = journal.read_bytes()
    other = plan_map(WasherParams(), {**TINY, "load": (300.0, 500.0)})
    with pytest.raises(ParameterError, match=r"another map \(other box\)"):
        with_journal(other, journal)
    assert journal.read_bytes() == before


def test_a_build_that_solves_nothing_leaves_nothing(tmp_path, monkeypatch):
    def fail(*_):
        raise SolveError("no film is thick enough")

    monkeypatch.setattr("thrustwasher.washer.map.map_build.find_reach", fail)
    with pytest.raises(SolveError):
        make_map(WasherParams(), tmp_path / "x.twm", box=TINY, fidelity="field", workers=1)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_map_that_cannot_be_written_loses_no_line(tmp_path, monkeypatch):

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    def no_more(places, wanted):
        assert not wanted  # none is solved again
        return []

    out = tmp_path / "x.twm"
    monkeypatch.setattr("thrustwasher.washer.map.map_build.check_map", fail)
    with pytest.raises(OSError, match="No space"):
        make_map(WasherParams(), out, box=TINY, fidelity="field", workers=1)
    assert [p.name for p in tmp_path.iterdir()] == ["x.twm.journal"]
    monkeypatch.undo()
    monkeypatch.setattr("thrustwasher.washer.map.map_build._neighbours", no_more)
    make_map(WasherParams(), out, box=TINY, fidelity="field", workers=1, points=4)
    assert [p.name for p in tmp_path.iterdir()] == ["x.twm"]


@pytest.mark.parametrize(
    ("box", "word"),
    [
        ({"load": (0.1, 10.0)}, "load"),
        ({"load": (100.0, 101.0)}, "1.2 x low"),
        ({"speed": (100.0, 5000.0)}, "speed"),
        ({"tilt": (0.002, 0.001)}, "tilt"),
        ({"torque": (1.0, 2.0)}, "torque"),
        ({"oil_temperature": ("a", 1.0)}, "oil_temperature"),
    ],
)
def test_a_wrong_box_is_refused_by_name(tmp_path, box, word):
    with pytest.raises(ParameterError, match=word):
        make_map(WasherParams(), tmp_path / "x.twm", box=box)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("params", "options", "word"),
    [
        ({"oil_supply_temperature": 300.0}, {}, "oil_supply_temperature = 300 K"),
        ({}, {"tolerance": 0.5}, "tolerance = 0.5"),
        ({}, {"tolerance": float("nan")}, "tolerance = nan"),
        ({}, {"fidelity": "coarse"}, "fidelity"),
    ],
)
def test_what_a_map_cannot_be_is_said_at_once(tmp_path, params, options, word):
    with pytest.raises(ParameterError, match=word) as refused:
        make_map(WasherParams(**params), tmp_path / "x.twm", box=TINY, **options)
    assert "\n" not in str(refused.value) and list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_map_without_oil_cooling_has_no_heat_carried(tmp_path):
    params, path = WasherParams.preset("paper"), tmp_path / "paper.twm"
    make_map(params, path, box=TINY, fidelity="field", workers=1, points=4)
    washer = WasherMap(params, path)
    found = washer.look_up(load=350.0, speed=545.0, tilt=0.002, oil_temperature=297.15)
    there = solve_washer(params, load=350.0, speed=545.0, tilt=0.002, fidelity="field")
    assert found["throughflow_heat"] == there.throughflow_heat == 0.0
    assert found["oil_outlet_temperature"] == there.oil_outlet_temperature == 297.15
    for name in ("friction_torque", "oil_heat", "film_temperature", "stick_margin", "oil_flow"):
        assert float(found[name]) == pytest.approx(getattr(there, name), rel=2e-3), name


@pytest.mark.slow
def test_a_finer_tolerance_takes_more_lines():
    plans = [plan_map(WasherParams(), {**TINY, "speed": (200.0, 800.0)}, t) for t in (0.02, 1e-3)]
    sizes = [survey(plan, find_reach(plan)).size for plan in plans]
    assert sizes[0] < sizes[1]


# A map is as good as it says: the mesh's error counts, and a missed tolerance is told.

# just where asperities begin to carry the mesh of "field" is half a percent off
WIDE = WasherParams(
    inner_radius=7.5e-3, outer_radius=19e-3, gear_inner_radius=11e-3, roughness=3.1e-7
)
BOX = {
    "load": (2.0, 60.0),
    "speed": (5.0, 20.0),
    "tilt": (1.6e-3, 1.6e-3),
    "oil_temperature": (350.0, 350.0),
}
PLACE = {"load": 6.0, "speed": 10.0, "tilt": 1.6e-3, "oil_temperature": 350.0}
MESH_TINY = {**BOX, "load": (10.0, 14.0), "speed": (10.0, 10.0)}


@pytest.mark.slow
def test_few_lines_on_a_finer_mesh_make_good_what_the_mesh_misses(tmp_path):
    metadata = make_map(WIDE, tmp_path / "wide.twm", box=BOX, tolerance=0.01, workers=1, points=6)
    assert metadata["built_from"] == "field" and metadata["finer_lines"] == 3
    assert metadata["mesh_made_good"] > 3e-3 and metadata["held_out"]["torque"] < 0.01
    there = solve_washer(WIDE, **PLACE, fidelity="fine").friction_torque
    assert solve_washer(WIDE, **PLACE).friction_torque > 1.003 * there
    torque = WasherMap(WIDE, tmp_path / "wide.twm").torque(*PLACE.values())
    assert torque == pytest.approx(there, rel=3e-3)


def made(folder, labels):
    """Make a tiny map; the labels of its progress are kept."""
    wish = {"box": MESH_TINY, "tolerance": 0.01, "workers": 1, "points": 2}

    def progress(label):
        labels.append(label)
        return lambda done, total: None

    return make_map(WIDE, folder / "wide.twm", **wish, progress=progress)


def test_that_all_lines_go_to_the_finer_mesh_is_said(tmp_path, monkeypatch):
    def rough(*_):
        raise NotSmooth("the coarser mesh is 6.0% off")

    monkeypatch.setattr(map_build, "change_of_mesh", rough)
    labels = []
    metadata = made(tmp_path, labels)
    assert metadata["built_from"] == "fine"
    assert "the coarser mesh is 6.0% off: all lines on the finer mesh," in labels


@pytest.mark.slow
def test_a_missed_tolerance_is_told_with_its_place_and_nothing_is_left(tmp_path, monkeypatch):
    meshes, labels = [], []

    def check(params, path, *, grid, **options):
        meshes.append(grid)
        return replace(real(params, path, grid=grid, **options), torque=0.03)

    real = map_build.check_map
    monkeypatch.setattr(map_build, "check_map", check)
    with pytest.raises(SolveError, match=r"3\.00% off at load = .* N, speed = 10 rad/s") as told:
        made(tmp_path, labels)
    assert "the map is 3.0% off: all lines on the finer mesh," in labels
    assert "\n" not in str(told.value) and "1.00%" in str(told.value)
    assert len(meshes) == 2 and list(tmp_path.iterdir()) == []  # all lines were tried on "fine"


def test_of_the_kept_maps_those_unused_longest_go(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(map_file, "MOST_KEPT", 2)
    files = [map_file.own_folder().parent / f"kernels{k % 2}" / f"{k}.twm" for k in range(4)]
    for k, file in enumerate(files):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
        os.utime(file, (1e9 - k, 1e9))
    map_file.forget_unused()
    assert [file.exists() for file in files] == [True, True, False, False]
