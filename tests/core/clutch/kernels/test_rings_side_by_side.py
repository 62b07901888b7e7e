"""Rings side by side, and the heat of a pack that holds: the same rates as one by one."""

import numpy as np
import pytest
from clutch_pack import Pack

from thrustwasher import ClutchParams
from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.rates import pack_rates
from thrustwasher.tribology.viscosities import straight_viscosity

DRAW = np.random.default_rng(1)
GIVEN = [k.R_POWER + i for i in range(6)]  # what stands in place of a pack's own heat


def test_compiled_rings_side_by_side_have_the_bits_of_one_after_another():
    pack = Pack("fine", made=ClutchParams)
    for _ in range(20):
        pack.work[k.W_SURFACE : k.W_SURFACE + 4] = DRAW.uniform(230.0, 600.0, 4)
        pack_rates(pack.par, 3000.0, 50.0, 10.0, 1.5, pack.work, k.W_NEIGHBOUR)
        law = pack.par[[k.P_VISCOSITY_SCALE, k.P_VISCOSITY_CONSTANT, k.P_VISCOSITY_EXPONENT]]
        for i in range(4):
            one = straight_viscosity(float(pack.work[k.W_SURFACE + i]), *law.tolist())
            assert pack.work[k.W_VISCOSITY + i] == one[0]
            assert pack.work[k.W_VISCOSITY_SLOPE + i] == one[1]


@pytest.mark.parametrize("level", ["field", "fine"])
@pytest.mark.parametrize("load", [0.0, 30.0, 3000.0, 20000.0])
def test_the_film_of_a_pack_whose_heat_is_given_moves_as_that_of_one_that_makes_it(level, load):
    """Film, cooling and their slopes; of the powers the shares of what is given are left."""
    pack, rings = Pack(level, made=ClutchParams), 4 if level == "fine" else 1
    for u in (-35.0, -2.0, 0.05, 1.3, 4.0, 9.0, 60.0):
        found = []
        for given in (0.0, 1.0):
            pack.work[k.W_SURFACE : k.W_SURFACE + 4] = 300.0, 340.0, 380.0, 420.0
            pack.work[k.W_GIVEN], pack.work[k.W_GIVEN_POWER] = given, 70.0
            pack.work[k.W_GIVEN_SLOPE] = 0.0
            pack.work[k.W_RING_SHARE : k.W_RING_SHARE + 4] = 0.4, 0.3, 0.2, 0.1
            pack_rates(pack.par, load, -40.0, 25.0, u, pack.work, k.W_NEIGHBOUR)
            found.append(pack.work[k.W_NEIGHBOUR : k.W_NEIGHBOUR + k.N_RATES].copy())
        own, other = (rates[k.R_RINGS :].reshape(-1, k.N_OF_RING)[:rings] for rates in found)
        film = [rates[: k.R_RINGS] for rates in found]
        assert film[1] == pytest.approx(film[0], rel=1e-13, abs=0.0)
        rest = [i for i in range(k.N_OF_RING) if i not in [*GIVEN, k.R_EXCESS]]
        assert other[:, rest] == pytest.approx(own[:, rest], rel=1e-12, abs=0.0)
        shares = [0.4, 0.3, 0.2, 0.1][:rings]
        assert other[:, k.R_POWER] == pytest.approx([70.0 * s for s in shares], rel=1e-15)
        assert not other[:, GIVEN[1:]].any()
