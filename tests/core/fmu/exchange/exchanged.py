"""An FMU in model exchange, call by call, whatever its version of FMI."""

from contextlib import contextmanager
from functools import cache

import numpy as np
from built import built_fmu
from fmpy import read_model_description
from fmpy.simulation import instantiate_fmu

from thrustwasher.fmu.running.loading import unpack

_kept = []  # FMPy has one logger of FMI 2 per process, the last: it has to live on


class Unit:
    """One instance, by the names of its variables."""

    def __init__(self, folder, description, kind="ModelExchange"):
        self.said = []
        self.description, self.fmi = description, int(description.fmiVersion[0])
        self.variables = {v.name: v for v in description.modelVariables}
        self.n = len(description.derivatives)
        self.states = [d.variable.derivative.name for d in description.derivatives]
        self.fmu = instantiate_fmu(
            folder, description, kind, debug_logging=True, logger=lambda *a: self.said.append(a)
        )
        _kept.append(getattr(self.fmu, "callbacks", None))
        self.next_time = None

    def start(self, t=0.0, **values):
        if self.fmi == 2:
            self.fmu.setupExperiment(startTime=t)
        parameters = [n for n in values if self.variables[n].causality == "parameter"]
        self.set(**{n: values[n] for n in parameters})
        self.fmu.enterInitializationMode(**({} if self.fmi == 2 else {"startTime": t}))
        self.set(**{n: x for n, x in values.items() if n not in parameters})
        self.fmu.exitInitializationMode()
        if hasattr(self.fmu, "getDerivatives") or self.fmi == 3:
            self.update()
        return self

    def update(self):
        """Iterate over the event and go on; return the time of the next event, or None."""
        again = True
        while again:
            call = self.fmu.newDiscreteStates if self.fmi == 2 else self.fmu.updateDiscreteStates
            again, _, _, _, defined, time = call()
        self.next_time = time if defined else None
        self.fmu.enterContinuousTimeMode()
        return self.next_time

    def event(self, t, **values):
        self.fmu.setTime(t)
        self.fmu.enterEventMode()
        self.set(**values)
        return self.update()

    def set(self, **values):
        for name, x in values.items():
            v = self.variables[name]
            kind = {"Real": "Real", "Float64": "Float64"}.get(v.type, v.type)
            if v.type == "Enumeration":
                kind = "Integer" if self.fmi == 2 else "Int64"
            getattr(self.fmu, f"set{kind}")([v.valueReference], [x])

    def get(self, *names):
        found = []
        for name in names:
            v = self.variables[name]
            kind = v.type
            if v.type == "Enumeration":
                kind = "Integer" if self.fmi == 2 else "Int64"
            found += getattr(self.fmu, f"get{kind}")([v.valueReference])
        return found[0] if len(names) == 1 else found

    def put(self, x):
        values = np.ascontiguousarray(x, dtype=float)
        self.fmu.setContinuousStates(values.ctypes.data_as(_doubles()), self.n)

    def _read(self, name, n):
        values = np.zeros(n)
        getattr(self.fmu, name)(values.ctypes.data_as(_doubles()), n)
        return values

    def x(self):
        return self._read("getContinuousStates", self.n)

    def dx(self):
        name = "getDerivatives" if self.fmi == 2 else "getContinuousStateDerivatives"
        return self._read(name, self.n)

    def z(self):
        return self._read("getEventIndicators", self.description.numberOfEventIndicators)

    def nominals(self):
        return self._read("getNominalsOfContinuousStates", self.n)

    def along(self, unknowns, knowns, seed):
        """Return the directional derivative of unknowns."""
        places = [[self.variables[n].valueReference for n in names] for names in (unknowns, knowns)]
        return np.array(self.fmu.getDirectionalDerivative(*places, list(seed)))


def _doubles():
    from ctypes import POINTER, c_double

    return POINTER(c_double)


@cache
def opened(path):
    """Return the folder of an FMU and what FMPy reads of it, which takes it a tenth of a second."""
    return str(unpack(path)), read_model_description(str(path))


@contextmanager
def unit(model, fmi=2, kind="ModelExchange"):
    made = Unit(*opened(built_fmu(model, fmi=fmi, local=True)), kind)
    try:
        yield made
    finally:
        made.fmu.freeInstance()
