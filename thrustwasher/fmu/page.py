"""documentation/index.html of an FMU: one page without scripts and outside links."""

import base64
from collections.abc import Sequence
from html import escape

from ..models._spec import ModelSpec
from .icon import icon
from .interface import Variable, enumerations, variables
from .reference import FOLDER
from .registry import package_version

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;
color:#263242}table{border-collapse:collapse;width:100%;margin:1em 0}
td:nth-child(3){min-width:7em}
th,td{border:1px solid #c4ccd4;padding:.25em .5em;text-align:left;vertical-align:top}
th{background:#eef1f4}code,pre{background:#f4f6f8}pre{padding:1em;overflow:auto}"""

NEEDS = """<p>This FMU runs in Python: the importing process must be, or find, a Python with the
package <code>thrustwasher</code> of version {version}
(<code>pip install thrustwasher=={version}</code>). Another version is refused at instantiation with
a message that names both. The first run on a machine compiles the model, which takes seconds to
minutes; later runs load the result.</p>"""

FAILS = """<ul>
<li>A value outside its range, or NaN, is not taken over: the old value stays, the message names
variable, value, unit and range, <code>solver_status</code> shows BAD_INPUT, and the next step is
refused until a good value is set.</li>
<li>A step without a solution leaves every value as it was before the step.
<code>solver_status</code> and the message say why. The call returns fmi2Discard: the library this
target is built on cannot return fmi2Error. Treat it as a failed step, not as the end of the run.
A step with better input works again.</li>
<li>The complete state can be saved, restored and serialized.</li>
<li>Values read after setting an input, without a step, are those at the new input.</li>
</ul>"""

CHECK = """<p>Simulate the default experiment with the inputs of
<code>{folder}/{model}_in.csv</code> (linear between the rows, those at the beginning of a step hold
during it) and compare with <code>{model}_out.csv</code> beside it.</p>"""


def page(
    spec: ModelSpec, *, target: str, fmi: int, guid: str, equations: str, platforms: Sequence[str]
) -> str:
    """Return the page; ``equations`` is the model's readme, shown as it is."""
    found = variables(spec)
    picture = base64.b64encode(icon(spec.name)).decode("ascii")
    parts = [
        f"<h1>{escape(spec.name)}</h1><p>{escape(spec.help)}.</p>",
        f'<p><img alt="icon" width="200" height="200" src="data:image/png;base64,{picture}"></p>',
        "<h2>What it needs</h2>", NEEDS.format(version=escape(package_version())),
        *_section("Inputs", found, "input"), *_section("Outputs", found, "output"),
        "<h2>How to wire it</h2>", _wiring(spec),
        *_section("Parameters", found, "parameter"),
        "<h2>Enumerations</h2>", _enumerations(spec),
        "<h2>When something goes wrong</h2>", FAILS,
        "<h2>To check an installation</h2>", CHECK.format(folder=FOLDER, model=spec.name),
        f"<h2>Equations</h2><pre>{escape(equations)}</pre>",
        f"<h2>Origin</h2><p>thrustwasher {escape(package_version())}, GUID {escape(guid)}</p>",
    ]  # fmt: skip
    title = f"<title>{escape(spec.name)}</title><style>{STYLE}</style>"
    head = f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{title}</head>'
    return head + "<body>\n" + "\n".join(parts) + "\n</body></html>\n"


def _section(title: str, found: tuple[Variable, ...], causality: str) -> list[str]:
    shown = [v for v in found if v.causality == causality]
    if causality == "output":
        outputs = [(v.name, _unit(v), v.help) for v in shown]
        return [f"<h2>{title}</h2>", _table(("name", "unit", "meaning"), outputs)]
    rows = [(v.name, _unit(v), _allowed(v), f"{v.start:g}", v.help) for v in shown]
    return [f"<h2>{title}</h2>", _table(("name", "unit", "allowed", "start", "meaning"), rows)]


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = ["".join(f"<th>{cell}</th>" for cell in head)]
    lines += ["".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows]
    return "<table>" + "\n".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def _unit(v: Variable) -> str:
    return v.unit if v.type == "Real" else v.type_name or v.type


def _allowed(v: Variable) -> str:
    return f"{v.low:g} .. {v.high:g}" if v.low is not None and v.high is not None else ""


def _enumerations(spec: ModelSpec) -> str:
    found = enumerations(spec).items()
    rows = [(name, str(i.value), i.name, i.help) for name, items in found for i in items]
    return _table(("enumeration", "number", "item", "meaning"), rows)


def _wiring(spec: ModelSpec) -> str:
    through = [s.name for s in spec.outputs if s.depends]
    lines = [
        "All values are SI. Outputs are valid after the initialization and at the end of each step."
    ]
    if through:
        lines.append(
            "These outputs follow the inputs at once, so that a master with fixed steps sees them "
            f"one step late: {', '.join(through)}."
        )
    lines.append(f"Suggested step: {spec.step_size:g} s.")
    plugs = [
        (t.name, t.kind, ", ".join(f"{member} = {name}" for name, member, _ in t.members), t.help)
        for t in spec.terminals
    ]
    text = "".join(f"<p>{escape(line)}</p>" for line in lines)
    return text + _table(("terminal", "kind", "members", "meaning"), plugs)
