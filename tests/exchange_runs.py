"""A model's functions for model exchange, called from Python by the names of its variables."""

import numpy as np
from scipy.integrate import solve_ivp

from thrustwasher.model.prepare import filled
from thrustwasher.model.registry import exchange_kernel_of, kernel_of


class Kernels:
    """Arrays of one instance; methods fill them."""

    def __init__(self, spec, fidelity=None, own=None, **parameters):
        self.spec, self.k, self.step = spec, exchange_kernel_of(spec), kernel_of(spec)
        k, made = self.k, spec.params(**parameters)
        level = fidelity or spec.default_fidelity
        self.par = filled(spec, made, level, k.NPAR, self.step.derive)
        self.own = np.array(
            [{**(own or {})}.get(s.name, s.start) for s in spec.exchange.parameters]
        )
        self.inp = np.array([s.in_fmus for s in spec.inputs])
        self.cont, self.der = np.zeros(k.NCONT), np.zeros(k.NCONT)
        self.discrete, self.work, self.sign = (
            np.zeros(k.NMODE),
            np.zeros(k.NWORK),
            np.zeros(k.NSIGN),
        )
        self.outputs, self.iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)

    def _given(self):
        return self.par, self.own, self.inp, self.cont, self.discrete, self.work

    def put(self, **inputs):
        names = [s.name for s in self.spec.inputs]
        for name, value in inputs.items():
            self.inp[names.index(name)] = value

    def start(self, t=0.0, **inputs):
        self.put(**inputs)
        assert self.k.start(*self._given(), t) == 0
        assert self.update(t) == 0

    def rates(self):
        return self.k.rates(*self._given(), self.outputs, self.der, self.sign)

    def update(self, t):
        return self.k.update(*self._given(), self.outputs, self.iout, t)

    def slopes(self, along):
        found = np.zeros(self.k.NOUT + self.k.NCONT)
        assert self.k.slopes(*self._given(), np.array(along, float), found) == 0
        return found

    def out(self, name):
        return float(self.outputs[self.spec.real_outputs.index(name)])

    def stepped(self, dt=0.0):
        """Return the outputs of co-simulation at these inputs."""
        k = self.step
        state, work, out = np.zeros(k.NSTATE), np.zeros(k.NWORK), np.zeros(k.NOUT)
        inp, iout = np.zeros(k.NINP + getattr(k, "NRATES", 0)), np.zeros(k.NIOUT, np.int32)
        inp[: k.NINP] = self.inp
        assert k.step(self.par, inp, state, work, out, iout, 0.0, dt) == 0
        return {
            **dict(zip(self.spec.real_outputs, out.tolist(), strict=True)),
            "iout": iout.tolist(),
        }

    def solved(self, rates, start, end, **more):
        given = {"method": "LSODA", "rtol": 1e-8, "atol": 1e-12, **more}
        run = solve_ivp(rates, (0.0, end), start, **given)
        assert run.success, run.message
        return run
