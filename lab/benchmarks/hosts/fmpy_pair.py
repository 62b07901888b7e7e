"""Clutch and plant as instances of FMPy, and the orders in which they are stepped."""

from pathlib import Path
from typing import Any

from lock_scene import EXTRAS, STARTS, STOP, TORQUE, WIRES, measured

Found = dict[str, Any]


class Part:
    """One FMU in FMPy: values by name, steps, states."""

    def __init__(self, fmu: Path, scratch: Path, messages: list[str], events: bool = False) -> None:
        from fmpy import extract, read_model_description
        from fmpy.simulation import instantiate_fmu

        known = read_model_description(str(fmu))
        self.variables = {v.name: v for v in known.modelVariables}
        self.fmi, self.events = 3 if known.fmiVersion.startswith("3") else 2, events
        self.stops = 0
        folder = extract(str(fmu), str(scratch / fmu.stem))

        def heard(*given: Any) -> None:
            status, category, text = given[2:5] if self.fmi == 2 else given[1:4]
            text, category = (t.decode() if isinstance(t, bytes) else t for t in (text, category))
            level = ("OK", "warning", "discard", "error", "fatal", "pending")[status]
            messages.append(f"{fmu.stem}: {level}: {text}")

        self.fmu = instantiate_fmu(
            folder, known, "CoSimulation", logger=heard, event_mode_used=events, debug_logging=True
        )

    def start(self, values: dict[str, float]) -> None:
        """Begin to initialize with these values."""
        if self.fmi == 2:
            self.fmu.setupExperiment(startTime=0.0, stopTime=STOP)
        for name, value in values.items():
            self.put(name, value)
        if self.fmi == 2:
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=0.0, stopTime=STOP)

    def started(self) -> None:
        """End to initialize."""
        self.fmu.exitInitializationMode()
        if self.events:
            self.settle()

    def settle(self) -> None:
        """Leave Event Mode once there is nothing left to update."""
        while self.fmu.updateDiscreteStates()[0]:
            pass
        self.fmu.enterStepMode()

    def get(self, name: str) -> Any:
        """Return a value."""
        variable = self.variables[name]
        kind = {"Enumeration": ("Integer", "Int64")[self.fmi - 2]}.get(variable.type, variable.type)
        return getattr(self.fmu, f"get{kind}")([variable.valueReference])[0]

    def put(self, name: str, value: float) -> None:
        """Set a real value."""
        setter = self.fmu.setReal if self.fmi == 2 else self.fmu.setFloat64
        setter([self.variables[name].valueReference], [value])

    def step(self, t: float, h: float, final: bool = True) -> None:
        """Step; handle an event at the end."""
        found = self.fmu.doStep(t, h, noSetFMUStatePriorToCurrentPoint=final)
        if self.events and found[0]:
            self.stops += 1
            self.fmu.enterEventMode()
            self.settle()

    def extras(self) -> Found:
        """Return what a clutch tells next to its torque, if it does."""
        return {name: self.get(name) for name in EXTRAS if name in self.variables}


class Pair:
    """Clutch and plant in FMPy, and how they are stepped."""

    def __init__(self, clutch: Path, plant: Path, scratch: Path, events: bool = False) -> None:
        self.messages: list[str] = []
        self.clutch = Part(clutch, scratch, self.messages, events)
        self.plant = Part(plant, scratch, self.messages)
        self.times: list[float] = []
        self.slips: list[float] = []
        self.clutch.start(STARTS)
        self.plant.start({})
        self.to_clutch()
        self.to_plant()
        self.clutch.started()
        self.plant.started()
        self.note(0.0)

    def to_clutch(self) -> None:
        """Hand the plant's outputs to the clutch."""
        for output, name in WIRES:
            self.clutch.put(name, self.plant.get(output))

    def to_plant(self) -> None:
        """Hand the clutch's torque to the plant."""
        self.plant.put("torque", self.clutch.get(TORQUE))

    def note(self, t: float) -> None:
        """Take down the slip."""
        self.times.append(t)
        self.slips.append(self.plant.get("slip"))

    def step(self, t: float, h: float, exchange: str, final: bool = True) -> None:
        """Take one step of the host."""
        if exchange == "parallel":
            values = [(name, self.plant.get(output)) for output, name in WIRES]
            self.to_plant()
            for name, value in values:
                self.clutch.put(name, value)
            self.clutch.step(t, h, final)
            self.plant.step(t, h, final)
            return
        for first in ("clutch", "plant") if exchange == "clutch first" else ("plant", "clutch"):
            if first == "clutch":
                self.to_clutch()
                self.clutch.step(t, h, final)
            else:
                self.to_plant()
                self.plant.step(t, h, final)

    def found(self, **more: Any) -> Found:
        """Return what the run came to."""
        torque = self.clutch.get(TORQUE)
        more |= self.clutch.extras()
        return measured(self.times, self.slips, torque, self.messages, **more)
