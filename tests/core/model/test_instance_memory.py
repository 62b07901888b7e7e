"""What an instance of a model keeps in memory, counted from the sizes of its kernel."""

import pytest

from thrustwasher.model.registry import find_spec, kernel_of

LIMIT = 64 * 1024  # bytes


@pytest.mark.parametrize(
    "model",
    ["WetClutch", "GearMesh", "ShiftTransmission", "OilSump", "DrivelineLosses", "CommandSource"],
)
def test_the_arrays_of_an_instance_leave_a_third_of_64_kb_to_the_shell(model):
    """Parameters, inputs, work, outputs and memory, the latter two also as before a step."""
    kernel = kernel_of(find_spec(model))
    kept_twice = kernel.NSTATE + kernel.NOUT + kernel.NIOUT
    doubles = kernel.NPAR + kernel.NINP + kernel.NWORK + 2 * kept_twice
    assert 8 * doubles <= 2 * LIMIT // 3
