"""The gear mesh's page draws teeth and path of contact, with places and shares of Python."""

import math

import numpy as np
import pytest
from pages import answers, node

from thrustwasher import GearMeshParams, solve_gearmesh
from thrustwasher.gearmesh.kernels import layout as k
from thrustwasher.gearmesh.kernels.load_sharing import shared
from thrustwasher.gearmesh.solve import prepare

POINT = {"power": 2e4, "speed": 200.0, "oil_temperature": 350.0}
FZG_C = {
    "pinion_teeth": 16,
    "gear_ratio": 1.5,
    "normal_module": 4.5e-3,
    "face_width": 0.014,
    "profile_shift_pinion": 0.1817,
    "profile_shift_gear": 0.1715,
    "tip_diameter_pinion": 0.08246,
    "tip_diameter_gear": 0.11836,
}
RELIEF = {
    "load_sharing": "elastic",
    "tip_relief_pinion": 35e-6,
    "tip_relief_gear": 35e-6,
    "tip_relief_length_pinion": 3e-3,
    "tip_relief_length_gear": 3e-3,
}
PAIRS = {
    "standard": {},
    "shifted, relieved": FZG_C | RELIEF,
    "ring": {"internal": True, "gear_ratio": 3.0, "addendum_gear": 0.8},
    "ring, shifted": {"internal": True, "gear_ratio": 3.0, "profile_shift_pinion": 0.4},
    "long teeth": {"pinion_teeth": 60, "addendum": 1.3, "load_sharing": "elastic"},
    "helical": {"helix_angle": 0.2, "face_width": 0.02},
}
pairs = pytest.mark.parametrize("changed", PAIRS.values(), ids=PAIRS)


def opened_with(opened, changed):
    given = "&".join(f"{n}={str(v).lower()}" for n, v in (POINT | changed).items())
    return opened("gearmesh", f"#{given}")


def points_of(page):
    """Return the points A to E as drawn [m] from the pitch point."""
    found = page.page.locator("svg.teeth [data-point]").all()
    at = [[float(p.get_attribute(f"data-{axis}")) for axis in "xy"] for p in found]
    return dict(zip((p.get_attribute("data-point") for p in found), np.array(at), strict=True))


@pytest.mark.browser
@pairs
def test_the_path_drawn_has_pythons_contact_ratio_and_ends_on_the_tip_circles(opened, changed):
    params = GearMeshParams(**changed)
    wanted, drawn = solve_gearmesh(params, **POINT), points_of(opened_with(opened, changed))
    base = wanted.pinion_diameter * math.cos(wanted.working_pressure_angle)
    pitch = math.pi * base / params.pinion_teeth
    length = np.linalg.norm(drawn["E"] - drawn["A"])
    assert length / pitch == pytest.approx(wanted.contact_ratio, rel=1e-9)
    assert drawn["C"] == pytest.approx([0.0, 0.0])
    for first, second in ("BE", "AD"):
        assert np.linalg.norm(drawn[second] - drawn[first]) == pytest.approx(pitch, rel=1e-9)
    above = -1.0 if params.internal else 1.0
    for end, gear, side in (("E", "pinion", -1.0), ("A", "gear", above)):
        axis = [0.0, side * getattr(wanted, f"{gear}_diameter") / 2.0]
        tip = getattr(wanted, f"{gear}_tip_diameter") / 2.0
        assert np.linalg.norm(drawn[end] - axis) == pytest.approx(tip, rel=1e-9)


@pytest.mark.browser
@pairs
def test_flanks_drawn_touch_in_the_pairs_in_contact(opened, changed):
    page = opened_with(opened, changed).page
    far = page.evaluate(
        """() => [...document.querySelectorAll("svg.teeth .touch")].flatMap((dot) => {
        const [x, y] = [Number(dot.getAttribute("cx")), Number(dot.getAttribute("cy"))];
        return [...document.querySelectorAll("svg.teeth .flank")].map((flank) => {
          const edge = flank.getAttribute("d").slice(1).split("L");
          const points = edge.map((p) => p.split(",").map(Number));
          return Math.min(...points.slice(1).map(([u, v], k) => {
            const [a, b] = points[k], l = (u - a) ** 2 + (v - b) ** 2 || 1;
            const t = Math.min(1, Math.max(0, ((x - a) * (u - a) + (y - b) * (v - b)) / l));
            return Math.hypot(x - a - t * (u - a), y - b - t * (v - b));
          }));
        });
      })"""
    )
    assert len(far) >= 2 and max(far) < 0.8  # pixels


