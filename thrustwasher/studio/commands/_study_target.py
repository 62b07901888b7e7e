"""What a study is of: a part at a point or a gear shift, by options that both commands have."""

import argparse
from dataclasses import replace
from typing import Any

from ...cli.common import _options
from ...cli.common._options import option_name
from ...model.levels import level_named
from ...model.registry import find_model

OPTIONS = {
    "--preset NAME": "of a model: named set of parameters, e.g. paper",
    "--fidelity LEVEL": "of a part: fidelity level of its model, if not the part file's",
}


def add_part_options(parser: argparse.ArgumentParser) -> None:
    """Declare what a part is solved with and at."""
    _options.add(parser, OPTIONS)
    parser.add_argument(
        "--reached",
        choices=["below", "above"],
        default="below",
        help="of a washer: where several solutions exist, the branch: as loaded up from light load "
        "(below, default), or coming down (above)",
    )
    _options.add_settings(parser, "of a part: change a parameter, e.g. --set roughness=4e-7")
    _options.add_oil(parser)
    inputs = parser.add_argument_group("inputs of a part, if not those of its [box]")
    for name, units in _options.inputs_of_all_models().items():
        inputs.add_argument(option_name(name), dest=name, metavar="QUANTITY", help=units)


def read_target(arguments: argparse.Namespace) -> tuple[Any, dict[str, str] | None]:
    """Return the part or scene and the inputs that are given."""
    from ...model.part_file import PartFile
    from ..evaluators.make import part_or_scene

    given = {
        n: getattr(arguments, n)
        for n in _options.inputs_of_all_models()
        if getattr(arguments, n) is not None
    }
    found = part_or_scene(arguments.target)
    if isinstance(found, PartFile):
        _options.refuse_unused(arguments, "a part, of which no figure is costly", ("indices",))
        if find_model(found.spec.key).sweep.draws is None:
            what = f"a {found.spec.key}, which has one solution"
            _options.refuse_unused(arguments, what, (), reached="below")
        if arguments.preset is not None:
            found = _options.solvable(arguments.target, arguments.preset)
        if arguments.fidelity is not None:
            found = replace(found, fidelity=level_named(found.spec, arguments.fidelity))
        settings = _options.read_settings(arguments.settings, found.spec, found)
        found = _options.with_oil(arguments, found, settings)
        return replace(found, parameters=found.parameters | settings), given
    unused = (*_options.inputs_of_all_models(), "preset", "fidelity", "settings")
    _options.refuse_unused(arguments, "a scene", unused, reached="below")
    if arguments.oil is not None:
        from ...shift import load_scene

        found = load_scene(arguments.target, arguments.oil)
    return found, None
