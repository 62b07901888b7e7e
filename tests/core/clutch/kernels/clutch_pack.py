"""A wet pack on the kernels themselves, with its arrays."""

from kernel_part import Part

from thrustwasher.clutch.parameters import ClutchParams


def plain(**changes):
    """A full-size pack without grooves in the paper's law of friction, its gaps always full."""
    size = {"inner_radius": 0.064, "outer_radius": 0.085, "faces": 8}
    return ClutchParams.preset("paper", **size | changes)


class Pack(Part):
    def __init__(self, fidelity="field", made=plain, **params):
        super().__init__("clutch", fidelity, made(**params))

    def step(self, load, speed, dt, oil=297.15, drum=0.0):
        return super().step((load, speed, oil, drum), dt)
