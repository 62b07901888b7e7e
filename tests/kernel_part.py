"""A model's kernel with its arrays, called by hand."""

import numpy as np

from thrustwasher.model.prepare import fill_table, filled
from thrustwasher.model.registry import find_spec, kernel_of


class Part:
    """A part at a level, from nothing; ``work`` starts as NaN, since it may hold anything."""

    def __init__(self, model, level, params=None, **changes):
        self.spec = find_spec(model)
        self.k = k = kernel_of(self.spec)
        self.params = params or self.spec.params(**changes)
        self.par = filled(self.spec, self.params, level, k.NPAR, k.derive).copy()
        self.state, self.work = np.zeros(k.NSTATE), np.full(k.NWORK, np.nan)
        fill_table(self.spec, self.params, self.par, self.work)
        self.out, self.iout = np.full(k.NOUT, np.nan), np.full(k.NIOUT, -7, np.int32)
        self.reals = [s.name for s in self.spec.outputs if s.kind == "real"]
        self.others = [s.name for s in self.spec.outputs if s.kind != "real"]
        self.time = 0.0

    def step(self, inputs, dt=0.0):
        """Step on or, without time, look; inputs left out are 0. Return the status."""
        inp = np.zeros(self.k.NINP)
        inp[: len(inputs)] = inputs
        arrays = (self.par, inp, self.state, self.work, self.out, self.iout)
        status = self.k.step(*arrays, self.time, dt)
        self.time += dt if status == 0 else 0.0
        return status

    def __getitem__(self, name):
        if name in self.reals:
            return float(self.out[self.reals.index(name)])
        return float(self.iout[self.others.index(name)])
