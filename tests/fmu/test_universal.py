"""The table of a universal macOS library points at its parts."""

import struct

from thrustwasher.fmu.universal import universal

X86_64, ARM64 = 0x01000007, 0x0100000C


def library(processor, subtype, length):
    return struct.pack("<III", 0xFEEDFACF, processor, subtype) + bytes(length - 12)


def test_each_part_lies_at_a_whole_page_as_the_table_says():
    parts = [library(X86_64, 3, 20_000), library(ARM64, 0, 5_001)]
    data = universal(parts)
    magic, n = struct.unpack_from(">II", data)
    assert (magic, n) == (0xCAFEBABE, 2)
    entries = [struct.unpack_from(">IIIII", data, 8 + 20 * i) for i in range(n)]
    assert [e[:2] for e in entries] == [(X86_64, 3), (ARM64, 0)]
    for part, (_, _, offset, size, align) in zip(parts, entries, strict=True):
        assert offset % (1 << align) == 0 and offset % 0x4000 == 0
        assert data[offset : offset + size] == part
    assert len(data) == entries[-1][2] + entries[-1][3]
