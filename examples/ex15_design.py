"""The washer with the minimum friction that keeps a film, and what would make it better still."""

from thrustwasher import optimise


def main() -> float:
    found = optimise(
        "washer",
        vary={"roughness": "0.3 um:1 um", "washer_thickness": "0.5 mm:2 mm"},
        minimise="friction_torque",
        limits=["film_ratio>=18"],
        at={"load": "300 N", "speed": "953 rad/s", "tilt": 0.002},
    )
    torque = found.best.figures["friction_torque"]
    print(f"{found.start['friction_torque']:.4f} N m before, {torque:.4f} N m now")
    print(", ".join(f"{name} = {value:.4g}" for name, value in found.best.values.items()))
    print(f"{found.tries} designs tried; what binds: {', '.join(found.binding)}")
    return torque


if __name__ == "__main__":
    main()
