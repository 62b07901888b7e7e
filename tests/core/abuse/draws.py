"""Random values, sane and not: the whole legal range, its ends, just outside, and no numbers."""

import math
from dataclasses import fields

from thrustwasher.units import SHARE, ULPS

NO_NUMBERS = (math.nan, math.inf, -math.inf, 1e300, -1e300, 1.7976931348623157e308)
TINY = (0.0, -0.0, 5e-324, -5e-324, 2.2e-308, -2.2e-308, 1e-200)


def inside(rng, low, high):
    """Return a legal value: an end, next to nothing, even over the range or over its decades."""
    kind = rng.randrange(8)
    if kind == 0:
        return rng.choice([low, high])
    if kind == 1:
        return rng.choice([x for x in TINY if low <= x <= high] or [low])
    if kind < 5:
        return rng.uniform(low, high)
    if low > 0.0:
        return min(max(low * (high / low) ** rng.random(), low), high)
    size = 10.0 ** -rng.uniform(0.0, 9.0)
    return rng.choice([low, high]) * size


def outside(rng, low, high):
    """Return a value that has to be refused: what rounding alone puts outside is taken."""
    size = max(abs(low), abs(high))
    room = min(ULPS * math.ulp(1.0) * size, SHARE * (high - low))
    beside = [
        math.nextafter(low - 2.0 * room, -math.inf),
        math.nextafter(high + 2.0 * room, math.inf),
    ]
    far = [low - 1.0 - abs(low), high + 1.0 + abs(high)]
    return rng.choice([*beside, *far, *(x for x in NO_NUMBERS if not low <= x <= high)])


def point(rng, signals, share=0.3):
    """Return values of all inputs by name, and whether all are legal."""
    values = {s.name: inside(rng, s.low, s.high) for s in signals}
    if rng.random() >= share:
        return values, True
    bad = rng.choice(signals)
    values[bad.name] = outside(rng, bad.low, bad.high)
    return values, False


def settings(rng, spec, share=0.2):
    """Return changed parameters by name, and whether each alone is legal."""
    known = fields(spec.params)
    chosen = rng.sample(range(len(known)), rng.choice([0, 1, 1, 2, 3, 5]))
    values = {known[k].name: _parameter(rng, known[k].metadata) for k in chosen}
    numbers = [known[k] for k in chosen if known[k].metadata["kind"] == "real"]
    if not numbers or rng.random() >= share:
        return values, True
    bad = rng.choice(numbers)
    values[bad.name] = outside(rng, bad.metadata["min"], bad.metadata["max"])
    return values, False


def _parameter(rng, meta):
    if meta["kind"] == "enumeration":
        return rng.choice(list(meta["options"]))
    if meta["kind"] == "boolean":
        return rng.choice([True, False])
    if meta["kind"] == "integer":
        return rng.choice(
            [int(meta["min"]), int(meta["max"]), rng.randint(int(meta["min"]), int(meta["max"]))]
        )
    return inside(rng, meta["min"], meta["max"])
