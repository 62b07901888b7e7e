"""The doctor reports and never stumbles; the build script says what is wrong in one line."""

import subprocess
import sys

import pytest
from toy.places import HERE

from thrustwasher.errors import ParameterError
from thrustwasher.fmu import diagnosis
from thrustwasher.native import link


def found():
    return {check.name: check for check in diagnosis.diagnose()}


def test_every_finding_has_a_name_and_a_sentence():
    for name, check in found().items():
        assert name and check.text and "\n" not in check.text


def test_what_the_tests_run_on_works():
    checks = found()
    for name in ("thrustwasher", "Python", "numpy", "numba", "fmpy", "pythonfmu", "slave files"):
        assert checks[name].ok, checks[name].text
    assert "nothing has to be compiled" in checks["compiled kernels"].text
    assert "builds for linux64" in checks["native FMUs, compiler"].text


def test_a_missing_package_is_a_finding_with_the_command_that_helps():
    check = diagnosis._look("x", diagnosis._importable("no_such_package"))
    assert not check.ok and "pip install no-such-package" in check.text


def test_a_folder_that_cannot_be_written_to_is_a_finding(tmp_path):
    with pytest.raises(ParameterError, match="cannot be written to"):
        diagnosis._writable(str(tmp_path / "missing"))


def test_a_platform_without_library_is_a_finding(monkeypatch):
    monkeypatch.setattr("platform.machine", lambda: "aarch64")
    with pytest.raises(ParameterError, match=r"no library for .* on aarch64"):
        diagnosis._binary()


def test_no_compiler_is_a_finding_with_what_to_install(monkeypatch):
    monkeypatch.setattr(link.importlib.util, "find_spec", lambda name: None)
    monkeypatch.setattr(link.shutil, "which", lambda name: None)
    link.forget()
    check = diagnosis._look("x", diagnosis._compiler)
    monkeypatch.undo()
    link.forget()
    assert (
        not check.ok and "pip install 'thrustwasher[build]'" in check.text and "gcc" in check.text
    )


def script(*arguments):
    command = [sys.executable, HERE.parents[1] / "build_fmu.py", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


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
