"""What thermal stress leaves of a gear's contact endurance: fewer teeth, hotter flanks."""

from thrustwasher import GearMeshParams, solve_gearmesh


def main() -> float:
    print("teeth  surface  asperities  film ratio  contact   allowable ratio")
    print("          degC        degC               MPa     AISI 1020  AISI 4340")
    for teeth in (18, 20, 24, 30, 40):
        mesh = GearMeshParams.preset("paper", pinion_teeth=teeth, gear_ratio=5.0)
        r = solve_gearmesh(mesh, power=7500.0, speed=180.0)
        print(
            f"{teeth:4d}  {r.surface_temperature - 273.15:8.2f}"
            f"{r.asperity_temperature - 273.15:12.1f}{r.film_ratio:11.2f}"
            f"{1e-6 * r.contact_stress:10.0f}{r.allowable_ratio_aisi1020:11.3f}"
            f"{r.allowable_ratio_aisi4340:11.3f}"
        )

    point = {"power": 7500.0, "speed": 180.0}
    rough, fine = (
        solve_gearmesh(GearMeshParams.preset("paper", gear_ratio=5.0, surface=surface), **point)
        for surface in ("rough", "fine")
    )
    print(
        f"rough ground flanks are {rough.asperity_temperature - fine.asperity_temperature:.0f} K "
        f"hotter than fine ground ones; the mesh loses {rough.friction_power:.0f} W"
    )
    return rough.allowable_ratio_aisi4340


if __name__ == "__main__":
    main()
