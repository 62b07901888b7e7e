"""A pack that is let go: film and grooves say how fast it opens, and what it drags until then."""

import math

import numpy as np
import pytest
from closed_forms.squeeze_film import parting_time, squeeze_group
from clutch_pack import Pack, plain
from clutch_reference import Reference
from scipy.optimize import nnls

from thrustwasher import ClutchParams, engage_clutch, solve_clutch
from thrustwasher.clutch.kernels import layout as k
from thrustwasher.clutch.kernels.constants import groove_factor
from thrustwasher.clutch.kernels.pack_friction import rough_faces
from thrustwasher.clutch.kernels.rates import MOST_TORN, film_rate, groove_lift, torn
from thrustwasher.clutch.solve import prepare

ATMOSPHERE = 1e5
SMOOTH = {"roughness": 1e-8, "permeability": 0.0, "viscosity_constant": 0.0}


@pytest.mark.parametrize("grooves", [0, 24, 400])
def test_a_spring_parts_smooth_faces_in_the_time_of_the_closed_form(grooves):
    """Without grooves the ring's squeeze constant G, with many the strip's eta v a^3 b/h^3."""
    p = ClutchParams(
        **SMOOTH,
        viscosity_scale=0.05,
        groove_count=grooves,
        groove_width=5e-4,
        land_share=1.0,
        separating_force=300.0,
    )
    drag = 1.5 * math.pi * 0.05 * squeeze_group(0.064, 0.085)
    if grooves == 24:
        drag *= groove_factor(prepare(p, "field"))  # its own tests are in test_grooves
    if grooves == 400:  # pads of 0.67 x 21 mm: 2 % short of endless strips
        a, b = math.pi * 0.149 / 400 - 5e-4, 0.021
        drag = 400 * 0.05 * a**3 * b * (1.0 - 0.63025 * a / b)
    pack = Pack(made=lambda: p)
    pack.par[k.P_STARTS_PRESSED] = 0.0
    start, end = 3e-5, 1.2e-4
    pack.par[k.D_OPEN_RATIO] = start / p.roughness  # where it begins
    pack.step(0.0, 0.0, 1e-9)
    pack.par[k.D_OPEN_RATIO] = p.initial_film / p.roughness
    pack.step(0.0, 0.0, parting_time(300.0, drag, p.initial_film, start, end))
    assert pack.out[k.O_FILM] == pytest.approx(end, rel=1e-4)


def test_a_cavity_in_the_middle_of_a_narrow_pad_parts_it_faster():
    """h^3/(12 eta) p'' = v, p = 0 at both ends, p >= -1 atm: as least squares on 400 cells."""
    n, speeds = 400, np.array([0.5, 1.0, 2.0, 6.0])
    x = np.arange(1, n) / n
    for v in speeds:  # of the speed at which the parabola just reaches one atmosphere
        free = -4.0 * v * x * (1.0 - x)  # the untorn pressure, in atmospheres
        stiff = n * n * (2.0 * np.eye(n - 1) - np.eye(n - 1, k=1) - np.eye(n - 1, k=-1)) / 8.0
        root = np.linalg.cholesky(stiff).T  # least (1 + p) K (1 + p)/2 with 1 + p >= 0
        above = nnls(root, root @ (free + 1.0))[0]
        suction = -float((above - 1.0).mean() * (n - 1) / n)
        more = torn(suction * ATMOSPHERE)[0] - 1.0
        factor = 1.0 + more / (1.0 - more / (MOST_TORN - 1.0))  # of plates without mass
        assert 2.0 / 3.0 * v == pytest.approx(factor * suction, rel=0.02 if v > 1 else 1e-4)
    for suction in (0.3, 0.7, 0.9, 0.98, 1.2):
        up, down = (torn(ATMOSPHERE * (suction + d))[0] for d in (1e-6, -1e-6))
        slope = (up - down) / (2e-6 * ATMOSPHERE)
        assert torn(ATMOSPHERE * suction)[1] == pytest.approx(slope, rel=1e-6, abs=1e-12)


