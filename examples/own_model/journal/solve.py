"""One operating point."""

from dataclasses import dataclass

import numpy as np
from journal.kernels import step as k
from journal.parameters import SPEC, JournalParams

from thrustwasher.errors import SolveError, Status
from thrustwasher.model.advice import warnings_of
from thrustwasher.model.parameters import check_number
from thrustwasher.model.prepare import filled


@dataclass(frozen=True, slots=True)
class JournalResult:
    """Results in SI units."""

    friction_torque: float
    temperature: float
    film_thickness: float
    status: Status
    fidelity: str
    warnings: tuple[str, ...] = ()


def solve_journal(
    params: JournalParams,
    *,
    load: float,
    speed: float,
    oil_temperature: float = 313.15,
    fidelity: str = "closed",
    throw: bool = True,
) -> JournalResult:
    """Return friction and film of a journal bearing."""
    given = (load, speed, oil_temperature)
    point = np.array(
        [
            check_number(s.name, value, s.unit, s.low, s.high)
            for s, value in zip(SPEC.inputs, given, strict=True)
        ]
    )
    par = filled(SPEC, params, fidelity, k.NPAR, k.derive)
    out, flags = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)
    k.step(par, point, np.zeros(k.NSTATE), np.zeros(k.NWORK), out, flags, 0.0, 0.0)
    status = Status(flags[-1])
    if status.is_failure and throw:
        raise SolveError(f"load = {load:g} N, speed = {speed:g} rad/s: {status.advice}")
    inputs = dict(zip([s.name for s in SPEC.inputs], given, strict=True))
    outputs = dict(zip(SPEC.real_outputs, out.tolist(), strict=True))
    return JournalResult(
        *out.tolist(), status, fidelity, warnings_of(SPEC, status, inputs, outputs)
    )
