"""The toy model is packed once; its folder is importable for slaves and child processes."""

import os
import subprocess
import sys

import pytest
from toy.places import HERE, TOY_SLAVES, TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.fmu.build import build
from thrustwasher.fmu.stepper import DirectInstance, Instance

os.environ["SOURCE_DATE_EPOCH"] = "1767225600"  # builds repeat while somebody commits


@pytest.fixture(scope="session")
def toy_fmu(tmp_path_factory):
    out = tmp_path_factory.mktemp("dist")
    return build([TOY.key], target="python", out=out, sources=TOY_SLAVES)[0]


@pytest.fixture(scope="session")
def fmus(tmp_path_factory):
    """Every model of this version, packed for Python."""
    return {path.stem: path for path in build(target="python", out=tmp_path_factory.mktemp("dist"))}


@pytest.fixture
def toy(toy_fmu):
    with Instance(toy_fmu) as instance:
        instance.initialize(inputs=TOY_START)
        yield instance


@pytest.fixture
def direct_toy():
    instance = DirectInstance(TOY)
    instance.initialize(inputs=TOY_START)
    return instance


@pytest.fixture
def run_child():
    """Run Python code in a fresh process and return what it prints."""

    def run(code, *args, check=True):
        path = os.pathsep.join([str(HERE), str(HERE.parents[1]), os.environ.get("PYTHONPATH", "")])
        done = subprocess.run(
            [sys.executable, "-c", code, *map(str, args)],
            env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, timeout=500,
        )  # fmt: skip
        assert not check or done.returncode == 0, done.stderr
        return done.stdout.strip() if check else done

    return run
