"""What the numbers of a shift are worth, in sentences."""

from collections.abc import Iterator
from dataclasses import asdict
from functools import partial

from ....shift.account.shift_record import PACKS, Record
from ....units import format_quantity

say = partial(format_quantity, digits=3)
CLOSE = 1e-5  # a difference that is as good as none


def trust_texts(r: Record) -> list[str]:
    """Return what the numbers are worth, last where the defaults of the models come from."""
    docs = {p.spec.name: (p.spec.params.__doc__ or "").replace("``", "") for p in r.parts}
    return [
        f"Energy: the balance closes to {r.energy['residual_share']:.1e} of {r.whole_name}. This "
        "is the error of the integration inside the driveline.",
        _coupling(r),
        _step(r),
        *_packs(r),
        *_washer(r),
        *_meshes(r),
        *_thrust(r),
        *_washers(r),
        *_jerk(r),
        *(f"{model}. {' '.join(words.split())}" for model, words in docs.items()),
        *(f"The run says: {message}." for message in r.messages),
    ]


def _coupling(r: Record) -> str:
    prefix = "" if r.engaging == "clutch" else "brake_"
    off = abs(r.energy[f"{prefix}coupling_difference_share"])
    return (
        f"Coupling: the {r.engaging} FMU counts {'up to 0.001 %' if off < CLOSE else f'{off:.3%}'} "
        "more or less heat than the driveline. Both are right about their own step; the difference "
        f"is the error of exchanging values only every {say(r.step, 's', digits=4)} and shrinks "
        "with it."
    )


def _step(r: Record) -> str:
    error = r.step_error
    if error is None:
        return "Communication step: what it errs by was not checked."
    return (
        f"Communication step: it errs by about {error.words()}, found by a second run with "
        f"steps of {say(error.compared_with, 's', digits=4)}; lock-up time is "
        "counted from the start of the shift."
    )


def _packs(r: Record) -> Iterator[str]:
    used = [p for p in r.parts if p.name in PACKS and r.presses(p.name)]
    if {part.parameters.get("fidelity") for part in used} != {"field"}:
        yield (
            "Clutch and brake: the oil film between the plates is always settled at this fidelity. "
            "Squeezing it out takes time and would delay the torque by roughly 0.05 to 0.2 s."
        )
        return
    yield (
        "Clutch and brake: film and interface temperature are states of their own. The film is "
        "squeezed out between smooth lands of a permeable lining. Clearance, permeability and the "
        "cooling in the grooves are estimates unless measured."
    )
    if share := r.figures.get(f"{r.engaging}_viscous_share"):
        yield (
            f"Shear of the oil: it makes {share:.0%} of the heat in the {r.engaging} and carries "
            "torque before the faces touch. It follows from film thickness, viscosity and the "
            "grooves: an estimate, no measurement of this or a similar pack stands behind it."
        )


def _washer(r: Record) -> Iterator[str]:
    part = r.part("washer")
    if part is None:
        return
    given, spec = part.parameters, part.spec
    level = given.get("fidelity", spec.default_fidelity)
    text = f"Washer, fidelity {level}: {spec.fidelities.get(level, '')}."
    if given.get("thermal_mode") != "transient":
        text += " The washer is quasi-steady: every step is a steady state, whatever its bodies "
        text += f"store. {_steady_washer(r)}"
    else:
        text += " Carrier, washer and gear store heat."
        if given.get("body_storage") == "lumped":
            text += " Each has one temperature across its thickness: a thick body's face warms up "
            text += "earlier than that says, its back later."
    yield text
    yield (
        "Washer's size: the published 45 mm washer does not fit a planet of a car-sized set; a "
        "scene that wants it to fit uses half the size. What is used stands in the parameters."
    )


def _steady_washer(r: Record) -> str:
    """Return whether steady states hold for the washer in this run."""
    followed = r.in_time.get("washer")
    if followed is None:
        return "Whether steady states hold in this run was not checked."
    if followed.differences or followed.stopped:
        return "They do not hold throughout this run: see the warning above."
    return (
        f"After the run it was followed in time along the recorded inputs, at {len(followed.time)} "
        "instants: torque, film and hottest spot stay close to the steady states."
    )


def _meshes(r: Record) -> Iterator[str]:
    if not r.part("mesh"):
        return
    if r.rated_teeth:
        yield (
            "Gear mesh: all of the loss heats the flanks, along the whole path of contact. The "
            "formulas of the safeties are as standards are publicly quoted, their own text was not "
            "at hand: estimates, no rating by a standard, and for the load of this run, not for a "
            "life."
        )
    else:
        yield (
            "Gear mesh: closed forms at the start of contact; the bulk of the teeth has the oil's "
            "temperature. One pair carries the whole load: where teeth share it, true contact "
            "stress is lower. The endurance limits are those of two through-hardened steels."
        )
    if not r.part("ring_mesh"):
        yield "The ring mesh's loss follows from the sun mesh's: an estimate."


def _thrust(r: Record) -> Iterator[str]:
    """Yield what the thrust of sun and ring rests on; nothing where no bearing takes it."""
    part, most = r.part("transmission"), r.figures.get("peak_sun_thrust")
    p, rests = asdict(part.params()) if part else {}, []
    for gear in ("sun", "ring"):
        if friction := p.get(f"{gear}_bearing_coefficient"):
            names = (f"{gear}_bearing_{n}" for n in ("shaft_1", "shaft_2", "mean_radius"))
            one, two, radius = map(p.__getitem__, names)
            place = f"(friction {friction} at {say(radius, 'm')})"
            rests.append(f"{gear}'s between {one} and {two} {place}")
    if rests and most:
        yield (
            "Axial thrust: the teeth press sun and ring against each other's side with up to "
            f"{say(most, 'N')}; the planets are in balance. Needle thrust bearings take it, the "
            f"{', the '.join(rests)}. Their friction is an estimate."
        )


def _washers(r: Record) -> Iterator[str]:
    """Yield where the washers' load comes from."""
    part, most = r.part("transmission"), r.figures.get("peak_washer_load")
    if not part or not r.part("washer") or most is None:
        return
    p = part.params()
    if p.needle_count:
        yield (
            f"The washers' load, up to {say(most, 'N')}, is what {p.needle_count} needles with "
            f"{say(p.needle_clearance, 'm')} of radial clearance leave of a planet's tilting "
            f"couple from where it touches in its end play of {say(p.end_play, 'm')}."
        )
    else:
        yield (
            f"The washers' load, up to {say(most, 'N')}, is a share of a planet's tilting couple "
            f"(thrust_share = {p.thrust_share:g}), which decides here: an estimate of what needles "
            "that run askew bring. The model of a planet on its needles (needle_count above 0), if "
            "its play is usual, leaves them none."
        )


def _jerk(r: Record) -> Iterator[str]:
    if r.reach is not None:
        yield (
            "Jerk and acceleration are those of a vehicle without seats, tyres and mounts, which "
            "soften them."
        )
