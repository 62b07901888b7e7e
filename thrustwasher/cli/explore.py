"""``thrustwasher explore``: one file in which a model is tried in a browser."""

import argparse

from ..model.registry import models_with_points
from ..model.rungs import gone_rung
from .common import _options, _output

HELP = "write one page in which a part is tried in any browser, without Python"
USUAL = "washer"
OPTIONS = {
    "--preset PRESET": "preset of the model, `thrustwasher part list` names them",
    "--out PAGE.html": "file to write, default explore-NAME.html",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    models = ", ".join(models_with_points())
    parser.add_argument(
        "subject",
        nargs="?",
        default=USUAL,
        metavar="PART.toml|MODEL",
        help=f"part file, or model with its defaults: {models}; default {USUAL}",
    )
    _options.add(parser, OPTIONS)
    _options.add_oil(parser)


def run(arguments: argparse.Namespace) -> int:
    """Write the page."""
    part = _options.solvable(arguments.subject, arguments.preset)
    part = _options.with_oil(arguments, part, ())
    out = f"explore-{part.name}.html" if arguments.out is None else arguments.out
    target = _output.check_file(out, "--out", (".html", ".htm"))
    _output.warn(gone_rung(part.spec, part.fidelity))

    from ..explore.page import page

    text = page(part)
    _output.write_text(target, text)
    _options.tell_oil(part)
    _output.warn(part.oil_warnings)
    print(f"{out}: {len(text.encode()) / 1e6:.2f} MB; open it in a browser")
    return 0
