"""Why a wet clutch may shudder: its friction rises while the slip falls."""

from thrustwasher import ClutchParams, boundary_friction, solve_clutch


def main() -> float:
    pack = ClutchParams(friction_law="wang")
    for speed in (200.0, 100.0, 50.0, 25.0, 10.0):
        result = solve_clutch(pack, load=5898.0, speed=speed, interface_temperature=373.15)
        print(
            f"{speed:5.0f} rad/s  mu {result.friction_coefficient:.4f}  "
            f"{result.friction_torque:6.1f} N m"
        )
    print("boundary friction at full shear strength:", boundary_friction(0.1, 1.0, 0.085275))

    slow = solve_clutch(pack, load=5898.0, speed=25.0, interface_temperature=373.15)
    fast = solve_clutch(pack, load=5898.0, speed=50.0, interface_temperature=373.15)
    return (fast.friction_torque - slow.friction_torque) / 25.0


if __name__ == "__main__":
    main()
