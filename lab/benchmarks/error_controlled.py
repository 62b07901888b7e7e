"""The default shift under masters that choose their step by an error estimate.

Run: python -m lab.benchmarks.error_controlled [own] [pyfmi] [--rtol 1e-3 1e-4]
     [--order parallel|serial] [--correct] [--maxh 1e-3] [--torque-age 1] [--lead 0]

``own`` is the small master below, which needs nothing but this package. ``pyfmi`` runs PyFMI's
Master with error_controlled=True where PyFMI is installed. Printed per run: host, tolerance, time
of lock-up, its distance from the converged run, steps taken and refused, processor seconds.

Step doubling: every step is taken once as a whole and once as two halves with an exchange between
them; what both end with differs by the error that the estimate goes by. A refused step starts again
from the saved states.
"""

import argparse
import math
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np

from thrustwasher.fmu.build import build
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.shift import Scene, cosimulate, load_scene
from thrustwasher.shift.ssp.system_structure import Structure, plan, prepared, start_values

CONVERGED = 2e-5  # s: step of the run that the others are compared with
PYFMI = "PyFMI is not installed: build FMI Library (cmake), then PyFMI from source against it"


class Run(NamedTuple):
    """What a run of a master came to."""

    lock_time: float  # s
    taken: int
    refused: int
    seconds: float
    shortest: float  # s, of the steps tried


class StepDoubling:
    """Connected instances, stepped as far as the tolerance lets it.

    ``order``: "parallel", all parts at once from the values of the last exchange, or "serial", one
    after the other, each with what those before it give at the step's end. ``correct``: the
    exchanged values are brought to what they are once the chain has settled, by the slopes that the
    instances give.
    """

    def __init__(
        self,
        instances: Mapping[str, Any],
        links: Sequence[Any],
        *,
        rtol: float,
        atol: float = 1e-4,
        order: str = "parallel",
        correct: bool = False,
        longest: float = math.inf,
    ) -> None:
        self.instances, self.links = dict(instances), list(links)
        self.rtol, self.atol, self.longest = rtol, atol, longest
        self.order, self.correct = order, correct
        self.inputs = {n: [0.0] * len(i.input_names) for n, i in self.instances.items()}
        self.wires = [
            (
                k.source,
                self.instances[k.source].output_names.index(k.output),
                k.target,
                self.instances[k.target].input_names.index(k.input),
            )
            for k in links
        ]

    def initialize(self, start: float, inputs: Mapping[str, Mapping[str, float]]) -> None:
        """Start every instance with inputs that belong together."""
        for name, instance in self.instances.items():
            self.inputs[name] = [inputs[name][n] for n in instance.input_names]
            instance.initialize(start, inputs[name])

    def signals(self) -> np.ndarray:
        """Return what each wire carries."""
        outputs = {n: i.outputs() for n, i in self.instances.items()}
        return np.array([outputs[source][k] for source, k, _, _ in self.wires])

    def send(self, values: np.ndarray, only: str | None = None) -> None:
        """Set the inputs of all instances, or of one, to what the wires carry."""
        for value, (_, _, target, slot) in zip(values.tolist(), self.wires, strict=True):
            self.inputs[target][slot] = value
        for name, instance in self.instances.items():
            if only in (None, name):
                instance.set_inputs(self.inputs[name])

    def settled(self, values: np.ndarray, sent: np.ndarray) -> np.ndarray:
        """Return the signals once the chain has settled, by the slopes at the inputs ``sent``."""
        if not self.correct:
            return values
        slopes = np.zeros((len(self.links),) * 2)
        for column, cause in enumerate(self.links):
            instance = self.instances[cause.target]
            rows = [r for r, k in enumerate(self.links) if k.source == cause.target]
            names = [self.links[r].output for r in rows]
            found = instance.directional_derivative(names, [cause.input], [1.0])
            slopes[rows, column] = found
        return np.linalg.solve(np.eye(len(slopes)) - slopes, values - slopes @ sent)

    def step(self, t: float, h: float, sent: np.ndarray) -> np.ndarray:
        """Step all instances; return the signals at the end, ``sent`` those of the start."""
        if self.order == "parallel":
            for instance in self.instances.values():
                instance.step(t, h)
            return self.settled(self.signals(), sent)
        values = sent.copy()
        for name, instance in self.instances.items():
            self.send(values, only=name)
            instance.step(t, h)
            outputs = instance.outputs()
            for k, (source, slot, _, _) in enumerate(self.wires):
                if source == name:
                    values[k] = outputs[slot]
        return values

    def run(self, start: float, stop: float, first: float = 0.01) -> tuple[int, int, float]:
        """Step from start to stop; return steps taken, steps refused and the shortest one tried."""
        t, h, taken, refused, shortest = start, min(first, self.longest), 0, 0, math.inf
        now = self.signals()
        self.send(now)
        while t < stop:
            h = min(h, stop - t)
            shortest = min(shortest, h)
            saved = {n: i.get_state() for n, i in self.instances.items()}
            whole = self.step(t, h, now)
            self.put_back(saved, now)
            middle = self.step(t, 0.5 * h, now)
            self.send(middle)
            end = self.step(t + 0.5 * h, 0.5 * h, middle)
            error = math.sqrt(float(np.mean(abs(end - whole) / (self.atol + self.rtol * abs(end)))))
            if error < 1.1:
                t, now, taken = t + h, end, taken + 1
                self.send(now)
            else:
                self.put_back(saved, now)
                refused += 1
            for name, state in saved.items():
                self.instances[name].free_state(state)
            growth = 6.0 if error == 0.0 else min(6.0, max(0.2, 0.9 / math.sqrt(error)))
            h = min(h * growth, self.longest)
        return taken, refused, shortest

    def put_back(self, saved: Mapping[str, Any], sent: np.ndarray) -> None:
        """Go back to saved states and the signals that were there."""
        for name, state in saved.items():
            self.instances[name].set_state(state)
        self.send(sent)


