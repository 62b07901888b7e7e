"""How far a run is to be trusted, in sentences."""

from ...units import format_quantity as say
from . import shift_tables, summary
from .shift_record import PACKS, Record


def trust_texts(record: Record) -> list[str]:
    """Return what the numbers are worth."""
    book = record.energy
    prefix = "" if record.engaging == "clutch" else "brake_"
    texts = [
        f"Energy: the book closes to {book['residual_share']:.1e} of "
        f"{summary.whole_name(record)}. This is the error of the integration inside the driveline.",
        f"Coupling: the {record.engaging} FMU counts "
        f"{book[f'{prefix}coupling_difference_share']:.3%} more or less heat than the driveline. "
        "Both are right about their own step; the difference is the error of exchanging values "
        f"only every {say(record.step, 's')}{'' if record.steps is None else ' or less'} and "
        "shrinks with it.",
        *_packs(record),
    ]
    if record.part("washer") is not None:
        texts += _washer(record)
    if record.part("mesh") is not None:
        texts.append(_mesh())
    texts += shift_tables.source_texts(record)
    return [*texts, *(f"The run says: {message}." for message in record.messages)]


def _packs(record: Record) -> list[str]:
    """Return what the packs' film is worth at their fidelity."""
    sheared = _sheared(record)
    rungs = {part.parameters.get("fidelity") for part in record.parts
             if part.name in PACKS and record.presses(part.name)}  # fmt: skip
    if rungs == {"field"}:
        return [
            "Clutch and brake: film and interface temperature are states of their own. The film "
            "is squeezed out of smooth rings with a permeable lining; grooves are one factor. All "
            "heat goes into the steel plates, so that interface temperatures are rather too high.",
            *sheared,
        ]
    return [
        "Clutch and brake: the oil film between the plates is always settled at this fidelity. "
        "Squeezing it out takes time and would delay the torque by roughly 0.05 to 0.2 s."
    ]


def _sheared(record: Record) -> list[str]:
    """Return which share of the heat is shear of the oil, and that nobody has measured it."""
    pack = record.engaging
    share = record.figures.get(f"{pack}_viscous_share")
    if not share:
        return []
    return [
        f"Shear of the oil: it makes {share:.0%} of the heat in the {pack} and carries torque from "
        "the beginning of the ramp, so that it decides how long the shift takes. It follows from "
        "film thickness, viscosity and the factor for grooves; no measurement of this or a similar "
        "pack stands behind it."
    ]


def _washer(record: Record) -> list[str]:
    """Return what the washer's numbers are worth."""
    from ...washer.parameters import SPEC

    part = record.part("washer")
    given = part.parameters if part else {}
    rung = str(given.get("fidelity", SPEC.default_fidelity))
    promise = SPEC.fidelities.get(rung, "")
    if given.get("thermal_mode") == "transient":
        heat = (
            "Carrier, washer and gear store heat, each with one temperature across its thickness: "
            "a thick body's face warms up earlier than that says, its back later."
        )
    else:
        heat = (
            "The washer is quasi-steady, every step is a steady state: while its bodies warm up, "
            "its temperatures are an upper bound, and its film is rather thicker in truth."
        )
    return [
        f"Washer, fidelity {rung}: {promise}. {heat}",
        "Washer's size: the published 45 mm washer does not fit a planet of a car-sized set; a "
        "scene that wants it to fit uses half the size. What is used stands in the parameters.",
    ]


def _mesh() -> str:
    """Return what the gear mesh's numbers are worth."""
    return (
        "Gear mesh: closed forms at the start of contact; the bulk of the teeth has the oil's "
        "temperature. A helical pair is taken as a spur pair in its transverse section, one of "
        "which carries the whole load: helical teeth share it, so that true contact stress is "
        "lower. The endurance limits are those of two through-hardened steels. The ring mesh's "
        "loss follows from the sun mesh's."
    )
