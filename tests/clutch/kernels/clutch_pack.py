"""A wet pack on the kernels themselves, with its arrays."""

import numpy as np

from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.step import step
from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.clutch.solve import prepare


def plain(**changes):
    """A full-size pack without grooves in the paper's law of friction, its gaps always full."""
    size = {"inner_radius": 0.064, "outer_radius": 0.085, "faces": 8}
    return ClutchParams.preset("paper", **size | changes)


class Pack:
    """A pack of one rung; ``work`` starts as NaN, since it may hold anything."""

    def __init__(self, fidelity="field", made=plain, **params):
        self.params = made(**params)
        self.par = prepare(self.params, fidelity)
        self.state, self.work = np.zeros(k.NSTATE), np.full(k.NWORK, np.nan)
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)

    def step(self, load, speed, dt, oil=297.15, drum=0.0):
        inp = np.array([load, speed, oil, drum])
        return step(self.par, inp, self.state, self.work, self.out, self.iout, 0.0, dt)
