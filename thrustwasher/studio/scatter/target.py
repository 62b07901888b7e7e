"""What a study asks of an evaluator: which figures, outcomes and signals of its rows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, suggestion
from ...model.quantity import Figure
from ...model.scatter import Scatter
from ...model.toml_tables import unknown
from ..evaluators.evaluator import Array, Codes, Effort, Scattering, some_figures, texts


@dataclass(frozen=True, kw_only=True)
class Target:
    """An evaluator, what scatters of it, and what is kept of its rows."""

    evaluator: Scattering
    scatter: Scatter
    figures: tuple[Figure, ...]
    """Numbers of a run."""
    outcomes: tuple[str, ...] = ()
    """What a run says yes (1) or no (0) to, such as ``film_lost``."""
    series: tuple[str, ...] = ()
    """Signals over ``time``; () if there are none."""

    @property
    def name(self) -> str:
        """Name of the part, scene or function."""
        return self.evaluator.name

    @property
    def kind(self) -> str:
        """What it is."""
        return self.evaluator.kind

    @property
    def time(self) -> Array:
        """(n_t,) [s], common to all runs."""
        return self.evaluator.time

    @property
    def costly(self) -> tuple[str, ...]:
        """Figures that only base runs give, unless all are asked to; elsewhere they are NaN."""
        names = {f.name for f in self.figures}
        return tuple(name for name in self.evaluator.costly if name in names)

    @property
    def identity(self) -> dict[str, str]:
        """What makes a study of this target another one, in words by kind; for the journal."""
        word = "outputs" if self.kind == "part" else "figures"
        found = {**self.evaluator.identity, word: ", ".join(f.name for f in self.figures)}
        return found | ({"series": ", ".join(self.series)} if self.evaluator.signals else {})

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why a run failed, by its code less one."""
        return tuple(dict.fromkeys(self.evaluator.reasons.values()))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed of it, a line each."""
        return texts(self.evaluator.remarks, "warning")

    @property
    def notes(self) -> tuple[str, ...]:
        """What else is to be known of it."""
        note = getattr(self.evaluator, "note", "")
        return (*texts(self.evaluator.remarks, "note"), *((note,) if note else ()))

    @property
    def setting(self) -> dict[str, str]:
        """Level, inputs that do not scatter and a named oil of a part, as words."""
        words = getattr(self.evaluator, "setting", None)
        return words(self.scatter.names) if words else {}

    def nominal(self) -> Array:
        """Return what the run at the nominal values gives (m,): see ``solve``."""
        answers = self.evaluator.nominal(self._names, self.series)
        found: Array = _flat(answers.values, answers.series)[0]
        return found

    def solve(
        self, rows: Sequence[Mapping[str, Any]], costly: NDArray[np.bool_]
    ) -> tuple[Array, Codes]:
        """Return what runs give: (n, m) and their codes (n,).

        The columns are figures, outcomes, then the series, signal by signal. Code 0 is a sound run;
        with another the row is NaN and ``reasons`` says why.
        """
        efforts: list[Effort] = ["search" if own else "least" for own in costly.tolist()]
        answers = self.evaluator.evaluate(rows, self._names, efforts, self.series)
        known = self.evaluator.reasons
        number = {code: 1 + self.reasons.index(words) for code, words in known.items()}
        codes = [number.get(code, 0) for code in answers.codes.tolist()]
        return _flat(answers.values, answers.series), np.array(codes, np.int32)

    @property
    def _names(self) -> list[str]:
        return [*(f.name for f in self.figures), *self.outcomes]

    @property
    def n_columns(self) -> int:
        """How many numbers a run gives."""
        return len(self._names) + len(self.series) * len(self.time)


def target_of(
    evaluator: Scattering, scatter: Scatter, outputs: Sequence[str] | None = None
) -> Target:
    """Return what a study asks for; ``outputs``: figures and signals to keep, None: all."""
    every = evaluator.figures
    known = [n for n, f in every.items() if f.kind == "real" and not f.of_curve]
    signals = list(evaluator.signals)
    if outputs is None or not (outputs or evaluator.kind == "scene"):
        chosen = [*known, *signals]
    else:
        own = getattr(getattr(evaluator, "part", None), "own_name", str)
        chosen = [own(name) for name in outputs]
        for name in chosen:
            if name not in known and name not in signals:
                raise _unknown(evaluator, name, [*known, *signals])
    figures = [n for n in chosen if n in known]
    if evaluator.kind == "scene":  # in their own order
        figures = [n for n in known if n in chosen]
    found = evaluator.under(scatter, figures)
    return Target(
        evaluator=found,
        scatter=scatter,
        figures=tuple(every[n] for n in figures),
        outcomes=tuple(n for n, f in every.items() if f.kind == "outcome"),
        series=tuple(n for n in signals if n in chosen),
    )


def _unknown(evaluator: Scattering, name: str, known: Sequence[str]) -> ParameterError:
    if evaluator.kind == "scene":
        return unknown(f"scene {evaluator.name!r}: outputs", name, known)
    hint = ""
    if evaluator.kind == "part":
        hint = suggestion(name, some_figures(evaluator, known), "; did you mean {!r}?")
    return ParameterError(f"outputs: {name!r}, allowed: {', '.join(known)}{hint}")


def _flat(values: Array, series: Array | None) -> Array:
    """Return figures and outcomes, then the signals, in one row each."""
    return values if series is None else np.hstack((values, series.reshape(len(values), -1)))
