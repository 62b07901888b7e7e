"""What is simulated: the parts of a shift with their parameters, times, oil and master."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import pairwise
from typing import Any

from ...errors import ParameterError, within
from ...ladder.choose import level_and_tolerance
from ...model.levels import level_named
from ...model.prepare import check_together
from ...model.spec import ModelSpec
from ...model.toml_tables import number
from ...model.unread import unread
from ...transmission.bearings import BEARINGS
from ...transmission.parameters import profile_points
from ...transmission.vehicle import Vehicle
from ...units import format_quantity
from ..masters.master import FIXED_STEPS, MASTERS

MAX_STEPS = 500_000  # all signals of so many steps still fit into memory
STEP_RANGE = (1e-6, 1.0)  # s
STEPS_OF_A_SHIFT = 20.0  # at least
PRESSED = 0.9  # of the maximum pressure: below it a pack that lets go is meant to


@dataclass(frozen=True, kw_only=True)
class Part:
    """One part of a scene: its model, fidelity and parameters."""

    spec: ModelSpec
    fidelity: str
    params: Any
    tolerance: float | None = None
    """Requested with fidelity "auto": the level is still to be chosen; None: it is as it stands."""
    labels: dict[str, Any] = field(default_factory=dict, compare=False)
    """Name, notes and box of its part file, as packages show them."""
    scatter: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """What scatters by its part file or preset: a law by the parameter's name."""
    usual: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """Parameters that the scene and its oil give it, which nobody gave for this part."""
    asked: str = field(default="", compare=False)
    """Name by which the level was requested; it may be that of one that is gone."""
    start: float = 0.0
    """When the scene starts [s]; its times, those in ``params`` too, are those of one clock."""

    def parameters(self) -> dict[str, Any]:
        """Return all parameters by name, the fidelity among them, as an FMU takes them.

        There times count from the start of the run.
        """
        values = {f.name: getattr(self.params, f.name) for f in fields(self.params)}
        if self.start:
            for f in fields(self.params):
                if "instant" in f.metadata and not unread(self.params, f.name, self.fidelity):
                    values[f.name] -= self.start
        return {**values, "fidelity": self.fidelity}

    def at(self, level: str) -> "Part":
        """Return the part with a level that stands."""
        return replace(self, fidelity=level, tolerance=None, asked="")

    def asked_for(self, where: str, text: object) -> "Part":
        """Return the part at the level that a text asks for: "field", "auto" or "auto:0.01"."""
        asked, tolerance = level_and_tolerance(where, self.spec, text)
        level = level_named(self.spec, asked)
        return replace(self, fidelity=level, tolerance=tolerance, asked=asked)


@dataclass(frozen=True, kw_only=True)
class Published:
    """What a source says about a run of this scene: key figures in SI units, by name."""

    source: str
    figures: dict[str, float]


