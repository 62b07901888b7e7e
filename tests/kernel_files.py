"""Which files hold kernels."""

from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "thrustwasher"
FOLDERS = ("numerics", "tribology", "tribology/holding", "*/kernels", "*/kernels/*")


def kernel_files():
    """Return the modules of kernels, without what makes kernels of functions."""
    found = [path for folder in FOLDERS for path in PACKAGE.glob(f"{folder}/*.py")]
    return sorted(p for p in found if p.name not in ("jit.py", "parameters.py", "__init__.py"))
