"""A macOS library for several processors: a table of contents, then each library as it is."""

import struct
from collections.abc import Sequence

MAGIC = 0xCAFEBABE
HEADER, ENTRY = ">II", ">IIIII"  # big-endian, as Apple's <mach-o/fat.h> defines them
ALIGNMENT = 14  # as a power of two: the page of arm64


def universal(parts: Sequence[bytes]) -> bytes:
    """Return one file of several 64-bit Mach-O libraries.

    Each part begins with magic, processor and subtype, little-endian; the table repeats the last
    two. Parts start at whole pages.
    """
    table = struct.pack(HEADER, MAGIC, len(parts))
    end = struct.calcsize(HEADER) + len(parts) * struct.calcsize(ENTRY)
    body = b""
    for part in parts:
        processor, subtype = struct.unpack_from("<II", part, 4)
        gap = -end % (1 << ALIGNMENT)
        table += struct.pack(ENTRY, processor, subtype, end + gap, len(part), ALIGNMENT)
        body += bytes(gap) + part
        end += gap + len(part)
    return table + body
