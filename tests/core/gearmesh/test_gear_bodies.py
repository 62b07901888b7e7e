"""Bodies of gears with several mates: counted once, and as warm as all mates make them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.parameters import ENDURANCE, SPEC, absent_outputs
from thrustwasher.gearmesh.plausibility import doubts_of_parameters
from thrustwasher.gearmesh.solve import prepare
from thrustwasher.shift import load_scene
from thrustwasher.studio.sweep.run_sweep import run_sweep

PLANET = GearMeshParams.preset("planet")
POINT = {"power": 14.0 * 510.0, "speed": 510.0, "oil_temperature": 358.15}


def rise(**changes):
    r = solve_gearmesh(replace(PLANET, **changes), **POINT)
    return r.bulk_temperature - POINT["oil_temperature"], r


def test_all_meshes_of_a_set_together_have_its_gears_once():
    """Four planets and a sun as discs, the ring as a rim of four transverse modules: 1.38 kg."""
    parts = load_scene("planetary").parts
    gearbox, meshes = (
        parts["transmission"].params,
        (parts["mesh"].params, parts["ring_mesh"].params),
    )
    mass = sum(
        gearbox.planets * prepare(m, "field")[L.D_BULK_CAPACITY] / m.heat_capacity for m in meshes
    )
    module = 1.5e-3 / math.cos(math.radians(20.0))
    planet, sun, ring = (0.5 * z * module for z in (18, 38, 74))
    areas = 4.0 * planet**2 + sun**2 + (ring + 4.0 * module) ** 2 - ring**2
    assert mass == pytest.approx(7850.0 * 22e-3 * math.pi * areas, rel=1e-12)
    assert mass == pytest.approx(1.38, abs=5e-3)


@pytest.mark.parametrize(
    ("pinion", "gear", "factor"), [(1, 1, 1.0), (2, 1, 1.5), (1, 4, 2.5), (2, 4, 2.5), (5, 4, 3.0)]
)
@pytest.mark.parametrize("load_factor", [1.0, 1.5])
def test_the_gear_with_more_mates_decides_how_warm_both_are(pinion, gear, factor, load_factor):
    one, bare = rise(mates_pinion=1, mates_gear=1, load_factor=1.0)
    found, r = rise(mates_pinion=pinion, mates_gear=gear, load_factor=load_factor)
    assert found == pytest.approx(one * factor * load_factor**0.75, rel=1e-9)
    assert r.friction_power == bare.friction_power
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-13)


def test_surfaces_that_cool_at_rest_are_shared_like_the_bodies():
    alone = prepare(replace(PLANET, mates_pinion=1, mates_gear=1), "field")[L.D_STILL]
    shared = prepare(PLANET, "field")[L.D_STILL]
    assert shared / alone == pytest.approx((18 / 2 + 38 / 4) / (18 + 38), rel=1e-12)


def test_a_scene_says_how_many_mates_its_gears_have(tmp_path):
    def scene(text):
        path = tmp_path / "mine.toml"
        path.write_text(f'base = "planetary"\n{text}', encoding="utf-8")
        return load_scene(path).parts

    for mesh in ("mesh", "ring_mesh"):
        given = load_scene("planetary").parts[mesh].params
        assert (given.mates_pinion, given.mates_gear) == (2, 4)
    assert scene("[transmission]\nplanets = 2")["ring_mesh"].params.mates_gear == 2
    assert scene("[mesh]\nmates_gear = 1")["mesh"].params.mates_gear == 1
    part = tmp_path / "pair.toml"
    part.write_text('model = "gearmesh"\nname = "Pair"\n[parameters]\nmates_pinion = 3\n')
    own = scene('[mesh]\npart = "pair.toml"')["mesh"].params
    assert (own.mates_pinion, own.mates_gear) == (3, 4)


def test_a_safety_without_a_limit_is_none():
    r = solve_gearmesh(PLANET, **POINT)
    assert r.micropitting_safety is None and r.as_dict()["micropitting_safety"] is None
    given = solve_gearmesh(replace(PLANET, permissible_film_ratio=0.5), **POINT)
    assert given.micropitting_safety == pytest.approx(2.0 * r.film_ratio_gf, rel=1e-14)
    with pytest.raises(ParameterError, match=r"permissible_film_ratio = 0.001, allowed: 0 .no lim"):
        replace(PLANET, permissible_film_ratio=1e-3)


@pytest.mark.parametrize(
    ("changes", "known"),
    [
        ({"preset": "paper"}, True),
        ({"preset": "paper", "steel": "AISI1020"}, True),
        ({"preset": "paper", "steel": "case-hardened"}, False),
        ({"preset": "planet"}, False),
        ({"preset": "planet", "steel": "AISI4340"}, False),
    ],
)
def test_endurance_is_told_of_the_papers_heat_and_steels_alone(changes, known):
    params = GearMeshParams.preset(changes.pop("preset"), **changes)
    r = solve_gearmesh(params, **POINT)
    names = [n for n in SPEC.real_outputs if n.startswith((*ENDURANCE, "stress_utilization"))]
    assert len(names) == 8
    assert {getattr(r, name) is not None for name in names} == {known}
    assert (set(names) <= absent_outputs(params)) is not known
    if params.steel == "AISI1020":
        assert r.modification_factor == r.modification_factor_aisi1020


def test_an_fmu_has_the_numbers_there_that_its_descriptions_name():
    unit = DirectInstance(SPEC)
    unit.initialize(inputs={"load": 40.0, "speed": 180.0, "oil_temperature": 330.0})
    out = dict(zip(unit.output_names, unit.outputs(), strict=True))
    about = {s.name: s.help for s in SPEC.outputs}
    absent = absent_outputs(GearMeshParams())
    assert len(absent) == 10
    for name in absent:
        number = 1000.0 if name in ("micropitting_safety", "root_safety") else -1.0
        assert out[name] == number and f"({number:g}: no " in about[name], name


def test_a_sweep_leaves_out_what_has_no_value():
    table = run_sweep("gearmesh", {"load": [10.0, 20.0], "speed": [180.0]}, workers=1)
    assert np.isnan(table["micropitting_safety"]).all()
    assert np.isnan(table["allowable_ratio"]).all() and (table["pitting_safety"] > 0.0).all()


@pytest.mark.parametrize(("more", "fouls"), [(6, True), (8, True), (9, False), (14, False)])
def test_a_ring_with_too_few_teeth_fouls_its_pinion(more, fouls):
    """Nine teeth more at 20 degrees, as handbooks say of trochoid interference."""
    pair = GearMeshParams(internal=True, pinion_teeth=40, gear_ratio=(40 + more) / 40)
    said = [line for line in doubts_of_parameters(pair) if "foul" in line]
    assert bool(said) is fouls


@pytest.mark.parametrize(
    ("preset", "power"),
    [(None, 120e3), ("paper", 7500.0), ("literal", 7500.0), ("iso", 7500.0), ("planet", 8200.0)],
)
def test_the_presets_leave_nothing_to_doubt(preset, power):
    params = GearMeshParams.preset(preset) if preset else GearMeshParams()
    assert solve_gearmesh(params, power=power, speed=180.0).warnings == ()
