"""A zip with the same bytes for the same content: sorted and undated."""

import io
import zipfile
from collections.abc import Mapping

from ...native.files import write as write

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
