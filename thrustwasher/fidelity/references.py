"""Where each model's reference values come from."""

from __future__ import annotations

from importlib import import_module

from .truths import Source


def source_of(model: str) -> Source:
    """Return the source of a model's reference values."""
    home = import_module(f".truth_{model}", __package__)
    return home.SOURCE  # type: ignore[no-any-return]
