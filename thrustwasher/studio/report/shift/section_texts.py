"""What stands above the tables of the report's sections."""

from functools import partial

from ....shift.account.shift_record import Record
from ....units import format_quantity

say = partial(format_quantity, digits=3)
WARMS = 5.0  # [K] a rise from which on a pack does not stay cool
USUAL_TEXT = (
    "Ranges for power shifts in automatic transmissions of passenger cars. A figure outside them "
    "is marked; that is no fault: it says where this shift differs from most. What is called a "
    "rule of thumb has no source beyond engineering practice."
)


def temperature_texts(r: Record) -> list[str]:
    """Return what to know about the temperatures of a run."""
    other, values = r.releasing, r.series(f"{r.releasing}.temperature")
    washer, texts = r.part("washer"), []
    if r.presses(other) and values is not None and values.max() - values[0] < WARMS:
        heat = say(r.energy[other], "J") if r.energy[other] > 1.0 else "less than 1 J"
        texts.append(f"The {other} stays cool: it takes up {heat}, no more.")
    if washer:
        stores = washer.parameters.get("thermal_mode") == "transient"
        those = "bodies that store heat" if stores else "steady states"
        texts.append(f"Washer temperatures are those of {those}.")
    if r.part("mesh"):
        texts.append("Of the teeth: where they are hottest along the path of contact.")
    return [" ".join(texts)] if texts else []


def level_texts(r: Record) -> list[str]:
    """Return how levels were chosen, how far off they were and what was run again."""
    first = "A first run with the cheapest fidelity levels recorded the inputs to choose for."
    guard = r.guard
    if guard is None:
        return [first, "The choice was not checked after the run."]
    again = [*guard.again, *([guard.stopped] if guard.stopped else [])]
    texts = [
        first,
        "After the run the guard solved the next higher level at recorded points: those with the "
        "extremes, those after changes of regime, and others spread over the run.",
        *([f"{t[0].upper()}{t[1:]}." for t in again] or ["Nothing had to run again."]),
    ]
    if guard.again:
        texts.append(f"The earlier runs took {1e3 * guard.earlier_seconds:.3g} ms.")
    for check in guard.checks:
        if check.outside:
            texts.append(f"{check.part}, {check.fidelity}: {check.outside}.")
        texts += [f"{check.part}: {check.above} gave no solution {t}" for t in check.failed]
    return texts


def cost_texts(r: Record) -> list[str]:
    """Return how long the run took against what it simulated."""
    span = r.time[-1] - r.time[0]
    return [
        f"{say(r.wall_time, 's')} for {say(span, 's', digits=4)} of shift, "
        f"{span / r.wall_time:.2g} simulated seconds a second, without building and loading the "
        "FMUs. FMUs through FMPy; the time of a step includes setting inputs and reading outputs."
    ]


def simulated_texts(r: Record) -> list[str]:
    """Return what the scene is, and how it was stepped."""
    return [
        r.help,
        f"Communication step {say(r.step, 's', digits=4)}, master {r.master}. All values in SI "
        "units.",
    ]
