"""Trains that tests share."""

from thrustwasher.train.parameters import TrainParams

SHAFTS = range(1, 5)


def no_losses_of_shafts(**changes):
    """A train that loses in its teeth alone, so that torques of shafts are known by hand.

    On ball bearings: none induces an axial force.
    """
    dry = {"mesh_2_gear_immersion": 0.0}
    for i in SHAFTS:
        dry |= {f"shaft_{i}_seals": 0, f"shaft_{i}_axial": "first"}
        for k in (1, 2):
            dry |= {f"shaft_{i}_bearing_{k}_{f}": 0.0 for f in ("viscous_factor", "load_factor")}
            dry[f"shaft_{i}_bearing_{k}_type"] = "ball"
    return TrainParams(**{**dry, **changes})


def alike(mesh, **values):
    """The parameters of a mesh by their names."""
    return {f"mesh_{mesh}_{name}": value for name, value in values.items()}


SPUR = {
    "pinion_teeth": 25,
    "gear_ratio": 2.0,
    "normal_module": 4e-3,
    "helix_angle": 0.0,
    "face_width": 0.04,
}
