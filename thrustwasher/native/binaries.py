"""Object files and shared libraries: what they need and what they show.

ELF, PE (COFF) and Mach-O, 64 bit, little endian; WebAssembly, 32 bit.
"""

import re
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ..errors import EnvironmentProblem

ALLOWED = {
    "ELF": r"(libc\.so\.6|ld-linux-.*)",
    "PE": r"(kernel32|api-ms-win-crt-[a-z]+-l1-1-0|ucrtbase)\.dll",
    "MachO": r"/usr/lib/libSystem\.B\.dylib",
    "WASM": r"",  # a module for browsers needs nothing
}
# Functions that a library may take from the C library: memory, text and files, and where its own
# file lies (of Windows in the last line). No mathematics: a host may have functions of these names.
IMPORTS = frozenset(
    """
    calloc free memchr memcmp bcmp memcpy memmove memset bzero __bzero
    memset_pattern8 memset_pattern16
    strchr strcmp strlen strncmp strncpy strtod strtol atoi snprintf vsnprintf
    fclose fgetc fopen fread dladdr
    GetModuleHandleExW GetModuleFileNameW WideCharToMultiByte
    """.split()
)
# Of compilers and linkers: how a library is set up and taken down. The lines from the third on are
# of Windows, where each name is taken from one DLL and from no other place.
_STARTS = frozenset(
    """
    __cxa_finalize __gmon_start__ _ITM_deregisterTMCloneTable _ITM_registerTMCloneTable
    dyld_stub_binder
    DeleteCriticalSection EnterCriticalSection GetLastError InitializeCriticalSection
    LeaveCriticalSection Sleep TlsGetValue VirtualProtect VirtualQuery __acrt_iob_func
    __stdio_common_vfprintf __stdio_common_vsprintf _execute_onexit_table _exit
    _initialize_onexit_table _initterm _initterm_e _register_onexit_function _wfopen abort fwrite
    """.split()
)
# What linkers show beside what is asked for: zig's for macOS; the memory, its free part and the
# table of functions of WebAssembly, and what sets up its C library.
_OWN = {"__dso_handle", "_mh_dylib_header", "memory", "__heap_base", "__indirect_function_table"}
_OWN |= {"_initialize"}
_NEEDED = 1  # tag in ELF's dynamic section
_DYNAMIC, _DYNSYM = 6, 11  # section types of ELF
_SYMTAB = 2  # section type in ELF and load command in Mach-O
_COFF = (0x8664, 0xAA64)
_EXPORT, _IMPORT = 0, 1  # directories of PE
_MACHO = 0xFEEDFACF
_WASM = b"\0asm"
_IMPORTS, _EXPORTS, _FUNCTION = 2, 7, 0  # sections of WebAssembly; a kind of import
_LOAD = (0xC, 0x80000018)  # commands of Mach-O: LOAD_DYLIB and the weak one
_TRIE = {0x80000022: 40, 0x80000033: 8}  # DYLD_INFO_ONLY, DYLD_EXPORTS_TRIE: where the tree lies


@dataclass(frozen=True, slots=True)
class Linked:
    """Libraries needed, names taken from them, names exported."""

    format: str
    needed: frozenset[str]
    imports: frozenset[str]
    exports: frozenset[str]


def check(data: bytes, *, exports: Iterable[str]) -> None:
    """Stop if a library needs more than memory, text and files of the C library, or shows others.

    ``exports``: just the names that it has to show.
    """
    found, required = read(data), set(exports)
    allowed = re.compile(ALLOWED[found.format], re.I if found.format == "PE" else 0)
    problems = [f"it needs {n}" for n in sorted(found.needed) if not allowed.fullmatch(n)]
    problems += [f"it needs {n}" for n in sorted(found.imports - IMPORTS - _STARTS)]
    problems += [f"it exports {name}" for name in sorted(found.exports - required - _OWN)]
    problems += [f"it does not export {name}" for name in sorted(required - found.exports)]
    if problems:
        raise EnvironmentProblem(f"the linked library is not as it should be: {problems[0]}")


