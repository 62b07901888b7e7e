"""What a Python FMU says it can do, it can; what it says it cannot, it refuses."""

import ctypes
import subprocess
import sys
from pathlib import Path

import needed
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE


@pytest.fixture
def bare(fmus, tmp_path):
    """A clutch that is given a logger and nothing else: no allocator, no environment."""
    path = str(fmus["WetClutch"])
    described = read_model_description(path)
    fmu = FMU2Slave(
        guid=described.guid,
        unzipDirectory=extract(path, str(tmp_path)),
        modelIdentifier="WetClutch",
    )
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_: None)
    fmu.instantiate(callbacks=callbacks)
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    yield fmu
    fmu.freeInstance()


def test_it_runs_without_memory_functions(bare):
    bare.doStep(0.0, 1e-3)
    state = bare.getFMUstate()
    bare.setFMUstate(state)
    bare.freeFMUstate(state)
    assert bare.getReal([0]) == [1e-3]


def test_what_it_cannot_do_is_not_answered_with_ok(bare):
    one, real = (ctypes.c_uint * 1)(1), (ctypes.c_double * 1)(1.0)
    order = (ctypes.c_int * 1)(1)
    for call in (
        lambda: bare.fmi2GetDirectionalDerivative(bare.component, one, 1, one, 1, real, real),
        lambda: bare.fmi2SetRealInputDerivatives(bare.component, one, 1, order, real),
        lambda: bare.fmi2GetRealOutputDerivatives(bare.component, one, 1, order, real),
        lambda: bare.fmi2CancelStep(bare.component),
    ):
        with pytest.raises(FMICallException):
            call()
    bare.doStep(0.0, 1e-3)


@pytest.mark.parametrize("name", ["WetClutch"])  # native ones: test_native_package
@pytest.mark.slow
def test_checkers_find_nothing(name, fmus):
    tools = Path(sys.executable).parent
    done = subprocess.run([tools / "fmpy", "validate", fmus[name]], capture_output=True, text=True)
    assert (done.returncode, done.stdout.strip()) == (0, "No problems found."), done.stderr
    command = [needed.tool("fmutool"), "-input", fmus[name], "-check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = done.stdout + done.stderr
    assert "seems to be compliant" in said
    assert not [line for line in said.splitlines() if line.startswith(("ERROR", "WARN", "CRIT"))]
