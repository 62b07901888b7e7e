"""Whatever is asked of the Python functions: a right answer, or a refusal by name."""

import calls
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sizes

from examples import examples

randoms = st.randoms(use_true_random=False)


@pytest.fixture(scope="module", params=["clutch", "gearmesh", "washer"])
def model(request):
    """A model that answers a sane call after all the others as it did before."""
    before = calls.sane_bits(request.param)
    yield request.param
    assert calls.sane_bits(request.param) == before


@sizes(20, 80, pytest.mark.abuse)
def test_any_call_is_answered_right_or_refused_by_name(model, n):
    @examples(n)
    @given(rng=randoms)
    def one(rng):
        calls.solve_once(model, rng)

    one()
