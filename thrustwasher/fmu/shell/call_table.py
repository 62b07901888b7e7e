"""Which FMI function may be called when: one table, as data.

The C tables of the native shell are written from it, and the tests walk through it: every function
in every mode.
"""

INSTANTIATED, INITIALIZING, STEPPING, TERMINATED, EVENTS = 1, 2, 4, 8, 16
NEVER = 0
ALWAYS = INSTANTIATED | INITIALIZING | STEPPING | TERMINATED | EVENTS
SOLVABLE = INITIALIZING | STEPPING | EVENTS  # events: FMI 3 only

# What a mode is called in messages, and the function (without "fmi2", "fmi3") that leads out of it.
MODES = {
    INSTANTIATED: ("instantiated", "EnterInitializationMode"),
    INITIALIZING: ("initialization mode", "ExitInitializationMode"),
    STEPPING: ("step mode", "Terminate"),
    EVENTS: ("event mode", "EnterStepMode"),
    TERMINATED: ("terminated", "Reset"),
}

# Causality, in the order of tables.h -> modes in which a value may be set, and may be read.
ACCESS = {
    "independent": (NEVER, ALWAYS),
    "input": (INSTANTIATED | SOLVABLE, ALWAYS),
    "parameter": (INSTANTIATED | INITIALIZING, ALWAYS),
    "output": (NEVER, SOLVABLE | TERMINATED),
}

_STATE_2 = ("GetFMUstate", "SetFMUstate", "FreeFMUstate", "SerializedFMUstateSize",
            "SerializeFMUstate", "DeSerializeFMUstate")  # fmt: skip
_STATE_3 = ("GetFMUState", "SetFMUState", "FreeFMUState", "SerializedFMUStateSize",
            "SerializeFMUState", "DeserializeFMUState")  # fmt: skip
_TYPES_2 = ("Real", "Integer", "Boolean", "String")
_TYPES_3 = ("Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64",
            "UInt64", "Boolean", "String", "Binary", "Clock")  # fmt: skip


def _values(types: tuple[str, ...]) -> dict[str, int]:
    """Return the getters and setters of some types; ``ACCESS`` then looks at each variable."""
    setting = ACCESS["input"][0] | ACCESS["parameter"][0]
    return {f"Get{t}": ALWAYS for t in types} | {f"Set{t}": setting for t in types}


# Functions with an instance -> modes they are allowed in. The rest of them may be called always.
_COMMON = {
    "SetDebugLogging": ALWAYS,
    "FreeInstance": ALWAYS,
    "EnterInitializationMode": INSTANTIATED,
    "ExitInitializationMode": INITIALIZING,
    "Terminate": STEPPING | EVENTS,
    "Reset": ALWAYS,
    "GetDirectionalDerivative": SOLVABLE,
    "DoStep": STEPPING,
}
_STATUS_2 = ("GetStatus", "GetRealStatus", "GetIntegerStatus", "GetBooleanStatus",
             "GetStringStatus")  # fmt: skip

# Functions that are there, as the standard demands, but only say why they do nothing.
_INTERPOLATED = "inputs are not interpolated within a step (canInterpolateInputs is false)"
_NO_OUTPUT_DERIVATIVE = "there are no time derivatives of outputs (maxOutputDerivativeOrder is 0)"
_NO_PARTITIONS = "the discrete states are updated at once (providesEvaluateDiscreteStates is false)"
_NO_CLOCKS = "this model has no clocks"
_NO_STRUCTURE = "this model has no structural parameters"
_NO_EXCHANGE = "this FMU is for co-simulation, not for model exchange"
DECLINED = {
    2: {
        "SetRealInputDerivatives": _INTERPOLATED,
        "GetRealOutputDerivatives": _NO_OUTPUT_DERIVATIVE,
        "CancelStep": "no step is ever pending (canRunAsynchronuously is false)",
    },
    3: {
        "EvaluateDiscreteStates": _NO_PARTITIONS,
        **dict.fromkeys(("EnterConfigurationMode", "ExitConfigurationMode"), _NO_STRUCTURE),
        **dict.fromkeys(("GetIntervalDecimal", "GetIntervalFraction", "GetShiftDecimal",
                         "GetShiftFraction", "SetIntervalDecimal", "SetIntervalFraction",
                         "SetShiftDecimal", "SetShiftFraction", "ActivateModelPartition"),
                        _NO_CLOCKS),
        **dict.fromkeys(("EnterContinuousTimeMode", "CompletedIntegratorStep", "SetTime",
                         "SetContinuousStates", "GetContinuousStateDerivatives",
                         "GetEventIndicators", "GetContinuousStates",
                         "GetNominalsOfContinuousStates", "GetNumberOfEventIndicators",
                         "GetNumberOfContinuousStates"), _NO_EXCHANGE),
        "GetOutputDerivatives": _NO_OUTPUT_DERIVATIVE,
    },
}  # fmt: skip

CALLS: dict[int, dict[str, int]] = {
    2: {
        **_COMMON,
        "SetupExperiment": INSTANTIATED,
        **_values(_TYPES_2),
        **dict.fromkeys(_STATE_2, ALWAYS),
        **dict.fromkeys(_STATUS_2, STEPPING | TERMINATED),
        **dict.fromkeys(DECLINED[2], ALWAYS),
    },
    3: {
        **_COMMON,
        **_values(_TYPES_3),
        **dict.fromkeys(_STATE_3, ALWAYS),
        "GetAdjointDerivative": SOLVABLE,
        "EnterEventMode": STEPPING,
        "EnterStepMode": EVENTS,
        "UpdateDiscreteStates": EVENTS,
        "GetNumberOfVariableDependencies": ALWAYS,
        "GetVariableDependencies": ALWAYS,
        **dict.fromkeys(DECLINED[3], ALWAYS),
    },
}

# Functions without an instance.
FREE = {
    2: ("GetTypesPlatform", "GetVersion", "Instantiate"),
    3: ("GetVersion", "InstantiateModelExchange", "InstantiateCoSimulation",
        "InstantiateScheduledExecution"),
}  # fmt: skip


def functions(fmi: int) -> tuple[str, ...]:
    """Return the names of all functions an FMU of this version exports."""
    return tuple(f"fmi{fmi}{name}" for name in (*FREE[fmi], *CALLS[fmi]))
