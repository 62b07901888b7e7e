"""Derivatives of a step's outputs by differences, for comparison with those it gives itself."""

import numpy as np

STEPS = (1e-3, 1e-4, 1e-5)  # of the inputs' scales
EPS = np.finfo(float).eps


class Unit:
    """A kernel with its arrays; calls at dt = 0."""

    def __init__(self, kernel, par, state=None):
        self.k, self.par = kernel, par
        self.state = np.zeros(kernel.NSTATE) if state is None else state
        self.work = np.zeros(kernel.NWORK)
        self.out, self.iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)

    def step(self, inp, t=0.0, dt=0.0):
        arrays = (self.par, np.asarray(inp, float), self.state, self.work, self.out, self.iout)
        status = self.k.step(*arrays, t, dt)
        assert status == 0, (status, list(inp))
        return self.out.copy()

    def sens(self, inp, seed):
        """Return the directional derivative; `step` must have been called with ``inp``."""
        dout = np.full(self.k.NOUT, np.nan)
        arrays = (self.par, np.asarray(inp, float), self.state, self.work)
        status = self.k.sens(*arrays, np.asarray(seed, float), dout)
        assert status == 0, (status, list(inp))
        return dout

    def gradient(self, inp):
        """Return d out/d inp, a column per input."""
        self.step(inp)
        return np.stack([self.sens(inp, row) for row in np.eye(self.k.NINP)], axis=1)


def differences(unit, inp, scale, h):
    """Return d out/d inp x scale by central differences with one Richardson extrapolation."""
    columns = []
    for i, s in enumerate(scale):
        away = np.zeros(len(inp))
        away[i] = h * s
        wide = unit.step(inp + away) - unit.step(inp - away)
        near = unit.step(inp + 0.5 * away) - unit.step(inp - 0.5 * away)
        columns.append((8.0 * near - wide) / (6.0 * h))
    return np.stack(columns, axis=1)


def disagreement(unit, inp, scale):
    """Return the worst difference between the two derivatives, relative to each output's change.

    An output changes by its rounding even where it does not depend on the inputs; that much is
    taken off. Of the steps tried the best one counts for each number: a wrong derivative fits none.
    """
    inp, scale = np.asarray(inp, float), np.asarray(scale, float)
    found = unit.gradient(inp) * scale
    size = np.abs(unit.step(inp))[:, None]
    best = np.full(found.shape, np.inf)
    for h in STEPS:
        wanted = differences(unit, inp, scale, h)
        change = np.maximum(np.abs(wanted), np.abs(found)).max(axis=1, keepdims=True)
        wrong = np.maximum(np.abs(found - wanted) - 50.0 * EPS * size / h, 0.0)
        best = np.minimum(best, wrong / np.maximum(change, 1e-300))
    return best
