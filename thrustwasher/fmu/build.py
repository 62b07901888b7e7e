"""From a model's list, binaries and documents to an FMU file."""

import logging
import os
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import ParameterError, SolveError, within
from ..model.oil import Oil, refuse_two_ways, sheet_oil
from ..model.part_file import PartFile, find_part, is_part, load_part
from ..model.prepare import check_together, with_box
from ..model.registry import all_specs, find_model, find_spec
from ..model.spec import ModelSpec
from ..native.files import Note, write, zipped
from ..native.link import this_platform
from .description.interface import Interface, interface
from .description.model_description import description, terminals_and_icons
from .documentation.html_page import accuracy, page
from .documentation.reference_results import reference_files
from .model_kernels import content_digest, has_derivatives, package_version
from .package.licences import licences
from .package.model_sources import Order, identifier, model_folder, source_folder
from .shell.c_sources import FOLDER, compiled, source_files
from .shell.platform_libraries import chosen, library_identity, native_contents

TARGETS = ("native", "python")
DESCRIPTION = "modelDescription.xml"  # lies in front
FMU = ".fmu"


def build(
    models: Sequence[str | PartFile] | None = None,
    *,
    target: str = "native",
    fmi: int = 2,
    out: Path = Path("dist"),
    sources: Path | None = None,
    platforms: Sequence[str] | None = None,
    note: Note | None = None,
    local: bool = False,
    maps: bool = True,
    terminals: bool = False,
    oil: str | Mapping[str, object] | None = None,
    c_sources: bool = False,
    plain: bool = False,
    fidelity: str | None = None,
) -> list[Path]:
    """Build FMUs and return their paths, ``out/<target>-fmi<N>/<Model>.fmu``.

    Parameters
    ----------
    models : FMU names such as "ThrustWasher" (or keys such as "washer"), part files such as
        "mine.toml" or parts, whose FMU has the part's name; None: all models
    target : "native": compiled, needs nothing where it runs; "python": needs this package of the
        same version there
    fmi : 2 or 3; the Python target knows 2 only
    out : folder of the results; existing files are replaced at once
    sources : folder with one folder per model (readme.md, icon.png); None: those of this package
    platforms : native only, what to build for ("linux64", "win64", "aarch64-linux",
        "darwin-x86_64", "darwin-arm64"); None: all that are shipped or can be linked here
    note : is called with one sentence before each step that takes time
    local : for use on this machine only: compiled for its processor, without reference results
    maps : native only, put in what fidelity "map" looks up; without, the washer's FMU is smaller by
        2.5 MB and refuses that fidelity
    terminals : put the plugs into an FMI 2.0 FMU too; they are of FMI 3.0, where they always are,
        and some tools for FMI 2.0 call the file an error
    oil : native only, the oil of all models that know one, as for ``thrustwasher.oil``; an FMU's
        start values follow it
    c_sources : native only, put in the folder sources too: the same FMU as C99 for any compiler
    plain : for hosts that know real and whole numbers only: enumerations and Booleans are local
        variables, not outputs, and integers with a range, also as parameters
    fidelity : native only, "map": the washer with its map alone, without solver and without the
        parameters that a map is made for; in a fraction of the memory

    Raises
    ------
    ParameterError : unknown model, target, FMI version or platform; a part file that is not sound
    EnvironmentProblem : libraries that are not shipped, and no C compiler; the message says what to
        install
    """
    _check(target, fmi, platforms, maps and fidelity is None)
    if fidelity is not None and not maps:
        raise ParameterError("an FMU of the map alone needs its map; leave out --no-maps")
    if target == "python" and c_sources:
        raise ParameterError("C sources lie in native FMUs only; use --target native")
    specs = asked(models, oil)
    if fidelity is not None:
        specs = [find_model(spec.key).of_one_level(spec, fidelity) for spec in specs]
    specs = [with_box(spec) for spec in specs] if maps else specs
    say = note or (lambda _: None)
    if target == "python" and any(spec.kind for spec in specs):
        raise ParameterError("part files and oils are for native FMUs only; use --target native")
    places: Sequence[str] = ()
    if target == "native":
        places = [this_platform().name] if local else chosen(platforms, say, specs)
    order, paths = Order(target, fmi, places, say, local, c_sources, plain), []
    for spec in specs:
        shown, folder = interface(spec), model_folder(spec, sources or source_folder())
        files = contents(shown, folder, order, reference=not local)
        if not maps:
            files = {n: data for n, data in files.items() if not n.startswith("resources/map-")}
        if terminals:
            files |= _icons(shown, folder, 3)
        path = Path(out) / f"{target}-fmi{fmi}" / f"{spec.name}.fmu"
        write(path, zipped(files, first=DESCRIPTION))
        logging.getLogger(__name__).info("built %s", path)
        paths.append(path)
    return paths


