"""A zip with the same bytes for the same content: sorted, undated, written all or nothing."""

import io
import os
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

from ..errors import naming

FIRST = "modelDescription.xml"
EPOCH = (1980, 1, 1, 0, 0, 0)
UNIX, FILE_MODE = 3, 0o100644


def pack(files: Mapping[str, bytes]) -> bytes:
    """Return a zip of ``files``: path with forward slashes -> content."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name in sorted(files, key=lambda n: (n != FIRST, n)):
            name.encode("ascii")  # FMI 2 says nothing about other characters
            info = zipfile.ZipInfo(name, EPOCH)
            info.create_system, info.external_attr = UNIX, FILE_MODE << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, files[name], compresslevel=9)
    return buffer.getvalue()


def write(path: Path, data: bytes) -> None:
    """Put a file in place at once: a reader sees the old one or the new one, never a half."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with naming(path), os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(part, 0o644)
        os.replace(part, path)
    except BaseException:
        os.unlink(part)
        raise
