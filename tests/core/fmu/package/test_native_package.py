"""Native FMUs: what lies inside, what checkers say, that building repeats, how large they are."""

import re
import subprocess
import zipfile
from dataclasses import replace
from pathlib import Path

import fmpy
import needed
import numpy as np
import pytest
from built import built_fmu
from fmpy import simulate_fmu
from fmpy.util import read_csv
from lxml import etree
from needed import IN_CI, linkable

from thrustwasher.cli import main
from thrustwasher.errors import ParameterError
from thrustwasher.fmu.build import build, validate
from thrustwasher.fmu.documentation.reference_results import FOLDER
from thrustwasher.fmu.model_kernels import has_derivatives
from thrustwasher.fmu.shell import platform_libraries
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.native.link import find_linker
from thrustwasher.native.targets import PLATFORMS

SMALL = "GearMesh"
LARGEST = 800_000  # bytes of an FMU with the libraries of every platform
LARGEST_WASHER = 2_050_000  # seven times 220 kB of kernels; with one platform it is below LARGEST
NAMES = [*(spec.name for spec in all_specs()), "CommandSource"]


pytestmark = pytest.mark.skipif(
    "linux64" not in linkable() and not IN_CI,
    reason="no C compiler for Linux: pip install ziglang, or gcc",
)
can_all = pytest.mark.skipif(
    len(linkable()) < len(PLATFORMS) and not IN_CI,
    reason="pip install ziglang to link for every platform",
)


def everywhere(test):
    """Mark a test that builds for every platform."""
    return pytest.mark.platforms(can_all(test))


each_fmi = pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])


def packed(name, fmi):
    """Return the FMU of a model for Linux."""
    return built_fmu(name, fmi=fmi, platforms=["linux64"])


@pytest.fixture(scope="module", params=[2, 3])
def whole(request, tmp_path_factory):
    """A small model for every platform: FMI version, contents."""
    (path,) = build([SMALL], fmi=request.param, out=tmp_path_factory.mktemp("dist"))
    with zipfile.ZipFile(path) as zipped:
        return request.param, {n: zipped.read(n) for n in zipped.namelist()}


@pytest.mark.parametrize(
    ("name", "fmi"),
    [(SMALL, 2), *(pytest.param(n, 2, marks=pytest.mark.slow) for n in NAMES if n != SMALL)]
    + [pytest.param(n, 3, marks=pytest.mark.slow) for n in NAMES],
)
def test_fmpys_check_finds_nothing(name, fmi):
    assert validate(packed(name, fmi)) == []