def test_what_grooves_pile_up_is_the_solution_of_reynolds_equation_on_land_and_groove():
    """Along the slip: one flow over step and land. Over a pad: Laplace, the series by cells."""
    p = ClutchParams()
    par, h, d = prepare(p, "field"), 4e-5, p.groove_depth
    a, b = math.pi * 0.149 / 24 - p.groove_width, 0.021
    eta, slip = 3.0, 200.0
    v = slip * p.friction_radius
    rows = [[1.0, h**3 / (12.0 * eta * a)], [1.0, -((h + d) ** 3) / (12.0 * eta * p.groove_width)]]
    rise = -np.linalg.solve(rows, [0.5 * v * h, 0.5 * v * (h + d)])[1]  # over the land, falling
    x = np.arange(1, 60)
    lap = 2.0 - 2.0 * np.cos(np.pi * x / 60)
    modes = np.sin(np.pi * np.outer(x, x) / 60)
    source = np.zeros((59, 59))
    source[0] = (60 / a) ** 2  # 1 at the end before the first row
    wide = lap[:, None] * (60 / a) ** 2 + lap[None, :] * (60 / b) ** 2
    u = modes @ (modes @ source @ modes / wide) @ modes * (2.0 / 60) ** 2
    mean = (u.sum() + 0.5 * 59) / 60**2
    wanted = mean * 24 * a * b / (p.lining_area / 4) * (abs(rise) / 2.0 - ATMOSPHERE)
    found = groove_lift(par, h / p.roughness, eta, slip)
    assert wanted > 1e4 and found[0] == pytest.approx(wanted, rel=3e-3)
    assert groove_lift(par, 1.0, 0.01, 300.0)[0] == 0.0  # warm oil is not torn: as much down as up


@pytest.mark.parametrize("load", [0.0, 5e3])
@pytest.mark.parametrize("u", [-0.5, 0.4, 1.4, 2.5, 9.0])
def test_slopes_of_the_film_rate_are_those_of_differences(u, load):
    par = prepare(ClutchParams(), "field")
    at = np.array([load, u, 2.0 * load * (u < 1.0) + 3e4 * (u < 3.0), 0.7, 250.0])

    def rate(x):
        faces = rough_faces(x[1])
        return film_rate(par, x[0], x[1], x[2], 0.0, x[3], x[4], faces[5], faces[6])

    slopes = rate(at)
    for slope, i in ((slopes[1], 1), (slopes[3], 3), (slopes[4], 4), (slopes[2], 0)):
        step = np.zeros(5)
        step[i] = 1e-6 * max(at[i], 1.0) if load or i else 0.0
        if step[i]:
            change = (rate(at + step)[0] - rate(at - step)[0]) / (2.0 * step[i])
            assert slope == pytest.approx(change, rel=1e-6, abs=1e-9 * abs(slopes[0]))


@pytest.mark.parametrize(
    ("oil", "slip"), [(253.15, 250.0), pytest.param(353.15, 100.0, marks=pytest.mark.slow)]
)
def test_a_pack_let_go_follows_the_tight_reference(oil, slip):
    pack = Pack(made=ClutchParams, starts_pressed=True, contact_rise=False)
    pack.step(6000.0, slip, 1e-9, oil)
    reference = Reference(pack.params, lambda t: 0.0, lambda t: slip, oil)
    times = np.linspace(0.0, 0.3, 31)
    start = [float(pack.out[k.O_RATIO]), float(pack.out[k.O_TEMPERATURE])]
    film, temperature = reference.solve(times, start)
    for n in range(1, len(times)):
        assert pack.step(0.0, slip, times[n] - times[n - 1], oil) == 0
        exact = reference.torque(times[n], film[n], temperature[n])
        assert pack.out[k.O_RATIO] == pytest.approx(film[n], rel=1e-4)
        assert pack.out[k.O_TORQUE] == pytest.approx(exact, rel=3e-4)
        assert pack.out[k.O_TEMPERATURE] == pytest.approx(temperature[n], abs=1e-3)


