"""A shift transmission alone, its packs' capacities given by hand."""

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.transmission.parameters import SPEC

FREE = {"engine_torque": 0.0, "load_torque": 0.0, "washers": 0}


class Gearbox:
    """Steps on from where it is."""

    def __init__(self, **params):
        self.instance = DirectInstance(SPEC, parameters=params)
        self.instance.initialize()
        self.time = 0.0

    def step(self, dt, clutch=0.0, brake=0.0):
        self.instance.set_inputs([clutch, brake, *[0.0] * 7])
        self.instance.step(self.time, dt)
        self.time += dt
        return self

    def __getitem__(self, name):
        return self.instance.get([name])[0]