@pytest.mark.parametrize(
    "name", [SMALL, *(pytest.param(n, marks=pytest.mark.slow) for n in NAMES if n != SMALL)]
)
@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.slow
def test_the_manipulation_toolbox_finds_nothing(name, fmi):
    fmu = packed(name, fmi)
    command = [needed.tool("fmutool"), "-input", fmu, "-check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = done.stdout + done.stderr
    assert f"seems to be compliant with FMI-{fmi}.0" in said
    assert not [line for line in said.splitlines() if line.startswith(("ERROR", "WARN", "CRIT"))]


# what FMI 3 does to the numbers, the small model shows: nothing
@pytest.mark.parametrize(
    ("name", "fmi"), [*((n, 2) for n in NAMES), pytest.param(SMALL, 3, marks=pytest.mark.fmi3)]
)
def test_the_default_experiment_gives_the_reference_results(name, fmi, tmp_path):
    with zipfile.ZipFile(packed(name, fmi)) as zipped:
        zipped.extractall(tmp_path)
    expected = read_csv(tmp_path / FOLDER / f"{name}_out.csv")
    given = tmp_path / FOLDER / f"{name}_in.csv"
    found = simulate_fmu(
        str(packed(name, fmi)),
        output=expected.dtype.names[1:],
        input=read_csv(given) if given.is_file() else None,
    )
    found = found[np.searchsorted(found["time"], expected["time"] - 1e-9)]
    assert found["time"] == pytest.approx(expected["time"], abs=1e-9)
    for signal in find_spec(name).outputs:
        absent = 2e-6 * (signal.nominal or 0.0)  # less than a millionth is written as 0
        assert found[signal.name] == pytest.approx(expected[signal.name], rel=1e-8, abs=absent)


@everywhere
def test_every_platform_has_its_library_at_its_place(whole):
    fmi, files = whole
    folders = {"linux64": "so", "win64": "dll", "aarch64-linux": "so", "darwin64": "dylib"}
    if fmi == 3:
        folders = {
            "x86_64-linux": "so",
            "x86_64-windows": "dll",
            "aarch64-linux": "so",
            "x86_64-darwin": "dylib",
            "aarch64-darwin": "dylib",
        }
    expected = {f"binaries/{folder}/{SMALL}.{ending}" for folder, ending in folders.items()}
    assert {name for name in files if name.startswith("binaries/")} == expected
    starts = {"so": b"\x7fELF", "dll": b"MZ", "dylib": b"\xcf\xfa\xed\xfe"}
    if fmi == 2:
        starts["dylib"] = b"\xca\xfe\xba\xbe\0\0\0\2"  # both processors in one file
    for name in expected:
        assert files[name].startswith(starts[name.rpartition(".")[2]]), name


@everywhere
def test_everything_a_user_looks_for_is_inside_and_nothing_else(whole):
    fmi, files = whole
    tree = etree.fromstring(files["modelDescription.xml"])
    guid = tree.get("guid" if fmi == 2 else "instantiationToken")
    page = files["documentation/index.html"].decode()
    assert guid.encode() in files["resources/part.bin"]
    assert guid in page and f"FMI {fmi}.0" in page and ", ".join(PLATFORMS) in page
    for name, content in files.items():
        if name.startswith("binaries/"):
            assert b"/tmp/" not in content and b"/root/" not in content, name
        if name.startswith("documentation/licenses/"):
            assert len(content.strip()) > 200
    assert ("model.png" in files) == (fmi == 2)
    plugs = {"terminalsAndIcons"} if fmi == 3 else set()
    assert {n.split("/")[0] for n in files} - {"model.png"} == plugs | {
        "modelDescription.xml",
        "binaries",
        "documentation",
        "extra",
        "resources",
    }
    assert not [n for n in files if n.endswith((".py", ".o", ".pdb", ".lib"))]


@pytest.mark.slow
def test_plugs_lie_in_fmi_2_files_only_where_they_are_asked_for(tmp_path):
    """FMI Library 3 calls them fatal there; in FMI 3.0 files they always lie."""
    for words, version, wanted in (([], 2, False), (["--terminals"], 2, True), ([], 3, True)):
        out = tmp_path / f"{version}-{wanted}"
        asked = ["build", SMALL, "--platforms", "linux64", "--fmi", str(version), *words]
        assert main([*asked, "--out", str(out)]) == 0
        (path,) = out.rglob("*.fmu")
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
        assert ("terminalsAndIcons/terminalsAndIcons.xml" in names) == wanted
        assert validate(path) == []


def description_of(path):
    with zipfile.ZipFile(path) as archive:
        return etree.fromstring(archive.read("modelDescription.xml"))


@pytest.mark.parametrize("name", NAMES)
@each_fmi
def test_the_description_says_derivatives_where_the_kernels_have_them(name, fmi):
    flag = {2: "providesDirectionalDerivative", 3: "providesDirectionalDerivatives"}[fmi]
    has = "true" if has_derivatives(find_spec(name)) else "false"
    assert description_of(packed(name, fmi)).find("CoSimulation").get(flag) == has


@each_fmi
def test_building_again_elsewhere_gives_the_same_bytes(fmi, tmp_path, run_child):
    code = (
        "import sys; from pathlib import Path; from thrustwasher.fmu.build import build;"
        "build(['CommandSource'], fmi=int(sys.argv[2]), out=Path(sys.argv[1]),"
        "      platforms=['linux64'])"
    )
    run_child(code, tmp_path, fmi)
    again = tmp_path / f"native-fmi{fmi}" / "CommandSource.fmu"
    assert again.read_bytes() == packed("CommandSource", fmi).read_bytes()


@everywhere
def test_building_for_every_platform_repeats(tmp_path):
    one, two = (
        build(["CommandSource"], out=tmp_path / folder)[0].read_bytes() for folder in ("a", "b/c")
    )
    assert one == two


def test_without_zig_what_is_not_shipped_is_for_this_platform_alone_and_it_is_said(monkeypatch):
    alone = replace(find_linker(), name="gcc", platforms=("linux64",))
    monkeypatch.setattr(platform_libraries, "find_linker", lambda: alone)
    monkeypatch.setattr(platform_libraries, "is_shipped", lambda spec: False)
    said, specs = [], all_specs()
    assert platform_libraries.chosen(None, said.append, specs) == ("linux64",)
    assert len(said) == 1 and "linux64 only" in said[0] and "pip install" in said[0]
    with pytest.raises(
        ParameterError, match=r"platform = 'win64', allowed here: linux64; for .* pip"
    ):
        platform_libraries.chosen(["win64"], said.append, specs)


def test_an_unknown_platform_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="platform = 'amiga', allowed: linux64, win64"):
        build([SMALL], out=tmp_path, platforms=["amiga"])
    assert list(tmp_path.iterdir()) == []


