"""FMUs of every kind, made when wanted."""

from functools import cache

import pytest
from built import built_fmu

from thrustwasher.fmu.stepper import Instance


@pytest.fixture(scope="session")
def fmu_of():
    """Return (model, "native-fmi2") -> the FMU."""

    @cache
    def made(model, kind):
        target, fmi = kind.split("-fmi")
        return built_fmu(model, target=target, fmi=int(fmi), local=True)

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
