"""The names an object file needs from elsewhere: ELF, COFF and Mach-O, 64 bit, little endian."""

import struct

from ..errors import EnvironmentProblem

_MACHO = 0xFEEDFACF
_SYMTAB = 2  # section type in ELF and load command in Mach-O
_COFF = (0x8664, 0xAA64)


def undefined(code: bytes) -> set[str]:
    """Return the symbols that an object file refers to and does not define.

    Raises
    ------
    EnvironmentProblem : the file is of another kind
    """
    if code[:4] == b"\x7fELF":
        return _elf(code)
    number = struct.unpack_from("<I", code)[0]
    if number == _MACHO:
        return _macho(code)
    if number & 0xFFFF in _COFF:
        return _coff(code)
    raise EnvironmentProblem(
        f"an object file starts with {code[:4]!r}: neither ELF, COFF nor MachO"
    )


def text_at(data: bytes, start: int) -> str:
    """Return the zero-terminated text at a place."""
    return data[start : data.index(b"\0", start)].decode("ascii")


def elf_sections(code: bytes) -> list[tuple[int, ...]]:
    """Return (name, type, flags, address, offset, size, link, info, align, entry size) of each."""
    start, size, number = *struct.unpack_from("<Q", code, 40), *struct.unpack_from("<HH", code, 58)
    return [struct.unpack_from("<IIQQQQIIQQ", code, start + i * size) for i in range(number)]


def _elf(code: bytes) -> set[str]:
    sections = elf_sections(code)
    found = set()
    for section in sections:
        if section[1] == _SYMTAB:
            names = sections[section[6]][4]
            for place in range(section[4] + 24, section[4] + section[5], 24):  # the first is empty
                name, _, _, home = struct.unpack_from("<IBBH", code, place)
                if home == 0:
                    found.add(text_at(code, names + name))
    return found


def _coff(code: bytes) -> set[str]:
    start, number = struct.unpack_from("<II", code, 8)
    names, found, i = start + 18 * number, set(), 0
    while i < number:
        raw, value, home, _, kind, extra = struct.unpack_from("<8sIhHBB", code, start + 18 * i)
        if kind == 2 and home == 0 and value == 0:  # external, in no section, no common block
            zero, offset = struct.unpack("<II", raw)
            found.add(raw.rstrip(b"\0").decode("ascii") if zero else text_at(code, names + offset))
        i += 1 + extra
    return found


def _macho(code: bytes) -> set[str]:
    commands, place, found = struct.unpack_from("<I", code, 16)[0], 32, set()
    for _ in range(commands):
        command, size = struct.unpack_from("<II", code, place)
        if command == _SYMTAB:
            start, number, names, _ = struct.unpack_from("<IIII", code, place + 8)
            for i in range(number):
                name, kind, home, _, value = struct.unpack_from("<IBBHQ", code, start + 16 * i)
                if kind & 0x0E == 0 and kind & 0x01 and home == 0 and value == 0:
                    found.add(text_at(code, names + name).removeprefix("_"))
        place += size
    return found
