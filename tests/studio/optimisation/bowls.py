"""Designs with known answers: a bowl with its minimum at (0.3, -0.4), with and without slopes."""

import math
from dataclasses import dataclass, replace

import numpy as np

from thrustwasher.model.quantity import Figure, Quantity
from thrustwasher.model.scatter import Law, Scatter, Source
from thrustwasher.studio.evaluators.evaluator import Answers, Slopes
from thrustwasher.studio.optimisation.designs import Budget

LEAST = 0.3, -0.4
PLACES = {n: Quantity(name=n, unit="1", nominal=0.9, low=-1.0, high=1.0) for n in ("x", "y")}
FIGURES = {n: Figure(n, "1", "") for n in ("bowl", "sum", "other")}
SPREAD = 0.1  # of x
BUDGET = Budget(sample=8, starts=2, rounds=2, tries=60)


@dataclass(frozen=True)
class Bowl:
    """``gone``: no figures right of this x; ``step``: lowers the bowl by so much times x."""

    sloped: bool = True
    gone: float = math.inf
    step: float = 0.0
    kind = "part"
    name = "Bowl"
    quantities = PLACES
    figures = FIGURES
    remarks = ()

    @property
    def identity(self):
        return {"bowl": f"{self.step:g}"}

    def one(self, row):
        x, y = row["x"] - LEAST[0], row["y"] - LEAST[1]
        found = {
            "bowl": x * x + 2.0 * y * y - self.step * row["x"],
            "sum": row["x"] + row["y"],
            "other": (x + 1.0) ** 2 + y * y,
        }
        return dict.fromkeys(found, math.nan) if row["x"] > self.gone else found

    def evaluate(self, rows, figures, effort="search"):
        values = np.array([[self.one(row)[n] for n in figures] for row in rows])
        return Answers(values, np.zeros(len(rows), np.int32))

    def gradient(self, row, figures, names, effort="search"):
        if not self.sloped:
            return None
        x, y = row["x"] - LEAST[0], row["y"] - LEAST[1]
        of = {
            "bowl": {"x": 2.0 * x - self.step, "y": 4.0 * y},
            "sum": {"x": 1.0, "y": 1.0},
            "other": {"x": 2.0 * (x + 1.0), "y": 2.0 * y},
        }
        values = self.evaluate([row], figures).values[0]
        return Slopes(values, np.array([[of[f][n] for n in names] for f in figures]))

    def scattered(self, table, row):
        law = Law(kind="normal", middle=row["x"], spread=SPREAD, text="normal")
        place = Quantity(name="x", unit="1", nominal=row["x"])
        return Scatter(sources=(Source(place=place, law=law),))

    def shorter_step(self, rows, figures, gain):
        assert all(row.keys() == {"x", "y"} for row in rows)
        shorter = self.step / 4.0 if self.step > 0.1 else None
        return shorter, f"a step of {self.step:g} errs" if self.step else ""

    def with_step(self, step):
        return replace(self, step=step)

    def file(self, row):
        return f"{row}\n"
