"""FMUs of every kind, made when wanted."""

from functools import cache

import pytest

from thrustwasher.cli._fmu_cache import fmu_paths
from thrustwasher.fmu.build import build
from thrustwasher.fmu.native.link import find_linker
from thrustwasher.fmu.registry import find_spec
from thrustwasher.fmu.stepper import Instance


@pytest.fixture(scope="session")
def fmu_of(tmp_path_factory):
    """Return (model, "native-fmi2") -> the FMU."""
    folder = tmp_path_factory.mktemp("fmus")

    @cache
    def made(model, kind):
        target, fmi = kind.split("-fmi")
        if target == "native":
            try:
                find_linker()
            except Exception as problem:
                pytest.skip(str(problem))
        spec = find_spec(model)
        if fmi == "2":
            return fmu_paths([spec.name], target)[spec.name]
        return build([spec.name], target=target, fmi=int(fmi), out=folder, local=True)[0]

    return made


@pytest.fixture
def instance_of(fmu_of):
    """Return (model, kind, parameters) -> an instance; all are freed in the end."""
    alive = []

    def make(model, kind, parameters=None):
        alive.append(Instance(fmu_of(model, kind), parameters=parameters))
        return alive[-1]

    yield make
    for instance in alive:
        instance.close()
