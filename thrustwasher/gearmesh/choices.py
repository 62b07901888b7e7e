"""The words that a gear mesh's parameters take, each with a sentence."""

SURFACES = {
    "rough": "rough ground: composite RMS 2.26 um, effective roughness 4.5e-5",
    "fine": "fine ground: composite RMS 0.566 um, effective roughness 1.5e-5",
}
LOAD_SHARING = {
    "rigid": "equally, whatever the load",
    "elastic": "by their stiffness; tip relief counts as a gap",
}
FRICTION_LAWS = {
    "li-seireg": "falls with film over radius (Atan Eq 4); slide/roll ratio above 0.27 only",
    "iso": "mean coefficient of the scuffing standard (ISO/TS 6336-20), at most f0",
    "constant": "the constant coefficient constant_friction",
    "mixed": "film and asperities share the load; their mean is that of schlenk (film_heat loss "
    "only)",
    "schlenk": "mean coefficient fitted to loss tests of gears; below 1 m/s no more than "
    "boundary_friction",
    "efficiency": "what efficiency and efficiency_back lose (film_heat loss only)",
}
BASE_OILS = {
    "mineral": "mineral oil; also where the base is not known",
    "pao": "polyalphaolefin",
    "ester": "ester",
    "polyglycol": "polyglycol, not soluble in water",
}
MATERIALS_GEAR = {
    "as-pinion": "the gear is of what the pinion is of",
    "nodular-iron": "nodular cast iron, 173 GPa, contact limit 498 MPa (200 HB)",
    "grey-iron": "grey cast iron, 118 GPa, contact limit 339 MPa (200 HB)",
    "bronze": "cast tin bronze, 103 GPa, contact limit 300 MPa, an estimate",
}
FILM_HEAT = {
    "loss": "all of the loss heats the flanks, along the whole path of contact",
    "atan": "shear of the oil at ambient pressure warms the flank (Atan Eq 6, 7), friction the "
    "asperities (Eq 3), both where contact starts",
}
THERMAL_MODES = {
    "quasi_steady": "bodies at their steady temperature at every instant",
    "transient": "bodies store heat",
}
THERMAL_STARTS = {
    "steady": "bodies as warm as the first operating point makes them",
    "oil": "bodies at oil temperature",
}
STEELS = {
    "AISI4340": "high-carbon steel: endurance 0.53 mechanical, 0.40 thermal of 1301 MPa",
    "AISI1020": "low-carbon steel: endurance 0.63 mechanical, 0.77 thermal of 689 MPa",
    "case-hardened": "contact limit 1500 MPa; asperities as hard as of AISI4340, no endurance",
}
VISCOSITY_AT = {
    "surface": "the film has the viscosity at the flank's temperature, found with it",
    "inlet": "the film has the viscosity of the oil supplied",
}
FILM_VISCOSITY = {
    "surface": "the film thickness follows the same viscosity as the shear",
    "inlet": "the film thickness is made by the oil supplied, whatever the flank does",
}
HEAT_PARTITION = {
    "constant": "the pinion takes the share partition_share",
    "velocity": "the share that makes both flanks equally hot",
}
TRACTION_LAWS = {
    "ambient": "shear stress of the oil at ambient pressure",
    "limited": "viscosity rises with pressure, stress up to limiting_traction x mean pressure",
}
AREA_LAWS = {
    "bounded": "Greenwood-Williamson area, no asperity pressed beyond its hardness",
    "greenwood-williamson": "Greenwood-Williamson area, unbounded (up to a ratio of 1e6)",
    "constant": "the constant ratio area_ratio of nominal over real area",
}
SWITCHES = {
    "smooth": "asperity heating fades out from film ratio 1.0 to 1.8",
    "sharp": "asperity heating up to film ratio 1.4, none above",
    "none": "asperity heating at any film ratio",
}
ASPERITY_BASES = {
    "surface": "the asperity's rise is added to the flank's temperature",
    "bulk": "the asperity's rise is added to the oil's; without contact it is as hot as the film",
}
