"""A wet pack that closes under a rising force while its slip runs out: one engagement in a row."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ...clutch.engagement import engage_clutch
from ...clutch.kernels import layout as k
from ...clutch.parameters import SPEC
from ...clutch.run_out import run_out
from ...clutch.solve import heat_status, prepare
from ...errors import ParameterError, SolveError, Status
from ...face_load import FACE_LOADS, LIMITED, face_loads
from ...model.levels import level_named
from ...model.part_file import PartFile, part_text
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter
from .evaluator import Answers, Effort, Remark, Row, Rows, digest_of

PROFILE = {
    "inertia": Quantity(name="inertia", unit="kg.m2", nominal=0.0, low=0.0, high=1e4),
    "ramp": Quantity(name="ramp", unit="s", nominal=0.1, low=0.0, high=3600.0),
    "duration": Quantity(name="duration", unit="s", nominal=0.5, low=1e-6, high=3600.0),
    "step": Quantity(name="step", unit="s", nominal=1e-3, low=1e-6, high=3600.0),
}
MOST_POINTS = 200_000
FIGURES = (
    Figure("energy", "J", "heat of the engagement"),
    Figure("peak_temperature", "K", "highest mean temperature of the interface", high=k.HOT_LIMIT),
    Figure("slip_time", "s", "time until the slip has run out; none if it has not"),
    Figure("slip_left", "rad/s", "slip at the end", high=0.0),
    Figure("peak_torque", "N.m", "largest friction torque"),
    Figure("minimum_film_ratio", "1", "smallest film ratio"),
)


@dataclass(frozen=True, kw_only=True)
class EngagementEvaluator:
    """An engagement of a pack, see ``engagement_evaluator``."""

    part: PartFile
    inputs: Mapping[str, float]
    fidelity: str
    remarks: tuple[Remark, ...] = ()
    kind: Literal["engagement"] = "engagement"
    reasons: Mapping[int, str] = field(
        default_factory=lambda: {int(s): s.name for s in Status if s.is_failure}
    )

    @property
    def name(self) -> str:
        """Name of the part."""
        return f"engagement of {self.part.name}"

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """Load, slip at the start, inertia and times, and the pack's parameters."""
        return self.part.suggesting({**self.part.places(self.inputs), **PROFILE})

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Heat, peaks and times; what loads the faces at its worst moment."""
        bears = self.part.limits
        faces = {
            name: Figure(name, unit, f"{words}, at its worst", high=bears.get(name, np.inf))
            for name, (unit, words) in LIMITED.items()
        }
        return {f.name: f for f in FIGURES} | faces

    @property
    def profile(self) -> tuple[str, ...]:
        """Inputs and times of an engagement, by name."""
        optional = {s.name for s in self.part.spec.inputs if s.optional}
        return tuple(n for n in (*self.inputs, *PROFILE) if n not in optional)

    @property
    def identity(self) -> dict[str, str]:
        """The pack, its inputs and level."""
        return {
            "model": "engage",
            "parameters": digest_of(asdict(self.part.params)),
            "inputs": digest_of(dict(self.inputs)),
            "fidelity": self.fidelity,
        }

    def evaluate(
        self,
        rows: Sequence[Row],
        figures: Sequence[str],
        effort: Effort | Sequence[Effort] = "search",
        signals: Sequence[str] = (),
    ) -> Answers:
        """Return figures of rows, each an engagement of its own; codes are statuses.

        Without ``inertia`` the slip runs out evenly over ``duration``, as in ``thrustwasher
        engage``; with it the slip follows the torque, and ``duration`` is the longest time.
        """
        values = np.full((len(rows), len(figures)), np.nan)
        codes = np.zeros(len(rows), np.int32)
        for i, row in enumerate(rows):
            try:
                found = self._one(row, anew=isinstance(rows, Rows))
                values[i] = [found[name] for name in figures]
                codes[i] = heat_status(found["peak_temperature"])
            except ParameterError:
                codes[i] = Status.BAD_INPUT
            except SolveError:
                codes[i] = Status.MAX_ITERATIONS
        return Answers(values, codes)

    def gradient(self, *_: Any) -> None:
        """Return nothing: it is not known."""

    def file(self, row: Row, *, draw: bool = False) -> str:
        """Return the pack's part file, with the command that engages it so in its first line."""
        own = {name: row.get(name, q.nominal) for name, q in PROFILE.items()}
        rest = {name: value for name, value in row.items() if name not in PROFILE}
        params, given = self.part.varied(rest)
        inputs = {**self.inputs, **given}
        box = {name: (x, x) for name, x in inputs.items()}
        part = replace(self.part, parameters=asdict(params), box=box, scatter={})
        sets = " ".join(f"--set {name}={value!r}" for name, value in own.items())
        over = f"--over load={inputs['load']!r}"
        return f"# thrustwasher sweep engage FILE {over} {sets}\n{part_text(part)}"

    def scattered(self, table: Mapping[str, Any] | None = None, row: Row | None = None) -> Scatter:
        """Return how the pack scatters at its values."""
        return self.part.scattered(table, self.inputs)

    def _one(self, row: Row, *, anew: bool) -> dict[str, float]:
        """Return all figures of an engagement; ``anew``: choices ``auto`` as the row has them."""
        profile: dict[str, float] = {n: row.get(n, q.nominal) for n, q in PROFILE.items()}
        rest = {name: value for name, value in row.items() if name not in PROFILE}
        if anew:
            given = {name: value for name, value in rest.items() if name in self.inputs}
            own = {name: value for name, value in rest.items() if name not in given}
            params = replace(self.part.params, **own) if own else self.part.params
        else:
            params, given = self.part.varied(rest)
        at = {**self.inputs, **given}
        if profile["duration"] / profile["step"] > MOST_POINTS:
            raise ParameterError(
                f"step = {profile['step']:g} s, allowed: duration/{MOST_POINTS} or longer"
            )
        if at["speed"] <= 0.0:
            raise ParameterError(f"speed = {at['speed']:g} rad/s, allowed: above 0, slip that ends")
        found = self._followed(params, at, profile) if profile["inertia"] else None
        return found or self._straight(params, at, profile)

    def _followed(
        self, params: Any, at: Mapping[str, float], profile: Mapping[str, float]
    ) -> dict[str, float]:
        """Return figures of an engagement whose slip follows the torque."""
        got = run_out(
            prepare(params, self.fidelity),
            load=at["load"],
            speed=at["speed"],
            inertia=profile["inertia"],
            ramp=profile["ramp"],
            longest=profile["duration"],
            step=profile["step"],
            oil_temperature=at["oil_temperature"],
            drum_speed=at["drum_speed"],
        )
        columns = dict(zip(SPEC.real_outputs, got.rows.T, strict=False))
        ramp = profile["ramp"]
        rise = np.minimum(got.time / ramp, 1.0) if ramp > 0.0 else np.ones_like(got.time)
        load = at["load"] * rise
        faces = face_loads(params.face, load, got.speed, columns["friction_power"])
        return _figures(params, got.time, got.speed, {**columns, **faces})

    def _straight(
        self, params: Any, at: Mapping[str, float], profile: Mapping[str, float]
    ) -> dict[str, float]:
        """Return figures of an engagement whose slip runs out evenly."""
        duration, ramp = profile["duration"], profile["ramp"]
        n = max(round(duration / profile["step"]), 1)
        time = np.linspace(0.0, duration, n + 1)
        if ramp < duration and not (np.abs(time - ramp) < 1e-9 * duration).any():
            time = np.sort(np.append(time, ramp))
        rise = np.minimum(time / ramp, 1.0) if ramp > 0.0 else np.ones_like(time)
        found = engage_clutch(
            params,
            time=time,
            load=at["load"] * rise,
            fidelity=self.fidelity,
            speed=at["speed"] * (1.0 - time / duration),
            oil_temperature=at["oil_temperature"],
            drum_speed=at["drum_speed"],
        )
        names = (*FACE_LOADS, "energy", "temperature", "friction_torque", "film_ratio")
        return _figures(params, time, found.speed, {n: getattr(found, n) for n in names})


