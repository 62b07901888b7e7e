"""A host that is no Python but has loaded libpython runs Python FMUs: same numbers, clean ends."""

import shutil

import pytest
from c_host import load, needs_host, talk
from sampling import sizes
from toy.places import TOY_START

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.stepper import DirectInstance, unpack
from thrustwasher.model.registry import all_specs

pytestmark = needs_host
SET = "set_real " + " ".join(f"{i} {value}" for i, value in enumerate(TOY_START.values(), 1))
BEGUN = ["instantiate", SET, "initialize"]


def clean(said):
    """Every call ended OK, and the process with 0."""
    return said.code == 0 and not said.messages and not any(rc for _, rc, _ in said.calls)


@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.name)
@pytest.mark.slow
def test_every_fmu_runs_in_a_bare_host(spec, fmus):
    outputs = [v for v in interface(spec).variables if v.causality == "output" and v.type == "Real"]
    read = f"get_real {' '.join(str(v.reference) for v in outputs)}"
    script = ["version", "instantiate", "initialize", read, "steps 0 3", read, "last", "release"]
    said = talk(fmus[spec.name], *script)
    assert said.code == 0 and not any(rc for _, rc, _ in said.calls), said
    direct = DirectInstance(spec)
    direct.initialize()
    start = direct.get([v.name for v in outputs])
    for i in range(3):
        direct.step(i * 1e-3, 1e-3)
    expected = [start, direct.get([v.name for v in outputs])]
    assert [list(map(float, values)) for values in said.values("get_real")] == expected
    assert said.values("last") == [["0.003", "0"]]


def test_without_libpython_the_library_does_not_load(python_toy):
    assert talk(python_toy, LD_PRELOAD=None).unloaded


@sizes(2, 4)
def test_processes_end_cleanly_whether_instances_are_freed_or_not(python_toy, n):
    for i in range(n):
        assert clean(talk(python_toy, *BEGUN, "steps 0 3", *["release"] * (i % 2)))


def test_a_library_can_be_unloaded_and_loaded_again(python_toy, tmp_path):
    copy = tmp_path / "copy"  # as tools do that unpack again for every run
    shutil.copytree(unpack(python_toy), copy)
    other = load(python_toy).replace(str(unpack(python_toy)), str(copy))
    life = [*BEGUN, "steps 0 3", "release", "unload"]
    said = talk(python_toy, *life, load(python_toy), *life, other, *life, load(python_toy), *life)
    assert clean(said) and said["unload"] == [0] * 4
