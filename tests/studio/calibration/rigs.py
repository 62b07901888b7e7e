"""A pack that is worn, and recordings of its engagements."""

import numpy as np

from thrustwasher import ClutchParams, engage_clutch
from thrustwasher.studio.calibration.engagement import pack_history

OIL = 353.15  # K
PACK = ClutchParams()
TRUTH = {"friction_scale": 0.92, "permeability": 3e-13}
WORN = ClutchParams(**TRUTH)


def history(n=301, ends=0.6):
    """Return a ramp of the load and a slip that runs out."""
    time = np.linspace(0.0, ends, n)
    load = 5000.0 * np.clip((time - 0.05) / 0.1, 0.0, 1.0)
    return {"time": time, "load": load, "speed": 300.0 * (1.0 - time / ends)}


def recorded(pack=WORN, noise=1.5, seed=1, way=None):
    """Return a recording of a pack's torque, with noise [N m]."""
    way = way or history()
    made = engage_clutch(pack, **way, oil_temperature=OIL).friction_torque
    scatter = noise * np.random.default_rng(seed).standard_normal(len(made))
    return {**way, "oil_temperature": OIL, "friction_torque": made + scatter}


def advances_by(monkeypatch, other):
    """Let fits step a pack by ``other(advance)``, where ``advance`` is the kernel's step."""
    bound, advance = pack_history.bound, pack_history.clutch_advance.advance

    def taken(kernel, **arrays):
        made = bound(kernel, **arrays)
        return other(made) if kernel is advance else made

    monkeypatch.setattr(pack_history, "bound", taken)