def engagement_evaluator(part: PartFile, inputs: Mapping[str, float]) -> EngagementEvaluator:
    """Return engagements of a wet pack as what is evaluated; ``inputs`` [SI] of its model.

    ParameterError: the part is no wet clutch.
    """
    if part.spec.key != SPEC.key:
        raise ParameterError(f"engage: {part.name} is a {part.spec.key}, allowed: a clutch")
    return EngagementEvaluator(
        part=part,
        inputs={**part.starts, **inputs},
        fidelity=level_named(part.spec, part.fidelity),
    )


def _figures(
    params: Any, time: np.ndarray, slip: np.ndarray, columns: Mapping[str, np.ndarray]
) -> dict[str, float]:
    """Return the figures of an engagement from its points."""
    ended = slip[-1] <= 0.0
    energy = float(columns["energy"][-1])
    found = {name: float(np.max(columns[name])) for name in FACE_LOADS}
    return found | {
        "energy": energy,
        "energy_per_area": energy / params.lining_area,
        "peak_temperature": float(np.max(columns["temperature"])),
        "slip_time": float(time[-1]) if ended else np.nan,
        "slip_left": float(max(slip[-1], 0.0)),
        "peak_torque": float(np.max(np.abs(columns["friction_torque"]))),
        "minimum_film_ratio": float(np.min(columns["film_ratio"])),
    }
