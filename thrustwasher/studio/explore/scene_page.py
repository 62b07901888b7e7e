"""The page of a scene: the whole shift in a browser, its profiles dragged by their points."""

import json
from typing import Any

from ... import __version__
from ...shift.key_figures.figure_list import FIGURES
from ...shift.scene.scene import Scene
from ...shift.shift_result import ShiftResult
from ...shift.tolerance.run_to_tolerance import run_auto
from ...templates import policy_source, template
from ...units import format_quantity
from ..report.bundles import FOLDER, bundle
from .scene_data import checked, instance_of, modules, scene_data, started

TEMPLATE = FOLDER.parent / "scene" / "scene.html.jinja"
LARGE = ("lock_time", "slip_energy", "peak_jerk", "peak_power", "torque_hole")


def scene_page(scene: Scene, result: ShiftResult | None = None) -> str:
    """Return the page of a scene as HTML.

    Parameters
    ----------
    scene : one shift
    result : its run, where there is one: else it is run here

    Raises
    ------
    ParameterError : it has a sequence, or a master that a page cannot run
    SolveError : the scene as it is cannot be run
    """
    checked(scene)
    result = result or run_auto(scene, instance_of, guard=False)
    about = scene_data(result)
    script, style = bundle("scene.js"), bundle("scene.css")
    filled: str = template(TEMPLATE).render(
        title=f"{scene.title}: try it",
        name=scene.title,
        help=scene.description or "A gear shift, run in this page.",
        version=__version__,
        policy=(
            f"default-src 'none'; script-src {policy_source(script)} 'wasm-unsafe-eval'; "
            f"worker-src blob:; style-src {policy_source(style)}; img-src data:; "
            "base-uri 'none'; form-action 'none'"
        ),
        style=style,
        script=script,
        about=json.dumps(about, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c"),
        worker=bundle("scene_worker.js"),
        modules=modules(result.scene),
        figures=_figures(result),
        warnings=[*result.warnings],
    )
    return filled


def _figures(result: ShiftResult) -> list[dict[str, Any]]:
    """Return the figures of the scene as it is: name, value in full, text, meaning."""
    words = {"pack": result.scene.engaging, "other": result.scene.releasing, "film_speed": 0.0}
    return [
        {
            "name": name,
            "value": "" if value is None else repr(value),
            "text": "none" if value is None else format_quantity(value, FIGURES[name].unit),
            "help": FIGURES[name].text.format(**words),
            "large": name in LARGE or name.endswith("_temperature"),
        }
        for name, value in started(result).items()
    ]
