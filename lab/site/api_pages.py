"""The API reference: a page per purpose, docstrings, parameters from their fields."""

from dataclasses import fields, is_dataclass
from pathlib import Path

import thrustwasher
import thrustwasher.shift
from thrustwasher.units import pretty_unit

# Page -> title, sentence, public names.
PAGES = {
    "solve": (
        "Solve one point",
        "Each takes parameters and inputs in SI units and returns a result with warnings.",
        "solve_washer solve_clutch boundary_friction solve_gearmesh solve_losses solve_train",
    ),
    "parameters": (
        "Parameters",
        "Frozen dataclasses: fields with unit, range and meaning.",
        "WasherParams ClutchParams GearMeshParams LossesParams TrainParams Oil oil",
    ),
    "curves": (
        "Curves and time",
        "Load curves with folds, engagements, releases, washers followed in time.",
        "load_curve LoadCurve follow_washer WasherHistory engage_clutch Engagement release_clutch "
        "Release",
    ),
    "results": (
        "Results",
        "What a solve returns.",
        "WasherResult ClutchResult GearMeshResult LossesResult TrainResult",
    ),
    "studies": (
        "Sweep, fit, scatter, optimise",
        "Many solves, on all cores.",
        "run_sweep SweepTable calibrate calibrate_traces Calibration ModelCalibration "
        "propagate ScatterResult optimise Optimum choose Choice",
    ),
    "shifts": (
        "A shift, an FMU",
        "From a scene's name, from a part.",
        "run_shift load_scene build_fmu ShiftResult SequenceResult",
    ),
    "parts": ("Parts", "Your own part in a file.", "load_part PartFile"),
    "errors": ("Errors", "Each has a name.", "ParameterError SolveError BranchError Status"),
}
SHIFT = (
    "Scenes and shifts",
    "`thrustwasher.shift`: a gear shift of parts that run together.",
    "builtin_scenes cosimulate run_auto run_sequence with_fidelities Scene Part Cost Event Phase",
)


def write_api(folder: Path) -> list[tuple[str, str]]:
    """Write the pages; return (title, file) of each. Every public name is on one."""
    target = folder / "api"
    target.mkdir(parents=True, exist_ok=True)
    listed = {name for _, _, names in PAGES.values() for name in names.split()}
    rest = sorted(set(thrustwasher.__all__) - listed)
    pages = dict(PAGES)
    if rest:
        pages["more"] = ("More", "All other public names.", " ".join(rest))
    found = []
    for stem, (title, words, names) in pages.items():
        lines = [f"# {title}", words]
        for name in names.split():
            lines += [f"::: thrustwasher.{name}", *_fields(getattr(thrustwasher, name))]
        _write(target / f"{stem}.md", lines)
        found.append((title, f"api/{stem}.md"))
    title, words, names = SHIFT
    _write(target / "shift.md", [f"# {title}", words, *(f"::: {_home(n)}" for n in names.split())])
    return [*found, (title, "api/shift.md")]


def _home(name: str) -> str:
    """Return where a public name of ``thrustwasher.shift`` is defined."""
    found = getattr(thrustwasher.shift, name)
    return f"{found.__module__}.{found.__qualname__}"


def _fields(found: object) -> list[str]:
    """Return the table of a parameter class: name, default, unit, range, meaning."""
    if not (isinstance(found, type) and is_dataclass(found)):
        return []
    rows = []
    for f in fields(found):
        m = f.metadata
        if "help" not in m:
            return []
        allowed = ", ".join(m["options"]) if "options" in m else f"{m.get('min')} .. {m.get('max')}"
        unit = pretty_unit(m["unit"]).replace("1", "") if "unit" in m else ""
        rows.append(f"| `{f.name}` | {f.default} | {unit} | {allowed} | {m['help']} |")
    head = ["| field | default | unit | allowed | meaning |", "|---|---|---|---|---|"]
    return ["\n".join([*head, *rows])]


def _write(path: Path, lines: list[str]) -> None:
    path.write_text("\n\n".join(lines) + "\n", encoding="utf-8")
