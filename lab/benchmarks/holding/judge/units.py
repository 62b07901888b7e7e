"""Drive a built FMU by its own functions: FMI 2 (native or Python target) or FMI 3.

Steps cost microseconds, so that hundreds of drivelines take minutes. Nothing of the package is
used: the library is opened as a host would.
"""

from __future__ import annotations

import ctypes as c
import re
import tempfile
import zipfile
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

WARNING, ERROR = 1, 3  # statuses of both versions of FMI
LOG = {
    2: c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p),
    3: c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p),
}
KINDS = {"Real": "Real", "Float64": "Real", "Boolean": "Boolean"}  # everything else: whole number
# element of the description or type -> functions Get.., Set.. and the type of a value, by version
CALLS = {
    2: {
        "Real": ("Real", c.c_double),
        "Whole": ("Integer", c.c_int),
        "Boolean": ("Boolean", c.c_int),
    },
    3: {
        "Real": ("Float64", c.c_double),
        "Whole": ("Int64", c.c_int64),
        "Boolean": ("Boolean", c.c_bool),
    },
}


class _Callbacks(c.Structure):
    _fields_ = (
        ("logger", LOG[2]),
        ("allocate", c.c_void_p),
        ("free", c.c_void_p),
        ("finished", c.c_void_p),
        ("environment", c.c_void_p),
    )


class Model:
    """An unpacked FMU: its library, its variables and in which way they are called."""

    def __init__(self, path: Path) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="judge-")
        folder = Path(self._folder.name)
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.fmi = int(root.attrib["fmiVersion"][0])
        self.version = root.attrib.get("version", "?")
        whole = root.find("CoSimulation")
        self.token = root.attrib["guid" if self.fmi == 2 else "instantiationToken"]
        name = whole.attrib["modelIdentifier"]
        self.name = root.attrib["modelName"]
        variables = root.find("ModelVariables")
        self.places: dict[str, tuple[str, int]] = {}
        for v in variables:
            kind = next(iter(v)).tag if self.fmi == 2 else v.tag
            self.places[v.attrib["name"]] = (
                KINDS.get(kind, "Whole"),
                int(v.attrib["valueReference"]),
            )
            if v.tag == "Int32":
                self.places[v.attrib["name"]] = "Int32", int(v.attrib["valueReference"])
        self.items = {
            f"{t.attrib['name']}.{i.attrib['name']}": int(i.attrib["value"])
            for t in root.iter()
            if t.tag in ("SimpleType", "EnumerationType")
            for i in t.iter("Item")
        }
        binary = "linux64" if self.fmi == 2 else "x86_64-linux"
        self.library = c.CDLL(str(folder / "binaries" / binary / f"{name}.so"))
        resources = (folder / "resources").as_uri() if self.fmi == 2 else f"{folder}/resources/"
        self.resources = resources.encode()

    def __getitem__(self, name: str) -> Any:
        """Return a function of the library by its name without prefix."""
        return getattr(self.library, f"fmi{self.fmi}{name}")


@cache
def model_of(path: str) -> Model:
    """Return an FMU, unpacked and loaded once in a process."""
    return Model(Path(path))


