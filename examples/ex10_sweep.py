"""Load up and down again at several speeds: where the film is lost, and where it comes back."""

import numpy as np

from thrustwasher import run_sweep

SPEEDS = (436.0, 545.0, 654.0)
UP_AND_DOWN = "300:1200:20, 1180:300:-20"  # one line: the path remembers its branch


def main() -> float:
    table = run_sweep("washer", {"load": UP_AND_DOWN, "speed": SPEEDS})  # out="loop.parquet"
    carried = {}
    for speed in SPEEDS:
        line = table["speed"] == speed
        load, lost = table["load"][line], table["distress"][line]
        top = int(np.argmax(load))
        carried[speed] = load[: top + 1][~lost[: top + 1]].max()
        print(
            f"{speed:5.0f} rad/s: film carries up to {carried[speed]:4.0f} N, "
            f"comes back at {load[top:][~lost[top:]].max():4.0f} N; "
            f"torque {table['friction_torque'][line].min():.3f} .. "
            f"{table['friction_torque'][line].max():.3f} N m"
        )
    return float(carried[545.0])


if __name__ == "__main__":
    main()
