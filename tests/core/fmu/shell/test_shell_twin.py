"""The shell and the Python core answer alike, to the bit and to the word, whatever is asked."""

import math
import random

import pytest
from shell_runs import GUID, needs_gcc, run, toy_library
from toy.spec import SPEC as TOY
from twin import Twin

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
H = 1e-3
GOOD = {"load": 500.0, "speed": 20.0, "oil_temperature": 310.0, "heat_capacity": 100.0}
VALUES = {
    "load": [0.0, 1.0, 800.0, 4000.0, 9000.0, 9500.0, -1.0, math.nan, math.inf, -0.0],
    "speed": [0.0, 20.0, -300.0, 777.0, 1000.0, 1001.0, -math.inf],
    "oil_temperature": [300.0, 24.0, 0.0, 473.15, 233.15],
    "discs": [3, 13, 21], "law": [1, 2, 3], "heat_capacity": [1.0, 50.0], "dry": [0, 1],
    "inner_radius": [0.02, 0.3, 1e-5, 2e6], "outer_radius": [0.1, 1.5],
}  # fmt: skip


def wander(twin, rng, n):
    """Ask n things at random, good and bad ones."""
    t = 0.0
    for _ in range(n):
        what = rng.random()
        if what < 0.45:
            names = rng.sample(list(VALUES), rng.choice([1, 1, 2, 3]))
            if twin.core.mode >= 2 and rng.random() < 0.9:
                names = [n for n in names if n in GOOD] or ["load"]
            if twin.core.refused:
                twin.put(**GOOD)
            twin.put(**{name: rng.choice(VALUES[name]) for name in names})
        elif what < 0.65:
            twin.take()
        elif what < 0.9 and twin.core.mode == 2:
            h = rng.choice([H, H, 1e-2, 1e-9, 0.0, -H, math.nan, math.inf])
            t = rng.choice([twin.core.time, twin.core.time, t, math.nan])
            if not (twin.core.refused and 0.0 < h < math.inf and math.isfinite(t)):
                twin.step(t, h)
        elif what < 0.93:
            twin.save(rng.randrange(3))
        elif what < 0.96 and twin.states and not twin.core.refused:
            slot = rng.choice(list(twin.states))
            if not len(twin.states[slot].refused):
                twin.restore(slot)
        elif what < 0.97:
            twin.reset()
        elif twin.core.mode == 0:
            twin.begin(rng.choice([0.0, 2.5]))
        elif twin.core.mode == 1:
            twin.leave()


@both
@pytest.mark.parametrize("seed", range(6))
def test_the_core_and_the_shell_answer_alike_to_whatever_is_asked(fmi, seed):
    twin = Twin(TOY, GUID)
    rng = random.Random(seed)
    wander(twin, rng, 100)
    if twin.core.mode == 0:
        twin.begin()
    if twin.core.mode == 1:
        twin.put(**GOOD, discs=2, law=1, dry=0, inner_radius=0.05, outer_radius=0.1)
        twin.leave()
    wander(twin, rng, 800)
    replies = run(fmi, toy_library(), twin.script)
    twin.check(replies)
    assert sum(r.status == 0 for r in replies) > 100 and sum(r.status == 3 for r in replies) > 50
