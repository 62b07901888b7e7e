"""What a finished library needs from the machine that loads it, and what it shows: checked."""

import re
import struct
from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import EnvironmentProblem
from .symbols import elf_sections, text_at

ALLOWED = {
    "ELF": r"(libc\.so\.6|libm\.so\.6|ld-linux-.*)",
    "PE": r"(kernel32|api-ms-win-crt-[a-z]+-l1-1-0|ucrtbase)\.dll",
    "MachO": r"/usr/lib/libSystem\.B\.dylib",
}
_OWN = {"__dso_handle", "_mh_dylib_header"}  # places that zig's linker for macOS always shows
_NEEDED = 1  # tag in ELF's dynamic section
_DYNAMIC, _DYNSYM, _VERNEED = 6, 11, 0x6FFFFFFE  # section types
_EXPORT, _IMPORT = 0, 1  # directories of PE
_LOAD = (0xC, 0x80000018)  # commands of Mach-O: LOAD_DYLIB and the weak one
_TRIE = {0x80000022: 40, 0x80000033: 8}  # DYLD_INFO_ONLY, DYLD_EXPORTS_TRIE: where the tree lies


@dataclass(frozen=True, slots=True)
class Linked:
    """Libraries needed, names exported, versions of the C library asked for (Linux)."""

    format: str
    needed: frozenset[str]
    exports: frozenset[str]
    versions: frozenset[str] = frozenset()


def check(data: bytes, *, exports: Iterable[str], glibc: tuple[int, int] | None) -> None:
    """Stop if a library needs more than libc and libm, or does not export just the given names.

    ``glibc`` is the newest version that may be asked for; None: whatever this machine has.

    Raises
    ------
    EnvironmentProblem : names what is too much or missing
    """
    found, wanted = read(data), set(exports)
    allowed = re.compile(ALLOWED[found.format], re.I if found.format == "PE" else 0)
    problems = [f"it needs {n}" for n in sorted(found.needed) if not allowed.fullmatch(n)]
    problems += [f"it needs {v}" for v in sorted(found.versions) if glibc and _number(v) > glibc]
    problems += [f"it exports {name}" for name in sorted(found.exports - wanted - _OWN)]
    problems += [f"it does not export {name}" for name in sorted(wanted - found.exports)]
    if problems:
        raise EnvironmentProblem(f"the linked library is not as it should be: {problems[0]}")


def read(data: bytes) -> Linked:
    """Return what a shared library of any of the formats needs and exports."""
    if data[:4] == b"\x7fELF":
        return _elf(data)
    return _pe(data) if data[:2] == b"MZ" else _macho(data)


def _number(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.removeprefix("GLIBC_").split("."))


def _elf(data: bytes) -> Linked:
    sections, needed, exports, versions = elf_sections(data), set(), set(), set()
    for section in sections:
        kind, start, size = section[1], section[4], section[5]
        names = sections[section[6]][4] if section[6] < len(sections) else 0
        if kind == _DYNAMIC:
            for tag, value in struct.iter_unpack("<QQ", data[start : start + size]):
                if tag == _NEEDED:
                    needed.add(text_at(data, names + value))
        elif kind == _DYNSYM:
            for symbol in struct.iter_unpack("<IBBHQQ", data[start : start + size]):
                if symbol[3] and symbol[1] >> 4:  # defined, not local
                    exports.add(text_at(data, names + symbol[0]))
        elif kind == _VERNEED:
            versions |= _versions(data, start, names)
    return Linked("ELF", frozenset(needed), frozenset(exports), frozenset(versions))


def _versions(data: bytes, start: int, names: int) -> set[str]:
    """Walk the two levels of ELF's needed versions: libraries, and versions of each."""
    found, step = set(), 1
    while step:
        _, number, _, first, step = struct.unpack_from("<HHIII", data, start)
        place = start + first
        for _ in range(number):
            _, _, _, name, following = struct.unpack_from("<IHHII", data, place)
            found.add(text_at(data, names + name))
            place += following
        start += step
    return found


def _pe(data: bytes) -> Linked:
    header = struct.unpack_from("<I", data, 0x3C)[0]
    sections, optional = struct.unpack_from("<H", data, header + 6)[0], header + 24
    first = optional + struct.unpack_from("<H", data, header + 20)[0]
    table = [struct.unpack_from("<IIII", data, first + 40 * i + 8) for i in range(sections)]

    def place(address: int) -> int:
        for size, start, raw, offset in table:
            if start <= address < start + max(size, raw):
                return int(offset + address - start)
        raise EnvironmentProblem(f"the library refers to {address:#x}, which it does not have")

    def directory(number: int) -> int:
        return int(struct.unpack_from("<I", data, optional + 112 + 8 * number)[0])

    needed, exports = set(), set()
    entry = place(directory(_IMPORT))
    while name := struct.unpack_from("<I", data, entry + 12)[0]:
        needed.add(text_at(data, place(name)))
        entry += 20
    if directory(_EXPORT):
        shown = place(directory(_EXPORT))
        number, names = (
            *struct.unpack_from("<I", data, shown + 24),
            place(struct.unpack_from("<I", data, shown + 32)[0]),
        )
        for address in struct.unpack_from(f"<{number}I", data, names):
            exports.add(text_at(data, place(address)))
    return Linked("PE", frozenset(needed), frozenset(exports))


def _macho(data: bytes) -> Linked:
    commands, place, needed, exports = struct.unpack_from("<I", data, 16)[0], 32, set(), set()
    for _ in range(commands):
        command, size = struct.unpack_from("<II", data, place)
        if command in _LOAD:
            needed.add(text_at(data, place + struct.unpack_from("<I", data, place + 8)[0]))
        elif command in _TRIE:
            start, length = struct.unpack_from("<II", data, place + _TRIE[command])
            exports |= {name.removeprefix("_") for name in _trie(data[start : start + length])}
        place += size
    return Linked("MachO", frozenset(needed), frozenset(exports))


def _trie(data: bytes) -> set[str]:
    """Return the names in Mach-O's tree of exports: each edge holds a piece of a name."""
    found, todo = set(), [(0, "")] if data else []
    while todo:
        place, name = todo.pop()
        size, place = _uleb(data, place)
        if size:
            found.add(name)
        place += size
        edges, place = data[place], place + 1
        for _ in range(edges):
            piece = text_at(data, place)
            child, place = _uleb(data, place + len(piece) + 1)
            todo.append((child, name + piece))
    return found


def _uleb(data: bytes, place: int) -> tuple[int, int]:
    """Return a number of variable length and the place behind it."""
    value = shift = 0
    while True:
        byte = data[place]
        value, shift, place = value | (byte & 0x7F) << shift, shift + 7, place + 1
        if byte < 0x80:
            return value, place
