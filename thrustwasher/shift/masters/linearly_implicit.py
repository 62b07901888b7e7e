"""Linearly implicit master: the torques that fit the speeds at the end of the step.

As in the sequential master the transmission gets fresh torques T; but first they are corrected to
what they will be at the end of the step, linearized: with D = d(torque)/d(inputs of its part), from
directional derivatives, and S = d(those inputs at the end of the step)/d(torques), from trial steps
that are rolled back,

    dT = D (u_trial - u + S dT)      so that      (I - D S) dT = D (u_trial - u):

one linear solve per step and no iteration. For one torque c w on an inertia J the factor per step
is 1/(1 + H c/J). Where a torque falls with its slip, H c/J < 0, that factor would have a pole at -1
and beyond it damp what grows: there S dT is left out, which stops the series of the factor after
its second term, 1 + x + x^2 with x = H |c|/J.
"""

from typing import NamedTuple

import numpy as np

from ...errors import ParameterError, SolveError
from ...numerics.jit import Array
from ..cosim.schedule import Correct, Schedule, gauss_seidel
from ..cosim.system import Capable, ConnectedPart, System, can, capable
from ..scene.connections import SPEED

NAME = "linearly-implicit"
REFRESH = 20  # steps until S, and torques that do not matter, are looked at again
QUIET = 1e-4  # of H c/J: less does not matter
PROBE = 1e-3  # of a torque: how far it is moved to find S
WIDTH = 1e-6  # of an input's nominal value: half the distance of a difference
LONG = 0.5  # of H |c|/J where friction falls: more is worth a word


def schedule(system: System) -> Schedule:
    """Return the schedule of one communication step."""
    actions = gauss_seidel(system)
    actions.insert(-1, Correct(system.transmission, Correction(system)))
    return actions


class Wire(NamedTuple):
    """A torque on its way from a friction part to the transmission."""

    slot: int  # which input of the transmission
    part: ConnectedPart
    output: int
    places: list[tuple[int, int]]  # (input of the part, output of the transmission it comes from)
    speed: int | None  # which of ``places`` is the slip, if the torque has its sign


class Correction:
    """Corrects the torques that the transmission is about to step with."""

    def __init__(self, system: System) -> None:
        self.hub = hub = system.transmission
        self.wires = [
            _wire(slot, part, output)
            for slot, part, output in hub.sources
            if hub.input_names[slot] not in system.carries_on
        ]
        kinds = [signal.kind for signal in hub.spec.outputs]
        self._whole = [i for i, kind in enumerate(kinds) if kind in ("integer", "boolean")]
        self._probed: tuple[float, list[float]] | None = None  # for which step and modes
        self._age = REFRESH
        self._reach: Array = np.zeros((0, 0))  # d(outputs of the transmission)/d(torques)
        self._gains = [1.0] * len(self.wires)  # H c/J at the last look
        self.worst: dict[str, float] = {}
        self.by_differences: set[str] = set()
        self.without: dict[str, int] = {}

    def __call__(self, t: float, h: float) -> None:
        """Change the transmission's present inputs for the step from ``t`` to ``t + h``."""
        if not self.wires:
            return
        ahead = self._look_ahead(t, h)
        n = len(self.wires)
        matrix, rise = np.eye(n), np.zeros(n)
        for i, wire in enumerate(self.wires):
            now = np.array([wire.part.inputs[k] for k, _ in wire.places])
            then = np.array([ahead[k] for _, k in wire.places])
            if self._age and abs(self._gains[i]) < QUIET and not _turns(wire, now, then):
                continue
            reach = self._reach[[k for _, k in wire.places]]
            slopes = self._slopes(wire, now, then, reach)
            gain = self._gains[i] = -float(slopes @ reach[:, i])
            rise[i] = slopes @ (then - now)
            if gain >= 0.0:
                matrix[i] -= slopes @ reach
            else:
                self.worst[wire.part.name] = min(self.worst.get(wire.part.name, 0.0), gain)
        self._age += 1
        try:
            change = np.linalg.solve(matrix, rise)
        except np.linalg.LinAlgError:
            change = np.full(n, np.nan)
        if not np.isfinite(change).all():
            raise SolveError(
                f"{self.hub.name} at t = {t:g} s: the corrected torques of master {NAME!r} cannot "
                "be solved for; take a shorter step or master 'gauss-seidel'"
            )
        for wire, more in zip(self.wires, change.tolist(), strict=True):
            self.hub.inputs[wire.slot] += more

    def words(self) -> list[str]:
        """Say what a reader has to know of the corrections of a run."""
        messages = [
            f"{name}: no directional derivatives here (native FMUs have them); {NAME} took "
            "differences of its outputs"
            for name in sorted(self.by_differences)
        ]
        messages += [
            f"{name}: no derivative in {n} steps; there its torque was passed on as it came"
            for name, n in self.without.items()
        ]
        return messages + [
            f"{name}: friction falls with slip, H c/J down to {gain:.2g}: the driveline itself is "
            "unstable there and the step is long compared with its growth; nothing was damped"
            for name, gain in self.worst.items()
            if gain < -LONG
        ]

    def _look_ahead(self, t: float, h: float) -> list[float]:
        """Return the outputs that a step with the present torques would end with; renew S."""
        hub = self.hub
        instance = _with_state(hub)
        inputs, outputs, start = list(hub.inputs), hub.outputs, instance.get_state()
        try:
            hub.step(t, h)
            ahead = hub.outputs
            now = h, [ahead[k] for k in self._whole]
            if now != self._probed or self._age >= REFRESH:
                self._probed, self._age = now, 0
                columns = []
                for wire in self.wires:
                    instance.set_state(start)
                    columns.append(self._moved(wire, t, h, inputs, ahead))
                self._reach = np.array(columns).T
            return ahead
        finally:
            instance.set_state(start)
            instance.free_state(start)
            hub.inputs, hub.outputs = inputs, outputs

    def _moved(
        self, wire: Wire, t: float, h: float, inputs: list[float], ahead: list[float]
    ) -> Array:
        """Return how the outputs at the step's end change with one torque."""
        hub, torque = self.hub, inputs[wire.slot]
        size = max(abs(torque), hub.spec.inputs[wire.slot].nominal or 1.0)
        apart = PROBE * (size if torque >= 0.0 else -size)
        hub.inputs = list(inputs)
        hub.inputs[wire.slot] += apart
        hub.step(t, h)
        moved: Array = (np.array(hub.outputs) - np.array(ahead)) / apart
        return moved

    def _slopes(self, wire: Wire, now: Array, then: Array, reach: Array) -> Array:
        """Return d(torque)/d(each input of its part) for those inputs that move."""
        part, found = wire.part, np.zeros(len(now))
        name = part.output_names[wire.output]
        try:
            for j in np.flatnonzero((then != now) | reach.any(axis=1)).tolist():
                found[j] = slope(part, name, part.input_names[wire.places[j][0]])
        except SolveError:
            self.without[part.name] = self.without.get(part.name, 0) + 1
            return np.zeros(len(now))
        if not can(part.instance, "gives_derivatives"):
            self.by_differences.add(part.name)
        slip, torque = wire.speed, part.outputs[wire.output]
        if slip is not None and _turns(wire, now, then) and torque * now[slip] > 0.0:
            # The chord to zero slip, of which a tangent out on the saturated branch knows nothing.
            found[slip] = max(found[slip], torque / now[slip])
        return found


