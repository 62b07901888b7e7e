"""Completion of words in the shell, where the package argcomplete is installed."""

import argparse
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

ASKED = "_ARGCOMPLETE"  # the shell sets it
FILES = ("--out", "--plot", "--part", "--ssp", "--points")  # options whose value is a file

SUBJECTS = ("target", "scene", "subject", "model", "models")  # what a command is about
OF_SCENES = ("explore", "efficiency", "optimise", "scatter", "shift")


def complete(
    parser: type[argparse.ArgumentParser],
    commands: Mapping[str, str],
    add_arguments: Callable[[str, argparse.ArgumentParser], None],
) -> None:
    """Answer the shell and leave, if it asks; without argcomplete do nothing.

    ``parser`` makes the program's parser, ``add_arguments`` declares a command's options: only
    those of the command in the line are declared.
    """
    if ASKED not in os.environ:
        return
    try:
        import argcomplete
    except ImportError:
        return
    package: Any = argcomplete  # it has no types
    program = parser(prog="thrustwasher")
    found = program.add_subparsers(parser_class=parser)
    line = os.environ.get("COMP_LINE", "").split()
    for name, words in commands.items():
        command = found.add_parser(name, help=words)
        if name in line:
            add_arguments(name, command)
            for action in command._actions:
                _choose(action, name)
    package.autocomplete(program, always_complete_options="long")


def _choose(action: Any, command: str) -> None:
    """Give an option the words that complete it; files otherwise."""
    if action.choices or action.nargs == 0 or {*FILES} & {*action.option_strings}:
        return
    if "--set" in action.option_strings:
        action.completer = lambda **_: [f"{name}=" for name in _parameters(command)]
    elif "--fidelity" in action.option_strings:
        action.completer = lambda **_: _levels(command)
    elif "--preset" in action.option_strings:
        action.completer = lambda **_: _presets()
    elif "--scene" in action.option_strings or action.dest in SUBJECTS:
        scenes = _scenes if command in OF_SCENES else list
        action.completer = lambda prefix, **_: [*scenes(), *_models(), *_files(prefix)]


def _models() -> list[str]:
    from ..model.registry import all_models

    return [model.key for model in all_models()]


def _scenes() -> list[str]:
    from ..shift.scene.scene_file import builtin_scenes

    return list(builtin_scenes())


def _presets() -> list[str]:
    from ..model.part_file import preset_parts
    from ..model.registry import all_models

    return sorted({name for model in all_models() for name in preset_parts(model.spec)})


def _parameters(command: str) -> list[str]:
    from dataclasses import fields

    with suppress(KeyError):
        return [f.name for f in fields(_spec_of(command).params)]
    return []


def _levels(command: str) -> list[str]:
    with suppress(KeyError):
        return [*_spec_of(command).levels, "auto:0.01"]
    return ["auto:0.01"]


def _spec_of(command: str) -> Any:
    from ..model.registry import models_with_points

    owner = {name: m for m in models_with_points().values() for name in m.commands()}
    return owner[command].spec


def _files(prefix: str) -> list[str]:
    from argcomplete.completers import FilesCompleter

    return list(FilesCompleter(["toml"])(prefix))