def undefined(code: bytes) -> set[str]:
    """Return the symbols that an object file refers to and does not define."""
    if code[:4] == b"\x7fELF":
        return {name for name, _, home in _elf_symbols(code, _SYMTAB) if name and home == 0}
    if code[:4] == _WASM:
        return {name for name, kind in _wasm_imports(code) if kind == _FUNCTION}
    number = _word(code, 0)
    if number == _MACHO:
        return _macho_undefined(code)
    if number & 0xFFFF in _COFF:
        return _coff_undefined(code)
    raise EnvironmentProblem(
        f"an object file starts with {code[:4]!r}: neither ELF, COFF, MachO nor WASM"
    )


def read(data: bytes) -> Linked:
    """Return what a shared library of any of the formats needs and exports."""
    if data[:4] == b"\x7fELF":
        return _elf(data)
    if data[:4] == _WASM:
        needed = frozenset(name for name, _ in _wasm_imports(data))
        return Linked("WASM", needed, needed, frozenset(_wasm_exports(data)))
    return _pe(data) if data[:2] == b"MZ" else _macho(data)


def _word(data: bytes, place: int) -> int:
    return int(struct.unpack_from("<I", data, place)[0])


def _text(data: bytes, start: int) -> str:
    """Return the zero-terminated text at a place."""
    return data[start : data.index(b"\0", start)].decode("ascii")


def _elf_sections(code: bytes) -> list[tuple[int, ...]]:
    """Return (name, type, flags, address, offset, size, link, info, align, entry size) of each."""
    start, size, number = *struct.unpack_from("<Q", code, 40), *struct.unpack_from("<HH", code, 58)
    return [struct.unpack_from("<IIQQQQIIQQ", code, start + i * size) for i in range(number)]


def _elf_symbols(code: bytes, kind: int) -> Iterator[tuple[str, int, int]]:
    """Give name, binding and home (0: undefined) of the symbols in ELF's sections of a type."""
    sections = _elf_sections(code)
    for section in sections:
        if section[1] == kind:
            names, start = sections[section[6]][4], section[4]
            for symbol in struct.iter_unpack("<IBBHQQ", code[start : start + section[5]]):
                yield _text(code, names + symbol[0]), symbol[1] >> 4, symbol[3]


def _commands(code: bytes) -> Iterator[tuple[int, int]]:
    """Give the number and the place of each load command of Mach-O."""
    place = 32
    for _ in range(_word(code, 16)):
        yield _word(code, place), place
        place += _word(code, place + 4)


def _coff_undefined(code: bytes) -> set[str]:
    start, number = struct.unpack_from("<II", code, 8)
    names, found, i = start + 18 * number, set(), 0
    while i < number:
        raw, value, home, _, kind, extra = struct.unpack_from("<8sIhHBB", code, start + 18 * i)
        if kind == 2 and home == 0 and value == 0:  # external, in no section, no common block
            zero, offset = struct.unpack("<II", raw)
            found.add(raw.rstrip(b"\0").decode("ascii") if zero else _text(code, names + offset))
        i += 1 + extra
    return found


def _macho_undefined(code: bytes) -> set[str]:
    found = set()
    for command, place in _commands(code):
        if command == _SYMTAB:
            start, number, names, _ = struct.unpack_from("<IIII", code, place + 8)
            for i in range(number):
                name, kind, home, _, value = struct.unpack_from("<IBBHQ", code, start + 16 * i)
                if kind & 0x0E == 0 and kind & 0x01 and home == 0 and value == 0:
                    found.add(_text(code, names + name).removeprefix("_"))
    return found


