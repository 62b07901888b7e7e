"""Whatever a master does to an instance: right outputs or a named error, and it lives on."""

import calls
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sizes

from examples import examples
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

MOVES = 12
LEVELS = {"map": 10, "field": 1}  # of the washer: examples
walks = st.lists(st.randoms(use_true_random=False), min_size=MOVES, max_size=MOVES)


NATIVE, PYTHON = "native-fmi2", "python-fmi2"
MASTERS = [  # model, kind, parameters, examples; the first by default
    *((m, k, {}, 12) for m in ("clutch", "gearmesh", "transmission") for k in (NATIVE, PYTHON)),
    ("clutch", "native-fmi3", {}, 12),
    *(("washer", k, {"fidelity": r}, n) for k in (NATIVE, PYTHON) for r, n in LEVELS.items()),
]


@pytest.mark.parametrize(
    ("model", "kind", "parameters", "n"),
    [MASTERS[0], *(pytest.param(*one, marks=pytest.mark.abuse) for one in MASTERS[1:])],
)
def test_a_wild_master_gets_right_outputs_or_named_errors(model, kind, parameters, n, instance_of):
    instance = instance_of(model, kind, parameters)

    @examples(n)
    @given(rngs=walks)
    def wild(rngs):
        instance.reset()
        judged = calls.Walk(find_spec(model), instance)
        for rng in rngs:
            judged.move(rng)
        assert sum(judged.counts.values()) == len(rngs)

    wild()


@sizes(8, 40, pytest.mark.abuse)
@pytest.mark.parametrize("model", ["clutch", "gearmesh", "transmission"])
def test_any_parameters_run_or_are_refused_by_name(model, n):
    @examples(n)
    @given(rng=st.randoms(use_true_random=False))
    def one(rng):
        calls.run_once(model, rng, lambda spec, changed: DirectInstance(spec, parameters=changed))

    one()
