"""How many substeps a step takes where load and slip jump, and what heat it books then."""

import pytest
from clutch_pack import Pack

from lab.realtime.walk import Walk
from thrustwasher import ClutchParams
from thrustwasher.clutch.kernels import layout as k
from thrustwasher.model.registry import find_spec


@pytest.mark.parametrize(("level", "most", "mean"), [("field", 42, 2.0), ("fine", 42, 2.3)])
def test_no_step_of_a_walk_with_jumps_takes_many_substeps(level, most, mean):
    """Refused ones count. The most where oil is torn: a film passes from 1e5 to 10 1/s there."""
    counts, pack = [], Pack(level, made=ClutchParams)
    piece = Walk(find_spec("clutch"), 7).piece(20_000)
    for row, h, again in zip(piece.inputs.tolist(), piece.sizes, piece.restarts, strict=True):
        if again:
            pack = Pack(level, made=ClutchParams)
        assert pack.step(row[0], row[1], float(h), row[2], row[3]) == 0
        counts.append(pack.work[k.W_SUBSTEPS] + pack.work[k.W_REFUSED])
    assert max(counts) <= most
    assert sum(counts) < mean * len(counts)


@pytest.mark.parametrize("load", [300.0, 7600.0])
@pytest.mark.parametrize("level", ["field", "fine"])
def test_one_long_step_from_open_books_the_heat_of_many_short_ones(level, load):
    """The film is squeezed out in the first thousandth of the step, while oil shears the most."""
    ends = []
    for n in (1, 1000):
        pack = Pack(level, made=ClutchParams, holding="off")
        for _ in range(n):
            assert pack.step(load, 60.0, 2.0 / n, 350.0) == 0
        made, stored = pack.out[k.O_ENERGY], pack.out[k.O_STORED_HEAT]
        assert made == pytest.approx(stored + pack.out[k.O_OIL_ENERGY], rel=1e-12)
        if n == 1:
            assert made == pytest.approx(stored + 2.0 * pack.out[k.O_OIL_HEAT], rel=1e-9)
        ends.append((made, stored))
    assert ends[0] == pytest.approx(ends[1], rel=2e-5)