@dataclass(frozen=True, kw_only=True)
class ShiftSequence:
    """Shifts up and down, each with its window of fine steps; times in s.

    Long steps lie between the windows. ``profiles``: of pressures and engine torque by direction,
    as parameters of the transmission, from the shift's own time on.
    """

    shifts: tuple[tuple[float, str], ...]
    window: float
    pause_step: float
    ramp: dict[str, float]
    profiles: dict[str, dict[str, Any]]


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A shift to be simulated; times in s, temperature in K.

    The shift command goes from ``shift_from`` to ``shift_to``: 0 presses the brake, 1 the clutch.
    """

    name: str
    title: str
    description: str
    start_time: float
    stop_time: float
    step: float
    master: str
    oil_temperature: float
    shift_start: float
    shift_duration: float
    shift_from: float = 0.0
    shift_to: float = 1.0
    parts: dict[str, Part]
    published: Published | None = None
    vehicle: Vehicle | None = None
    notes: tuple[str, ...] = ()
    """What a reader of a run has to know of its making."""
    warnings: tuple[str, ...] = ()
    """What is doubtful in the scene itself, one line each."""
    sequence: ShiftSequence | None = None
    """Several shifts in one run; None: the one that the scene's own ramp or profiles make."""
    scatter: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """What is known within bounds only: a law by the path of its value, as the file gives it."""
    source: str = field(default="", compare=False)
    """Name of a built-in scene, or the path of the file."""
    table: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The tables of the file and its bases, merged."""

    def __repr__(self) -> str:
        """Return name, title, times and parts in a few lines."""
        parts = ", ".join(f"{name} ({part.fidelity})" for name, part in self.parts.items())
        times = f"{self.start_time:g} .. {self.stop_time:g} s, step {self.step:g} s"
        oil = f"oil {format_quantity(self.oil_temperature, 'K')}"
        return f"Scene: {self.name}, {self.title}\n  {times}, {oil}\n  {parts}"

    def command(self, time: float) -> float:
        """Return the shift command: a ramp between two values."""
        if time <= self.shift_start:
            return self.shift_from
        if time >= self.shift_start + self.shift_duration:
            return self.shift_to
        done = (time - self.shift_start) / self.shift_duration
        return self.shift_from + (self.shift_to - self.shift_from) * done

    @property
    def engaging(self) -> str:
        """The pack that the ramp presses."""
        return "clutch" if self.shift_to >= self.shift_from else "brake"

    @property
    def releasing(self) -> str:
        """The pack that the ramp lets go."""
        return "brake" if self.engaging == "clutch" else "clutch"

    @property
    def longest_step(self) -> float:
        """The longest communication step [s] that makes sense: a twentieth of the shift.

        Where no pack hands over to the other, and where the command jumps, how long it takes is
        known after the run only: there the time from the command's start to the end of the run
        counts.
        """
        gearbox, lasts = self.parts["transmission"].params, self.shift_duration
        hands_over = gearbox.actuation == "pressure" or (
            gearbox.clutch_force > 0.0 and gearbox.brake_force > 0.0
        )
        if not (hands_over and lasts > 0.0):
            lasts = self.stop_time - max(self.shift_start, self.start_time)
            lasts = lasts if lasts > 0.0 else self.stop_time - self.start_time
        return lasts / STEPS_OF_A_SHIFT

    def check_step(self) -> None:
        """Raise ParameterError if the step is too long for the shift."""
        longest = self.longest_step
        if self.step > longest * (1.0 + 1e-9):
            raise ParameterError(
                f"scene {self.name!r}: step = {format_quantity(self.step, 's', digits=4)}, allowed "
                f"here: up to {format_quantity(longest, 's', digits=4)}, a twentieth of the shift"
            )

    @property
    def alone(self) -> bool:
        """True if the engaging pack is all that acts: no engine, no load, no other pack."""
        gearbox = self.parts["transmission"].params
        other = getattr(gearbox, f"{self.releasing}_force")
        if gearbox.actuation == "pressure" or gearbox.engine_torque_points:
            return False
        return not (gearbox.engine_torque or gearbox.load_torque or other)

    @property
    def bearings(self) -> dict[str, bool]:
        """Whether there is a thrust bearing of the sun and of the ring, by its name."""
        gearbox = self.parts["transmission"].params
        return {name: getattr(gearbox, f"{name}_coefficient") > 0.0 for name in BEARINGS}

    @property
    def kiss_end(self) -> float | None:
        """Where the engaging pack's pressure leaves the kiss point [s]; None without pistons.

        It is the last point before the pressure rises for good to what closes the pack: the first
        one above the return spring, or the last of those at falling or equal pressure behind it.
        """
        gearbox = self.parts["transmission"].params
        points = profile_points(gearbox, f"{self.engaging}_pressure")
        spring = getattr(gearbox, f"{self.engaging}_return_spring")
        above = [i for i, (t, p) in enumerate(points) if t >= self.shift_start and p > spring]
        if gearbox.actuation != "pressure" or not above:
            return None
        i = above[0]
        while i + 1 < len(points) and points[i + 1][1] <= points[i][1]:
            i += 1
        return points[i][0]

    @property
    def required_until(self) -> float:
        """The time [s] up to which the engaging pack is meant to hold: its pressure falls then."""
        gearbox = self.parts["transmission"].params
        points = profile_points(gearbox, f"{self.engaging}_pressure")
        if gearbox.actuation == "pressure" and points:
            enough = PRESSED * max(p for _, p in points)
            if points[-1][1] < enough:
                return min(max(t for t, p in points if p >= enough), self.stop_time)
        return self.stop_time

    def with_options(
        self,
        *,
        step: float | None = None,
        master: str | None = None,
        stop_time: float | None = None,
    ) -> "Scene":
        """Return the scene with another step, master or end; what hangs on them is adapted."""
        given: dict[str, Any] = {"step": step, "master": master, "stop_time": stop_time}
        return replace(self, **{k: x for k, x in given.items() if x is not None}).checked()

    def checked(self) -> "Scene":
        """Check what concerns several values; hand oil and master on to the parts."""
        where = f"scene {self.name!r}"
        if self.master not in MASTERS:
            options = " or ".join(repr(n) for n in MASTERS)
            gone = f"; {FIXED_STEPS}" if self.master == "step-doubling" else ""
            raise ParameterError(f"{where}: master = {self.master!r}, allowed: {options}{gone}")
        number(where, "step", self.step, ("s", *STEP_RANGE))
        span = self.stop_time - self.start_time
        if not self.step <= span <= MAX_STEPS * self.step and not self.sequence:
            raise ParameterError(
                f"{where}: stop_time = {self.stop_time!r} s, allowed: start_time + 1 .. "
                f"{MAX_STEPS} steps of {self.step!r} s (start_time = {self.start_time!r} s)"
            )
        if not self.sequence:
            self.check_step()
        for name, part in self.parts.items():
            with within(f"{where} [{name}]"):
                check_together(part.spec, part.params, part.fidelity)
        gearbox = self.parts["transmission"]
        params = _with(
            gearbox.params,
            oil_temperature=self.oil_temperature,
            torque_age=MASTERS[self.master].torque_age,
            ring_mesh="ring_mesh" in self.parts,
        )
        parts = {
            **self.parts,
            "transmission": replace(gearbox, params=params, start=self.start_time),
        }
        # The transmission looks ahead by itself: packs that say where they are now couple to it
        # with second order.
        # Stick and slip are decided in it alone.
        for name, part in parts.items():
            if hasattr(part.params, "input_profile"):
                parts[name] = replace(part, params=_with(part.params, input_profile="linear"))
            if hasattr(part.params, "holding"):
                held = parts[name]
                parts[name] = replace(held, params=_with(held.params, holding="off"))
        return replace(self, parts=parts)


def _with(params: Any, **values: object) -> Any:
    """Return parameters with these values; what does not change is not checked again."""
    new = {name: value for name, value in values.items() if getattr(params, name) != value}
    return replace(params, **new) if new else params


def shift_of_pressures(gearbox: object) -> dict[str, Any]:
    """Return the shift that profiles of pressure make, as fields of a scene.

    The pack whose pressure ends higher than it began engages; the shift begins where its pressure
    first rises and ends with its last point.
    """
    rise = {}
    for pack in ("clutch", "brake"):
        points = profile_points(gearbox, f"{pack}_pressure") or [(0.0, 0.0)]
        rise[pack] = points[-1][1] - points[0][1]
    engaging = max(rise, key=lambda pack: rise[pack])
    points = profile_points(gearbox, f"{engaging}_pressure") or [(0.0, 0.0)]
    begin = next((a[0] for a, b in pairwise(points) if b[1] > a[1]), points[0][0])
    ends = (0.0, 1.0) if engaging == "clutch" else (1.0, 0.0)
    return {
        "shift_start": begin,
        "shift_duration": points[-1][0] - begin,
        "shift_from": ends[0],
        "shift_to": ends[1],
    }


def with_fidelities(scene: Scene, choices: Sequence[str]) -> Scene:
    """Return the scene with other levels: "field" for all parts, "washer=map" for one.

    Later choices overrule earlier ones; parts with one level keep it.
    """
    parts = dict(scene.parts)
    for asked in choices:
        name, given, text = asked.partition("=")
        if not given:
            text, names = name, [n for n, p in parts.items() if len(p.spec.fidelities) > 1]
        elif name in parts:
            names = [name]
        else:
            raise ParameterError(
                f"fidelity = {asked!r}: there is no part {name!r} here, allowed: {', '.join(parts)}"
            )
        for n in names:
            parts[n] = parts[n].asked_for(f"part {n!r}", text)
    return replace(scene, parts=parts).checked()
