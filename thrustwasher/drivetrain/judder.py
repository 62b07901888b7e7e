"""What a swing of the output shaft is: judder, a swing that decays, or an artefact of the step."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from .figure_list import Found

FEW = 3  # lock-ups of one pack; so many are stick-slip
AGREES = 0.1, 1e-3  # of the predicted growth, and of the frequency


@dataclass(frozen=True, kw_only=True)
class Judder:
    """A swing of the shaft while a pack slips; rates in 1/s, frequencies in Hz."""

    pack: str
    """The pack that slips, the one with the steepest fall of friction if both do."""
    start: float
    """[s] The swing was judged from here ..."""
    end: float
    """[s] ... to here."""
    frequency: float
    growth: float
    """Measured; below 0 the swing decays."""
    amplitude: float
    """[N m] of the shaft torque at its greatest, half of the way from crest to trough."""
    locks: int
    """How often the pack stuck in the swing's course."""
    slope: float
    """[N m s/rad] of the pack's torque over its slip."""
    damping: float
    """[N m s/rad] of the shaft."""
    limit_damping: float
    """[N m s/rad] below which the swing grows."""
    mode_frequency: float
    """Of the eigenvalue."""
    mode_growth: float
    """Of the eigenvalue."""
    step_growth: float
    """What handing capacities over once per step adds to the eigenvalue's growth."""
    step: float
    """[s]"""
    scatter: float = 0.0
    """Of measured less computed growth, from window to window."""

    @property
    def tolerance(self) -> float:
        """Growth [1/s] to which measured and computed growth are held to agree."""
        relative, absolute = AGREES
        angular = 2.0 * math.pi * self.mode_frequency
        return max(relative * abs(self.mode_growth), absolute * angular, self.scatter)

    @property
    def stick_slip(self) -> bool:
        """The pack sticks again and again: not the one lock-up that ends a shift."""
        return self.locks >= FEW

    @property
    def kind(self) -> str:
        """What the growth is.

        "physical": it grows as the eigenvalue says; "decaying": it decays, as the eigenvalue says;
        "numerical": the communication step makes the difference; "unexplained": another one.
        """
        more = self.growth - self.mode_growth
        if abs(more) <= self.tolerance:
            return "physical" if self.growth > 0.0 else "decaying"
        if abs(self.step_growth) > 0.5 * self.tolerance and more * self.step_growth > 0.0:
            return "numerical"
        return "decaying" if max(self.growth, self.mode_growth) <= 0.0 else "unexplained"

    def as_dict(self) -> dict[str, Any]:
        """Return all of it, the kind and a step that adds little included."""
        return {**asdict(self), "kind": self.kind, "good_step": self.good_step}

    @property
    def good_step(self) -> float:
        """Step [s] that would add half the tolerance; what it adds falls with its square."""
        wanted = 0.5 * self.tolerance / max(abs(self.step_growth), 1e-300)
        return float(self.step * min(1.0, wanted**0.5))


def judder_figures(found: Judder | None) -> Found:
    """Return the key figures of a swing; times are those of its beginning."""
    if found is None:
        return {}
    names = (
        "frequency", "mode_frequency", "growth", "mode_growth", "step_growth", "amplitude",
        "slope", "damping", "limit_damping",
    )  # fmt: skip
    first = found.start
    return {
        f"judder_{name}": (getattr(found, name), first if name == "growth" else None)
        for name in names
    }
