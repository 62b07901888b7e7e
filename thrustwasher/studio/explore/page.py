"""The file: template, styles, scripts, the module of kernels, values of the start."""

import base64
import json
from collections.abc import Mapping, Sequence
from typing import Any

from ... import __version__
from ...errors import ParameterError
from ...fmu.documentation.html_page import equations
from ...fmu.package.model_sources import model_folder, source_folder
from ...ladder.error_table import error_estimate
from ...model.part_file import PartFile
from ...model.registry import find_model
from ...native.library import web_module
from ...templates import policy_source, template
from ...units import format_quantity
from ..report.bundles import FOLDER, bundle
from .clutch_page import VIEW as CLUTCH
from .description import describe, inputs_of, outputs_of
from .gearmesh_page import VIEW as GEARMESH
from .losses_page import VIEW as LOSSES
from .train_page import VIEW as TRAIN
from .view import View
from .washer_page import VIEW as WASHER

# by the models' keys
VIEWS = {
    "washer": WASHER,
    "clutch": CLUTCH,
    "gearmesh": GEARMESH,
    "losses": LOSSES,
    "train": TRAIN,
}
TEMPLATE = FOLDER.parent / "explore" / "explore.html.jinja"


def page(part: PartFile) -> str:
    """Return the page of a part as HTML.

    ParameterError: there is no page for its model, or its parameters have no solution at the start.
    """
    model = find_model(part.spec.key)
    if model.key not in VIEWS:
        raise ParameterError(f"model = {model.key!r} has no page to explore")
    view = VIEWS[model.key]
    inputs = inputs_of(model, view)
    point = {s.name: part.inside(s.name, view.usual.get(s.name, s.usual)) for s in inputs}
    about = describe(model, view, part, point)
    if view.result is not None:
        result = view.result(part.params, point, about["level"])
    else:
        result = model.solve(part.params, **point, fidelity=about["level"])
    folder = model_folder(model.spec, source_folder())
    script, style = bundle(f"{view.page}.js"), bundle("explore.css")
    filled: str = template(TEMPLATE).render(
        title=f"{part.name}: try it",
        name=part.name,
        help=part.description or model.spec.help,
        version=__version__,
        policy=_policy(script, style),
        style=style,
        script=script,
        about=json.dumps(about, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c"),
        worker=view.worker.source(),
        module=base64.b64encode(web_module(model.spec.kernel)).decode("ascii"),
        figures=_figures(outputs_of(model, view), view.figures, result),
        large=view.figures,
        terms=view.terms,
        group=view.group[0],
        start=", ".join(f"{s.name} {format_quantity(point[s.name], s.unit)}" for s in inputs),
        level=about["level"],
        error=_error(view, part, point, about["level"], result),
        equations=equations(folder).replace("<pre>", '<pre tabindex="0">'),
        others=[key for key in VIEWS if key != model.key],
    )
    return filled


def _error(
    view: View, part: PartFile, point: Mapping[str, float], level: str, result: object
) -> str:
    """Say the verified error of the torque at the start."""
    known = error_estimate(
        part.spec.key,
        level,
        part.params,
        view.verified_point(point),
        branch=getattr(result, "branch", None),
        film_ratio=getattr(result, "film_ratio", None),
    )
    return "not verified" if known is None else f"at most {max(100.0 * known, 1e-3):.2g} %"


def _policy(script: str, style: str) -> str:
    """Return the content policy: nothing from outside, this script, this style, the kernels."""
    return (
        f"default-src 'none'; script-src {policy_source(script)} 'wasm-unsafe-eval'; "
        f"worker-src blob:; style-src {policy_source(style)}; img-src data:; base-uri 'none'; "
        "form-action 'none'"
    )


def _figures(
    known: dict[str, dict[str, Any]], large: Sequence[str], result: object
) -> list[dict[str, Any]]:
    """Return the results of the start, ``large`` ones first: name, value in full, text, meaning."""
    found = []
    for name in (*large, *(n for n in known if n not in large)):
        value, about = getattr(result, name, None), known[name]
        if isinstance(value, bool):
            text = "yes" if value else "no"
        elif isinstance(value, int | float):
            text = format_quantity(value, about["unit"], difference=about["relative"])
        else:
            text = "" if value is None else str(value)
        full = "" if value is None else repr(value) if isinstance(value, float) else str(value)
        found.append({"name": name, "value": full, "text": text, "help": about["help"]})
    return found
