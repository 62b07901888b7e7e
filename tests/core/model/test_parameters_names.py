"""A wrong name of a parameter is answered by the nearest one, and signatures stay readable."""

import inspect

import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    LossesParams,
    ParameterError,
    TrainParams,
    WasherParams,
)


@pytest.mark.parametrize(
    ("params", "wrong", "meant"),
    [
        (WasherParams, "rougness", "roughness"),
        (ClutchParams, "inner_radus", "inner_radius"),
        (GearMeshParams, "face_widht", "face_width"),
        (LossesParams, "sump_volum", None),
        (TrainParams, "mesh_1_face_widht", "mesh_1_face_width"),
    ],
)
def test_a_wrong_name_is_answered_by_the_nearest_one(params, wrong, meant):
    with pytest.raises(ParameterError) as problem:
        params(**{wrong: 0.1})
    said = str(problem.value)
    assert f"{params.__name__} has no parameter {wrong!r}" in said
    assert meant is None or said.endswith(f"did you mean {meant}?")


def test_a_signature_lists_the_parameters_for_completion():
    assert "roughness" in inspect.signature(WasherParams).parameters
    assert "faces" in inspect.signature(ClutchParams).parameters
