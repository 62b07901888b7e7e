"""Bodies of gears with several mates: counted once, and as warm as all mates make them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reference_pairs import STAGE_3

from thrustwasher import GearMeshParams, ParameterError, oil, solve_gearmesh
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.gearmesh.kernels import contact
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.parameters import ENDURANCE, SPEC, absent_outputs
from thrustwasher.gearmesh.plausibility import doubts_of_parameters
from thrustwasher.gearmesh.solve import prepare
from thrustwasher.model.part_file import find_part
from thrustwasher.model.part_places import part_places
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


# The pressure coefficient of the viscosity: by base oil and viscosity, and by temperature.

# AGMA 925-A03: alpha [mm2/N] = k eta^s of eta [mPa s].
AGMA = {"mineral": (0.010471, 0.1348), "pao": (0.010326, 0.0507), "polyglycol": (0.0047, 0.1572)}


def alpha(params):
    return float(prepare(params, "field")[L.D_ALPHA])


def of(name, **changes):
    return GearMeshParams(**{**oil(name).parameters_for("gearmesh"), **changes})


@pytest.mark.parametrize("base", AGMA)
def test_two_standards_with_other_units_say_the_same(base):
    params = of(f"ISO VG 320 {base if base != 'polyglycol' else 'PAG'}")
    assert params.base_oil == base and params.pressure_viscosity == 0.0
    thick = params.viscosity_scale * math.exp(params.viscosity_b / (38.0 + params.viscosity_c))
    k, s = AGMA[base]
    assert alpha(params) == pytest.approx(1e-6 * k * (1e3 * thick) ** s, rel=2e-3)


def test_an_oil_of_a_report_has_the_reports_coefficient():
    """KISSsoft: 0.02162 mm2/N of a mineral oil of 220 and 19 mm2/s, 890 kg/m3."""
    assert alpha(of("ISO VG 220")) == pytest.approx(2.162e-8, rel=5e-3)
    pao, mineral = alpha(of("ISO VG 320 PAO")), alpha(of("ISO VG 320"))
    assert mineral / pao == pytest.approx(1.65, rel=0.02)
    assert alpha(GearMeshParams()) == pytest.approx(1.96e-8, rel=5e-3)


def test_a_value_that_is_given_always_wins():
    assert alpha(of("ISO VG 320 PAO", pressure_viscosity=1.9e-8)) == 1.9e-8
    given = oil("ISO VG 320 PAO").parameters_for("gearmesh") | {"pressure_viscosity": 1.9e-8}
    assert alpha(GearMeshParams(**given)) == 1.9e-8
    measured = oil({"name": "ISO VG 320 PAO", "pressure_viscosity": 2.1e-8})
    assert measured.parameters_for("gearmesh")["pressure_viscosity"] == 2.1e-8
    for preset in ("paper", "bounded", "literal", "iso"):
        assert alpha(GearMeshParams.preset(preset)) == 2.2e-8
    with pytest.raises(ParameterError, match=r"0 \(by base_oil and viscosity\) or 1e-09"):
        GearMeshParams(pressure_viscosity=1e-12)


def test_an_ester_has_no_formula_and_says_so():
    r = solve_gearmesh(of("ISO VG 100 ester"), power=5e3, speed=150.0)
    assert any("'ester': no standard gives its pressure coefficient" in w for w in r.warnings)
    given = solve_gearmesh(
        of("ISO VG 100 ester", pressure_viscosity=1.6e-8), power=5e3, speed=150.0
    )
    assert not any("'ester'" in w for w in given.warnings)


def test_its_fall_with_temperature_lies_in_the_band_of_measured_oils():
    """0.69 from 30 to 100 degC by the standard; twelve measured oils 0.48 .. 0.75."""
    cold, hot = (contact.pressure_coefficient(t + 273.15)[0] for t in (30.0, 100.0))
    assert hot / cold == pytest.approx(0.69, abs=0.005)
    assert contact.pressure_coefficient(311.0)[0] == 1.0


@pytest.mark.parametrize("viscosity_at", ["surface", "inlet"])
def test_the_film_has_the_coefficient_at_its_temperature(viscosity_at):
    """Two temperatures of the oil: all but load and speed as Dowson and Higginson have it."""
    grade = oil("ISO VG 220").parameters_for("gearmesh")
    params = GearMeshParams(**{**STAGE_3, **grade, "viscosity_at": viscosity_at})
    found = [
        solve_gearmesh(params, power=5e6, speed=122.1, oil_temperature=t) for t in (333.15, 363.15)
    ]
    warm = "bulk_temperature" if viscosity_at == "surface" else "oil"
    ts = [getattr(r, warm, t) for r, t in zip(found, (333.15, 363.15), strict=True)]
    factors = [1.0 + 516.0 * (1.0 / t - 1.0 / 311.0) for t in ts]
    expected = (found[1].viscosity / found[0].viscosity) ** 0.7 * (factors[1] / factors[0]) ** 0.54
    films = [r.film_thickness for r in found]
    assert films[1] / films[0] == pytest.approx(expected, rel=1e-9)
    assert films[1] / films[0] == pytest.approx(found[1].film_ratio / found[0].film_ratio)


def test_micropitting_has_its_own_law_of_temperature_once():
    """The film of micropitting is proportional to alpha_38^0.6: 0.22 powers of S_GF cancel."""
    grade = oil("ISO VG 220").parameters_for("gearmesh")
    films = [
        solve_gearmesh(
            GearMeshParams(**{**STAGE_3, **grade, "pressure_viscosity": a}),
            power=5e6,
            speed=122.1,
            oil_temperature=353.15,
        ).film_ratio_gf
        for a in (1e-8, 2e-8)
    ]
    assert films[1] / films[0] == pytest.approx(2.0**0.6, rel=1e-12)


def test_the_value_behind_the_zero_is_what_scatters():
    part = find_part("gearmesh")
    place = part_places(part.spec, part.params, {s.name: s.usual for s in part.spec.inputs})
    assert place["pressure_viscosity"].nominal == pytest.approx(alpha(part.params), rel=1e-12)
