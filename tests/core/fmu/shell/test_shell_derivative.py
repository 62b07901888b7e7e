"""Derivatives: of the present point, of listed pairs only, and without a trace."""

import math

import pytest
from shell_runs import BEGUN, MADE, last, needs_gcc, putting, ref, run, taking, toy_library
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
LOAD, SPEED, OIL = (ref(n) for n in ("load", "speed", "oil_temperature"))
TORQUE, TEMPERATURE, ENERGY = (ref(n) for n in ("friction_torque", "temperature", "energy"))
POINT = putting(load=300.0, speed=0.7, oil_temperature=320.0)


def slopes():
    """Return the torque's derivatives with respect to load and speed, at POINT."""
    factor, coefficient, tanh = 0.5 * 0.15 * 2.0, 0.05 + 0.001 * 0.7, math.tanh(0.7)
    by_load = factor * coefficient * tanh
    return by_load, factor * 300.0 * (0.001 * tanh + coefficient * (1.0 - tanh**2))


@both
def test_pairs_that_are_not_listed_are_zero(fmi):
    for unknown, known in ((ENERGY, LOAD), (TEMPERATURE, SPEED), (TORQUE, OIL)):
        assert last(fmi, BEGUN + POINT + f"derive {unknown} {known} 1\n").values == [0.0]


@both
def test_they_belong_to_the_present_point_whatever_was_solved_before(fmi):
    ask = f"derive {TORQUE} {LOAD} 1\n"
    step = POINT + "step 0 1e-3\n"
    elsewhere = putting(load=1.0, speed=-5.0) + "step 1e-3 1e-3\n"
    failed = putting(load=9500.0) + "step 1e-3 1e-3\n" + putting(load=300.0)
    for before in (POINT, step, step + "save 0\n" + elsewhere + "restore 0\n", step + failed):
        found = last(fmi, BEGUN + before + ask).values[0]
        assert found == pytest.approx(slopes()[0], rel=1e-14)
    assert last(fmi, MADE + "enter 0\n" + POINT + ask).values[0] == found


@both
def test_at_a_fold_there_is_none_and_the_instance_lives_on(fmi):
    script = BEGUN + putting(load=5000.0) + f"derive {TORQUE} {LOAD} 1\n"
    reply = last(fmi, script)
    assert reply.status == 3 and "at the fold: SINGULAR" in reply.messages[-1]
    assert last(fmi, script + "step 0 1e-3\n").status == 0


@both
@pytest.mark.parametrize(
    ("question", "text"),
    [
        (f"{LOAD} {LOAD} 1", "load: derivatives are of real outputs"),
        (f"{TORQUE} {ENERGY} 1", "energy: derivatives are of real outputs"),
        (f"{ref('regime')} {LOAD} 1", "regime: derivatives are of real outputs"),
        (f"{TORQUE} {ref('inner_radius')} 1", "inner_radius: derivatives are of real outputs"),
        (f"{TORQUE} 99 1", "value reference 99 is unknown"),
        (f"{TORQUE} {LOAD} nan", "seed of the derivative is not finite"),
    ],
)
def test_what_has_no_derivative_is_named(fmi, question, text):
    reply = last(fmi, BEGUN + POINT + f"derive {question}\n")
    assert reply.status == 3 and text in reply.messages[-1]


def test_the_adjoint_ones_of_fmi_3_are_the_same_numbers_transposed():
    by_load, by_speed = slopes()
    reply = last(3, BEGUN + POINT + f"adjoint {LOAD} {TORQUE} 2\n")
    assert reply.values[0] == pytest.approx(2.0 * by_load, rel=1e-14)
    film = ref("film_ratio")
    both_of = last(3, BEGUN + POINT + f"adjoint {LOAD} {TORQUE} 2 {film} 1 {ENERGY} 5\n").values[0]
    alone = last(3, BEGUN + POINT + f"derive {film} {LOAD} 1\n").values[0]
    assert both_of == pytest.approx(2.0 * by_load + alone, rel=1e-13)
    assert last(3, BEGUN + POINT + f"adjoint {SPEED} {TORQUE} 1\n").values[0] == pytest.approx(
        by_speed, rel=1e-14
    )


RADIUS, DISCS = ref("outer_radius"), ref("discs")


@both
def test_until_the_initialization_ends_parameters_are_knowns_as_the_description_says(fmi):
    """Every real pair of InitialUnknowns can be requested; torque is as the mean radius."""
    torque = 0.5 * 0.15 * 2.0 * 300.0 * (0.05 + 0.001 * 0.7) * math.tanh(0.7)
    here = MADE + "enter 0\n" + POINT
    found = last(fmi, here + f"derive {TORQUE} {RADIUS} 1\n").values[0]
    assert found == pytest.approx(torque / 0.15, rel=1e-8)
    both_kinds = last(fmi, here + f"derive {TORQUE} {RADIUS} 2 {LOAD} 3\n").values[0]
    assert both_kinds == pytest.approx(2.0 * torque / 0.15 + 3.0 * slopes()[0], rel=1e-8)
    asked = f"derive {TORQUE} {RADIUS} 1\n"
    replies = [
        run(fmi, toy_library(), here + x + "leave\n" + taking(["friction_torque"]))
        for x in ("", asked)
    ]
    assert replies[0][-1].values == replies[1][-1].values
    assert last(fmi, BEGUN + asked).status == 3
    assert last(fmi, here + f"derive {TORQUE} {DISCS} 1\n").status == 3


@both
def test_a_host_may_name_all_that_an_output_depends_on_and_seed_one_of_them(fmi):
    """So hosts solve loops at the start: what counts nothing may be of any type."""
    here = MADE + "enter 0\n" + POINT
    parameters = [v.reference for v in interface(TOY).variables if v.causality == "parameter"]
    named = " ".join(f"{r} {int(r == RADIUS)}" for r in parameters)
    alone = last(fmi, here + f"derive {TORQUE} {RADIUS} 1 {SPEED} 0\n")
    found = last(fmi, here + f"derive {TORQUE} {named} {SPEED} 0\n")
    assert found.status == 0 and found.values == alone.values
    reply = last(fmi, here + f"derive {TORQUE} {RADIUS} 0 {DISCS} 1\n")
    assert reply.status == 3 and "discs: derivatives are of real outputs" in reply.messages[-1]


@both
def test_where_a_rule_is_near_the_difference_is_one_sided(fmi):
    near = putting(inner_radius=0.05, outer_radius=0.05 * (1.0 + 1e-7))
    reply = last(fmi, MADE + "enter 0\n" + POINT + near + f"derive {TORQUE} {RADIUS} 1\n")
    torque = 0.5 * 0.1 * 2.0 * 300.0 * (0.05 + 0.001 * 0.7) * math.tanh(0.7)
    assert reply.status == 0 and reply.values[0] == pytest.approx(torque / 0.1, rel=1e-5)
