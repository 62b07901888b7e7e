"""A whole shift run by the page's scripts: the numbers of Python's loop, errors with names."""

import base64
import functools
import hashlib
import json
import re
import textwrap
from pathlib import Path

import numpy as np
import pytest
from pages import node
from scene_pages import html, nominal, page_runs, python_figures, python_run, scene_file, told

from thrustwasher import cli
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.shift import load_scene
from thrustwasher.shift.expressions import FUNCTIONS
from thrustwasher.studio import report
from thrustwasher.studio.explore.scene_data import checked, started
from thrustwasher.studio.explore.scene_page import scene_page

SAME = 1e-9
LARGEST = 2_500_000  # bytes of a page
KISS = {"clutch_pressure": [[0.1, 0.0], [0.11, 6e4], [0.2, 6e4], [0.4, 3.2e5], [0.935, 7.2e5]]}


def test_the_page_knows_the_functions_of_rules_that_python_knows():
    """``and`` and ``or`` are written as functions in the page alone."""
    script = Path(report.__file__).parent / "web" / "scene" / "expressions.js"
    body = re.search(r"(?s)const FUNCTIONS = \{\n(.*?)\n\};", script.read_text("utf-8"))[1]
    names = set(re.findall(r'(?m)^  "?([^\s":,}]+)"?[:,]', body))
    assert names - {"and", "or"} == set(FUNCTIONS)


def drawn_profiles(n):
    """Return profiles of the default scene with all points moved, the same each time."""
    rng, found = np.random.default_rng(5), []
    for _ in range(n):
        profiles = {}
        for name, known in told("planetary")["profiles"].items():
            t, x = np.array(known["points"]).T
            t = t + np.r_[rng.uniform(0.0, 0.4, len(t) - 1) * np.diff(t), 0.0]
            x = x * rng.uniform(0.9, 1.1, len(x))
            profiles[name] = np.column_stack((t, x)).tolist()
        found.append(profiles)
    return found


def assert_same(found, wanted, rel=SAME):
    for name, value in wanted.items():
        if value is None:
            assert found.get(name) is None, name
        else:
            assert found[name] == pytest.approx(value, rel=rel, abs=1e-9), name


@pytest.mark.slow
@node
def test_profiles_give_the_figures_of_pythons_loop(tmp_path):
    every = drawn_profiles(3)
    found = page_runs("planetary", [{"profiles": p, "washers": "map"} for p in every])
    for profiles, one in zip(every, found, strict=True):
        path = scene_file(tmp_path, "planetary", profiles)
        assert_same(one["figures"], python_figures(path, ["washer=map"]))


@node
@pytest.mark.parametrize("name", ["planetary-downshift", "msl", "brake-test", "planetary-shuffle"])
@pytest.mark.slow
def test_built_in_scenes_give_the_figures_of_their_own_run(name):
    (found,) = page_runs(name, [{"washers": ""}])
    assert_same(found["figures"], started(nominal(name)))


@node
@pytest.mark.slow
def test_recorded_washers_give_the_run_they_are_from():
    (found,) = page_runs("planetary", [{"washers": "recorded"}])
    assert_same(found["figures"], started(nominal("planetary")))


@node
@pytest.mark.slow
def test_a_run_knows_nothing_of_those_before():
    runs = [{"washers": "map"}, {"washers": "map", "profiles": KISS}, {"washers": "map", "draw": 3}]
    first, _, _, again = page_runs("planetary", [*runs, {"washers": "map"}])
    assert again == first


@node
def test_what_fails_names_part_time_and_reason():
    backwards = {"clutch_pressure": [[0.2, 0.0], [0.1, 1e5]]}
    beyond = {"engine_torque": [[0.0, 1e5]]}
    order, speed = page_runs(
        "planetary", [{"washers": "map", "profiles": p} for p in (backwards, beyond)]
    )
    assert order["problem"].startswith("transmission: clutch_pressure")
    assert re.match(r"\w+ at t = [\d.]+ s: ", speed["problem"])


