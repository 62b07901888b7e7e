"""The toy model is packed once; its folder is importable for slaves and child processes."""

import needed
import pytest
from built import built_fmu
from children import child
from toy.places import HERE, TOY_SLAVES
from toy.spec import SPEC as TOY

from thrustwasher.model.registry import all_specs


@pytest.fixture(scope="session")
def python_toy():
    return built_fmu(TOY.key, target="python", sources=TOY_SLAVES)


def native_toy(fmi):
    needed.linker()
    return built_fmu(TOY.key, fmi=fmi, sources=TOY_SLAVES, local=True)


@pytest.fixture(scope="session")
def fmi2_toy():
    return native_toy(2)


@pytest.fixture(scope="session")
def fmi3_toy():
    return native_toy(3)


@pytest.fixture(scope="session")
def fmus():
    """Every model of this version, packed for Python."""
    return {spec.name: built_fmu(spec.name, target="python") for spec in all_specs()}


@pytest.fixture(scope="session")
def natives():
    """Every model of this version, compiled for this machine."""
    return {spec.name: built_fmu(spec.name, local=True) for spec in all_specs()}


@pytest.fixture
def run_child():
    """Run Python code in a fresh process and return what it prints."""

    def run(code, *args, check=True):
        done = child(code, *args, check=check, path=(HERE,))
        return done.stdout.strip() if check else done

    return run
