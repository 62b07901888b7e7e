"""``thrustwasher explore``: one file in which a part or a shift is tried in a browser."""

import argparse
from pathlib import Path
from typing import Any

from ...cli.common import _options, _output
from ...errors import ParameterError, suggestion
from ...model.levels import gone_level
from ...model.registry import find_model, models_with_points

HELP = "write a page to try a part, gear train or shift in any browser"
EXAMPLES = (
    "thrustwasher explore washer",
    "thrustwasher explore planetary --out shift.html",
)
USUAL = "washer"
OPTIONS = {
    "--preset PRESET": "preset of the model, `thrustwasher part list` names them",
    "--out PAGE.html": "file to write, default explore-NAME.html",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    what = (
        f"part file, model with its defaults ({models}), scene file or built-in scene "
        f"(ev-reducer, or as `thrustwasher shift --list` names them); default {USUAL}"
    )
    _options.add_subject(parser, "subject", "TARGET", what, USUAL, asked=False)
    _options.add(parser, OPTIONS)
    _options.add_oil(parser)


def run(arguments: argparse.Namespace) -> int:
    """Write the page."""
    if _is_scene(arguments.subject):
        return _write_scene(arguments)
    part = _options.solvable(arguments.subject, arguments.preset)
    part = _options.with_oil(arguments, part, ())
    target = _target(arguments, part.name)
    _output.warn(gone_level(part.spec, part.fidelity))

    from ..explore.page import page

    _write(target, page(part))
    _options.tell_oil(part)
    _output.warn(part.oil_warnings)
    return 0


def _write_scene(arguments: argparse.Namespace) -> int:
    """Write the page of a scene, after its run."""
    _options.refuse_unused(arguments, "a scene", ("preset",))

    from ...shift import load_scene
    from ..explore.scene_page import scene_page

    scene = load_scene(arguments.subject, arguments.oil)
    target = _target(arguments, scene.name)
    _output.warn(scene.warnings)
    _write(target, scene_page(scene))
    return 0


def _is_scene(subject: str) -> bool:
    """Tell if a target is a scene of a shift: built in, or a file that names no model.

    ParameterError: it is neither a model, nor a scene, nor a file.
    """
    from ...model.part_file import holds_part, scene_parts
    from ...shift import builtin_scenes

    if subject.endswith(".toml"):
        return not holds_part(subject, "file")
    if subject in builtin_scenes():
        return True
    if subject in scene_parts():
        return False
    try:
        find_model(subject)
    except ParameterError:
        known = [*models_with_points(), *scene_parts(), *builtin_scenes()]
        hint = suggestion(subject, known, "; did you mean {!r}?")
        raise ParameterError(
            f"target = {subject!r}, allowed: a model ({', '.join(models_with_points())}), a scene "
            f"({', '.join([*scene_parts(), *builtin_scenes()])}) or the path of a .toml file{hint}"
        ) from None
    return False


def _target(arguments: argparse.Namespace, name: str) -> Any:
    out = f"explore-{name}.html" if arguments.out is None else arguments.out
    return _output.check_file(out, "--out", (".html", ".htm"))


def _write(target: Path, text: str) -> None:
    _output.write_text(target, text)
    print(f"{target}: {len(text.encode()) / 1e6:.2f} MB; open it in a browser")