@pytest.mark.parametrize("name", ["planetary", "msl"])
def test_a_page_is_small_and_takes_nothing_from_outside(name):
    text = html(name)
    assert len(text.encode()) <= LARGEST
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', text)[1].replace("&#39;", "'")
    assert policy.startswith("default-src 'none';") and "http" not in policy
    for tag in ("script", "style"):
        found = re.search(rf"(?s)<{tag}>(.*?)</{tag}>", text)
        digest = base64.b64encode(hashlib.sha256(found[1].encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy


def test_the_page_has_the_figures_of_the_start_in_full():
    text = html("planetary")
    for name, value in started(nominal("planetary")).items():
        assert f'<data id="{name}" value="{value!r}">' in text


def test_profiles_are_those_of_the_file_and_its_factor_stands_beside_them(tmp_path):
    path = tmp_path / "more.toml"
    path.write_text('base = "planetary"\n[pressure.clutch]\nscale = 1.1\n', "utf-8")
    scene = load_scene(str(path))
    known = told("planetary")["profiles"]["clutch_pressure"]
    from thrustwasher.studio.explore.scene_data import _profiles

    own = _profiles(scene)["clutch_pressure"]
    assert own["points"] == [tuple(p) for p in known["points"]] and own["factor"] == 1.1


def test_a_scene_of_several_shifts_has_no_page():
    with pytest.raises(ParameterError, match=r"duty-cycle': it has a \[sequence\]"):
        scene_page(load_scene("duty-cycle"))


def test_a_master_that_changes_inputs_has_no_page():
    with pytest.raises(ParameterError, match=r"allowed in a page: 'gauss-seidel' or 'jacobi'"):
        checked(load_scene("planetary").with_options(master="linearly-implicit"))


@pytest.mark.slow
def test_the_command_takes_scenes_models_and_files(tmp_path, capsys):
    scene = scene_file(tmp_path, "msl", {})
    part = tmp_path / "part.toml"
    part.write_text('model = "clutch"\nname = "Mine"\n', "utf-8")
    for target, title in (("msl", "Modelica Standard"), (str(scene), ""), (str(part), "Mine")):
        out = tmp_path / "page.html"
        assert cli.main(["explore", target, "--out", str(out)]) == 0
        assert title in out.read_text("utf-8")
        out.unlink()
    assert capsys.readouterr().out.count("open it in a browser") == 3


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["planetry"], "did you mean 'planetary'?"),
        (["nowhere.toml"], "cannot be read (No such file or directory)"),
        (["msl", "--preset", "paper"], "--preset"),
        (["msl", "--out", "page.txt"], "--out page.txt"),
        (["duty-cycle"], "it has a [sequence]"),
    ],
)
def test_wrong_targets_and_options_are_told_in_one_line(given, words, capsys):
    assert cli.main(["explore", *given]) != 0
    said = capsys.readouterr().err
    assert words in said and "Traceback" not in said


def test_draws_follow_the_profiles_and_change_the_parts():
    rows, known = told("planetary")["scatter"]["rows"], told("planetary")["profiles"]
    factors = [row["profiles"]["clutch_pressure"]["factor"] for row in rows]
    assert min(factors) < 1.0 < max(factors) and len(known) == 3
    assert all("clutch" in row["parts"] for row in rows)
    assert json.dumps(rows)


# The page's warnings are those of Python's loop, word for word, but for checks by further runs.

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
OWN_LEVEL = 5  # profiles that are run on the washers' own level too
OUTSIDE = ("judder", "chatter", "The brake is let go", "The clutch is let go")


def warned_drawn_profiles(n, seed):
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
def of_profiles(washers="map"):
    """Return profiles and what the page makes of them: by the washers' map, "": their own level.

    By the map 14 runs take less than a second, on their own level 2 s each: some of them do.
    """
    every = [TIED, *WEAK, *warned_drawn_profiles(10, 5)][: 14 if washers else OWN_LEVEL]
    return every, page_runs("planetary", [{"profiles": p, "washers": washers} for p in every])


@node
@pytest.mark.parametrize(
    ("washers", "k"), [*(("map", k) for k in range(14)), *(("", k) for k in range(OWN_LEVEL))]
)
@pytest.mark.slow
def test_profiles_give_the_warnings_of_pythons_loop(washers, k, tmp_path):
    (every, found), levels = of_profiles(washers), [f"washer={washers}"] if washers else []
    try:
        wanted = at_once(python_run(scene_file(tmp_path, "planetary", every[k]), levels))
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
@pytest.mark.slow
def test_a_weak_pack_is_the_first_word_in_the_page():
    _, found = of_profiles()
    for one, pack in zip(found[1:3], ("brake", "clutch"), strict=True):
        assert one["warnings"][0].startswith(f"The {pack} is too weak for ")
    assert "; The clutch is too weak for second gear: " in found[3]["problem"]


@node
@pytest.mark.slow
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


def random_scene(seed):
    """Return a scene's file, most of whose runs are not what was meant, the same each time."""
    rng = np.random.default_rng(seed)
    start, stop = rng.uniform(-0.1, 0.15), rng.uniform(0.5, 1.4)
    end, full = rng.uniform(0.3, 1.2), rng.uniform(1e5, 9e5)
    gone, held = rng.uniform(0.15, 0.6), rng.uniform(1e5, 8e5)
    return f"""
        base = "planetary"
        oil_temperature = {rng.uniform(270.0, 390.0)}
        start_time = {start}
        stop_time = {stop}
        step = {rng.choice([1e-3, 7e-3])}
        losses = false
        [transmission]
        washers = {rng.choice([0, 8])}
        thrust_share = {rng.choice([0.0, 1.0])}
        [brake]
        friction_law = "{rng.choice(["table", "wang"])}"
        starts_pressed = {str(rng.random() < 0.7).lower()}
        [pressure.brake]
        points = [[0.0, {held}], [{gone - 0.1}, {held}], [{gone}, 0.0]]
        [pressure.clutch]
        points = [[0.1, 0.0], [0.11, 4e4], [{end - 0.15}, 4e4], [{end}, {full}]]
        [engine]
        torque_scale = {rng.uniform(0.3, 1.1)}
    """


@node
@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_random_scenes_give_the_same_warnings_on_both_sides(seed, tmp_path):
    path = tmp_path / "random.toml"
    path.write_text(textwrap.dedent(random_scene(seed)), "utf-8")
    try:
        run = nominal(str(path))
    except (ParameterError, SolveError):
        pytest.skip("it does not run")
    (found,) = page_runs(str(path), [{"washers": ""}])
    assert found["warnings"] == at_once(run)
