"""What keeps the kernels fit for compilation ahead of time: read from their sources."""

import ast
import importlib
import importlib.util
import inspect
import json
import subprocess
import sys
from pathlib import Path

import gate_rows
import llvmlite.binding as llvm
import pytest
from children import child
from kernel_files import ROOT, kernel_files

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.model.registry import compiled_packages
from thrustwasher.native import binaries
from thrustwasher.native.compiling import emit, gate
from thrustwasher.native.compiling.lower import is_of
from thrustwasher.native.targets import PLATFORMS, TARGETS

FILES = kernel_files()
ARRAY_METHODS = set("append astype copy dot fill max mean min ravel reshape sum T".split())
FORBIDDEN = tuple(
    getattr(ast, name)
    for name in """Raise Try With List Dict Set ListComp DictComp SetComp GeneratorExp JoinedStr
    Lambda Yield Global Import ImportFrom Assert MatMult""".split()
)


def kernels_of(path):
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.FunctionDef):
            names = {d.id for d in node.decorator_list if isinstance(d, ast.Name)}
            if names & {"kernel", "inlined"}:
                yield node


def body_nodes(function):
    """Walk what is compiled: neither annotations nor the docstring."""
    for statement in function.body:
        yield from ast.walk(statement)


def refused(function):
    for node in body_nodes(function):
        where = getattr(node, "lineno", 0)
        if isinstance(node, FORBIDDEN):
            yield where, type(node).__name__
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id == "np" and node.attr not in ("uintp", "log"):
                yield where, f"np.{node.attr}"
            elif node.value.id == "math" and node.attr == "gamma":
                yield where, "math.gamma"
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            if node.func.id in ("print", "list", "dict", "set", "sorted", "sum", "open"):
                yield where, node.func.id
        elif isinstance(node, ast.While) and isinstance(node.test, ast.Constant):
            yield where, "loop without an end"
        elif isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Subscript) and isinstance(target.slice, ast.Slice):
                    yield where, "assignment to a slice"
        if (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in ARRAY_METHODS
        ):
            yield where, f"method {node.func.attr}"


def name_of(path):
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


# What has no kernel, but a table of a file that kernels hold.
# Whose kernels are made of those of other models.
MADE_OF = {
    "thrustwasher.train.kernels": ("thrustwasher.gearmesh.kernels", "thrustwasher.losses.kernels")
}
READS_A_TABLE = ("thrustwasher.tribology.contact_table",)


def test_imports_are_numbers_only():
    """Numpy, numba and math, kernels of the same model, and those that all models share."""
    for path in FILES:
        name, package = name_of(path), name_of(path).rpartition(".")[0]
        own = [home for home in compiled_packages() if package.startswith(home)]
        own += [other for home in own for other in MADE_OF.get(home, ())]
        shared = ("thrustwasher.numerics", *(["thrustwasher.tribology"] if own else []))
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                assert {a.name for a in node.names} <= {"math", "numpy", "numba"}, name
            elif isinstance(node, ast.ImportFrom) and node.level:
                found = importlib.util.resolve_name("." * node.level + (node.module or ""), package)
                assert found.startswith((package, *own, *shared)), (name, found)
            elif isinstance(node, ast.ImportFrom):
                reads = ["pathlib"] if name in READS_A_TABLE else []
                known = ("typing", "numpy.typing", "numba", "__future__", *reads)
                assert node.module in known, name


def test_kernels_allocate_nothing_and_never_raise():
    kernels = [(path, kernel) for path in FILES for kernel in kernels_of(path)]
    found = [(name_of(path), k.name, *hit) for path, k in kernels for hit in refused(k)]
    assert found == []


def test_the_check_itself_sees_what_it_should():
    bad = """
@kernel
def k(a: NDArray[np.float64]) -> None:
    b = np.zeros(3)
    a[0:3] = b
    c = a.reshape(2, 2)
    while True:
        print([1])
    raise ValueError
"""
    function = next(n for n in ast.walk(ast.parse(bad)) if isinstance(n, ast.FunctionDef))
    kinds = {kind for _, kind in refused(function)}
    assert kinds == {
        "np.zeros",
        "assignment to a slice",
        "method reshape",
        "loop without an end",
        "print",
        "List",
        "Raise",
    }


PLAIN = """
import json
from thrustwasher import WasherParams, solve_washer
from thrustwasher.tribology.flow_factors import mean_gap, flow_conductance
from thrustwasher.tribology.viscosity import viscosity
r = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002, grid=(5, 8), throw=False)
b = solve_washer(WasherParams(heat_split=0.3), load=900.0, speed=136.0, tilt=0.002, grid=(5, 8),
                 start=None, throw=False)
m = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002, fidelity="map")
print(json.dumps([
    r.friction_torque, r.temperature, r.film_ratio, int(r.status), r.iterations, r.branch,
    b.friction_torque, b.temperature, b.film_ratio, int(b.status), b.iterations, b.branch,
    m.friction_torque, m.temperature, m.film_ratio, m.fidelity, m.branch,
    *mean_gap(1e-6, 7e-7), *flow_conductance(1e-6, 7e-7), *viscosity(297.15, 6.31e-5, 3.545, 1.053),
]))
"""