@pytest.mark.browser
@pytest.mark.parametrize("changed", [{}, FZG_C | RELIEF, PAIRS["long teeth"]])
def test_shares_told_sum_to_1_wherever_the_gears_are_rolled(opened, changed):
    page = opened_with(opened, changed).page
    seen = set()
    for rolled in np.linspace(0.0, 1.0, 12):
        page.locator("#roll").fill(str(rolled))
        shares = [float(s.get_attribute("value")) for s in page.locator(".pairs data").all()]
        assert len(shares) == page.locator("svg.teeth .touch").count()
        assert sum(shares) == pytest.approx(1.0, abs=1e-9)
        seen.add(len(shares))
    assert seen == ({2, 3} if changed.get("addendum") else {1, 2})


@node
@pairs
def test_shares_sliding_and_loss_of_the_worker_are_those_of_python(changed):
    params = GearMeshParams(**changed)
    (got,), _ = answers("gearmesh", [["solve", list(POINT.values())]], params=params)
    wanted = solve_gearmesh(params, **POINT)
    assert got["outputs"]["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-10)
    torque = POINT["power"] / POINT["speed"]
    par = shared(prepare(params, "field"), torque, np.zeros(k.NWORK))
    n = int(par[k.D_PLACES])
    for key, first in (("position", k.D_POSITION), ("share", k.D_PATH_SHARE)):
        assert got["path"][key] == pytest.approx(par[first : first + n], rel=1e-9, abs=1e-11)
    pitch = math.pi * wanted.pinion_diameter * math.cos(wanted.working_pressure_angle)
    pitch *= (1.0 + (-1.0 if params.internal else 1.0) / params.gear_ratio) / params.pinion_teeth
    sliding = pitch * POINT["speed"] * par[k.D_POSITION : k.D_POSITION + n]
    assert got["path"]["sliding"] == pytest.approx(sliding, rel=1e-9, abs=1e-9)


REFUSED = [
    ("profile_shift_pinion", 1.6, "allowed: less, or smaller tip diameters: a tooth is pointed"),
    ("pinion_teeth", 8, "(with so few the gear's tips cut below the pinion's involute"),
    ("addendum", 0.35, "(contact ratio 1 and more"),
]


@pytest.mark.browser
@pytest.mark.parametrize(("name", "bad", "words"), REFUSED)
def test_a_geometry_that_the_kernel_refuses_says_why_and_the_last_one_stays(
    opened, name, bad, words
):
    page = opened("gearmesh")
    before = points_of(page)
    page.put(name, bad)
    said = page.page.text_content("#state")
    assert said.startswith(f"{name} = {bad}, ") and words in said
    assert page.page.get_attribute("#results", "class") == "stale"
    assert points_of(page)["E"] == pytest.approx(before["E"])
    page.put("profile_shift_pinion", 0.2)
    page.put(name, {"profile_shift_pinion": 0.2, "pinion_teeth": 22, "addendum": 0.95}[name])
    assert points_of(page)["E"] != pytest.approx(before["E"])


@pytest.mark.browser
def test_the_shift_slider_moves_the_teeth(opened):
    page = opened("gearmesh")
    page.page.locator("#in-profile_shift_pinion-slider").fill("650")
    page.settled()
    shift = float(page.page.input_value("#in-profile_shift_pinion"))
    wanted = solve_gearmesh(
        GearMeshParams(profile_shift_pinion=shift), power=7500.0, speed=180.0
    ).contact_ratio
    assert shift == pytest.approx(0.3) and page.figure("contact_ratio") == pytest.approx(wanted)


@pytest.mark.browser
def test_without_anything_along_the_path_only_the_teeth_are_drawn(opened):
    page = opened("gearmesh", "#film_heat=atan").page
    assert page.locator("#views .panel").first.is_visible()
    assert page.locator("#views .panel").nth(1).is_hidden()
    assert "nothing along the path" in page.text_content(".pairs")


@pytest.mark.browser
def test_tips_that_reach_into_the_root_are_told(opened):
    said = opened_with(opened, {"addendum": 1.3, "pinion_teeth": 60}).page.text_content(".pairs")
    module = 2.0 * 0.254 / (60 * 3.0)
    assert f"Tips reach {1e6 * 0.05 * module:.4g} µm below the other gear's root circle" in said
