"""Build the wheels: ``python build_wheels.py [--out DIR] [PLATFORM ...]``.

One for each platform, with the compiled kernels linked for it, and one for any machine ("any"). All
hold the kernels' object files and the libraries of the FMUs for every platform. Takes the packages
build and, for platforms other than this machine's, ziglang. Wheels for Windows, macOS and ARM are
linked here, not run.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import ship
from thrustwasher.native import link, shipped
from thrustwasher.native.entries import libraries
from thrustwasher.native.targets import PLATFORMS

HERE = Path(__file__).parent
TREE = (
    "pyproject.toml",
    "hatch_build.py",
    "README.md",
    "CHANGELOG.md",
    "LICENSE",
    "thrustwasher",
    "fmu_src",
)
ANY = "any"
TAGS = {
    "linux64": "py3-none-manylinux_2_17_x86_64",
    "win64": "py3-none-win_amd64",
    "aarch64-linux": "py3-none-manylinux_2_17_aarch64",
    "darwin-x86_64": "py3-none-macosx_11_0_x86_64",
    "darwin-arm64": "py3-none-macosx_11_0_arm64",
}


def build(platform: str, out: Path) -> None:
    """Build one wheel from a copy of the tree that holds the libraries of this platform only."""
    surroundings = dict(os.environ)
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        for name in TREE:
            source = HERE / name
            if source.is_dir():
                shutil.copytree(source, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy2(source, tree / name)
        ship.relist(
            tree / "thrustwasher" / "data" / "native", [platform] if platform != ANY else []
        )
        if platform != ANY:
            surroundings["THRUSTWASHER_WHEEL_TAG"] = TAGS[platform]
        command = [sys.executable, "-m", "build", "--wheel", "--outdir", str(out), str(tree)]
        done = subprocess.run(command, env=surroundings, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{platform}: {(done.stderr or done.stdout).strip()}")


def main() -> None:
    """Build the wheels that are named, all if none is."""
    parser = argparse.ArgumentParser(description="Build the wheels.")
    parser.add_argument("--out", type=Path, default=Path("dist"), metavar="DIR")
    parser.add_argument("platforms", nargs="*", metavar="PLATFORM", help=f"{', '.join(TAGS)}, any")
    given = parser.parse_args()
    assert TAGS.keys() == PLATFORMS.keys()
    stale = [name for name in libraries() if not shipped.has_objects(name)]
    if stale:
        sys.exit(f"stale: {', '.join(stale)}; first: python ship_all.py")
    if not link.find_linker().is_cross:
        sys.exit("wheels are linked by the package ziglang: pip install ziglang")
    for platform in given.platforms or [*TAGS, ANY]:
        if platform not in TAGS and platform != ANY:
            parser.error(f"PLATFORM {platform!r}, allowed: {', '.join(TAGS)}, any")
        build(platform, given.out)
    for path in sorted(given.out.glob("*.whl")):
        print(path)


if __name__ == "__main__":
    main()
