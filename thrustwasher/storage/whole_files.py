"""Files and folders that are written whole or not at all."""

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
    with naming(path), _folder_unless_failed(path.parent):
        handle, name = tempfile.mkstemp(prefix=".", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        try:
            yield Path(name)
            os.chmod(name, 0o666 & ~_umask())
            os.replace(name, path)
        finally:
            Path(name).unlink(missing_ok=True)


@contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder whose files move to ``path`` only if all went well."""
    with naming(path), _folder_unless_failed(path):
        draft = Path(tempfile.mkdtemp(prefix=".draft-", dir=path))
        try:
            yield draft
            for made in sorted(draft.iterdir()):
                os.replace(made, path / made.name)
        finally:
            shutil.rmtree(draft, ignore_errors=True)


@contextmanager
def _folder_unless_failed(folder: Path) -> Iterator[None]:
    """Make a folder with its parents; after a failure those that are new and empty go again."""
    missing = [p for p in (folder, *folder.parents) if not p.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    try:
        yield
    except BaseException:
        _remove(missing)
        raise


@contextmanager
def folder_for_trial(folder: Path) -> Iterator[None]:
    """Make a folder with its parents; those that are new go again in any case."""
    missing = [p for p in (folder, *folder.parents) if not p.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    finally:
        _remove(missing)


def _remove(folders: list[Path]) -> None:
    """Remove the folders that exist and are empty, innermost first."""
    for folder in folders:
        with suppress(OSError):
            folder.rmdir()


def _umask() -> int:
    """Return the mask that ordinary new files get."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
