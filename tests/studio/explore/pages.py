"""Pages made once for all tests, and their workers run by node."""

import json
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path

import needed
import pytest

from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.part_file import find_part
from thrustwasher.model.registry import find_model
from thrustwasher.native.library import web_module
from thrustwasher.studio.explore.description import describe, inputs_of
from thrustwasher.studio.explore.page import VIEWS, page
from thrustwasher.studio.report.bundles import FOLDER

HERE, WEB = Path(__file__).parent, FOLDER.parent / "explore"
# Version 20 at times waits for ever where its compiler in the background wants memory collected.
NODE = ("--no-concurrent-recompilation",)
MODELS = ("washer", "gearmesh", "clutch", "losses", "train")
node = pytest.mark.skipif(
    not (shutil.which("node") or needed.IN_CI), reason="install the Debian package nodejs"
)


@cache
def html(model):
    return page(find_part(model))


@cache
def about(model):
    """What the page's scripts read."""
    found = find_model(model)
    view = VIEWS[model]
    point = {s.name: view.usual.get(s.name, s.usual) for s in inputs_of(found, view)}
    return describe(found, view, find_part(model), point)


@cache
def wasm_file(kernel):
    file = Path(tempfile.mkdtemp(prefix="wasm")) / "module.wasm"
    file.write_bytes(web_module(kernel))
    return file


def answers(model, tasks, *, params=None, level=None):
    """Return what the worker answers to its tasks, the parameters set first, and the seconds."""
    spec, view = find_model(model).spec, VIEWS[model]
    module = wasm_file(spec.kernel)
    own = f"models/{view.worker.script}.js"
    numbers = as_numbers(params or spec.params())
    given = {
        "scripts": [(WEB / name).as_uri() for name in ("kernel.js", own)],
        "about": about(model)["worker"],
        "module": str(module),
        "tasks": [["set", numbers, level or spec.default_fidelity], *tasks],
    }
    done = subprocess.run(
        ["node", *NODE, str(HERE / "worker_run.mjs")],
        input=json.dumps(given),
        text=True,
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found[0]["result"] == 0
    return [a["result"] for a in found[1:]], [a["seconds"] for a in found[1:]]
