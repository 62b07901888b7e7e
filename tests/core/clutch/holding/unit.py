"""The product's pack as a unit of the drivelines: its kernel, with loads and torques to scale."""

from dataclasses import replace

import numpy as np

from thrustwasher.clutch.kernels import layout as L
from thrustwasher.clutch.kernels import step as kernel
from thrustwasher.clutch.parameters import SPEC, ClutchParams
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.native.load import bound

# Its capacity is proportional to the load.
PACK = ClutchParams(friction_law="constant", friction_temperature_slope=0.0)
USUAL = (1e3, 5e5)  # N: loads that a case is brought into


class Unit:
    """Steps the kernel; ``scale``: torques of the driveline over those of the pack.

    ``known``: inertia and delay, given; None: it finds them.
    """

    def __init__(self, case, known=None, params=PACK, fidelity="stribeck", **changes):
        top = max(case.loads) if hasattr(case, "loads") else 2e4
        own = PACK.faces * PACK.friction_radius * PACK.constant_friction
        self.per_load = case.gain / own
        wanted = top * self.per_load
        self.scale = wanted / min(max(wanted, USUAL[0]), USUAL[1])
        if known:
            inertia, age = known
            changes |= {"holding": "given", "coupling_inertia": float(inertia) / self.scale}
            changes |= {"coupling_age": int(age)}
        made = replace(params, **changes)
        self.par, numbers = np.zeros(L.NPAR), as_numbers(made)
        self.par[: len(numbers) + 1] = [*numbers, list(SPEC.fidelities).index(fidelity) + 1]
        assert kernel.derive(self.par) == Status.OK
        self.inp = np.zeros(2 * L.NINP)
        self.inp[L.I_OIL] = 363.15
        self.state, self.work = np.zeros(L.NSTATE), np.zeros(L.NWORK)
        self.out, self.iout = np.zeros(L.NOUT), np.zeros(L.NIOUT, np.int32)
        arrays = {"par": self.par, "inp": self.inp, "state": self.state, "work": self.work}
        self._step = bound(kernel.step, **arrays, out=self.out, iout=self.iout)
        self.time, self.warned, self.told = 0.0, False, set()

    def step(self, slip, h, load):
        """Return the torque [N m] to apply."""
        self.inp[L.I_LOAD] = load * self.per_load / self.scale
        self.inp[L.I_SPEED] = slip
        assert self._step(self.time, h) == Status.OK
        self.time += h
        self.told.add(self.status)
        self.warned |= self.iout[L.IO_STATUS] == Status.CHATTER
        return self.scale * float(self.out[L.O_TORQUE])

    @property
    def capacity(self):
        return self.scale * float(self.out[L.O_CAPACITY])

    @property
    def energy(self):
        return self.scale * float(self.out[L.O_ENERGY])

    @property
    def locked(self):
        return bool(self.iout[L.IO_LOCKED])

    @property
    def inertia(self):
        return self.scale * float(self.out[L.O_PLANT_INERTIA])

    @property
    def bound(self):
        return float(self.out[L.O_SLIP_BOUND])

    @property
    def status(self):
        return Status(self.iout[L.IO_STATUS])

    @property
    def age(self):
        return int(self.iout[L.IO_PLANT_AGE])