class Unit:
    """An instance: ``set`` inputs, ``step``, read ``real``, ``status``, ``locked``.

    ``outputs`` are the real outputs that ``real`` holds after each step, in this order; those that
    this version lacks stay NaN. ``messages``: (status, text) of warnings and worse.
    """

    def __init__(
        self, path: str, inputs: tuple[str, ...], outputs: tuple[str, ...], **parameters: float
    ) -> None:
        self.model = model = model_of(path)
        self.messages: list[tuple[int, str]] = []
        self.parameters = parameters
        self._log = LOG[model.fmi](self._told2 if model.fmi == 2 else self._told3)
        label, token = model.name.encode(), model.token.encode()
        if model.fmi == 2:
            self._callbacks = _Callbacks(self._log, None, None, None, None)
            make = model["Instantiate"]
            make.restype = c.c_void_p
            found = make(label, 1, token, model.resources, c.byref(self._callbacks), 0, 1)
        else:
            make = model["InstantiateCoSimulation"]
            make.restype = c.c_void_p
            no, on = c.c_bool(False), c.c_bool(True)
            given = (no, on, no, no, None, c.c_size_t(0), None, self._log, None)
            found = make(label, token, model.resources, *given)
        if not found:
            raise RuntimeError(f"{model.name} is not instantiated: {self.messages}")
        self.instance = c.c_void_p(found)
        self._step, self._set = model["DoStep"], model[f"Set{CALLS[model.fmi]['Real'][0]}"]
        self._get = model[f"Get{CALLS[model.fmi]['Real'][0]}"]
        known = [name for name in outputs if name in model.places]
        self.at = {name: known.index(name) for name in known}
        self._in_refs = (c.c_uint * len(inputs))(*(model.places[name][1] for name in inputs))
        self._in = (c.c_double * len(inputs))()
        self._out_refs = (c.c_uint * len(known))(*(model.places[name][1] for name in known))
        self.real = (c.c_double * len(known))()
        self.inputs = inputs
        self.failed = 0
        more = () if model.fmi == 2 else (c.c_size_t(len(inputs)),)
        self._set_rest = (self._in_refs, c.c_size_t(len(inputs)), self._in, *more)
        more = () if model.fmi == 2 else (c.c_size_t(len(known)),)
        self._get_rest = (self._out_refs, c.c_size_t(len(known)), self.real, *more)
        self._whole = c.c_int() if model.fmi == 2 else c.c_int64()
        self._yes = c.c_int() if model.fmi == 2 else c.c_bool()
        flags = [c.c_bool(), c.c_bool(), c.c_bool(), c.c_double()]
        self._after = [] if model.fmi == 2 else [c.byref(f) for f in flags]
        for name, value in parameters.items():
            self.write(name, value)

    def _told2(self, _: Any, name: bytes, status: int, category: bytes, text: bytes) -> None:
        self._told3(_, status, category, text)

    def _told3(self, _: Any, status: int, category: bytes, text: bytes) -> None:
        if status >= WARNING:
            self.messages.append((status, (text or b"").decode(errors="replace")))

    def write(self, name: str, value: float) -> None:
        """Set a variable by name."""
        model = self.model
        kind, ref = model.places[name]
        call, ctype = CALLS[model.fmi].get(kind, ("Int32", c.c_int32))
        one = c.byref((c.c_uint * 1)(ref)), c.c_size_t(1), c.byref((ctype * 1)(ctype(value).value))
        more = () if model.fmi == 2 else (c.c_size_t(1),)
        status = model[f"Set{call}"](self.instance, *one, *more)
        if status >= ERROR:
            raise RuntimeError(f"{name} = {value}: {self.messages[-1:]}")

    def read(self, name: str) -> float:
        """Return a variable by name."""
        model = self.model
        kind, ref = model.places[name]
        call, ctype = CALLS[model.fmi].get(kind, ("Int32", c.c_int32))
        value = (ctype * 1)()
        more = () if model.fmi == 2 else (c.c_size_t(1),)
        model[f"Get{call}"](self.instance, (c.c_uint * 1)(ref), c.c_size_t(1), value, *more)
        return value[0]

    def start(self, **values: float) -> None:
        """Initialize at these inputs."""
        model, zero = self.model, c.c_double(0.0)
        if model.fmi == 2:
            model["SetupExperiment"](self.instance, 0, zero, zero, 0, zero)
            model["EnterInitializationMode"](self.instance)
        else:
            no = c.c_bool(False)
            model["EnterInitializationMode"](self.instance, no, zero, zero, no, zero)
        for name, value in values.items():
            self.write(name, value)
        if model["ExitInitializationMode"](self.instance) >= ERROR:
            raise RuntimeError(f"{model.name} does not start: {self.messages[-1:]}")
        self.failed = 0
        self._get(self.instance, *self._get_rest)

    def set(self, *values: float) -> None:
        """Set the inputs, in their order."""
        self._in[:] = values
        self._set(self.instance, *self._set_rest)

    def step(self, t: float, h: float) -> None:
        """Advance, and read the real outputs."""
        end = (1,) if self.model.fmi == 2 else (c.c_bool(True), *self._after)
        status = self._step(self.instance, c.c_double(t), c.c_double(h), *end)
        self.failed += status > WARNING
        self._get(self.instance, *self._get_rest)

    @property
    def status(self) -> int:
        """Return ``solver_status``."""
        return int(self.read("solver_status"))

    @property
    def locked(self) -> bool:
        """Return ``locked``."""
        return bool(self.read("locked"))

    def save(self) -> c.c_void_p:
        """Return a saved state."""
        state = c.c_void_p()
        name = "GetFMUstate" if self.model.fmi == 2 else "GetFMUState"
        if self.model[name](self.instance, c.byref(state)) >= ERROR:
            raise RuntimeError("the state is not saved")
        return state

    def restore(self, state: c.c_void_p) -> None:
        """Return to a saved state."""
        name = "SetFMUstate" if self.model.fmi == 2 else "SetFMUState"
        if self.model[name](self.instance, state) >= ERROR:
            raise RuntimeError("the state is not restored")
        self._get(self.instance, *self._get_rest)

    def close(self) -> None:
        """Terminate and free."""
        self.model["Terminate"](self.instance)
        self.model["FreeInstance"](self.instance)

    def told(self) -> list[str]:
        """Return warnings that are about holding."""
        return [text for _, text in self.messages if tells(text)]


ABOUT = re.compile(r"chatter|unanswered|refuted|\block|\bhold|\bheld\b|no_event|answer", re.I)
UNUSED = re.compile(r"\bnot used\b|overrule")


def tells(text: str) -> bool:
    """Tell whether a warning is about the lock."""
    return bool(ABOUT.search(text)) and not UNUSED.search(text)
