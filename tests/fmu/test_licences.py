"""Every part that comes from others has its notice in the FMU."""

import pytest

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu import licences as module
from thrustwasher.fmu.licences import PLACE, licences

SAID = {
    "license.txt": b"thrustwasher authors",
    "numba.txt": b"Anaconda",
    "llvmlite.txt": b"All rights reserved",
    "llvm.txt": b"LLVM Exceptions",
    "fmi-headers.txt": b"Modelica Association",
    "pythonfmu.txt": b"MIT",
}
BOTH = {"license.txt", "overview.txt"}
NATIVE = {*BOTH, "numba.txt", "llvmlite.txt", "llvm.txt", "fmi-headers.txt"}


@pytest.mark.parametrize(
    ("target", "platforms", "names"),
    [
        ("python", (), {*BOTH, "pythonfmu.txt"}),
        ("native", ("linux64",), NATIVE),
        ("native", ("linux64", "win64"), {*NATIVE, "mingw-w64.txt"}),
    ],
)
def test_the_notices_of_a_target_are_these(target, platforms, names):
    if "win64" in platforms:
        pytest.importorskip("ziglang", reason="pip install ziglang to link for Windows")
    found = {
        path.removeprefix(f"{PLACE}/"): text for path, text in licences(target, platforms).items()
    }
    assert found.keys() - {"zig.txt"} == names
    assert all(len(text.strip()) > 200 for text in found.values())
    for name in found.keys() & SAID.keys():
        assert SAID[name] in found[name], name
    for name in found.keys() - {"overview.txt"}:
        assert name.encode() in found["overview.txt"]


def test_the_notice_of_the_headers_is_that_of_a_bsd_licence():
    notice = licences("native")[f"{PLACE}/fmi-headers.txt"].decode()
    assert notice.startswith("Copyright") and notice.endswith("POSSIBILITY OF SUCH DAMAGE.\n")
    assert "Redistributions in binary form must reproduce the above copyright notice" in notice


def test_a_missing_notice_stops_the_build(monkeypatch):
    monkeypatch.setattr(module.metadata, "files", lambda package: [])
    with pytest.raises(EnvironmentProblem, match="install numba again"):
        licences("native")
