"""One FMU in a host with a package for Python: inputs from a table, outputs into one.

python single.py HOST FMU INPUTS.csv STEP STOP OUTPUTS.csv, HOST one of ``HOSTS``, run by the Python
that has the host's package (run.py does so). Prints a line of JSON with the version.
"""

import json
import sys
from importlib import metadata
from typing import Any

import numpy as np

SOLVER = {"solver": "CVode", "relative_tolerance": 1e-6}
# names, then one row of their values per point of time
Table = tuple[list[str], Any]


def fmpy(fmu: str, inputs: str, step: float, stop: float, **more: Any) -> Table:
    from fmpy import simulate_fmu
    from fmpy.util import read_csv

    given = {"input": read_csv(inputs), "output_interval": step, "step_size": step}
    found = simulate_fmu(fmu, stop_time=stop, **given, **more)
    names = list(found.dtype.names)
    return names, np.column_stack([found[name].astype(float) for name in names])


def fmpy_events(fmu: str, inputs: str, step: float, stop: float) -> Table:
    return fmpy(fmu, inputs, step, stop, early_return_allowed=True, use_event_mode=True)


def fmpy_exchange(fmu: str, inputs: str, step: float, stop: float) -> Table:
    return fmpy(fmu, inputs, step, stop, fmi_type="ModelExchange", **SOLVER)


def pyfmi_exchange(fmu: str, inputs: str, step: float, stop: float) -> Table:
    return pyfmi(fmu, inputs, step, stop, "ME")


def pyfmi(fmu: str, inputs: str, step: float, stop: float, kind: str = "CS") -> Table:
    from pyfmi import load_fmu

    model = load_fmu(fmu, log_level=2, kind=kind)
    table = np.genfromtxt(inputs, delimiter=",", names=True)
    names = list(table.dtype.names or ())
    given = (names[1:], np.column_stack([table[name] for name in names]))
    options = {"ncp": round(stop / step), "result_handling": "memory"}
    found = model.simulate(0.0, stop, input=given, options=options)
    outputs = ["time", *model.get_output_list()]
    return outputs, np.column_stack([np.asarray(found[name], float) for name in outputs])


def pathsim_exchange(fmu: str, inputs: str, step: float, stop: float) -> Table:
    """Each input a block that gives its value over time; the block's outputs by their names.

    Whether outputs follow inputs at once PathSim finds out by inputs of 0 K and -1e-8 N, which
    units refuse: it is told here. For the Jacobian it takes states for derivatives: turned back.
    """
    from pathsim import Connection, Simulation
    from pathsim.blocks import Scope, Source
    from pathsim.solvers import ESDIRK43
    from pathsim_fmi import ModelExchangeFMU

    class Told(ModelExchangeFMU):  # type: ignore[misc]
        def __len__(self) -> int:
            return 1

    block, scope = Told(fmu), Scope(sampling_period=step)
    known = block.fmu_wrapper
    known._state_refs, known._derivative_refs = known._derivative_refs, known._state_refs
    table = np.genfromtxt(inputs, delimiter=",", names=True)
    knobs = [n for n in table.dtype.names or () if n != "time"]
    given = [Source(lambda t, n=n: float(np.interp(t, table["time"], table[n]))) for n in knobs]
    names = list(block.outputs._mapping)
    wires = [Connection(s, block[n]) for s, n in zip(given, knobs, strict=True)]
    wires += [Connection(block[n], scope[k]) for k, n in enumerate(names)]
    more = {"Solver": ESDIRK43, "tolerance_lte_rel": 1e-6, "tolerance_lte_abs": 1e-8}
    run = Simulation([block, scope, *given], wires, dt=step, log=False, **more)
    run.run(stop)
    times, values = scope.read()
    return ["time", *names], np.column_stack([times, *values])


def fmuloader(fmu: str, inputs: str, step: float, stop: float) -> Table:
    """Step with fmuloader's bindings; it has no loop of its own."""
    from fmpy import read_model_description
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type
    from fmuloader.fmi3 import Fmi3Slave

    known = read_model_description(fmu)
    variables, model = known.modelVariables, known.coSimulation.modelIdentifier
    reals = [v for v in variables if v.type in ("Real", "Float64")]
    knobs = {v.name: v.valueReference for v in reals if v.causality == "input"}
    shown = [v for v in reals if v.causality == "output"]
    table = np.genfromtxt(inputs, delimiter=",", names=True)
    steps = round(stop / step)
    rows = []
    with (Fmi2Slave if known.fmiVersion == "2.0" else Fmi3Slave)(fmu, model_identifier=model) as it:
        if known.fmiVersion == "2.0":
            it.instantiate(model, Fmi2Type.CO_SIMULATION, guid=known.guid)
            it.setup_experiment(0.0)
            get, put = it.get_real, it.set_real
        else:
            it.instantiate_co_simulation(model, instantiation_token=known.guid)
            get, put = it.get_float64, it.set_float64
        it.enter_initialization_mode()
        for k in range(steps + 1):
            at = [float(np.interp(k * step, table["time"], table[name])) for name in knobs]
            put(list(knobs.values()), at)
            if k == 0:
                it.exit_initialization_mode()
                rows.append([0.0, *get([v.valueReference for v in shown])])
            if k < steps:
                it.do_step(k * step, step)
                rows.append([(k + 1) * step, *get([v.valueReference for v in shown])])
        it.terminate()
    return ["time", *(v.name for v in shown)], rows


HOSTS = {
    "fmpy": (fmpy, "fmpy"),
    "fmpy-events": (fmpy_events, "fmpy"),
    "fmpy-exchange": (fmpy_exchange, "fmpy"),
    "fmuloader": (fmuloader, "fmuloader"),
    "pathsim-exchange": (pathsim_exchange, "pathsim-fmi"),
    "pyfmi": (pyfmi, "pyfmi"),
    "pyfmi-exchange": (pyfmi_exchange, "pyfmi"),
}

if __name__ == "__main__":
    run, distribution = HOSTS[sys.argv[1]]
    fmu, inputs, step, stop, target = sys.argv[2:]
    names, rows = run(fmu, inputs, float(step), float(stop))
    np.savetxt(target, rows, "%.17g", ",", header=",".join(names), comments="")
    print(json.dumps({"version": metadata.version(distribution)}))
