"""A map is as good as it says: the mesh's error counts, and a missed tolerance is told."""

import os
from dataclasses import replace

import pytest

from thrustwasher.errors import SolveError
from thrustwasher.washer.map import map_build, map_file
from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_build import make_map
from thrustwasher.washer.map.map_mesh import NotSmooth
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

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
TINY = {**BOX, "load": (10.0, 14.0), "speed": (10.0, 10.0)}


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
    wish = {"box": TINY, "tolerance": 0.01, "workers": 1, "points": 2}

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