@everywhere
@pytest.mark.parametrize("name", NAMES)
@each_fmi
def test_an_fmu_for_every_platform_is_small(name, fmi, tmp_path):
    """Without the washer's maps, 2.5 MB of numbers."""
    (path,) = build([name], fmi=fmi, out=tmp_path, maps=False)
    assert path.stat().st_size <= (LARGEST_WASHER if name == "ThrustWasher" else LARGEST)
    (path,) = build([name], fmi=fmi, out=tmp_path, platforms=["linux64"], maps=False)
    assert path.stat().st_size <= LARGEST


def test_a_host_that_reads_all_outputs_as_real_numbers_runs_an_fmu_with_plain_outputs():
    """With the usual one it stops at the first enumeration."""
    usual, plain = (built_fmu("WetClutch", local=True, **o) for o in ({}, {"plain": True}))
    about = [fmpy.read_model_description(str(path)) for path in (usual, plain)]
    assert about[0].guid != about[1].guid and validate(plain) == []
    for path, model in zip((usual, plain), about, strict=True):
        references = [v.valueReference for v in model.modelVariables if v.causality == "output"]
        fmu = fmpy.instantiate_fmu(fmpy.extract(str(path)), model, "CoSimulation")
        fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        if path == usual:
            with pytest.raises(Exception, match="fmi2GetReal failed"):
                fmu.getReal(references)
        else:
            assert fmu.getReal(references)[0] > 0.0
            (locked,) = (v.valueReference for v in model.modelVariables if v.name == "locked")
            assert fmu.getBoolean([locked]) == [False]
        fmu.terminate()
        fmu.freeInstance()


def test_a_first_run_in_another_tool_shows_what_the_page_says():
    """Nothing connected, steps of 1 ms, as docs/start/host.md has it."""
    page = (Path(__file__).parents[4] / "docs/start/host.md").read_text("utf-8")
    said = {float(t): row for t, row in re.findall(r"^- at ([\d.]+) s: (.*)$", page, re.M)}
    names = ["friction_torque", "temperature", "film_ratio", "solver_status"]
    fmu = str(built_fmu("WetClutch", local=True))
    rows = simulate_fmu(fmu, stop_time=0.1, output_interval=1e-3, output=names)
    for row in (rows[0], rows[-1]):
        numbers = re.findall(r"(?<![\w.])\d+(?:\.\d+)?", said[round(row["time"], 6)])
        shown = [
            f"{row[n]:.{len(x.partition('.')[2])}f}" for n, x in zip(names, numbers, strict=True)
        ]
        assert shown == numbers