def build_fmu(
    part_or_model: str | Path | PartFile,
    out: str | Path = "dist",
    *,
    fmi: int = 2,
    platforms: Sequence[str] | None = None,
) -> Path:
    """Build the native FMU of a part or a model and return its path.

    Parameters
    ----------
    part_or_model : the path of a part file, a part (``load_part``), or a model: its key ("washer")
        or the name of its FMU ("ThrustWasher")
    out : the FMU's own path, if it ends in ".fmu", else the folder that it goes to under its name
    fmi, platforms : as in ``thrustwasher.fmu.build.build``, which builds several at once

    Raises
    ------
    ParameterError : an argument is not allowed, or a part is not sound; the message names it
    EnvironmentProblem : as of ``build``

    Examples
    --------
    >>> build_fmu("washer", "fmus")  # doctest: +SKIP
    PosixPath('fmus/ThrustWasher.fmu')
    """
    if not isinstance(part_or_model, str | Path | PartFile):
        raise ParameterError(
            f"part_or_model = {part_or_model!r}, allowed: the path of a part file, a part, or the "
            "key or name of a model"
        )
    if not isinstance(out, str | Path) or not str(out).strip():
        raise ParameterError(f"out = {out!r}, allowed: the path of an FMU (.fmu), or a folder")
    word = str(part_or_model) if isinstance(part_or_model, Path) else part_or_model
    target = Path(out)
    is_file = target.suffix == FMU
    if target.is_dir() if is_file else target.is_file():
        raise ParameterError(f"out = {str(out)!r}, allowed: the path of an FMU (.fmu), or a folder")
    with TemporaryDirectory() as draft:
        (built,) = build([word], fmi=fmi, platforms=platforms, out=Path(draft))
        path = target if is_file else target / built.name
        write(path, built.read_bytes())
    return path


def asked(
    models: Sequence[str | PartFile] | None, oil: str | Mapping[str, object] | None = None
) -> list[ModelSpec]:
    """Return the models to build; a part stands for its model with its own values."""
    own = None if oil is None else sheet_oil("oil", oil)
    found: dict[str, tuple[str, ModelSpec]] = {}
    known = {spec.name: spec for spec in all_specs(helpers=True)}
    for given in models or [spec.key for spec in all_specs()]:
        word, of_part = (given, is_part(given)) if isinstance(given, str) else (given.name, True)
        if of_part:
            spec = _part(given, own)
        else:
            spec = find_spec(word)
            if own and (models or own.parameters_for(spec)):
                spec = _oiled(find_part(spec.key), own).model
        other, _ = found.setdefault(spec.name, (word, spec))
        if other != word and (of_part or is_part(other)):
            raise ParameterError(f"{other} and {word} have one name, {spec.name}; change it in one")
        if known.get(spec.name, spec).key != spec.key:
            raise ParameterError(
                f"part {word!r}: name = {spec.name!r} is that of the model "
                f"{known[spec.name].key!r}; choose another"
            )
    return [spec for _, spec in found.values()]


def _oiled(part: PartFile, oil: Oil | None) -> PartFile:
    """Return a part with an oil; ParameterError if its model knows none."""
    if oil is None:
        return part
    refuse_two_ways("oil", oil, part.spec, ())
    return part.with_oil(oil)


def _part(given: str | PartFile, oil: Oil | None) -> ModelSpec:
    part = _oiled(load_part(given) if isinstance(given, str) else given, oil)
    with within(f"part {given if isinstance(given, str) else part.name!r}"):
        check_together(part.spec, part.params, part.fidelity)
    return part.model


def pack_native(
    spec: ModelSpec,
    *,
    fmi: int = 2,
    platforms: Sequence[str] | None = None,
    plain: bool = False,
    note: Note | None = None,
) -> bytes:
    """Return a native FMU of FMI 2 or 3 of any model, also of one with defaults of its own.

    It has no reference results: those of a model with its usual defaults are in the usual FMU.
    """
    say = note or (lambda _: None)
    order = Order("native", fmi, chosen(platforms, say, [spec]), say, plain=plain)
    folder = model_folder(spec, source_folder())
    files = contents(interface(spec), folder, order, reference=False)
    return zipped(files, first=DESCRIPTION)


