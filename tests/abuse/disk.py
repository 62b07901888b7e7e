"""A disk that is full for this process: files may not grow beyond a size."""

from contextlib import contextmanager

import pytest

resource = pytest.importorskip("resource", reason="needs limits of POSIX")


@contextmanager
def full_disk(size):
    """Let every write beyond ``size`` bytes of a file fail."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
