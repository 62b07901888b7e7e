"""Compiled code kept from an earlier run: a folder for each version of a kernel module."""

from pathlib import Path

from . import files, shipped
from .digest import digest


def kept_folder(kernel: str) -> Path:
    """Return the folder of this version of a kernel in the user's cache; it need not exist."""
    return files.code_folder() / f"{shipped.short(kernel)}-{digest(kernel)}"


def forget_old(kernel: str, home: Path) -> None:
    """Remove the folders of a kernel's versions in a folder, but the last five."""
    files.forget_old(home, f"{shipped.short(kernel)}-*", kept=5)
