"""``thrustwasher compare``: measurements of others against what the models say."""

import argparse
from pathlib import Path
from typing import Any

from ...cli.common import _options, _output, _table
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
    "--column NAME=COLUMN ...": f"of points.csv: {_table.COLUMN}",
    **{name: f"of points.csv: {text}" for name, text in _table.OPTIONS.items()},
    "--page FILE.md": "of a folder of measured data sets: write the page of all of them",
    "--json": "one JSON object with every number",
}
MOST_DRAWS = 4096


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "data_set",
        metavar="DATASET",
        help="folder with rig.toml, or a folder of measured data sets",
    )
    _options.add(parser, OPTIONS)


def run(arguments: argparse.Namespace) -> int:
    """Compare, then print, write or draw."""
    from ..measured.comparison import DRAWS, compare
    from ..measured.data_set_file import load_data_set

    fit = _count("--fit", arguments.fit, 0, 100, 0)
    draws = _count("--draws", arguments.draws, 2, MOST_DRAWS, DRAWS)
    folder = Path(arguments.data_set)
    if not folder.is_dir():
        raise ParameterError(f"measured data set {arguments.data_set!r}: there is no such folder")
    if arguments.page:
        return _page(arguments, folder, draws)
    out = _output.check_folder(arguments.out, "--out") if arguments.out else None
    columns = _table.renaming(arguments.column or ())
    data_set = load_data_set(folder, columns, _table.wanted_of(arguments))
    found = compare(data_set, fit=fit, draws=draws, progress=_output.time_left("compare:"))
    _output.warn(found.warnings)
    told = found.to_dict()
    if out:
        from ..report.model_plots.comparison_plot import comparison_figure

        with _output.whole_folder(out) as draft:
            comparison_figure(found).savefig(draft / "comparison.png")
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
    from ..measured.data_set_file import KINDS

    data_set = found.data_set
    print(f"{data_set.texts['title']}: {data_set.output} of {data_set.target_name}")
    print(f"  {data_set.texts['source']}")
    print(f"  {KINDS[data_set.kind]}")
    for i in range(len(data_set.measured)):
        given = ", ".join(
            f"{n} {_output.text_of(float(x[i]), '1')}" for n, x in data_set.inputs.items()
        )
        mark = "" if found.judged[i] else " (used for the fit)"
        print(
            f"  {given}: {data_set.outputs[i]} measured {data_set.measured[i]:.4g}, computed "
            f"{found.computed[i]:.4g} ({found.low[i]:.4g} .. {found.high[i]:.4g}) "
            f"{data_set.units[i]}{mark}"
        )
    for name, value in found.fitted.items():
        print(f"  fitted: {name} = {value:.4g}")
    low, high = told["inside_band_interval"]
    print(
        f"{told['points']} points judged: mean deviation {100.0 * told['mean_deviation']:+.1f} %, "
        f"largest {100.0 * told['largest_deviation']:+.1f} %, inside the band "
        f"{100.0 * told['inside_band']:.0f} % ({100.0 * low:.0f} .. {100.0 * high:.0f} %)"
    )
    print(f"Likely reason of what deviates: {data_set.texts['reason']}")


def _page(arguments: argparse.Namespace, folder: Path, draws: int) -> int:
    """Write the page of a folder of measured data sets."""
    from ..measured.collection_page import collection_page
    from ..measured.comparison import compare
    from ..measured.data_set_file import load_data_set

    _options.refuse_unused(
        arguments, "--page", ("fit", "out", "json", "column", "skip", "table", "sheet")
    )
    target = _output.check_file(arguments.page, "--page", (".md",))
    data_sets = [load_data_set(path.parent) for path in sorted(folder.glob("*/rig.toml"))]
    if not data_sets:
        raise ParameterError(
            f"measured data set {str(folder)!r}: there is no folder with a rig.toml in it"
        )
    blind, fits = [], []
    for data_set in data_sets:
        _output.note(f"{data_set.name}: {len(data_set.measured)} points")
        blind.append(compare(data_set, draws=draws))
        if data_set.fit and len(data_set.measured) > 1:
            fits.append(compare(data_set, fit=1, draws=draws))
    text = collection_page(blind, fits, folder / "wanted.toml")
    with _output.whole_file(target) as draft:
        draft.write_text(text, encoding="utf-8")
    _output.note(f"wrote {target}")
    return 0