@pytest.mark.parametrize("level", ["field", "fine"])
@pytest.mark.parametrize("oil", [253.15, 363.15])
def test_it_opens_to_its_clearance_and_never_closes_on_the_way_and_its_heat_is_its_work(level, oil):
    params, t = ClutchParams(starts_pressed=True), np.geomspace(1e-3, 30.0, 1501) - 1e-3
    e = engage_clutch(
        params,
        time=t,
        load=6000.0 * np.maximum(0.0, 1.0 - t / 0.05),
        speed=150.0,
        oil_temperature=oil,
        fidelity=level,
    )
    assert np.all(np.diff(e.film_ratio) >= -1e-6)
    assert e.film_thickness[-1] == pytest.approx(params.initial_film, rel=1e-3)
    work = np.trapezoid(e.friction_torque * 150.0, t)
    assert e.energy[-1] == pytest.approx(work, rel=2e-4)
    assert np.all(np.diff(e.energy) >= 0.0)


def test_oil_ten_times_as_thick_takes_ten_times_as_long():
    def film(scale, t):
        params = ClutchParams(starts_pressed=True, viscosity_constant=0.0, viscosity_scale=scale)
        load = np.where(t == 0.0, 6000.0, 0.0)
        return engage_clutch(params, time=t, load=load, speed=0.0)

    t = np.array([0.0, 1e-9, 0.15])
    thin, thick = film(0.01, t), film(0.1, 10.0 * t)
    assert 1.0 < thin.film_ratio[-1] < 5.0
    assert thick.film_ratio[-1] == pytest.approx(thin.film_ratio[-1], rel=1e-5)


def test_asperities_that_suction_presses_rub_with_no_more_than_load_and_atmosphere():
    pack = Pack(made=ClutchParams, starts_pressed=True)
    pack.step(6000.0, 50.0, 1e-9, 263.15)
    lever = pack.params.faces * pack.params.friction_radius
    area = pack.params.lining_area / pack.params.faces
    before = np.inf
    for _ in range(200):
        pack.step(0.0, 50.0, 1e-3, 263.15)
        mu, torque = pack.out[k.O_COEFFICIENT], pack.out[k.O_CONTACT_TORQUE]
        assert 0.0 < torque <= min(before, lever * mu * ATMOSPHERE * area * (1.0 + 1e-12))
        before = torque
    pressed = solve_clutch(pack.params, load=6000.0, speed=0.0).torque_capacity
    assert 0.01 * pressed < before < 0.2 * pressed


def held_for(torque, temperature, fidelity="field", load=5000.0, **changes):
    """Return how long [ms] a settled pack whose load goes at once can hold a torque."""
    pack = Pack(made=lambda: ClutchParams(starts_pressed=True, **changes), fidelity=fidelity)
    pack.step(load, 0.0, 1e-3, temperature)
    for ms in range(1, 1000):
        pack.step(0.0, 0.0, 1e-3, temperature)
        if pack.out[k.O_CAPACITY] < torque:
            return ms
    return None


UNGROOVED = {"faces": 8, "inner_radius": 0.0375, "outer_radius": 0.075, "groove_count": 0}
UNGROOVED |= {"land_share": 1.0, "friction_law": "constant", "constant_friction": 0.1}


def test_an_opened_pack_holds_on_by_suction_and_an_on_off_element_lets_go():
    """The figures of docs/theory/clutch.md, docs/driveline.md, docs/start/host.md."""
    for changes, torque, load, cold, warm in (
        (UNGROOVED, 40.0, 2650.0, 81, 11),
        ({}, 20.0, 5000.0, 15, 2),
    ):
        times = [held_for(torque, t, load=load, **changes) for t in (297.15, 358.15)]
        assert times == pytest.approx([cold, warm], abs=1)
        for level in ("stribeck", "closed"):
            assert held_for(torque, 297.15, level, load, **changes) == 1  # the first step


def test_without_spring_and_asperities_nothing_parts_the_faces():
    pack = Pack(made=plain, separating_force=0.0, starts_pressed=True)
    for load in (6000.0, 0.0):
        pack.step(load, 0.0, 1.0)
    stays = pack.out[k.O_RATIO]
    pack.step(0.0, 0.0, 100.0)
    assert 2.0 < stays < pack.out[k.O_RATIO] < 0.5 * 8.8e-5 / 8.41e-6