def _check(target: str, fmi: int, platforms: Sequence[str] | None, maps: bool) -> None:
    if target not in TARGETS:
        raise ParameterError(f"target = {target!r}, allowed: {' or '.join(TARGETS)}")
    if fmi not in (2, 3):
        raise ParameterError(f"fmi = {fmi!r}, allowed: 2 or 3")
    if target == "python" and fmi != 2:
        raise ParameterError(f"fmi = {fmi!r}, allowed: 2 for target python; use --target native")
    if target == "python" and not maps:
        raise ParameterError("maps lie in native FMUs only; use --target native")
    if target == "python" and platforms:
        raise ParameterError("platforms are chosen for target native only; use --target native")


def contents(shown: Interface, folder: Path, order: Order, *, reference: bool) -> dict[str, bytes]:
    """Return everything that lies in one FMU; ``folder`` holds the model's own sources."""
    spec, native = shown.spec, order.target == "native"
    tools = library_identity(spec, local=order.local) if native else ""
    guid = identifier(shown, folder, order, f"{tools} {accuracy(spec)}")
    if native:
        own = native_contents(shown, order, guid)
    else:
        own = _python_contents(shown, folder, guid)
    order.note(f"{spec.name}: {'reference results and documents' if reference else 'documents'}")
    in_c = source_files(shown, order.fmi, order.note, guid) if order.c_sources else {}
    described = description(
        shown,
        fmi=order.fmi,
        guid=guid,
        derivatives=native and has_derivatives(spec),
        moving=native,
        compiled=compiled(in_c),
        plain=order.plain,
        exchange=native,
    )
    try:
        results = reference_files(spec) if reference else {}
        text = page(shown, folder, order, guid, runs=reference)
    except SolveError as problem:  # a part need not have a solution all over the usual inputs
        order.note(f"{spec.name}: without reference results: {problem}")
        results, text = {}, page(shown, folder, order, guid, runs=False)
    return {
        DESCRIPTION: described,
        "documentation/index.html": text.encode(),
        **_icons(shown, folder, order.fmi),
        **licences(order.target, order.platforms, c_sources=order.c_sources),
        **results,
        **own,
        **{f"{FOLDER}/{name}": data for name, data in in_c.items()},
    }


def _icons(shown: Interface, folder: Path, fmi: int) -> dict[str, bytes]:
    """Return the model's picture at the place of this version, and the terminals of FMI 3."""
    file, place = folder / "icon.png", "terminalsAndIcons"
    icon = file.read_bytes() if file.is_file() else b""
    if fmi == 2:
        return {"model.png": icon} if icon else {}
    listed = {f"{place}/terminalsAndIcons.xml": terminals_and_icons(shown, icon=bool(icon))}
    return listed | ({f"{place}/icon.png": icon} if icon else {})


def _python_contents(shown: Interface, folder: Path, guid: str) -> dict[str, bytes]:
    """Return what only the Python target carries: pythonfmu, the slave, what the host must have."""
    module = f"thrustwasher_fmu_{folder.name}_{guid[:8]}"
    spec, version = shown.spec, package_version()
    slave = (Path(__file__).parent / "python" / "slavemodule.txt").read_text("utf-8")
    values = {"model": spec.key, "version": version, "digest": content_digest(spec), "guid": guid}
    for name, text in values.items():
        slave = slave.replace(f"@{name}@", text)
    needs = (source_folder() / "documentation" / "externalDependencies.txt").read_text("utf-8")
    needs = needs.format(version=version, pythonfmu=metadata.version("pythonfmu"))
    return {
        "documentation/externalDependencies.txt": needs.encode(),
        f"resources/{module}.py": slave.encode(),
        "resources/slavemodule.txt": module.encode(),
        **_pythonfmu(spec.name),
    }


def _pythonfmu(model: str) -> dict[str, bytes]:
    """Return pythonfmu's libraries, renamed to the model, and its modules."""
    # Not by import: a process that has run an FMU imported the FMU's own, smaller pythonfmu.
    root = Path(str(metadata.distribution("pythonfmu").locate_file("pythonfmu")))
    binaries = root / "resources" / "binaries"
    files = {
        f"binaries/linux64/{model}.so": binaries / "linux64" / "libpythonfmu-export.so",
        f"binaries/win64/{model}.dll": binaries / "win64" / "pythonfmu-export.dll",
    }
    for module in sorted(root.iterdir(), key=lambda entry: entry.name):
        if module.name.endswith(".py"):
            files[f"resources/pythonfmu/{module.name}"] = module
    return {name: file.read_bytes() for name, file in files.items()}


def validate(path: str | os.PathLike[str]) -> list[str]:
    """Return FMPy's findings on an FMU; an empty list is a pass."""
    from fmpy.validation import validate_fmu

    return [str(finding) for finding in validate_fmu(str(path))]
