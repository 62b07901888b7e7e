"""Gear pairs of published reports, as parameters and points; docs/accuracy.md names the sources."""

import math

from thrustwasher import GearMeshParams, oil, solve_gearmesh

# Third stage of a 5 MW wind gearbox (Nejad et al. 2016), reports of a commercial gear program.
STAGE_3 = {
    "gear_ratio": 95 / 24,
    "pinion_teeth": 24,
    "normal_module": 14e-3,
    "helix_angle": math.radians(10.0),
    "face_width": 0.36,
    "profile_shift_pinion": 0.48,
    "working_centre_distance": 0.861,
    "profile_shift_gear_from_distance": True,
    "tip_diameter_pinion": 0.380747,
    "tip_diameter_gear": 1.395376,
    "sigma_rms": 0.85e-6,
    "mean_roughness": 0.6e-6,
    "youngs_modulus": 206e9,
    "conductivity": 50.0,
    "heat_capacity": 485.0,
    "density": 7830.0,
    "load_factor": 1.678,
    "fzg_stage": 14,
    "pressure_viscosity": 2.162e-8,
    "permissible_film_ratio": 0.143,
    "root_limit": 430e6,
}
FZG_C = {
    "gear_ratio": 1.5,
    "pinion_teeth": 16,
    "normal_module": 4.5e-3,
    "face_width": 14e-3,
    "profile_shift_pinion": 0.1817,
    "profile_shift_gear": 0.1715,
    "working_centre_distance": 91.5e-3,
    "tip_diameter_pinion": 82.46e-3,
    "tip_diameter_gear": 118.36e-3,
    "youngs_modulus": 206e9,
}
# Example 1 of ISO/TR 6336-30 (9 kN m, 360 rpm; rack D of ISO 53), as MATISO_6336.m of
# github.com/gfsReboucas/Drivetrain prints it; the report's text was not at hand.
ISO_EXAMPLE_1 = {
    "gear_ratio": 103 / 17,
    "pinion_teeth": 17,
    "normal_module": 8e-3,
    "helix_angle": math.radians(15.8),
    "face_width": 0.1,
    "profile_shift_pinion": 0.145,
    "working_centre_distance": 0.5,
    "profile_shift_gear_from_distance": True,
    "tool_addendum": 1.4,
    "tool_tip_radius": 0.39,
    "youngs_modulus": 206e9,
    "load_factor": 1.003 * 1.16,
}
# Annex C of ISO 6336-6, a wind gearbox, as the same file and its table_C2.csv have it: bin 3.
ISO_SPECTRUM = {
    "gear_ratio": 60 / 17,
    "pinion_teeth": 17,
    "normal_module": 8.467e-3,
    "pressure_angle": math.radians(25.0),
    "helix_angle": math.radians(15.5),
    "face_width": 0.1524,
    "profile_shift_pinion": 0.172,
    "working_centre_distance": 0.339727,
    "profile_shift_gear_from_distance": True,
    "youngs_modulus": 206e9,
}
# Helical test gears H501 and H701 of GEARpie (REPORT/H501.txt, H701.txt): 15 degrees, 91.5 mm.
GEARPIE_HELICAL = {
    "gear_ratio": 1.5,
    "helix_angle": math.radians(15.0),
    "working_centre_distance": 91.5e-3,
    "profile_shift_gear_from_distance": True,
    "youngs_modulus": 206e9,
    "mean_roughness": 0.6e-6,
}
H501 = {
    **GEARPIE_HELICAL,
    "pinion_teeth": 20,
    "normal_module": 3.5e-3,
    "face_width": 23e-3,
    "profile_shift_pinion": 0.1809,
    "tip_diameter_pinion": 80.672e-3,
    "tip_diameter_gear": 116.264e-3,
}
H701 = {
    **GEARPIE_HELICAL,
    "pinion_teeth": 28,
    "normal_module": 2.5e-3,
    "face_width": 17e-3,
    "profile_shift_pinion": 0.2290,
    "tip_diameter_pinion": 78.552e-3,
    "tip_diameter_gear": 114.386e-3,
    "base_oil": "pao",
}
# Sun and planet of the second stage of the same gearbox, report stage_02.rtf: spur, 75 degC.
STAGE_2 = {
    "gear_ratio": 2.0,
    "pinion_teeth": 18,
    "normal_module": 21e-3,
    "face_width": 0.55,
    "profile_shift_pinion": 0.3890,
    "profile_shift_gear": 0.5039,
    "working_centre_distance": 0.584,
    "tip_diameter_pinion": 0.432838,
    "tip_diameter_gear": 0.815663,
    "sigma_rms": 0.85e-6,
    "mean_roughness": 0.6e-6,
    "youngs_modulus": 206e9,
    "load_factor": 1.25 * 1.06 * 1.10,
    "face_load_factor": 2.06,
    "permissible_film_ratio": 0.143,
}
# Low-loss test gears of GEARpie (REPORT/H951.txt): 200 N m, 1500 rpm, 46.23 mPa s at 75 degC; the
# width is that of its overlap of 1.00.
H951 = {
    "gear_ratio": 57 / 38,
    "pinion_teeth": 38,
    "normal_module": 1.75e-3,
    "helix_angle": math.radians(15.0),
    "face_width": 21.24e-3,
    "profile_shift_pinion": 1.6915,
    "profile_shift_gear": 2.0003,
    "tip_diameter_pinion": 76.23e-3,
    "tip_diameter_gear": 111.734e-3,
    "youngs_modulus": 206e9,
    "mean_roughness": 0.6e-6,
    "sigma_rms": 0.85e-6,
}


def stage_3(**changes):
    """Solve the third stage at 5 MW, 80 degC."""
    grade = oil("ISO VG 220").parameters_for("gearmesh")
    params = GearMeshParams(**{**STAGE_3, **grade, **changes})
    speed = 1165.9 * math.pi / 30.0
    return solve_gearmesh(params, power=5e6, speed=speed, oil_temperature=353.15)


def of_viscosity(eta, celsius):
    """Return the parameters of an oil that has this viscosity [Pa s] at this temperature."""
    return {"viscosity_scale": 1e-4, "viscosity_b": math.log(eta / 1e-4) * (celsius + 70.0)}