def _elf(data: bytes) -> Linked:
    sections, needed = _elf_sections(data), set()
    exports = {name for name, bound, home in _elf_symbols(data, _DYNSYM) if home and bound}
    imports = {name for name, _, home in _elf_symbols(data, _DYNSYM) if name and home == 0}
    for section in sections:
        if section[1] == _DYNAMIC:
            start, names = section[4], sections[section[6]][4]
            for tag, value in struct.iter_unpack("<QQ", data[start : start + section[5]]):
                if tag == _NEEDED:
                    needed.add(_text(data, names + value))
    return Linked("ELF", frozenset(needed), frozenset(imports), frozenset(exports))


def _pe(data: bytes) -> Linked:
    header = _word(data, 0x3C)
    sections, optional = struct.unpack_from("<H", data, header + 6)[0], header + 24
    first = optional + struct.unpack_from("<H", data, header + 20)[0]
    table = [struct.unpack_from("<IIII", data, first + 40 * i + 8) for i in range(sections)]

    def place(address: int) -> int:
        for size, start, raw, offset in table:
            if start <= address < start + max(size, raw):
                return int(offset + address - start)
        raise EnvironmentProblem(f"the library refers to {address:#x}, which it does not have")

    def directory(number: int) -> int:
        return _word(data, optional + 112 + 8 * number)

    needed, imports, exports = set(), set(), set()
    entry = place(directory(_IMPORT))
    while name := _word(data, entry + 12):
        needed.add(_text(data, place(name)))
        thunk = place(_word(data, entry))
        while address := struct.unpack_from("<Q", data, thunk)[0]:
            imports.add(_text(data, place(address) + 2))  # behind a hint of two bytes
            thunk += 8
        entry += 20
    if directory(_EXPORT):
        shown = place(directory(_EXPORT))
        number, names = _word(data, shown + 24), place(_word(data, shown + 32))
        for address in struct.unpack_from(f"<{number}I", data, names):
            exports.add(_text(data, place(address)))
    return Linked("PE", frozenset(needed), frozenset(imports), frozenset(exports))


def _macho(data: bytes) -> Linked:
    needed, exports = set(), set()
    for command, place in _commands(data):
        if command in _LOAD:
            needed.add(_text(data, place + _word(data, place + 8)))
        elif command in _TRIE:
            start, length = struct.unpack_from("<II", data, place + _TRIE[command])
            exports |= {name.removeprefix("_") for name in _trie(data[start : start + length])}
    imports = _macho_undefined(data)
    return Linked("MachO", frozenset(needed), frozenset(imports), frozenset(exports))


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
            piece = _text(data, place)
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


def _wasm_sections(data: bytes) -> Iterator[tuple[int, int]]:
    """Give the number and the place of each section of WebAssembly."""
    place = 8
    while place < len(data):
        number = data[place]
        size, place = _uleb(data, place + 1)
        yield number, place
        place += size


def _wasm_name(data: bytes, place: int) -> tuple[str, int]:
    size, place = _uleb(data, place)
    return data[place : place + size].decode(), place + size


def _wasm_imports(data: bytes) -> Iterator[tuple[str, int]]:
    """Give name and kind of what a module or an object file of WebAssembly takes from outside."""
    for place in (place for number, place in _wasm_sections(data) if number == _IMPORTS):
        n, place = _uleb(data, place)
        for _ in range(n):
            _, place = _wasm_name(data, place)
            name, place = _wasm_name(data, place)
            kind, place = data[place], place + 1
            yield name, kind
            if kind in (1, 3, 4):  # a table, a global, a tag: one byte of its type comes first
                place += 1
            limits = data[place] if kind in (1, 2) else 0
            place += 1 if kind in (1, 2, 3) else 0
            for _ in range({0: 1, 1: 1 + limits % 2, 2: 1 + limits % 2, 3: 0}.get(kind, 1)):
                _, place = _uleb(data, place)


def _wasm_exports(data: bytes) -> Iterator[str]:
    for place in (place for number, place in _wasm_sections(data) if number == _EXPORTS):
        n, place = _uleb(data, place)
        for _ in range(n):
            name, place = _wasm_name(data, place)
            _, place = _uleb(data, place + 1)
            yield name