@pytest.mark.slow
def test_kernels_run_as_plain_python():
    """The same numbers without compilation, to the last few bits, on the smallest grid."""
    answers = []
    for disable in ("1", "0"):
        done = child(PLAIN, check=True, NUMBA_DISABLE_JIT=disable)
        answers.append(json.loads(done.stdout))
    for plain, compiled in zip(*answers, strict=True):
        assert plain == (compiled if isinstance(plain, str) else pytest.approx(compiled, rel=1e-8))
    assert answers[0][3] == answers[0][9] == 0


# What may go into an FMU: libm and memset pass, everything else is named with cause and cure.


@pytest.fixture(scope="module")
def judgements(tmp_path_factory):
    """What the gate says of each kernel in gate_rows, from one process with numba's settings."""
    surroundings = emit.environment(str(tmp_path_factory.mktemp("numba")))
    surroundings["PYTHONPATH"] = str(Path(__file__).parents[3])
    command = [sys.executable, gate_rows.__file__]
    run = subprocess.run(command, capture_output=True, text=True, env=surroundings, timeout=500)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@pytest.mark.parametrize("row", gate_rows.PASSED, ids=lambda row: row.__name__)
def test_numbers_loops_and_libm_pass(row, judgements):
    assert judgements[row.__name__] == ""


@pytest.mark.parametrize("row", gate_rows.REFUSED, ids=lambda row: row.__name__)
def test_what_needs_more_is_refused_with_kernel_symbol_and_cause(row, judgements):
    said = judgements[row.__name__]
    assert said.startswith("rows.derive is not self-contained, it needs ")
    assert gate_rows.REFUSED[row] in said and "not on the list" not in said


DOUBLE = (
    "define double @tw_step(double %x) {{\n %y = call double @{0}(double %x)\n ret double %y\n}}"
)


def compiled(text, platform):
    """Return (module, object file) of LLVM text for a platform."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(text)
    module.triple = TARGETS[platform].triple
    machine = llvm.Target.from_triple(module.triple).create_target_machine(
        reloc="static" if platform == "wasm32" else "pic", codemodel="default"
    )
    return module, bytes(machine.emit_object(module))


@pytest.mark.parametrize("platform", TARGETS)
def test_the_object_file_is_read_too_on_every_platform(platform):
    text = DOUBLE.format("secret") + "\ndeclare double @secret(double)\n"
    _, code = compiled(text, platform)
    assert binaries.undefined(code) == {"secret"}
    with pytest.raises(EnvironmentProblem, match=r"k\.step .* it needs secret \(not on the list"):
        gate.check_object(code, "k.step")


@pytest.mark.parametrize("platform", TARGETS)
def test_an_intrinsic_that_becomes_a_call_of_libm_passes(platform):
    text = DOUBLE.format("llvm.exp.f64") + "\ndeclare double @llvm.exp.f64(double)\n"
    module, code = compiled(text, platform)
    assert binaries.undefined(code) == {"exp"}
    gate.check_module(module, "k")
    gate.check_object(code, "k")


def test_instructions_of_one_kind_of_machine_are_refused():
    name = "llvm.x86.rdtsc"
    text = f"define i64 @tw_step() {{\n %y = call i64 @{name}()\n ret i64 %y\n}}\n"
    module = llvm.parse_assembly(f"{text}declare i64 @{name}()\n")
    with pytest.raises(EnvironmentProblem, match=r"llvm\.x86\.rdtsc .* one kind of machine"):
        gate.check_module(module, "k")


def test_a_variable_that_is_only_declared_is_refused():
    text = "@outside = external global i64\ndefine ptr @tw_step() {\n ret ptr @outside\n}\n"
    with pytest.raises(EnvironmentProblem, match="it needs outside"):
        gate.check_module(llvm.parse_assembly(text), "k")


def test_an_unknown_kind_of_object_is_said():
    with pytest.raises(EnvironmentProblem, match="neither ELF"):
        binaries.undefined(b"garbage that is no object file")


# Kernels that keep all speed are found by the name of their module in the compiler's names.

LEVELS = {level.name: level for platform in PLATFORMS.values() for level in platform.levels}


@pytest.mark.parametrize("level", LEVELS.values(), ids=LEVELS)
def test_every_module_listed_as_quick_is_found_by_the_names_of_its_kernels(level):
    funcdesc = pytest.importorskip("numba.core.funcdesc")
    assert level.quick and level.grouped
    listed = level.quick + level.grouped
    for name in listed:
        module = importlib.import_module(f"thrustwasher.{name}")
        kernels = [
            k for k in vars(module).values() if hasattr(k, "py_func") or inspect.isfunction(k)
        ]
        own = [k for k in kernels if k.__module__ == module.__name__]
        assert own
        for kernel in own:
            prefix = funcdesc.qualifying_prefix(module.__name__, kernel.__qualname__)
            assert is_of(funcdesc.default_mangler(prefix, ()), listed)
    assert not is_of("_ZN12thrustwasher6washer7kernels9constants6deriveB2v1", listed)
