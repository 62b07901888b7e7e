"""Which gear is driven: the ring-driven set of a Simpson transmission beside the sun-driven one."""

import math
from dataclasses import replace

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.transmission.parameters import TransmissionParams

from test_transmission_step import Gearbox  # isort: skip

TEETH = {"sun_teeth": 38, "planet_teeth": 18, "ring_teeth": 74}
SIMPSON = TEETH | {"arrangement": "ring-input"}
SPEED = 360.0 * 74.0 / 112.0  # of the carrier in first gear


def steady(**more):
    """Return the ring-driven set at 360 rad/s and 250 N m, its load in balance."""
    return Gearbox(
        **SIMPSON
        | {
            "initial_engine_speed": 360.0,
            "engine_torque": 250.0,
            "load_speed": SPEED,
            "load_torque": 250.0 * 112.0 / 74.0,
        }
        | more
    )


def test_a_ring_driven_set_turns_and_holds_as_its_teeth_say():
    box = steady()
    box.step(0.0, brake=1e4)
    assert box["output_speed"] == pytest.approx(237.857, abs=5e-4)
    assert box["mesh_speed"] == pytest.approx(502.143, abs=5e-4)
    assert box["brake_reaction"] == pytest.approx(-128.378, abs=5e-4)
    assert box["tooth_force"] == pytest.approx(1058.212, abs=5e-4)
    assert box["tilting_couple"] == pytest.approx(11.06666, abs=5e-6)
    assert box["mesh_load"] == pytest.approx(1058.212 * 9e-3 * 1.5 / math.cos(math.radians(20)))


def test_the_clutch_unloads_the_brake_at_r_over_1_plus_r_of_the_engine():
    box = steady(load_torque=250.0)  # without the brake the output has what the input has
    box.step(0.0, clutch=84.8214, brake=1e4)
    assert box["brake_reaction"] == pytest.approx(0.0, abs=2e-4)
    assert box["clutch_reaction"] == 84.8214


def test_loss_of_a_mesh_is_that_of_the_true_teeth_whichever_gear_is_driven():
    """Friction of all meshes: sun meshes as given, ring meshes by their slide-roll ratio."""
    ring = (1.0 / 18.0 - 1.0 / 74.0) / (1.0 / 18.0 + 1.0 / 38.0)
    for arrangement in ("sun-input", "ring-input"):
        box = Gearbox(
            **TEETH | {"arrangement": arrangement, "load_torque": 0.0, "engine_torque": 0.0}
        )
        box.step(1e-5, brake=1e4, mesh=0.25)
        power = 4.0 * (1.0 + ring) * 0.25 * box["mesh_speed"]
        assert box["mesh_heat"] == pytest.approx(power * 1e-5, rel=1e-4)
        assert box["drag_torque"] * (box["engine_speed"] - box["output_speed"]) == pytest.approx(
            power, rel=1e-12
        )


def test_an_arrangement_is_the_other_one_with_sun_and_ring_exchanged_but_for_the_teeth():
    """r is all that the motion knows: 1.5 sun-driven, and its inverse with the ring driven."""
    teeth = {"sun_teeth": 30, "ring_teeth": 45, "planet_teeth": 0, "washers": 0}
    ring = Gearbox(**teeth, arrangement="ring-input", load_torque=50.0)
    plain = Gearbox(**teeth, load_torque=50.0)
    assert ring.par[2:8] == pytest.approx(plain.par[2:8])
    for box, ratio in ((ring, 1.0 + 30.0 / 45.0), (plain, 2.5)):
        box.step(1e-3, brake=1e4)
        assert box["engine_speed"] == pytest.approx(ratio * box["output_speed"], rel=1e-14)


def test_a_profile_shift_lets_the_planet_differ_by_a_tooth_and_no_more():
    TransmissionParams(**SIMPSON | {"planet_teeth": 17, "profile_shifted": True})
    with pytest.raises(ParameterError, match="planet_teeth"):
        TransmissionParams(**SIMPSON | {"planet_teeth": 16, "profile_shifted": True})


def test_inertias_answer_to_the_names_of_the_sun_driven_set_as_well():
    params = TransmissionParams(sun_inertia=0.3, ring_inertia=0.02)
    assert (params.input_inertia, params.drum_inertia) == (0.3, 0.02)
    assert params.sun_inertia == 0.3 and replace(params, washers=0).ring_inertia == 0.02
    with pytest.raises(ParameterError, match="sun_inertia"):
        TransmissionParams(sun_inertia=0.3, input_inertia=0.3)


def test_ring_meshes_of_their_own_lose_what_their_torque_says():
    box = Gearbox(**TEETH | {"load_torque": 0.0, "engine_torque": 0.0, "ring_mesh": True})
    box.step(1e-5, brake=1e4, mesh=0.25, ring_mesh=0.1)
    assert box["mesh_heat"] == pytest.approx(4.0 * 0.35 * box["mesh_speed"] * 1e-5, rel=1e-4)