def direct(scene: Scene) -> dict[str, DirectInstance]:
    """Return the kernels of every part, called in this process."""
    return {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in scene.parts.items()}


def structure(scene: Scene, *, torque_age: int = 0, lead: float = 0.0) -> Structure:
    """Return the shift as a package for other tools describes it, the transmission last."""
    found = plan(scene, start_values(scene, direct(scene)))
    for part in found.components:
        if part.name == "transmission":
            part.parameters["torque_age"] = torque_age
        if part.name == "command":
            part.parameters["lead"] = lead
    return found._replace(
        components=sorted(found.components, key=lambda c: c.name == "transmission")
    )


@contextmanager
def fmus(system: Structure) -> Iterator[dict[str, Path]]:
    """Give the FMU of every component."""
    with TemporaryDirectory() as folder:
        names = sorted({c.spec.name for c in system.components})
        paths = {p.stem: p for p in build(names, out=Path(folder), local=True)}
        yield {c.name: paths[c.spec.name] for c in system.components}


def own(system: Structure, paths: Mapping[str, Path], **options: Any) -> Run:
    """Run the master above on FMUs."""
    with ExitStack() as alive:
        made = {
            c.name: alive.enter_context(
                Instance(paths[c.name], parameters=c.parameters, name=c.name)
            )
            for c in system.components
        }
        return drive(system, made, **options)


def drive(system: Structure, instances: Mapping[str, Any], **options: Any) -> Run:
    """Run the master above on instances of any kind."""
    master = StepDoubling(instances, system.links, **options)
    master.initialize(system.scene.start_time, {c.name: c.starts for c in system.components})
    begin = time.process_time()
    taken, refused, shortest = master.run(system.scene.start_time, system.scene.stop_time)
    seconds = time.process_time() - begin
    gearbox = master.instances["transmission"]
    lock = gearbox.outputs()[gearbox.output_names.index("lock_time")]
    return Run(lock, taken, refused, seconds, shortest)


