"""The page of all measured data sets: what agrees, what does not, and why it may be so."""

import textwrap
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from .comparison import Comparison
from .data_set_file import DataSet

DEFAULTS = "inputs without a column in points.csv: taken by default"
WIDTH = 150
NARROW = 0.01  # of the computed value: no band narrower than this is shown
HEAD = """# Measured

Published numbers against the models. **Measured** data sets test a model: measured on the machine
that is modelled. The others are only **compared**: another machine, a calculation, or numbers that
chose a constant.

Nothing is fitted first; what is not published is at the part's default. Deviation: computed over
published, less 1. Band: 5 to 95 % of the scatter (uncertainty) of inputs and reading error, not
shown if narrower than 1 %; "inside" counts the points in it. Conditions, reading of the numbers
and rights are in `examples/measured/*/rig.toml`.

`thrustwasher compare examples/measured --page docs/measured.md` writes this page.
"""
OWN = """## Your own measured data set

Make a folder with `rig.toml` and `points.csv`, then compare, or fit first:

```sh
thrustwasher compare examples/measured/gearpie-c14
thrustwasher compare examples/measured/jackson-green-2006 --fit 1
```

`rig.toml` has

- texts `title`, `source`, `measured`, `conditions`, `rights`, `read` (how the numbers were read),
  `reason` (of a deviation);
- `part = "my-part.toml"`, or `scene = "my-scene.toml"` with `gear`;
- `kind` (measured, other machine, calculated, used), `vary` (input over which points are drawn),
  `fit` (parameters, the first first), `coefficients` of a published fit.

`points.csv` has a line per point: inputs, one measured output (of a part several),
`<output>_error` (standard deviation), `origin` (table, figure, text, fit).

`--fit N` fits the first N parameters to every second point and evaluates the others. At most as
many points of a published fit count as it has coefficients.
"""


def collection_page(blind: Sequence[Comparison], fits: Sequence[Comparison], wanted: Path) -> str:
    """Return the page as Markdown; ``wanted``: the list of what is not available."""
    lines = [HEAD]
    for title, ours in (("Measured", True), ("Compared", False)):
        chosen = [c for c in blind if (c.data_set.kind == "measured") == ours]
        later = [c for c in fits if (c.data_set.kind == "measured") == ours]
        lines += [f"## {title}", "", _counted(chosen), "", *_table([*chosen, *later]), ""]
    lines.pop()
    for c in blind:
        texts = c.data_set.texts
        text = (
            f"**{texts['title']}.** {texts['measured'].rstrip('.')}. Source: {texts['source']}. "
            f"Likely reason: {texts['reason']}"
        )
        lines += ["", f"## {c.data_set.name}", "", textwrap.fill(text, WIDTH), "", *_points(c)]
        lines += [f"\n{text.replace(DEFAULTS, 'Default')}." for text in c.warnings]
    if wanted.is_file():
        text = "lists numbers that are not available. Contributions are welcome."
        lines += ["", "## Wanted", "", f"`{wanted.as_posix()}` {text}"]
    return "\n".join([*lines, "", OWN])


def _points(c: Comparison) -> list[str]:
    """Return what all points share in a line, the rest in a table."""
    data = c.data_set
    columns = dict(zip(data.inputs, data.input_units, strict=True))
    shared = {name: x[0] for name, x in data.inputs.items() if np.ptp(x) == 0.0}
    at = [f"{name} {x:.5g} {columns[name]}" for name, x in shared.items()]
    own = [name for name in columns if name not in shared]
    how = "published" if data.kind == "calculated" else "measured"
    if len(data.measured) == 1:
        line = f"{data.output} {data.measured[0]:.4g}{_unit(data, 0)} {how}, {c.computed[0]:.4g} "
        return [f"At {', '.join(at)}: {line}computed (band {c.low[0]:.4g} .. {c.high[0]:.4g})."]
    several = len({*data.outputs}) > 1
    wide = c.high - c.low > NARROW * np.abs(c.computed)
    title = (
        f"{'Results' if several else data.output} {how}; computed{'; band' if any(wide) else ''}"
    )
    lines = [f"{title}{', at ' if at else ''}{', '.join(at)}:", ""]
    for i in range(len(data.measured)):
        point = [f"{name} {data.inputs[name][i]:.5g} {columns[name]}" for name in own]
        point += [f"{data.outputs[i]}{_unit(data, i)}"] if several else []
        value = f"{data.measured[i]:.4g}{'' if several else _unit(data, i)}; {c.computed[i]:.4g}"
        origin = f"; {data.origin[i]}" if len({*data.origin}) > 1 else ""
        band = f"; {c.low[i]:.4g} .. {c.high[i]:.4g}" if wide[i] else ""
        lines.append(f"- {', '.join(point)}: {value}{band}{origin}")
    return lines


def _unit(data_set: DataSet, i: int) -> str:
    unit = data_set.units[i]
    if unit == "1":
        return ""
    return f" [{unit}]" if len({*data_set.outputs}) > 1 else f" {unit}"


def _counted(found: Sequence[Comparison]) -> str:
    points = sum(len(c.deviations) for c in found)
    inside = sum(int(c.inside.sum()) for c in found)
    words = [
        f"{n} {what}{'' if n == 1 else 's'}"
        for n, what in ((len(found), "data set"), (points, "point"))
    ]
    return f"{', '.join(words)}, {inside} of them inside the band."


def _table(found: Sequence[Comparison]) -> list[str]:
    lines = [
        "| data set | result | kind | mean deviation | largest | inside |",
        "|---|---|---|---|---|---|",
    ]
    for c in found:
        data, numbers = c.data_set, c.to_dict()
        how = f", after a fit of {', '.join(c.fitted)}" if c.fitted else ""
        lines.append(
            f"| [{data.name}](#{data.name}){how} | {data.output} of {data.target_name} "
            f"| {data.kind} | {100.0 * numbers['mean_deviation']:+.1f} % "
            f"| {100.0 * numbers['largest_deviation']:+.1f} % "
            f"| {int(c.inside.sum())} of {numbers['points']} |"
        )
    return lines
