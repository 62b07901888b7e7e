"""The doctor reports and never stumbles; the build script says what is wrong in one line."""

import subprocess
import sys
import tomllib
from types import SimpleNamespace

import pytest
from kernel_files import ROOT
from packaging.requirements import Requirement
from toy.places import HERE

from thrustwasher import __version__
from thrustwasher.errors import ParameterError
from thrustwasher.fmu import diagnosis, packages
from thrustwasher.fmu.model_kernels import package_version


def found():
    return {check.name: check for check in diagnosis.diagnose()}


def test_every_finding_has_a_name_and_a_sentence():
    for name, check in found().items():
        assert name and check.text and "\n" not in check.text


def test_what_the_tests_run_on_works():
    checks = found()
    for name in ("Python", "numpy", "numba", "fmpy", "pythonfmu", "FMU sources"):
        assert checks[name].ok, checks[name].text
    assert "nothing has to be compiled" in checks["compiled kernels"].text
    assert "libraries of all FMUs are shipped" in checks["native FMUs, compiler"].text


@pytest.mark.parametrize("installed", ["0.0.9", None, __version__])
def test_an_installed_copy_of_another_version_is_a_finding(monkeypatch, installed):
    copies = [SimpleNamespace(version=installed)] if installed else []
    monkeypatch.setattr(diagnosis.metadata, "distributions", lambda name: copies)
    check = diagnosis._look("x", diagnosis._version)
    assert check.ok == (installed in (None, __version__)) and __version__ in check.text
    assert check.ok or ("0.0.9 is installed" in check.text and "pip install" in check.text)


def test_the_version_of_the_code_is_that_of_the_project():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    assert package_version() == __version__ == project["project"]["version"]


def test_a_missing_package_is_a_finding_with_the_command_that_helps():
    check = diagnosis._look("x", diagnosis._importable("no_such_package"))
    assert not check.ok and "pip install no-such-package" in check.text


@pytest.mark.parametrize(
    ("version", "words"),
    [
        ("2.0.1", "2.0.1 (tried: 2.0 .. 2.5.5)"),
        ("2.5.5.post1", "(tried: 2.0 .. 2.5.5)"),
        ("2.6.0rc1", "2.6.0rc1, newer than what was tried (2.0 .. 2.5.5): it may well do"),
    ],
)
def test_a_package_is_shown_beside_the_versions_that_were_tried(version, words, monkeypatch):
    monkeypatch.setattr(packages.metadata, "version", lambda name: version)
    assert words in packages.described(packages.Range("numpy", "2.0", "2.5.5"))


def test_a_package_older_than_required_is_a_finding(monkeypatch):
    monkeypatch.setattr(packages.metadata, "version", lambda name: "1.26.4")
    with pytest.raises(ParameterError, match=r"1\.26\.4 is older than what is required: 2\.0"):
        packages.described(packages.Range("numpy", "2.0", "2.5.5"))


def test_every_package_that_commands_use_was_tried_in_some_version():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = (project["optional-dependencies"][name] for name in packages.OPTIONAL)
    lines = [*project["dependencies"], *(line for extra in extras for line in extra)]
    assert {"python", *(Requirement(line).name for line in lines)} == packages.newest_tried().keys()


def test_a_folder_that_cannot_be_written_to_is_a_finding(tmp_path):
    with pytest.raises(ParameterError, match="cannot be written to"):
        diagnosis._writable(str(tmp_path / "missing"))


def test_a_platform_without_library_is_a_finding(monkeypatch):
    monkeypatch.setattr("platform.machine", lambda: "aarch64")
    with pytest.raises(ParameterError, match=r"no library for .* on aarch64"):
        diagnosis._binary()


def script(*arguments):
    command = [sys.executable, HERE.parents[2] / "build_fmu.py", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


@pytest.mark.slow
def test_the_build_script_builds_and_prints_paths(tmp_path):
    done = script("WetClutch", "--target", "python", "--out", tmp_path)
    path = tmp_path / "python-fmi2" / "WetClutch.fmu"
    assert (done.returncode, done.stdout) == (0, f"{path}\n"), done.stderr
    assert path.is_file()


@pytest.mark.parametrize("wrong", [["--target", "python", "--fmi", "3"], ["Clutch"]])
def test_the_build_script_says_what_is_wrong_in_one_line(wrong, tmp_path):
    done = script(*wrong, "--out", tmp_path)
    assert done.returncode == 2 and done.stdout == ""
    assert len(done.stderr.splitlines()) == 1 and "allowed" in done.stderr