def _turns(wire: Wire, now: Array, then: Array) -> bool:
    """Tell if the slip would pass through zero."""
    return wire.speed is not None and bool(now[wire.speed] * then[wire.speed] < 0.0)


def _wire(slot: int, part: ConnectedPart, output: int) -> Wire:
    places = [(k, o) for k, _, o in part.sources]
    names = [part.input_names[k] for k, _ in places]
    signed = part.spec.outputs[output].low is None and SPEED in names
    return Wire(slot, part, output, places, names.index(SPEED) if signed else None)


def _with_state(part: ConnectedPart) -> Capable:
    """Return a part's instance as one that saves its state; ParameterError if it cannot."""
    if not can(part.instance, "saves_state"):
        raise ParameterError(
            f"master = {NAME!r}: {part.name} cannot save its state, allowed: with parts that can "
            "(canGetAndSetFMUstate); 'gauss-seidel' and 'jacobi' need no state"
        )
    return capable(part.instance)


def slope(part: ConnectedPart, output: str, given: str) -> float:
    """Return d(output)/d(input) at the part's present inputs, memory held.

    From the instance's directional derivatives or, where it has none but can save its state, from
    a central difference after which it is where it was. SolveError if there is no derivative here,
    ParameterError if the instance can do neither.
    """
    if can(part.instance, "gives_derivatives"):
        return capable(part.instance).directional_derivative([output], [given], [1.0])[0]
    if not can(part.instance, "saves_state"):
        raise ParameterError(
            f"master = {NAME!r}: {part.name} has neither directional derivatives nor a "
            "state that can be saved, allowed: with parts that have one of them, such as the "
            "native FMUs"
        )
    instance, k = part.instance, part.input_names.index(given)
    place, signal = part.output_names.index(output), part.spec.inputs[k]
    width = WIDTH * (signal.nominal or 1.0)
    ends = part.inputs[k] - width, part.inputs[k] + width
    if signal.low is not None and ends[0] < signal.low:
        return 0.0  # at its limit, where models have corners: an open pack, a wheel at rest
    keeper = _with_state(part)
    state = keeper.get_state()
    try:
        found = []
        for value in ends:
            instance.set_inputs([*part.inputs[:k], value, *part.inputs[k + 1 :]])
            found.append(instance.outputs()[place])
    except ParameterError as problem:  # a limit of the part's inputs
        raise SolveError(str(problem)) from problem
    finally:
        keeper.set_state(state)
        keeper.free_state(state)
    return (found[1] - found[0]) / (ends[1] - ends[0])
