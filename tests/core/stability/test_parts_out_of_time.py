"""A scene whose parts disagree in time, or belong to another scene.

Hazard: instances of one model are alike in all they show. One that was stepped before goes on
    from its old film and heat; one made for another scene answers with other friction: the run
    ends without a complaint, its heat off by a factor.
Formula: a run is a function of scene and start only: the same scene twice gives the same bits.
Cure: an instance that was stepped is not initialized again before a reset, and the parameters of
    every instance are compared with the scene's; both are refused with part, value and remedy.
"""

from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import cosimulate, load_scene


def small(name="planetary-sun", **options):
    """Return a scene without washer and mesh, which are slow to compile."""
    scene = load_scene(name).with_options(**options)
    parts = {n: p for n, p in scene.parts.items() if n not in ("washer", "mesh")}
    gearbox = parts["transmission"]
    parts["transmission"] = replace(gearbox, params=replace(gearbox.params, washers=0))
    return replace(scene, parts=parts)


def instances(scene):
    return {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in scene.parts.items()}


SCENE = small(step=5e-3, stop_time=0.3)


def test_the_same_instances_again_are_refused_until_they_are_reset():
    made = instances(SCENE)
    first = cosimulate(SCENE, made)
    with pytest.raises(SolveError, match=r"transmission at t = 0 s: .*stands at t = 0\.3 s.*reset"):
        cosimulate(SCENE, made)
    for instance in made.values():
        instance.reset()
    again = cosimulate(SCENE, made)
    for name, values in first.signals.items():
        assert np.array_equal(values, again.signals[name]), name


@pytest.mark.parametrize("part", ["clutch", "brake", "transmission"])
def test_one_part_that_is_ahead_is_named(part):
    made = instances(SCENE)
    made[part].initialize(0.0, {"oil_temperature": 297.15} if part != "transmission" else {})
    for i in range(10):
        made[part].step(1e-2 * i, 1e-2)
    with pytest.raises(SolveError, match=rf"{part} at t = 0 s: .*stands at t = 0\.1 s"):
        cosimulate(SCENE, made)


def test_a_state_taken_over_from_a_run_counts_as_having_run():
    made, other = instances(SCENE), instances(SCENE)
    cosimulate(SCENE, made)
    other["clutch"].set_state(made["clutch"].get_state())
    with pytest.raises(SolveError, match="clutch at t = 0 s"):
        cosimulate(SCENE, other)


@pytest.mark.parametrize(
    ("part", "change"),
    [
        ("clutch", {"fidelity": "stribeck"}),
        ("brake", {"friction_law": "constant"}),
        ("transmission", {"coupling": "torque"}),
        ("clutch", {"starts_pressed": False}),
        ("transmission", {"torque_age": 1.0}),
        ("clutch", {"roughness": 8.4100001e-6}),
    ],
)
def test_any_other_parameter_is_found(part, change):
    made = instances(SCENE)
    made[part] = DirectInstance(
        SCENE.parts[part].spec, parameters=SCENE.parts[part].parameters() | change
    )
    with pytest.raises(ParameterError, match=rf"{part}: .*{next(iter(change))}"):
        cosimulate(SCENE, made)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        (
            lambda made: made | {"clutch": instances(small("msl"))["clutch"]},
            r"clutch: .* faces = 1, scene 'planetary-sun' has 8",
        ),
        (lambda made: made | {"clutch": made["transmission"]}, "clutch: the instance has the inp"),
        (lambda made: {n: x for n, x in made.items() if n != "brake"}, "brake missing"),
    ],
    ids=["another scene's", "another model's", "none"],
)
def test_an_instance_that_is_not_the_scenes_is_named(changed, said):
    with pytest.raises(ParameterError, match=said):
        cosimulate(SCENE, changed(instances(SCENE)))


def test_a_scene_may_begin_at_any_time_and_all_parts_with_it():
    late = replace(SCENE, start_time=10.0, stop_time=10.3, shift_start=10.1)
    first, second = cosimulate(SCENE, instances(SCENE)), cosimulate(late, instances(late))
    heat = "transmission.clutch_heat"
    assert second.signals[heat][-1] == pytest.approx(first.signals[heat][-1], rel=1e-9)
    assert second.time[0] == 10.0


@pytest.mark.parametrize("h", [0.0, -1e-3, float("nan"), float("inf")])
def test_a_step_to_nowhere_is_refused_and_the_next_one_goes_on(h):
    pack = instances(SCENE)["clutch"]
    pack.initialize(0.0, {"oil_temperature": 297.15})
    pack.step(0.0, 1e-3)
    told = pack.output_names.index("solver_status")  # it tells of the refusal

    def shown():
        return [x for i, x in enumerate(pack.outputs()) if i != told]

    before = shown()
    with pytest.raises(ParameterError, match="step from t"):
        pack.step(1e-3, h)
    assert shown() == before
    pack.step(1e-3, 1e-3)
