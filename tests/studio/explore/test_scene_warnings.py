"""The page's warnings are those of Python's loop, word for word, but for checks by further runs."""

import functools

import numpy as np
import pytest
from pages import node
from scene_pages import nominal, page_runs, python_run, scene_file, told

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.shift import load_scene

TIED = [[0.1, 0], [0.11, 4e4], [0.2, 4e4], [0.422, 5.61e5], [0.79, 3.41e5]]
TIED = {"clutch_pressure": [*TIED, [0.865, 3.46e5], [0.935, 7.2e5]]}
FULL = [[0, 253], [0.42, 253], [0.46, 188], [0.79, 188], [0.83, 250], [0.87, 253]]  # engine torque
WEAK = [
    {"brake_pressure": [[0, 2e5], [0.16, 2e5], [0.2, 1.8e5], [0.36, 8e4], [0.38, 0]]},
    {"clutch_pressure": [[0.1, 0], [0.11, 4e4], [0.2, 4e4], [0.4, 2.3e5]]},
    {
        "clutch_pressure": [[0.1, 0], [0.11, 4e4], [0.2, 4e4], [0.4, 1.3e5], [0.97, 1.7e5]],
        "engine_torque": FULL,
    },
]
OUTSIDE = ("judder", "chatter", "The brake is let go", "The clutch is let go")


def drawn_profiles(n, seed):
    """Return profiles of the default scene far off its own, the same each time."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(n):
        profiles = {}
        for name, known in told("planetary")["profiles"].items():
            t, x = np.array(known["points"]).T
            t = np.sort(t + np.r_[rng.uniform(-0.4, 0.4, len(t) - 1) * np.diff(t), 0.0])
            t = np.maximum.accumulate(t + 1e-3 * np.arange(len(t)))
            x = np.minimum(x * rng.uniform(0.5, 1.6, len(x)), known["max"])
            profiles[name] = np.column_stack((t, x)).tolist()
        found.append(profiles)
    return found


def at_once(result):
    """Return what Python warns of without the checks after a run, and without oscillations."""
    return [w for w in result.warnings if not any(word in w for word in OUTSIDE)]


@functools.cache
def of_profiles():
    every = [TIED, *WEAK, *drawn_profiles(10, 5)]
    return every, page_runs("planetary", [{"profiles": p, "washers": ""} for p in every])


@node
@pytest.mark.parametrize("k", range(14))
@pytest.mark.slow
def test_profiles_give_the_warnings_of_pythons_loop(k, tmp_path):
    every, found = of_profiles()
    try:
        wanted = at_once(python_run(scene_file(tmp_path, "planetary", every[k]), []))
    except (ParameterError, SolveError) as problem:
        assert found[k]["problem"] == str(problem)
    else:
        assert found[k]["warnings"] == wanted


@node
@pytest.mark.slow
def test_a_tie_up_is_seen_in_the_page():
    _, (found, *_) = of_profiles()
    assert any(w.startswith("Tie-up: from ") for w in found["warnings"])


@node
def test_a_weak_pack_is_the_first_word_in_the_page():
    _, found = of_profiles()
    for one, pack in zip(found[1:3], ("brake", "clutch"), strict=True):
        assert one["warnings"][0].startswith(f"The {pack} is too weak for ")
    assert "; The clutch is too weak for second gear: " in found[3]["problem"]


@node
def test_many_warnings_occur_in_these_profiles():
    _, found = of_profiles()
    assert len({key for one in found for key in one.get("keys", ())}) >= 5


@node
@pytest.mark.parametrize(
    "name",
    [
        "planetary-cold",
        "planetary-distressed",
        "planetary-sun",
        "msl",
        "judder-damped",
        "brake-test",
    ],
)
@pytest.mark.slow
def test_built_in_scenes_give_the_warnings_of_their_own_run(name):
    (found,) = page_runs(name, [{"washers": ""}])
    assert found["warnings"] == at_once(nominal(name))


@node
@pytest.mark.slow
def test_a_run_that_fails_says_that_no_pack_held(tmp_path):
    known = told("planetary")["profiles"]
    open_ = {n: [[t, 0.0] for t, _ in known[n]["points"]] for n in known if "pressure" in n}
    (found,) = page_runs("planetary", [{"washers": "", "profiles": open_}])
    with pytest.raises((ParameterError, SolveError)) as failed:
        python_run(scene_file(tmp_path, "planetary", open_), [])
    assert found["problem"] == str(failed.value)
    assert "no pack held" in found["problem"]


def test_what_only_a_run_outside_of_the_page_can_check_is_named():
    about = told("planetary")["warnings"]
    assert "the error of the communication step" in about["checked_outside"]
    assert load_scene("planetary").warnings == tuple(about["of_scene"])
