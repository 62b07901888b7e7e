"""The house stays in order: narrow folders, no circles, short functions, models by themselves.

The counts are those of ``lab/structure.py``; ``lint-imports`` checks the directions.
"""

import ast
import re
import tomllib
from statistics import median

import needed
import pytest
from kernel_files import PACKAGE, ROOT

from lab import shell_calls, structure
from thrustwasher import cli, plugins
from thrustwasher.errors import Status
from thrustwasher.model.registry import HELPERS, MODELS, find_model

# Lines are those of files as ``ruff format`` leaves them with every "fmt: skip" ignored.
FILE_LINES, FUNCTION_LINES, MEDIAN_LINES, FOLDER_FILES = 610, 110, 8, 20
FORMAT_MARKS = {"sources": 40, "tests": 40}  # tables of numbers
# Who names a model, next to its own modules and the list of models: reason -> module -> models.
PLACES = {
    "public names": {"thrustwasher": {"washer", "clutch", "gearmesh", "losses", "train"}},
    "a shift is a system of these models: what its scene connects, and what it makes of them": {
        "shift.scene.connections": {
            "washer",
            "clutch",
            "gearmesh",
            "losses",
            "transmission",
            "command",
            "sump",
        },
        "shift.checks.capacity": {"transmission"},
        "shift.checks.rule_data": {"clutch", "transmission", "washer"},
        "shift.checks.run_doubts": {"clutch"},
        "shift.scene.profile_file": {"transmission"},
        "shift.scene.doubts": {"clutch", "gearmesh", "transmission"},
        "shift.scene.places": {"transmission"},
        "shift.scene.scene": {"transmission"},
        "shift.scene.scene_file": {"losses", "sump"},
        "shift.scene.scene_tables": {"transmission"},
        "shift.scene.sequence": {"transmission"},
        "shift.several_shifts": {"transmission"},
        "shift.checks.washer_in_time": {"washer"},
        "shift.oscillation.chatter": {"transmission"},
        "shift.oscillation.torsion": {"clutch"},
        "studio.report.shift.live_washer": {"washer"},
        "studio.evaluators.scene_runs": {"washer"},
        "studio.evaluators.scene": {"washer"},
    },
    "what a finished shift is evaluated by is read by kernels in the transmission's library": {
        "shift.key_figures.comfort": {"transmission"},
        "shift.key_figures.events_and_phases": {"transmission"},
        "shift.key_figures.key_figures": {"transmission"},
        "shift.oscillation.judder": {"transmission"},
        "studio.report.shift.shift_data": {"transmission"},
    },
    "a train is made of meshes, and of the laws of bearings, churning and seals": {
        "train.kernels.chain": {"gearmesh", "losses"},
        "train.kernels.exchange": {"gearmesh"},
        "train.kernels.layout": {"gearmesh", "losses"},
        "train.kernels.step": {"gearmesh", "losses"},
        "train.parameters": {"gearmesh", "losses"},
        "train.solve": {"gearmesh", "losses"},
        "train.train_file": {"gearmesh"},
        "train.train_text": {"gearmesh"},
    },
    "a gearbox is a shift's scene or a train, which has a report of its own": {
        "studio.commands.efficiency": {"train"},
        "studio.commands._reducer_report": {"train"},
        "studio.report.reducer_report": {"train"},
    },
    "its page writes profiles into the transmission's parameters": {
        "studio.explore.scene_data": {"transmission"}
    },
    "the fit of the clutch's friction law": {
        "studio.calibration.friction.friction_fit": {"clutch"},
        "studio.calibration.friction.friction_law": {"clutch"},
        "studio.calibration.friction.reach": {"clutch"},
    },
    "a pack is stepped along recordings of its engagements": {
        "studio.calibration.engagement.pack_history": {"clutch"},
        "studio.calibration.engagement.recorded": {"clutch"},
        "studio.calibration.engagement.trace_fit": {"clutch"},
        "studio.calibration.engagement.traced_pack": {"clutch"},
    },
    "the folds of a washer's load curve are figures of a design": {
        "studio.evaluators.part_curve": {"washer"}
    },
    "engagements are those of a wet pack": {"studio.evaluators.engagement": {"clutch"}},
}


@pytest.mark.slow
def test_the_core_imports_nothing_of_the_studio():
    """Nor do names in strings lead there, but those of ``plugins``."""
    assert structure.upward() == []


@pytest.mark.slow
def test_functions_are_short():
    needed.package("ruff")
    lengths = structure.function_lengths(structure.formatted(structure.python_sources()))
    assert median(lengths.values()) <= MEDIAN_LINES


def test_the_formatter_is_kept_from_its_work_by_few_marks():
    found = {"sources": structure.python_sources(), "tests": structure.test_sources()}
    for kind, paths in found.items():
        assert structure.format_marks(paths) <= FORMAT_MARKS[kind], kind


def test_a_mark_for_the_formatter_makes_no_file_shorter(tmp_path):
    needed.package("ruff")
    wide, marked = tmp_path / "wide.py", tmp_path / "marked.py"
    text = f"x = [{', '.join(['first_of_all'] * 9)},]"
    wide.write_text(f"{text}\n")
    marked.write_text(f"{text}\n")
    found = structure.formatted((wide, marked))
    assert [len(text.splitlines()) for text in found.values()] == [11, 11]


def test_no_folder_holds_too_many_files():
    widths = structure.folder_widths() | structure.folder_widths(ROOT / "tests")
    del widths["thrustwasher/data/native"]  # compiled: three files to a model, read by none
    del widths["thrustwasher/studio/report/web/bundle"]  # put together of the scripts
    assert {folder: n for folder, n in widths.items() if n > FOLDER_FILES} == {}


