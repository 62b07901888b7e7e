"""FMUs for this machine: built once per version, never stale, with or without a compiler."""

import zipfile

import needed
import pytest

from thrustwasher.cli import main
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu import fmu_cache
from thrustwasher.native import link, shipped

PART = "CommandSource"


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """Give an empty cache for FMUs; compiled kernels stay where they are."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "thrustwasher" / "built"


@pytest.fixture
def edited(monkeypatch):
    """What the FMUs' libraries are made of was edited: none is shipped."""
    monkeypatch.setattr(shipped, "is_linked", lambda kernel, digest: False)


@pytest.fixture
def no_linker(monkeypatch):
    def find_linker():
        raise EnvironmentProblem("pip install something")

    monkeypatch.setattr(link, "find_linker", find_linker)
    for name in ("find_linker", "local_linker"):
        monkeypatch.setattr(f"thrustwasher.fmu.shell.platform_libraries.{name}", find_linker)


@pytest.fixture
def linker():
    needed.linker()


def test_the_second_call_builds_nothing(cache, linker, capsys):
    first = fmu_cache.fmu_paths([PART], "native")
    assert f"built {PART} in" in capsys.readouterr().err
    changed = first[PART].stat().st_mtime_ns
    assert fmu_cache.fmu_paths([PART], "native") == first
    assert first[PART].stat().st_mtime_ns == changed
    assert capsys.readouterr() == ("", "")
    names = zipfile.ZipFile(first[PART]).namelist()
    places = {n.split("/")[1] for n in names if n.startswith("binaries/")}
    assert places == {link.this_platform().fmi2}
    assert not [n for n in names if n.endswith("_out.csv")]


@pytest.mark.parametrize("size", [0, 5000, None])
def test_an_fmu_that_is_not_as_it_was_built_is_built_again(cache, linker, capsys, size):
    path = fmu_cache.fmu_paths([PART], "native")[PART]
    built = path.read_bytes()
    path.write_bytes(built[:size] if size is not None else built[:-9] + b"x" + built[-8:])
    capsys.readouterr()
    assert fmu_cache.fmu_paths([PART], "native")[PART].read_bytes() == built
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"{PART} again: not as it was built" in said


@pytest.mark.parametrize("fmi", ["2", "3"])
def test_no_compiler_is_needed(no_linker, tmp_path, capsys, fmi):
    assert main(["build", PART, "--fmi", fmi, "--out", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert f"native-fmi{fmi}" in out and "compiler" not in err and "links" not in err


def test_what_was_edited_takes_a_compiler_and_that_is_said(edited, no_linker, tmp_path, capsys):
    assert main(["build", PART, "--out", str(tmp_path)]) == 2
    assert capsys.readouterr().err.endswith("pip install something\n")
    with pytest.raises(EnvironmentProblem, match="pip install"):
        fmu_cache.fmu_paths([PART], "native")


@pytest.mark.parametrize("changed", ["tools", "_levels"])
def test_another_compiler_or_processor_is_another_version(changed, edited, linker, monkeypatch):
    before = fmu_cache.source_digest("native"), fmu_cache.source_digest("python")
    monkeypatch.setattr(
        f"thrustwasher.fmu.shell.platform_libraries.{changed}", lambda given: "other"
    )
    after = fmu_cache.source_digest("native"), fmu_cache.source_digest("python")
    assert after[0] != before[0] and after[1] == before[1]


def test_any_source_counts(tmp_path, monkeypatch):
    (tmp_path / "shell").mkdir()
    monkeypatch.setattr("thrustwasher.fmu.package.model_sources.source_folder", lambda: tmp_path)
    seen = set()
    for name in ("model.toml", "readme.md", "shell/lifecycle.c", "shell/shell.h"):
        (tmp_path / name).write_text("x")
        seen.add(fmu_cache.source_digest("python"))
    (tmp_path / "shell/lifecycle.c").write_text("y")
    seen.add(fmu_cache.source_digest("python"))
    assert len(seen) == 5


def test_what_the_core_does_not_use_does_not_count(tmp_path, monkeypatch):
    package = tmp_path / "thrustwasher"
    for name in ("fmu", "studio"):
        (package / name).mkdir(parents=True)
    monkeypatch.setattr(fmu_cache, "__file__", str(package / "fmu" / "fmu_cache.py"))
    before = fmu_cache.source_digest("python")
    (package / "studio" / "palette.py").write_text("BLUE = 1")
    assert fmu_cache.source_digest("python") == before
    (package / "fmu" / "build.py").write_text("x = 1")
    assert fmu_cache.source_digest("python") != before


def test_a_new_map_is_another_version(tmp_path, monkeypatch):
    before = fmu_cache.source_digest("python")
    (tmp_path / "mine.twm").write_bytes(b"a map")
    monkeypatch.setenv("THRUSTWASHER_MAPS", str(tmp_path))
    assert fmu_cache.source_digest("python") != before
