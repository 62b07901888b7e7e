"""What a machine may lack: a test that needs it is skipped with a reason; in CI it fails."""

import os
import sys
from importlib import import_module
from pathlib import Path

import pytest

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.native import link

IN_CI = bool(os.environ.get("CI"))
LACKS = (link.MISSING, "needs the package")  # what the package says of it
DEV = 'pip install -e ".[dev]"'


def missing(what):
    """Skip what needs something that is missing; fail where all must be there."""
    (pytest.fail if IN_CI else pytest.skip)(what)


def package(name):
    """Return a module of an optional package."""
    try:
        return import_module(name)
    except ImportError:
        return missing(f"{name} is missing: {DEV}")


def tool(name):
    """Return the command that a package put next to Python."""
    found = Path(sys.executable).parent / name
    return found if found.exists() else missing(f"{name} is missing: {DEV}")


def linker():
    """Return what links here."""
    try:
        return link.find_linker()
    except EnvironmentProblem as problem:
        return missing(str(problem))


def linkable():
    """Return the platforms that can be linked for."""
    try:
        return link.find_linker().platforms
    except EnvironmentProblem:
        return ()