@pytest.mark.slow
def test_no_modules_import_each_other_in_a_circle():
    """Wherever in a file they do so."""
    assert structure.circles(structure.imports()) == []


def test_no_c_files_of_the_shell_call_each_other_in_a_circle():
    graph = shell_calls.graph(structure.shell_sources())
    assert structure.circles(graph) == []
    assert "dispatch" in graph["solution"]  # calls are found


def test_a_c_file_calls_what_a_macro_of_a_header_names(tmp_path):
    texts = {
        "a.h": "#define ENTER(c) \\\n    if (!enter(c)) return 0\n",
        "a.c": "/* never */\nint f(int c) {\n    ENTER(c);\n    return own(c);\n}\n",
        "b.c": "static int own(int c) { return c; }\nint enter(int c) { return f(own(c)); }\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    graph = shell_calls.graph(tmp_path.iterdir())
    assert structure.circles(graph) == [["a", "b"]]


def test_no_module_is_imported_by_a_name_in_a_string():
    """But what is called from below: one list names it."""
    assert structure.names_of_modules().keys() == {"thrustwasher/plugins.py"}


@pytest.mark.parametrize("name", plugins.CALLED)
def test_what_is_called_from_below_is_there(name):
    assert plugins.called(name)


def test_a_circle_is_found():
    assert structure.circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) == [["a", "b", "c"]]


def test_no_file_is_long():
    needed.package("ruff")
    texts = structure.formatted(structure.python_sources())
    lengths = {str(path): len(text.splitlines()) for path, text in texts.items()}
    assert {name: n for name, n in lengths.items() if n > FILE_LINES} == {}


@pytest.mark.slow
def test_no_function_is_long():
    """A docstring is not counted."""
    needed.package("ruff")
    lengths = structure.function_lengths(structure.formatted(structure.python_sources()))
    assert {name: n for name, n in lengths.items() if n > FUNCTION_LINES} == {}


def test_every_status_is_used_somewhere():
    text = "\n".join(p.read_text("utf-8") for p in PACKAGE.rglob("*.py") if p.stem != "errors")
    assert [s.name for s in Status if not re.search(rf"\b{s.name}\b", text)] == []


def test_every_status_gives_advice():
    assert [s.name for s in Status if not s.advice] == []


def test_a_command_is_one_file_or_the_record_of_a_model():
    files = {p.stem for p in (PACKAGE / "cli").glob("[a-z]*.py")}
    lie = {"studio": set()}
    for folder, names in lie.items():
        names |= {p.stem for p in (PACKAGE / folder / "commands").glob("[a-z]*.py")}
    homes = {n: f"thrustwasher.{f}.commands.{n}" for f, names in lie.items() for n in names}
    assert homes == plugins.COMMANDS and files.isdisjoint(homes)
    files |= homes.keys()
    assert files.isdisjoint(cli.MODELS)
    assert files | set(cli.MODELS) == set(cli.COMMANDS)


# Models by themselves

HOMES = MODELS | HELPERS
KEYS = {name: key for key in HOMES for name in (key, find_model(key).name)}
LOOKS_UP = ("find_model", "find_spec", "spec_of", "ladder_of")  # by name


LISTS = (  # in layers above the models: each module that they import is of one model
    "studio.explore.page",
    "studio.report.model_plots",
    "studio.verification.reference_cache",
)


def belongs_to(key):
    """Return the modules that are a model's own: its folder, its commands."""
    command, home = find_model(key).command, HOMES[key]
    own = {f"thrustwasher.cli.{name}" for name in (command.more if command else ())}
    return own | {m for m in structure.modules() if m == home or m.startswith(f"{home}.")}


def named_models(module, path):
    """Return the models that a module imports, or tells from others by a constant."""
    imported = structure.imports()[module]
    found = {
        key
        for key, home in HOMES.items()
        if any(m == home or m.startswith(f"{home}.") for m in imported)
    }
    for node in ast.walk(structure.tree_of(path)):
        words = []
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            if any(is_key(side) for side in sides):
                words = [c for side in sides for c in ast.walk(side)]
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            words = node.args if node.func.id in LOOKS_UP else []
        found |= {KEYS[w.value] for w in words if isinstance(w, ast.Constant) and w.value in KEYS}
    return found


def is_key(node):
    """Tell if an expression is the key or the name of a model."""
    if isinstance(node, ast.Attribute):
        return node.attr in ("key", "name") and getattr(node.value, "id", "") in ("spec", "model")
    return isinstance(node, ast.Name) and node.id in ("model", "key")


@pytest.mark.slow
def test_who_names_a_model_is_listed_with_a_reason():
    own, found = {key: belongs_to(key) for key in HOMES}, {}
    listed = {m for name in LISTS for m in structure.imports()[f"thrustwasher.{name}"]}
    for module, path in structure.modules().items():
        named = {key for key in named_models(module, path) if module not in own[key]}
        if named and not (module in listed and len(named) == 1):
            found[module.removeprefix("thrustwasher.")] = named
    assert found == {m: named for modules in PLACES.values() for m, named in modules.items()}


def test_directions_of_imports_are_checked_for_every_model():
    config = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    homes = (MODELS | HELPERS).values()
    for contract in config["contracts"]:
        named = str(contract.get("source_modules", contract.get("layers")))
        if "thrustwasher.clutch" in named:
            missing = [home for home in homes if home not in named]
            assert not missing, f"{contract['name']}: {missing}"
