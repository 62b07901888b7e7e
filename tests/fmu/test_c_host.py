"""A host that is no Python: same numbers, the failure is seen, the process ends cleanly."""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import fmpy
import pytest
from conftest import HERE, TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance, unpack

LIBPYTHON = Path(sysconfig.get_config_var("LIBDIR") or "", sysconfig.get_config_var("INSTSONAME"))
pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or not shutil.which("gcc") or ".so" not in LIBPYTHON.name,
    reason="needs Linux, gcc and a shared libpython",
)


@pytest.fixture(scope="module")
def host(tmp_path_factory):
    program = tmp_path_factory.mktemp("host") / "host"
    headers = Path(fmpy.__file__).parent / "c-code"
    command = ["gcc", "-Wall", "-Wextra", f"-I{headers}", HERE / "host.c", "-o", program, "-ldl"]
    subprocess.run(command, check=True, timeout=60)
    return program


def test_a_c_host_gets_the_numbers_sees_the_failure_and_ends_cleanly(host, toy_fmu):
    folder = unpack(toy_fmu)
    path = os.pathsep.join([str(HERE), str(HERE.parents[1])])
    binaries = Path(sys.executable).parent
    environment = {
        **os.environ, "PYTHONPATH": path, "LD_PRELOAD": str(LIBPYTHON),
        "PATH": f"{binaries}{os.pathsep}{os.environ['PATH']}",
    }  # fmt: skip
    library, resources = folder / "binaries" / "linux64" / "ToyClutch.so", folder / "resources"
    direct = DirectInstance(TOY)
    direct.initialize()
    direct.set_inputs(list(TOY_START.values()))
    for i in range(10):
        direct.step(i * 1e-3, 1e-3)
    torque = direct.outputs()[0]
    expected = f"good 0 torque {torque:.17g} failed 2 status {int(Status.MAX_ITERATIONS)}"
    command = [host, library, resources.as_uri(), "any", "3"]
    for _ in range(8):
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        lines = done.stdout.splitlines()
        assert [line for line in lines if line.startswith("good")] == [expected] * 3
        assert sum("not converged" in line for line in lines) == 3
