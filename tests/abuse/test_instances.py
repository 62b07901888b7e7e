"""Whatever a master does to an instance: right outputs or a named error, and it lives on."""

import calls
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sizes

from examples import examples
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

KINDS = [
    (model, kind)
    for model in ("clutch", "gearmesh", "transmission")
    for kind in ("native-fmi2", "python-fmi2")
]
MOVES = 12
walks = st.lists(st.randoms(use_true_random=False), min_size=MOVES, max_size=MOVES)


def walk(spec, instance, rngs):
    judged = calls.Walk(spec, instance)
    for rng in rngs:
        judged.move(rng)
    assert sum(judged.counts.values()) == len(rngs)


@pytest.mark.parametrize(
    ("model", "kind"),
    [
        KINDS[0],
        *(
            pytest.param(*one, marks=pytest.mark.abuse)
            for one in [*KINDS[1:], ("clutch", "native-fmi3")]
        ),
    ],
)
def test_a_wild_master_gets_right_outputs_or_named_errors(model, kind, instance_of):
    instance = instance_of(model, kind)

    @examples(12)
    @given(rngs=walks)
    def wild(rngs):
        instance.reset()
        walk(find_spec(model), instance, rngs)

    wild()


@pytest.mark.abuse
@pytest.mark.parametrize("kind", ["native-fmi2", "python-fmi2"])
@pytest.mark.parametrize(("rung", "n"), [("map", 10), ("field", 1)])
def test_a_wild_master_of_a_washer_too(rung, n, kind, instance_of):
    instance = instance_of("washer", kind, {"fidelity": rung})

    @examples(n)
    @given(rngs=walks)
    def wild(rngs):
        instance.reset()
        walk(find_spec("washer"), instance, rngs)

    wild()


@sizes(8, 40, pytest.mark.abuse)
@pytest.mark.parametrize("model", ["clutch", "gearmesh", "transmission"])
def test_any_parameters_run_or_are_refused_by_name(model, n):
    @examples(n)
    @given(rng=st.randoms(use_true_random=False))
    def one(rng):
        calls.run_once(model, rng, lambda spec, changed: DirectInstance(spec, parameters=changed))

    one()
