"""The page of all rigs: what agrees, what does not, and why it may be so."""

from collections.abc import Sequence
from pathlib import Path

from ..model.toml_tables import read_file
from .rig_comparison import Comparison
from .rig_file import KINDS

HEAD = """# Measured

Numbers of others beside what the models say. **Measured** is what was measured on the machine that
is modelled and is compared blind: these points test a model. All others are only **compared**: of
another machine, calculated by those who published them, or used to choose a constant. Nothing is
fitted first: part and oil are as published, what is not published is as a part's defaults. The
band holds 5 to 95 % of the scatter of the inputs and the reading error together; "inside" is the
share of points in it, with its interval of 95 %. Deviation is computed over measured less 1, with
its sign here and with `--json`. What disagrees is shown as it is.

`thrustwasher compare examples/measured --page docs/measured.md` writes this page.
"""
OWN = """## Your own rig

A folder with two files: `rig.toml` (title, source, what was measured, conditions, rights, how the
numbers were read, likely reason of a deviation; `kind`: measured, other machine, calculated, used;
`part = "my-part.toml"` or
`scene = "my-scene.toml"`) and `points.csv`, a line per point: inputs, one measured output or, of a
part, several, `<output>_error` (standard deviation), `origin` (table, figure, text or fit).
`thrustwasher compare FOLDER` does the rest; `--fit N` fits the first N parameters of the list
`fit` to every second point and judges by the others. Points of a published fit count at most as
many as it has coefficients. We are glad to put rigs with a source on this shelf.
"""


def shelf_page(blind: Sequence[Comparison], fits: Sequence[Comparison], wanted: Path) -> str:
    """Return the page as Markdown; ``wanted``: the list of what could not be had."""
    lines = [HEAD]
    for title, ours in (("Measured", True), ("Compared", False)):
        chosen = [c for c in blind if (c.rig.kind == "measured") == ours]
        later = [c for c in fits if (c.rig.kind == "measured") == ours]
        lines += [f"## {title}", "", _counted(chosen), "", *_table([*chosen, *later]), ""]
    lines.pop()
    for c in blind:
        lines += [
            "",
            f"## {c.rig.name}",
            "",
            f"**{c.rig.texts['title']}.** {c.rig.texts['measured']}",
            "",
        ]
        lines += [f"- Kind: {KINDS[c.rig.kind]}"]
        lines += [f"- {key.capitalize()}: {c.rig.texts[key]}" for key in ("source", "conditions")]
        lines += [f"- Read: {c.rig.texts['read']}. Rights: {c.rig.texts['rights']}."]
        lines += [f"- Likely reason: {c.rig.texts['reason']}", ""]
        units = [f"{n} [SI]" for n in c.rig.inputs]
        several = len({*c.rig.outputs}) > 1
        units += ["result"] if several else []
        lines += [f"| {' | '.join(units)} | measured [{c.rig.unit}] | computed | band | origin |"]
        lines += ["|---" * (len(units) + 4) + "|"]
        for i in range(len(c.rig.measured)):
            given = " | ".join(f"{x[i]:.5g}" for x in c.rig.inputs.values())
            given += f" | {c.rig.outputs[i]} [{c.rig.units[i]}]" if several else ""
            lines.append(
                f"| {given} | {c.rig.measured[i]:.4g} | {c.computed[i]:.4g} "
                f"| {c.low[i]:.4g} .. {c.high[i]:.4g} | {c.rig.origin[i]} |"
            )
        lines += [f"\n{text}." for text in c.warnings]
    lines += [
        "",
        "## Wanted",
        "",
        "Numbers that could not be had; whoever can read them is welcome.",
        "",
    ]
    table = read_file("wanted", wanted) if wanted.is_file() else {}
    lines += [f"- {row['source']}: {row['what']}" for row in table.get("wanted", [])]
    return "\n".join([*lines, "", OWN])


def _counted(rigs: Sequence[Comparison]) -> str:
    points, inside = sum(len(c.deviations) for c in rigs), sum(int(c.inside.sum()) for c in rigs)
    words = [
        f"{n} {what}{'' if n == 1 else 's'}" for n, what in ((len(rigs), "rig"), (points, "point"))
    ]
    return f"{', '.join(words)}, {inside} of them inside the band."


def _table(rigs: Sequence[Comparison]) -> list[str]:
    lines = [
        "| rig | of | kind | points | mean deviation | largest | inside | interval |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for c in rigs:
        told = c.to_dict()
        how = f", after a fit of {', '.join(c.fitted)}" if c.fitted else ""
        low, high = c.interval
        lines.append(
            f"| [{c.rig.name}](#{c.rig.name}){how} | {c.rig.output} of {c.rig.target_name} "
            f"| {c.rig.kind} | {told['points']} | {100.0 * told['mean_deviation']:+.1f} % "
            f"| {100.0 * told['largest_deviation']:+.1f} % "
            f"| {int(c.inside.sum())} of {told['points']} | {low:.2f} .. {high:.2f} |"
        )
    return lines
