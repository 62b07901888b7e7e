"""Friction torque, temperature and film of a thrust washer at one operating point."""

from thrustwasher import WasherParams, solve_washer


def main() -> float:
    result = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
    print(f"torque       {result.friction_torque:.4f} N m")
    print(f"film         {1e6 * result.film_thickness:.2f} um, ratio {result.film_ratio:.2f}")
    print(f"temperature  {result.temperature - 273.15:.2f} degC on average")

    smoother = WasherParams(roughness=2e-7)
    polished = solve_washer(smoother, load=300.0, speed=953.0, tilt=0.002, start=result)
    print(f"polished     {polished.friction_torque:.4f} N m, ratio {polished.film_ratio:.2f}")
    return result.friction_torque


if __name__ == "__main__":
    main()
