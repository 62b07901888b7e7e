"""The whole curve: its branches, its folds, and what solving at one load says about the same."""

import itertools

import pytest
from curves import traced

from thrustwasher import Status, WasherParams, load_curve, solve_washer


@pytest.fixture(scope="module")
def curve():
    return traced()


def test_points_go_from_thick_to_thin_over_the_whole_range(curve):
    ratios = [p.film_ratio for p in curve.points]
    assert all(b < a for a, b in itertools.pairwise(ratios))
    assert curve.points[0].load <= 20.0 * 1.001 and curve.points[-1].load >= 3000.0


def test_branches_follow_each_other_and_meet_at_the_folds(curve):
    names = [p.branch for p in curve.points]
    order = [n for i, n in enumerate(names) if i == 0 or n != names[i - 1]]
    assert order == ["film", "unstable", "contact"]
    lost, regained = curve.folds
    assert (lost.kind, regained.kind) == ("film_lost", "film_regained")
    assert all(p.film_ratio >= lost.film_ratio for p in curve.points if p.branch == "film")
    assert all(p.film_ratio <= regained.film_ratio for p in curve.points if p.branch == "contact")
    assert max(p.load for p in curve.points if p.branch == "film") <= lost.load * (1 + 1e-9)
    assert min(p.load for p in curve.points if p.branch == "contact") >= regained.load * (1 - 1e-9)


def test_every_point_is_a_solution(curve):
    for p in curve.points:
        good = Status.HOT if p.temperature_max > 523.0 else Status.OK
        assert p.status is (Status.DISTRESS if p.distress else good)
        assert p.fluid_load + p.contact_load == pytest.approx(p.load, rel=1e-6)
        assert p.temperature_max >= p.temperature >= p.oil_temperature
        assert p.distress == (p.branch == "contact" or p.temperature - 297.15 > 200.0)


def test_solving_at_a_points_load_gives_the_point(curve):
    for branch in ("film", "contact"):
        points = [p for p in curve.points if p.branch == branch][1:-1:4]
        assert len(points) >= 3
        for p in points:
            r = solve_washer(WasherParams(), load=p.load, speed=545.0, tilt=0.002, branch=branch)
            assert r.friction_torque == pytest.approx(p.friction_torque, rel=1e-5)
            assert r.film_ratio == pytest.approx(p.film_ratio, abs=1e-3)


def test_a_point_serves_as_start(curve):
    p = next(p for p in curve.points if p.branch == "contact" and p.load > 500.0)
    r = solve_washer(WasherParams(), load=p.load, speed=545.0, tilt=0.002, start=p)
    assert r.branch == "contact" and r.film_ratio == pytest.approx(p.film_ratio, abs=1e-4)


@pytest.mark.parametrize("kind", ["film_lost", "film_regained"])
@pytest.mark.slow
def test_bisection_in_load_finds_the_fold_of_the_continuation(curve, kind):
    """Within 0.01 N on the same grid."""
    fold = next(f for f in curve.folds if f.kind == kind)
    there, gone = (-1.0, 1.0) if kind == "film_lost" else (1.0, -1.0)
    branch = "film" if kind == "film_lost" else "contact"
    at = {"speed": 545.0, "tilt": 0.002, "branch": branch, "throw": False}
    for _ in range(12):
        middle = 0.5 * (there + gone)
        r = solve_washer(WasherParams(), load=fold.load + middle, **at)
        assert r.status is Status.NO_BRANCH or not r.status.is_failure
        if not r.status.is_failure:
            there = middle
        else:
            gone = middle
    assert abs(there) < 0.01 and abs(gone) < 0.01


def test_less_film_heat_moves_the_fold_to_higher_loads(curve):
    loads = [
        load_curve(WasherParams(film_heat_fraction=x, oil_cooling=False), speed=545.0, tilt=0.002)
        .folds[0]
        .load
        for x in (0.3, 0.6, 1.0)
    ]
    assert loads[0] > loads[1] > loads[2] < curve.folds[0].load


def values(text):
    return {name: float(x) for name, x in (word.split("=") for word in text.split())}


FAR = {  # parameters, place, minimum and maximum load [N]
    "soft bodies, whose film grows with the load in the end": (
        """youngs_modulus=1.05e10 youngs_modulus_gear=7.5e10 yield_strength=1.16e9
        roughness_washer=2.8e-7 roughness_carrier=1.8e-7 asperity_radius=3.7e-5
        inner_radius=5.57e-3 gear_inner_radius=7.47e-3 outer_radius=11.43e-3""",
        "speed=14.75 tilt=0.00146 oil_temperature=300.1",
        (14.0, 2100.0),
    ),
    "flat folds": (
        """inner_radius=0.0106 outer_radius=0.0235 gear_inner_radius=0.0123
        washer_thickness=0.00256 carrier_thickness=0.0182 gear_thickness=0.00365
        oil_density=902 heat_split=0.7 roughness_washer=1.73e-6 roughness_carrier=3.17e-7
        youngs_modulus=3.83e10 youngs_modulus_gear=1.05e11 yield_strength=4.91e8
        asperity_radius=1.92e-4 oil_conductivity=0.126 conductivity=10.6""",
        "speed=707 tilt=1.87e-4 oil_temperature=359",
        (59.0, 8827.0),
    ),
    "much oil on a large disc": (
        """inner_radius=0.0222 outer_radius=0.0502 gear_inner_radius=0.0294
        washer_thickness=0.00163 carrier_thickness=0.0117 gear_thickness=0.00741
        oil_density=919 oil_heat_capacity=2240 heat_split=0.673 roughness_washer=2.48e-7
        roughness_carrier=6.1e-7 youngs_modulus=2.68e10 youngs_modulus_gear=1.17e11
        yield_strength=7.6e8 asperity_radius=1.15e-4 oil_conductivity=0.177 conductivity=11.1""",
        "speed=212 tilt=1.28e-4 oil_temperature=342",
        (269.0, 9000.0),
    ),
}
*SHORT, LONG = FAR


@pytest.mark.parametrize("name", [*SHORT, pytest.param(LONG, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_curves_of_washers_far_from_the_default_reach_their_ends(name):
    changes, place, (low, high) = FAR[name]
    params = WasherParams(**values(changes))
    curve = load_curve(params, **values(place), load_min=low, load_max=high)
    assert curve.points[0].load < low and curve.points[-1].load >= high
    kinds = [fold.kind for fold in curve.folds]
    assert kinds == ["film_lost", "film_regained"][: len(kinds)] and len(kinds) in (0, 2)
    for p in curve.points[:: len(curve.points) // 5]:
        assert p.fluid_load + p.contact_load == pytest.approx(p.load, rel=1e-5)
