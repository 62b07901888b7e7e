"""What tables of linings and bushings limit: the figures, their limits in parts, and warnings."""

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    ParameterError,
    WasherParams,
    engage_clutch,
    follow_washer,
    load_part,
    optimise,
    propagate,
    solve_clutch,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.face_load import FACE_LOADS, LIMITED
from thrustwasher.model.part_file import part_text

PACK = """model = "clutch"
name = "Pack"
[limits]
face_pressure = "0.2 MPa"
power_per_area = "0.5 MW/m2"
energy_per_area = "0.1 MJ/m2"
[scatter]
friction_scale = "5 %"
"""


def part(folder, text=PACK):
    (folder / "pack.toml").write_text(text, "utf-8")
    return str(folder / "pack.toml")


def test_of_a_washer_they_are_of_its_one_face():
    params = WasherParams()
    found = solve_washer(params, load=300.0, speed=-953.0, tilt=0.002)
    area = np.pi * (params.outer_radius**2 - params.inner_radius**2)
    assert found.face_pressure == pytest.approx(300.0 / area)
    assert params.inner_radius < found.sliding_speed / 953.0 < params.outer_radius
    assert found.pressure_velocity == found.face_pressure * found.sliding_speed
    assert found.power_per_area == pytest.approx(found.friction_power / area)


def test_of_a_pack_each_face_bears_the_whole_load_and_heat_is_shared():
    """Power over area is pressure times sliding times friction, whatever the number of faces."""
    for faces in (2, 7):
        params = ClutchParams(faces=faces, friction_law="constant", friction_data="total")
        found = solve_clutch(params, load=3000.0, speed=30.0)
        assert found.face_pressure == pytest.approx(3000.0 * faces / params.lining_area)
        heat = found.friction_coefficient * found.pressure_velocity
        assert found.power_per_area == pytest.approx(heat, rel=0.02)
        assert {*FACE_LOADS} <= {*found.to_dict()}


def test_over_time_they_are_columns_with_the_energy():
    time = np.linspace(0.0, 0.3, 31)
    found = engage_clutch(
        ClutchParams(), time=time, load=4000.0 * np.minimum(time / 0.1, 1.0), speed=100.0
    )
    np.testing.assert_allclose(found.energy_per_area, found.energy / ClutchParams().lining_area)
    np.testing.assert_allclose(found.power_per_area, found.heat_flux)
    assert {*LIMITED} <= {*found.to_pandas().columns}
    hot = WasherParams(thermal_mode="transient")
    profile = follow_washer(hot, time=[0.0, 0.5, 1.0], load=300.0, speed=545.0, tilt=0.002)
    assert profile.pressure_velocity[0] == profile.face_pressure[0] * profile.sliding_speed[0]
    assert profile.energy_per_area[-1] > 0.0


def test_limits_of_a_part_are_warnings_where_they_are_passed(tmp_path, capsys):
    pack = load_part(part(tmp_path))
    words = "face_pressure = 305.2 kPa, above the part's limit 200 kPa"
    assert any(words in text for text in pack.solve(load=3000.0, speed=30.0).warnings)
    assert not any("limit" in text for text in pack.solve(load=1000.0, speed=30.0).warnings)
    path = str(tmp_path / "pack.toml")
    assert main(["clutch", "--part", path, "--load", "3000", "--speed", "30"]) == 0
    assert words in capsys.readouterr().err
    assert main(["engage", "--part", path, "--load", "5000", "--speed", "200"]) == 0
    said = capsys.readouterr().err
    assert "energy_per_area = 0.1706 J/mm²" in said and "power_per_area" in said


def test_limits_are_written_and_read_back(tmp_path):
    pack = load_part(part(tmp_path))
    again = load_part(part(tmp_path, part_text(pack)))
    assert (
        again.limits
        == pack.limits
        == {
            "face_pressure": 2e5,
            "power_per_area": 5e5,
            "energy_per_area": 1e5,
        }
    )


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        ('face_presure = "1 MPa"', "did you mean 'face_pressure'"),
        ('face_pressure = "1 K"', "face_pressure"),
        ("face_pressure = -1.0", "allowed"),
    ],
)
def test_a_limit_that_is_none_is_refused(tmp_path, limits, words):
    with pytest.raises(ParameterError, match=words):
        load_part(part(tmp_path, f'model = "washer"\nname = "A"\n[limits]\n{limits}\n'))


def test_a_part_without_faces_has_no_limits_of_them(tmp_path):
    text = 'model = "gearmesh"\nname = "A"\n[limits]\nface_pressure = "1 MPa"\n'
    with pytest.raises(ParameterError, match="no faces"):
        load_part(part(tmp_path, text))


def test_studies_and_searches_have_them_as_figures(tmp_path):
    pack = load_part(part(tmp_path))
    found = propagate(pack, runs=16, indices=False, at={"load": 3000.0, "speed": 30.0})
    assert found.figures["face_pressure"].nominal == pytest.approx(305186.9, rel=1e-6)
    assert found.figures["face_pressure"].outside.value == 1.0  # above the part's limit
    low, _, high = found.figures["power_per_area"].quantiles.values()
    assert low < found.figures["power_per_area"].nominal < high
    best = optimise(
        pack,
        vary={"outer_radius": (0.08, 0.1)},
        minimise="friction_torque",
        limits=["face_pressure<=0.25 MPa"],
        at={"load": 3000.0, "speed": 30.0},
    )
    area = np.pi * (best.best.values["outer_radius"] ** 2 - ClutchParams().inner_radius ** 2)
    assert 3000.0 / area <= 2.5e5 * (1.0 + 1e-6)
