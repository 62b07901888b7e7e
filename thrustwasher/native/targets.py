"""The platforms an FMU is built for, the browser, and how hard the compiler works: data only.

x86-64 binaries hold the kernels twice and choose by the CPU when they run: "v3" (AVX2, 2013 and
later) and "v2" (SSE4.2, 2009 and later). The other platforms have one level.
"""

from dataclasses import dataclass, replace

GLIBC = (2, 17)  # the oldest C library on Linux; every distribution since 2014 is newer


@dataclass(frozen=True, slots=True, kw_only=True)
class Level:
    """One CPU level and how its object is optimised.

    ``speed`` is LLVM's optimisation level, 0 to 3. ``attribute`` is "", "optsize" or "minsize" and
    goes to every function but those of the kernel modules named in ``quick``, which keep all speed
    and are not inlined: small loops that take most of the time; those named in ``free``, which keep
    all speed where they are not inlined; and those named in ``grouped``, whose loops go in groups
    of four: not inlined, or LLVM would make slower vectors across the groups. ``inlining`` is the
    inliner's threshold (None: LLVM's own choice).
    """

    name: str  # ends the names of the entries: tw_step_v3
    cpu: str
    speed: int = 3
    attribute: str = ""
    quick: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    grouped: tuple[str, ...] = ()
    inlining: int | None = None
    unrolling: bool = True
    vectorization: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Platform:
    """One operating system on one kind of machine."""

    name: str
    fmi2: str  # folder below binaries/
    fmi3: str
    extension: str
    triple: str  # for LLVM
    zig: str  # for ziglang
    machine: tuple[str, str]  # platform.system(), platform.machine() where it runs
    format: str  # ELF, PE, MachO or WASM
    flags: tuple[str, ...]
    libraries: tuple[str, ...]
    levels: tuple[Level, ...]


# All at full speed makes the washer 60 % larger, the free ones 18 %, and either 10 % faster; all
# small makes it 40 % slower.
_QUICK = ("numerics.chebyshev",)
_GROUPED = ("numerics.banded",)
_FREE = tuple(
    f"washer.kernels.{module}"
    for module in ("film", "gap", "heat", "heat_factor", "newton", "throughflow")
)
_SMALL = Level(name="generic", cpu="generic", attribute="optsize", quick=_QUICK, grouped=_GROUPED)
_GENERIC = replace(_SMALL, free=_FREE)
_X86 = (
    replace(_GENERIC, name="v2", cpu="x86-64-v2"),
    replace(_GENERIC, name="v3", cpu="x86-64-v3"),
)
_ELF = ("-fPIC", "-Wl,-z,defs", "-Wl,--hash-style=gnu")
_GLIBC = ".".join(map(str, GLIBC))

PLATFORMS = {
    p.name: p
    for p in (
        Platform(
            name="linux64",
            fmi2="linux64",
            fmi3="x86_64-linux",
            extension="so",
            format="ELF",
            triple="x86_64-unknown-linux-gnu",
            zig=f"x86_64-linux-gnu.{_GLIBC}",
            machine=("Linux", "x86_64"),
            flags=_ELF,
            libraries=("-lm",),
            levels=_X86,
        ),
        Platform(
            name="win64",
            fmi2="win64",
            fmi3="x86_64-windows",
            extension="dll",
            format="PE",
            triple="x86_64-w64-windows-gnu",
            zig="x86_64-windows-gnu",
            machine=("Windows", "AMD64"),
            flags=(),
            libraries=(),
            levels=_X86,
        ),
        Platform(
            name="aarch64-linux",
            fmi2="aarch64-linux",
            fmi3="aarch64-linux",
            extension="so",
            format="ELF",
            triple="aarch64-unknown-linux-gnu",
            zig=f"aarch64-linux-gnu.{_GLIBC}",
            machine=("Linux", "aarch64"),
            flags=_ELF,
            libraries=("-lm",),
            levels=(_GENERIC,),
        ),
        Platform(
            name="darwin-x86_64",
            fmi2="darwin64",
            fmi3="x86_64-darwin",
            extension="dylib",
            format="MachO",
            triple="x86_64-apple-macosx11.0",
            zig="x86_64-macos.11.0",
            machine=("Darwin", "x86_64"),
            flags=("-fPIC",),
            libraries=("-lm",),
            levels=_X86[:1],
        ),
        Platform(
            name="darwin-arm64",
            fmi2="darwin64",
            fmi3="aarch64-darwin",
            extension="dylib",
            format="MachO",
            triple="arm64-apple-macosx11.0",
            zig="aarch64-macos.11.0",
            machine=("Darwin", "arm64"),
            flags=("-fPIC",),
            libraries=("-lm",),
            levels=(replace(_GENERIC, cpu="apple-m1"),),
        ),
    )
}
# Browsers run the same kernels; no FMU does. What JavaScript needs to call them is exported: the
# table of functions, and where the memory begins that is free.
WEB = Platform(
    name="wasm32",
    fmi2="",
    fmi3="",
    extension="wasm",
    format="WASM",
    triple="wasm32-unknown-unknown",
    zig="wasm32-wasi",
    machine=("Browser", "wasm32"),
    flags=(
        "-mexec-model=reactor",
        "-Wl,--export=tw_table",
        "-Wl,--export=__heap_base",
        "-Wl,--export-table",
    ),
    libraries=("-lm",),
    levels=(_SMALL,),
)
TARGETS = {**PLATFORMS, WEB.name: WEB}