def numbers(path: Path, parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return parameters as an FMU holds them, names of enumerations as their numbers."""
    kinds = {"Real": float, "Boolean": bool}
    with Instance(path, parameters=parameters) as fmu:
        found = dict(zip(parameters, fmu.get(list(parameters)), strict=True))
        types = {v.name: v.type for v in fmu.description.modelVariables}
    return {name: kinds.get(types[name], int)(value) for name, value in found.items()}


def pyfmi(
    system: Structure,
    paths: Mapping[str, Path],
    *,
    rtol: float,
    correct: bool = False,
    longest: float = math.inf,
    **_: Any,
) -> Run:
    """Run PyFMI's Master; ImportError where there is none."""
    from pyfmi import Master, load_fmu  # type: ignore[import-not-found]

    models = {c.name: load_fmu(str(paths[c.name]), log_level=2) for c in system.components}
    for part in system.components:
        for name, value in numbers(paths[part.name], part.parameters).items():
            models[part.name].set(name, value)
        for name, value in part.starts.items():
            models[part.name].set(name, value)
    wires = [(models[k.source], k.output, models[k.target], k.input) for k in system.links]
    master = Master(list(models.values()), wires)
    options = master.simulate_options()
    options.update(error_controlled=True, rtol=rtol, linear_correction=correct)
    options["result_handling"] = None
    if math.isfinite(longest):
        options["maxh"] = longest
    options["step_size"] = min(0.01, longest)
    begin = time.process_time()
    master.simulate(
        start_time=system.scene.start_time, final_time=system.scene.stop_time, options=options
    )
    seconds = time.process_time() - begin
    taken, refused = (master.statistics[key] for key in ("nsteps", "nreject"))
    return Run(float(models["transmission"].get("lock_time")[0]), taken, refused, seconds, 0.0)


HOSTS = {"own": own, "pyfmi": pyfmi}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hosts", nargs="*", default=list(HOSTS), help=", ".join(HOSTS))
    parser.add_argument("--rtol", type=float, nargs="+", default=[1e-3, 1e-4])
    parser.add_argument("--order", choices=("parallel", "serial"), default="parallel")
    parser.add_argument("--correct", action="store_true", help="settle the chain by slopes")
    parser.add_argument("--maxh", type=float, default=1e-3, help="longest step [s]; inf: any")
    parser.add_argument("--torque-age", type=int, help="default: 1 parallel, 0 serial")
    parser.add_argument("--lead", type=float, default=0.0, help="of the command [s]")
    parser.add_argument("--scene", default="planetary")
    parser.add_argument("--converged", type=float, help="lock-up to compare with [s]")
    given = parser.parse_args()
    scene = prepared(load_scene(given.scene))
    age = given.torque_age
    if age is None:
        age = 1 if given.order == "parallel" else 0
    system = structure(scene, torque_age=age, lead=given.lead)
    truth = given.converged
    if truth is None:
        finest = load_scene(given.scene).with_options(step=CONVERGED)
        truth = cosimulate(finest, direct(finest)).signals["transmission.lock_time"][-1]
    print(f"compared with lock-up at {truth:.7f} s")
    with fmus(system) as paths:
        for host in given.hosts:
            for rtol in given.rtol:
                try:
                    found = HOSTS[host](
                        system,
                        paths,
                        rtol=rtol,
                        order=given.order,
                        correct=given.correct,
                        longest=given.maxh,
                    )
                except ImportError as problem:
                    print(PYFMI if problem.name == "pyfmi" else problem)
                    break
                except Exception as problem:
                    print(f"{host} rtol {rtol:g}: failed: {problem}")
                    continue
                late = 1e3 * (found.lock_time - truth)
                print(
                    f"{host:8} rtol {rtol:g}  lock-up {found.lock_time:.7f} s ({late:+.4f} ms)  "
                    f"{found.taken} steps, {found.refused} refused  {found.seconds:.1f} s",
                    flush=True,
                )


if __name__ == "__main__":
    main()
