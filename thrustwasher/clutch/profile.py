"""A pack along given profiles of load and slip, by its kernels."""

from typing import Any

import numpy as np

from ..errors import SolveError, Status
from ..native.load import bound
from ..numerics.jit import Array
from .kernels import advance as clutch_advance
from .kernels import layout as k
from .kernels import pack_outputs, rates


def outputs_over(
    par: Any, time: Array, load: Array, slip: Array, oil: float, drum: Array
) -> tuple[Array, int]:
    """Return the real outputs of a pack at the points in time, (n, NOUT), and all substeps.

    ``par`` is that of the kernel, the rest as in ``engage_clutch``; SolveError too.
    """
    work, out, rows = np.zeros(k.NWORK), np.zeros(k.NOUT), np.empty((len(time), k.NOUT))
    substeps, to_oil, faces = 0, 0.0, par[k.P_FACES]  # to_oil: heat that reached the oil [J]
    status = clutch_advance.load_memory(par, load[0], oil, np.zeros(k.NSTATE), work)
    if status == Status.OK and not rates.moves_film(par):
        work[k.W_NOW + k.Y_FILM] = 1.0
        status = clutch_advance.settle_film(par, load[0], work)
    advance = bound(clutch_advance.advance, par=par, work=work)
    fill_outputs = bound(pack_outputs.fill_outputs, par=par, work=work, out=out)
    mean_surface = bound(pack_outputs.mean_surface, par=par, work=work)
    stored_heat = bound(pack_outputs.stored_heat, par=par, work=work)
    for i, (now, force, speed, turns) in enumerate(zip(time, load, slip, drum, strict=True)):
        if i and status == Status.OK:
            ends = (load[i - 1], slip[i - 1], oil, force, speed, oil, drum[i - 1], turns)
            power, proposed = out[k.O_POWER] / faces, work[k.W_PROPOSED]
            status = advance(ends, now - time[i - 1], power, proposed)
            substeps += int(work[k.W_SUBSTEPS])
        if Status(status).is_failure:
            raise SolveError(
                f"t = {now:g} s, load = {force:g} N, speed = {speed:g} rad/s: "
                f"{Status(status).advice}"
            )
        fill_outputs(force, speed, turns)
        out[k.O_TEMPERATURE], _ = mean_surface()
        out[k.O_ENERGY] = faces * work[k.W_NOW + k.Y_ENERGY]
        out[k.O_STORED_HEAT] = stored_heat(oil)
        before, to_oil = to_oil, out[k.O_ENERGY] - out[k.O_STORED_HEAT]
        out[k.O_OIL_ENERGY] = to_oil
        out[k.O_OIL_HEAT] = (to_oil - before) / (now - time[i - 1]) if i else 0.0
        rows[i] = out
    return rows, substeps
