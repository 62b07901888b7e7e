"""Which FMI function may be called when: one table, as data, in ``calls.toml``.

The C tables of the native shell are written from it, and the tests go through it: every function
in every mode. A mode there is a name of here in small letters.
"""

from ...model.toml_tables import table_beside

INSTANTIATED, INITIALIZING, STEPPING, TERMINATED, EVENTS = 1, 2, 4, 8, 16
UPDATING, UPDATED = 32, 64  # within the host's intermediateUpdate before and after a step, FMI 3
CONTINUOUS, EXCHANGE_EVENTS = 128, 256  # of model exchange
NEVER = 0
EXCHANGING = CONTINUOUS | EXCHANGE_EVENTS
ALWAYS = INSTANTIATED | INITIALIZING | STEPPING | TERMINATED | EVENTS | EXCHANGING
READABLE = ALWAYS | UPDATED
SOLVABLE = INITIALIZING | STEPPING | EVENTS | EXCHANGING  # events: FMI 3 only

# What a mode is called in messages, and the function (without "fmi2", "fmi3") that leads out of it.
MODES = {
    INSTANTIATED: ("instantiated", "EnterInitializationMode"),
    INITIALIZING: ("initialization mode", "ExitInitializationMode"),
    STEPPING: ("step mode", "Terminate"),
    EVENTS: ("event mode", "EnterStepMode"),
    CONTINUOUS: ("continuous-time mode", "EnterEventMode"),
    EXCHANGE_EVENTS: ("event mode", "EnterContinuousTimeMode"),
    TERMINATED: ("terminated", "Reset"),
}

# Causality, in the order of tables.h -> modes in which a value may be set, and may be read.
ACCESS = {
    "independent": (NEVER, READABLE),
    "input": (INSTANTIATED | SOLVABLE | UPDATING, READABLE),
    "parameter": (INSTANTIATED | INITIALIZING, READABLE),
    "output": (NEVER, SOLVABLE | TERMINATED | UPDATED),
    "local": (NEVER, SOLVABLE | TERMINATED | UPDATED),
}

_TABLE = table_beside(__file__, "calls.toml")

# Version -> functions without an instance.
FREE: dict[int, list[str]] = {fmi: _TABLE["free"][f"fmi{fmi}"].split() for fmi in (2, 3)}
# Version -> function that only says why it does nothing -> why.
DECLINED: dict[int, dict[str, str]] = {
    fmi: {n: why for why, names in _TABLE["declined"][f"fmi{fmi}"].items() for n in names.split()}
    for fmi in (2, 3)
}
# Version -> function with an instance -> modes it is allowed in.
CALLS: dict[int, dict[str, int]] = {
    fmi: {
        name: sum(globals()[mode.upper()] for mode in modes.split())
        for modes, names in _TABLE["calls"][f"fmi{fmi}"]
        for name in names.split()
    }
    | dict.fromkeys(DECLINED[fmi], ALWAYS)
    for fmi in (2, 3)
}


def functions(fmi: int) -> tuple[str, ...]:
    """Return the names of all functions an FMU of this version exports."""
    return tuple(f"fmi{fmi}{name}" for name in (*FREE[fmi], *CALLS[fmi]))
