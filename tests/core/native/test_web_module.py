"""The kernels in WebAssembly, run by node: nothing from outside, the numbers of Python's."""

import json
import shutil
import subprocess
from pathlib import Path

import needed
import numpy as np
import pytest
from kernel_runs import MODELS, Python, Run, parameters, profile

import thrustwasher
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.model.registry import find_spec, kernel_of
from thrustwasher.native import binaries, shipped
from thrustwasher.native.library import TABLE, web_functions

HERE = Path(__file__).parent
SCRIPT = Path(thrustwasher.__file__).parent / "studio" / "report" / "web" / "explore" / "kernel.js"
STEPS = 20
each = pytest.mark.parametrize("model", MODELS)
node = pytest.mark.skipif(
    not (shutil.which("node") or needed.IN_CI), reason="install the Debian package nodejs"
)


def module(model):
    found = shipped.web_file(find_spec(model).kernel)
    assert found, "first: python -m lab.ship_all"
    return found


@each
def test_a_module_needs_nothing_and_shows_its_table_and_memory(model):
    found = binaries.read(module(model).read_bytes())
    assert found.format == "WASM" and not found.needed
    assert {TABLE, "memory", "__heap_base", "__indirect_function_table"} <= found.exports
    binaries.check(module(model).read_bytes(), exports=[TABLE])


def test_a_module_that_needs_something_is_refused():
    # one type () -> (), one import "env" "secret" of a function
    code = b"\0asm\x01\0\0\0" + b"\x01\x04\x01\x60\0\0" + b"\x02\x0e\x01\x03env\x06secret\0\0"
    assert binaries.undefined(code) == {"secret"}
    with pytest.raises(EnvironmentProblem, match="it needs secret"):
        binaries.check(code, exports=[])


@node
@each
def test_a_profile_in_webassembly_is_the_one_in_python(model):
    spec, k = find_spec(model), kernel_of(find_spec(model))
    inputs, dt = profile(model, STEPS)
    entries = web_functions(spec.kernel, ("derive", "step"))
    given = {
        "script": SCRIPT.as_uri(),
        "module": str(module(model)),
        "inputs": inputs.tolist(),
        "dt": dt,
        "functions": entries,
        "parameters": parameters(model),
        "sizes": [k.NPAR, k.NINP, k.NSTATE, k.NWORK, k.NOUT],
        "whole_outputs": k.NIOUT,
    }
    done = subprocess.run(
        ["node", str(HERE / "web_run.mjs")], input=json.dumps(given), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert not any(found["codes"])
    run = Run(Python(model))
    run.start(parameters(model))
    rows = []
    for i, row in enumerate(inputs):
        assert run.step(row, i * dt, dt) == 0
        rows.append([*run.out, *run.iout])
    wanted, got = np.array(rows), np.array(found["rows"])
    assert np.array_equal(got, wanted)
