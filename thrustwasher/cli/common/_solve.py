"""The command that solves a model at one operating point, made from the model's record."""

import argparse
import time
from collections.abc import Mapping
from typing import Any

from ...model.record import Command, Model, Variants
from ...model.solutions import closing, input_lines, point_lines, title_of
from ...model.spec import ModelSpec
from ...plugins import called
from . import _options, _output

SHOWN = 4  # parameters of an output on the screen
ROUNDING = 1e-9  # of a result: smaller changes are none
Changes = dict[str, dict[str, float]]  # output -> parameter -> change
Ranking = dict[str, tuple[str, dict[str, float]]]  # output -> unit, changes by parameter


class PointCommand:
    """The command of one model, with the face of a command's module."""

    def __init__(self, model: Model) -> None:
        assert model.command is not None
        self.HELP, self.EXAMPLES = model.command.help, model.command.examples
        self._model, self._command = model, model.command

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the options."""
        model, spec = self._command, self._model.spec
        # The model's own inputs come first.
        inputs = sorted(self._model.inputs(), key=lambda signal: signal not in spec.inputs)
        _options.add_inputs(parser, inputs)
        _options.add_parameters(parser, spec)
        _options.add_fidelity(parser, spec, auto=self._model.ladder is not None)
        _options.add_options(parser, model.options)
        if model.ranks:
            parser.add_argument(
                "--sensitivities",
                nargs="?",
                const="",
                metavar="OUTPUTS",
                help="rank the parameters by what one percent more of each changes; of these "
                "outputs, separated by commas, default all; --plot draws the ranking",
            )
        _output.add_targets(parser, plot=model.plot)
        if model.report:
            parser.add_argument("--report", metavar="FILE", help=model.report)

    def meant(self, name: str, spelled: str) -> str:
        """Return what to say of an option that there is not, ``spelled`` what is spelled alike."""
        return spelled if spelled else _options.other_way(name, self._model)

    def run(self, arguments: argparse.Namespace) -> int:
        """Solve, then print or draw."""
        model, spec = self._command, self._model.spec
        inputs = self._model.inputs()
        at = _options.read_point(arguments, spec, inputs)
        point, params = at.there.values, at.part.params
        given = {"preset": getattr(arguments, "preset", None), "part": arguments.part}
        options = _options.read_options(arguments, model.options)
        targets = _output.targets(arguments)
        report = getattr(arguments, "report", None)
        report = _output.check_file(report, "--report", (".html",)) if report else None

        place = self._model.place(point)
        fidelity = _level(arguments.fidelity or at.part.fidelity, spec, params, place)
        began = time.perf_counter()
        result = self._model.solve(params, **point, fidelity=fidelity, **options)
        wall_time = time.perf_counter() - began
        own = "" if any(options.values()) else self._model.doubt(result)
        changes = _changes(getattr(arguments, "sensitivities", None), result)
        named = self._model.own_names(arguments.part or given["preset"])
        more = filter(None, [*at.part.over_limits(result), *result.warnings, own])
        warnings = at.warn(map(named, more))
        if targets.plot:
            targets.draw(
                called("point_figures")[spec.key](result, point, params)
                if changes is None
                else called("ranking_figure")(spec.name, _ranking(model, spec, result, changes))
            )
        found, parameters = _output.scalars(result), _output.parameters_of(params)
        if report:
            called(model.report_by)(report, at.part, [place])
        if arguments.json:
            if changes is not None:
                given["sensitivities"] = result.sensitivities(changes)
                given["change_per_percent"] = changes
            _output.print_json({**found, **point, **given, **at.record(warnings, wall_time)})
            return 0
        name = "" if at.part.name == spec.name else f": {at.part.name}"
        print(f"{title_of(self._model, params)}{name}")
        lines = [*input_lines(self._model, at.there), *point_lines(self._model, result, point)]
        _output.print_rows([(named(line.name), line.value, named(line.words)) for line in lines])
        if model.variants:
            _print_variants(model.variants, result, parameters)
        if changes is not None:
            print_ranking(_ranking(model, spec, result, changes))
        print(f"  {closing(self._model, result)}, {wall_time:.3g} s")
        return 0


def _changes(asked: str | None, result: Any) -> Changes | None:
    """Return the changes by one percent more of each parameter, None if nobody asks."""
    if asked is None:
        return None
    outputs = [name.strip() for name in asked.split(",") if name.strip()] or None
    found: Changes = result.sensitivities(outputs, per_percent=True)
    return found


def _ranking(model: Command, spec: ModelSpec, result: object, changes: Changes) -> Ranking:
    """Return unit and changes, largest first, of outputs in the table that change."""
    units = {s.name: s.unit for s in spec.outputs}
    units |= {name: unit for name, (unit, _) in model.extra.items()}
    return {
        name: (units[name], dict(sorted(row.items(), key=lambda item: -abs(item[1]))))
        for name, row in changes.items()
        if name in units and max(map(abs, row.values())) > ROUNDING * abs(getattr(result, name))
    }


def print_ranking(ranking: Ranking) -> None:
    """Print for each output the parameters that change it most."""
    print("  change by one percent more of a parameter, largest first:")
    wide = max(map(len, ranking), default=0)
    for output, (unit, row) in ranking.items():
        words = (
            f"{name} {_output.text_of(change, unit, True, digits=3)}"
            for name, change in list(row.items())[:SHOWN]
            if change
        )
        print(f"  {output:<{wide}}  {', '.join(words)}")


def _level(asked: str, spec: ModelSpec, params: object, point: Mapping[str, float]) -> str:
    """Return the level requested by name, or the one that is chosen at ``point``.

    Why it was chosen is written to standard error; SolveError if none holds the tolerance.
    """
    if asked in spec.fidelities:
        return asked
    from ...ladder.choose import choose, level_and_tolerance

    _, tolerance = level_and_tolerance(spec.key, spec, asked)
    choice = choose(spec.key, dict(point), tol=float(tolerance or 0.0), params=params)
    _output.note(str(choice))
    return choice.fidelity


def _print_variants(variants: Variants, result: object, parameters: Mapping[str, object]) -> None:
    """Print the results of all variants, a row for each; nothing where there are none."""
    names = (variants.name(column, row) for column in variants.columns for row in variants.rows)
    if all(getattr(result, name) is None for name in names):
        return
    heads = variants.columns.values()
    print("  " + variants.head.ljust(22) + "".join(head.rjust(len(head) + 3) for head in heads))
    for words in variants.rows:
        cells = (
            _output.text_of(getattr(result, variants.name(column, words)), "1").rjust(len(head) + 3)
            for column, head in variants.columns.items()
        )
        mine = parameters[variants.head] == words.replace(" ", "")
        note = f"  ({variants.chosen})" if mine else ""
        print("  " + words.ljust(22) + "".join(cells) + note)
