"""A master gone wild: ``python hostile.py FMU SEED CALLS`` makes random calls, sane or not.

Whatever comes, the process lives and no number that is read is NaN or infinite. Prints how many
calls ended OK and how many were refused by a status.
"""

import math
import random
import sys
import tempfile

from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

ODD = [math.nan, math.inf, -math.inf, 0.0, -1.0, 1e300, -1e300, 5e-324, 1e6]
WHOLE = [0, -1, 1, 2, 99, 2**31 - 1, -(2**31)]


class Master:
    """Random calls on one instance, with what it takes to make most of them plausible."""

    def __init__(self, path, seed):
        self.rng = random.Random(seed)
        self.known = read_model_description(path).modelVariables
        described = read_model_description(path)
        self.fmu = FMU2Slave(
            guid=described.guid,
            unzipDirectory=extract(path, tempfile.mkdtemp()),
            modelIdentifier=described.coSimulation.modelIdentifier,
        )
        self.fmu.instantiate(loggingOn=seed % 2 == 0)
        self.states, self.saved, self.time = [], [b"", b"x" * 300], 0.0

    def call(self):
        """Make one call; True if it ended OK."""
        calls = (
            [self.set_input] * 6
            + [self.step] * 8
            + [self.read] * 4
            + [
                self.set_anything,
                self.set_whole,
                self.begin,
                self.end,
                self.keep,
                self.go_back,
                self.to_bytes,
                self.from_bytes,
                self.forget,
                self.read_strings,
            ]
        )
        try:
            self.rng.choice(calls)()
        except FMICallException:
            return False
        return True

    def begin(self):
        calls = [
            self.fmu.setupExperiment,
            self.fmu.enterInitializationMode,
            self.fmu.exitInitializationMode,
        ]
        if self.rng.random() < 0.2:
            self.fmu.setupExperiment(startTime=self.rng.choice(ODD))
            calls = self.rng.sample(calls, self.rng.randint(0, 3))
        for call in calls:
            call()

    def end(self):
        self.rng.choice([self.fmu.terminate, self.fmu.reset, self.fmu.reset])()
        self.begin()

    def value(self, v):
        """Return a value, in three of four cases one that the description allows."""
        if self.rng.random() < 0.25 or v is None:
            return self.rng.choice(ODD)
        low, high = float(v.min or -1e3), float(v.max or 1e3)
        return self.rng.choice([low, high, self.rng.uniform(low, high), float(v.start or 0.0)])

    def some(self, kinds, causality=None):
        fit = [v for v in self.known if v.type in kinds and causality in (None, v.causality)]
        return self.rng.choices(fit, k=self.rng.randint(0, 4)) if fit else []

    def references(self, found):
        extra = [self.rng.choice([999, 2**32 - 1])] if self.rng.random() < 0.05 else []
        return [v.valueReference for v in found] + extra

    def set_input(self):
        found = [v for v in self.known if v.causality == "input"]
        self.fmu.setReal([v.valueReference for v in found], [self.value(v) for v in found])

    def set_anything(self):
        found = self.some(("Real",))
        references = self.references(found)
        values = [self.value(v) for v in found] + [1.0] * (len(references) - len(found))
        self.fmu.setReal(references, values)

    def set_whole(self):
        kinds = self.rng.choice([("Integer", "Enumeration"), ("Boolean",), ("Real",)])
        references = self.references(self.some(kinds))
        name = "Boolean" if kinds == ("Boolean",) else "Integer"
        values = [self.rng.choice(WHOLE) for _ in references]
        getattr(self.fmu, f"set{name}")(references, values)

    def step(self):
        t, h = self.time, self.rng.choice([1e-3, 1e-2, 0.1])
        if self.rng.random() < 0.1:
            t, h = self.rng.choice([t, *ODD]), self.rng.choice([h, *ODD])
        self.fmu.doStep(t, h)
        self.time = t + h

    def read(self):
        found = self.known if self.rng.random() < 0.3 else self.some(("Real",))
        references = self.references([v for v in found if v.type == "Real"])
        for value in self.fmu.getReal(references):
            assert math.isfinite(value), [v.name for v in found]
        whole = [v.valueReference for v in found if v.type in ("Integer", "Enumeration")]
        self.fmu.getInteger(whole)
        self.fmu.getBoolean(self.references(self.some(("Boolean",))))

    def read_strings(self):
        self.fmu.getString([self.rng.choice([0, 1, 999])])

    def keep(self):
        if len(self.states) < 5:
            self.states.append(self.fmu.getFMUstate())

    def go_back(self):
        if self.states:
            self.fmu.setFMUstate(self.rng.choice(self.states))

    def to_bytes(self):
        if self.states:
            self.saved.append(self.fmu.serializeFMUstate(self.rng.choice(self.states)))

    def from_bytes(self):
        data = bytearray(self.rng.choice(self.saved))
        if data and self.rng.random() < 0.5:
            data[self.rng.randrange(len(data))] ^= 1 << self.rng.randrange(8)
        if data and len(self.states) < 5:
            self.states.append(self.fmu.deSerializeFMUstate(bytes(data)))

    def forget(self):
        if self.states:
            state = self.states.pop(self.rng.randrange(len(self.states)))
            self.fmu.freeFMUstate(state)


def main():
    path, seed, calls = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    master = Master(path, seed)
    good = sum(master.call() for _ in range(calls))
    # after all that: a sane run works
    master.fmu.reset()
    master.fmu.setupExperiment()
    master.fmu.enterInitializationMode()
    master.fmu.exitInitializationMode()
    master.fmu.doStep(0.0, 1e-3)
    real = [v.valueReference for v in master.known if v.type == "Real"]
    assert all(map(math.isfinite, master.fmu.getReal(real)))
    master.fmu.freeInstance()
    print(good, calls - good)


if __name__ == "__main__":
    main()
