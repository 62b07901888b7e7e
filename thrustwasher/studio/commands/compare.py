"""``thrustwasher compare``: measurements of others against what the models say."""

import argparse
from pathlib import Path
from typing import Any

from ...cli.common import _options, _output
from ...errors import ParameterError

HELP = "compare the models with measured data sets, blind or after a fit"
EXAMPLES = (
    "thrustwasher compare examples/measured/oh-58a",
    "thrustwasher compare examples/measured/gearpie-c14 --draws 16 --out compared",
)
OPTIONS = {
    "--fit N": "fit the first N parameters that the data set lists to every second point and "
    "evaluate the fit by the others; default 0, blind",
    "--draws N": "of the scatter, for the band; default 64",
    "--out DIR": "folder for comparison.json and comparison.png",
    "--page FILE.md": "of a folder of measured data sets: write the page of all of them",
    "--json": "one JSON object with every number",
}
MOST_DRAWS = 4096


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "rig", metavar="DATASET", help="folder with rig.toml, or a folder of measured data sets"
    )
    _options.add(parser, OPTIONS)


def run(arguments: argparse.Namespace) -> int:
    """Compare, then print, write or draw."""
    from ..rigs.rig_comparison import DRAWS, compare
    from ..rigs.rig_file import load_rig

    fit = _count("--fit", arguments.fit, 0, 100, 0)
    draws = _count("--draws", arguments.draws, 2, MOST_DRAWS, DRAWS)
    folder = Path(arguments.rig)
    if not folder.is_dir():
        raise ParameterError(f"measured data set {arguments.rig!r}: there is no such folder")
    if arguments.page:
        return _page(arguments, folder, draws)
    out = _output.check_folder(arguments.out, "--out") if arguments.out else None
    rig = load_rig(folder)
    found = compare(rig, fit=fit, draws=draws, progress=_output.time_left("compare:"))
    _output.warn(found.warnings)
    told = found.to_dict()
    if out:
        from ..report.model_plots.rig_plot import rig_figure

        with _output.whole_folder(out) as draft:
            rig_figure(found).savefig(draft / "comparison.png")
            text = _output.json_text({**told, "warnings": found.warnings})
            (draft / "comparison.json").write_text(text, encoding="utf-8")
    if arguments.json:
        _output.print_json({**told, "warnings": found.warnings})
        return 0
    _say(found, told)
    return 0


def _count(option: str, text: str | None, low: int, high: int, usual: int) -> int:
    if text is None:
        return usual
    number = int(text) if text.strip().isdecimal() and len(text) < 9 else -1
    if not low <= number <= high:
        raise ParameterError(f"{option} {text}: allowed: a whole number {low} .. {high}")
    return number


def _say(found: Any, told: dict[str, Any]) -> None:
    """Print every point and what they come to."""
    from ..rigs.rig_file import KINDS

    rig = found.rig
    print(f"{rig.texts['title']}: {rig.output} of {rig.target_name}")
    print(f"  {rig.texts['source']}")
    print(f"  {KINDS[rig.kind]}")
    for i in range(len(rig.measured)):
        given = ", ".join(f"{n} {_output.text_of(float(x[i]), '1')}" for n, x in rig.inputs.items())
        mark = "" if found.judged[i] else " (used for the fit)"
        print(
            f"  {given}: {rig.outputs[i]} measured {rig.measured[i]:.4g}, computed "
            f"{found.computed[i]:.4g} ({found.low[i]:.4g} .. {found.high[i]:.4g}) "
            f"{rig.units[i]}{mark}"
        )
    for name, value in found.fitted.items():
        print(f"  fitted: {name} = {value:.4g}")
    low, high = told["inside_band_interval"]
    print(
        f"{told['points']} points judged: mean deviation {100.0 * told['mean_deviation']:+.1f} %, "
        f"largest {100.0 * told['largest_deviation']:+.1f} %, inside the band "
        f"{100.0 * told['inside_band']:.0f} % ({100.0 * low:.0f} .. {100.0 * high:.0f} %)"
    )
    print(f"Likely reason of what deviates: {rig.texts['reason']}")


def _page(arguments: argparse.Namespace, folder: Path, draws: int) -> int:
    """Write the page of a folder of measured data sets."""
    from ..rigs.rig_comparison import compare
    from ..rigs.rig_file import load_rig
    from ..rigs.shelf_page import shelf_page

    _options.refuse_unused(arguments, "--page", ("fit", "out", "json"))
    target = _output.check_file(arguments.page, "--page", (".md",))
    rigs = [load_rig(path.parent) for path in sorted(folder.glob("*/rig.toml"))]
    if not rigs:
        raise ParameterError(
            f"measured data set {str(folder)!r}: there is no folder with a rig.toml in it"
        )
    blind, fits = [], []
    for rig in rigs:
        _output.note(f"{rig.name}: {len(rig.measured)} points")
        blind.append(compare(rig, draws=draws))
        if rig.fit and len(rig.measured) > 1:
            fits.append(compare(rig, fit=1, draws=draws))
    text = shelf_page(blind, fits, folder / "wanted.toml")
    with _output.whole_file(target) as draft:
        draft.write_text(text, encoding="utf-8")
    _output.note(f"wrote {target}")
    return 0
