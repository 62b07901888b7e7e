"""Files and folders that are written whole or not at all."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import ParameterError, naming
from ..native.drafts import draft_in, flush


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a temporary path next to ``path`` that takes its place only if all went well."""
    with (
        naming(path),
        new_folder(path.parent),
        draft_in(path.parent, path.suffix, is_folder=False) as draft,
    ):
        yield draft
        mask = os.umask(0)  # of ordinary new files
        os.umask(mask)
        draft.chmod(0o666 & ~mask)
        flush(draft)
        os.replace(draft, path)


@contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder whose files move to ``path`` only if all went well.

    ParameterError: a folder has the name of a file.
    """
    with naming(path), new_folder(path), draft_in(path) as draft:
        yield draft
        made = sorted(draft.iterdir())
        for blocked in (path / file.name for file in made):
            if blocked.is_dir():
                raise ParameterError(
                    f"{blocked}: is a folder, and a file of this name is to be written; move "
                    "or rename it, or choose another folder"
                )
        flush(draft)
        for file in made:
            os.replace(file, path / file.name)


@contextmanager
def new_folder(folder: Path, *, stays: bool = True) -> Iterator[None]:
    """Make a folder with its parents; those that are new and empty go again unless all went well.

    For a trial nothing ``stays`` in any case.
    """
    missing = [p for p in (folder, *folder.parents) if not p.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
        missing = [] if stays else missing
    finally:
        for made in missing:  # the innermost first
            with suppress(OSError):
                made.rmdir()
