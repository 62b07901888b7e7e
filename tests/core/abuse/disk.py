"""A disk that is full for this process: files may not grow beyond a size."""

import os
import sys
from contextlib import contextmanager

import pytest

resource = pytest.importorskip("resource", reason="needs limits of POSIX")


@contextmanager
def full_disk(size):
    """Let every write beyond ``size`` bytes of a file fail.

    Python itself would go on with half a file of bytecode, now and later.
    """
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    bytecode = sys.dont_write_bytecode, os.environ.get("PYTHONDONTWRITEBYTECODE")
    sys.dont_write_bytecode = True
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        sys.dont_write_bytecode = bytecode[0]
        if bytecode[1] is None:
            del os.environ["PYTHONDONTWRITEBYTECODE"]
