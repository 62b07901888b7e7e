"""Kernels import nothing from above and repeat status numbers; here they are compared."""

from thrustwasher.clutch.kernels import pack_friction
from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels import layout
from thrustwasher.model.spec import REGIMES
from thrustwasher.numerics import status


def test_status_numbers_are_those_of_the_enumeration():
    numbers = {name: value for name, value in vars(status).items() if name.isupper()}
    assert numbers == dict(Status.__members__)


def test_regimes_count_from_1_in_the_order_of_the_list():
    numbers = [getattr(pack_friction, n.upper()) for n in REGIMES]
    assert numbers == [1, 2, 3, 4]
    mesh = [getattr(layout, n.upper()) for n in REGIMES if n != "adhesive"]
    assert mesh == [1, 2, 3]
