"""Files and folders that appear whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import naming


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a temporary path beside ``path`` that takes its place only if all went well."""
    with naming(path), made_folder(path.parent):
        handle, name = tempfile.mkstemp(prefix=".", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        try:
            yield Path(name)
            mask = os.umask(0)  # it can only be read by setting it
            os.umask(mask)
            os.chmod(name, 0o666 & ~mask)
            os.replace(name, path)
        finally:
            Path(name).unlink(missing_ok=True)


@contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder whose files move to ``path`` only if all went well."""
    with naming(path), made_folder(path):
        draft = Path(tempfile.mkdtemp(prefix=".draft-", dir=path))
        try:
            yield draft
            for made in sorted(draft.iterdir()):
                os.replace(made, path / made.name)
        finally:
            shutil.rmtree(draft, ignore_errors=True)


@contextmanager
def made_folder(folder: Path, *, trial: bool = False) -> Iterator[None]:
    """Make a folder with its parents; those that are new and empty go after a failure or trial."""
    missing = [p for p in (folder, *folder.parents) if not p.exists()]
    done = False
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
        done = True
    finally:
        for new in missing if trial or not done else ():
            with suppress(OSError):
                new.rmdir()
