"""Slip and torque of a pack between two inertias over time, with holding off and identified.

python -m lab.benchmarks.holding.time_history [FOLDER]

0.15 and 1 kg m2, a slip of 200 rad/s, 100 N m that drive and 20 N m that brake; the load on the
default pack rises from 200 to 6000 N in 0.3 s. Both inertias are stepped exactly by a host that
passes the torque of this step, or that of the step before. The insets show the slip once the pack
could hold. driveline.png goes to FOLDER.
"""

import argparse
import sys
from collections import deque
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "tests/core/clutch/holding"))

from unit import PACK, Unit

from thrustwasher.clutch.parameters import ClutchParams

INERTIAS, SLIP, DRIVING, BRAKING = (0.15, 1.0), 200.0, 100.0, 20.0
LOADS, RISE, END = (200.0, 6000.0), 0.3, 0.6  # N, s, s
HOSTS, DELAYS = (1e-4, 1e-3, 5e-3), (0, 1)
STYLES = {"off": ("#d55e00", 1.0, 0.8), "identified": ("#0072b2", 1.6, 1.0)}
CLOSE = (0.45, 0.6)  # s, of the insets
PASSED = {0: "fresh torque", 1: "torque a step old"}


def profile(holding: str, host: float, delay: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return times, slip at them and the torque that acts from them on."""
    gain = PACK.faces * PACK.friction_radius * PACK.constant_friction
    whole = SimpleNamespace(gain=gain, loads=LOADS)  # loads and torques as they are
    unit = Unit(whole, params=ClutchParams(holding=holding), fidelity="field")
    inertia = 1.0 / sum(1.0 / x for x in INERTIAS)
    outside = DRIVING / INERTIAS[0] + BRAKING / INERTIAS[1]
    slip, waiting = SLIP, deque([0.0] * delay)
    times = host * np.arange(round(END / host))
    slips, torques = np.zeros_like(times), np.zeros_like(times)
    for n, t in enumerate(times):
        load = float(np.interp(t, (0.0, RISE), LOADS))
        waiting.append(unit.step(slip, host, load))
        slips[n], torques[n] = slip, waiting.popleft()
        slip += host * (outside - torques[n] / inertia)
    return times, slips, torques


def draw(folder: Path) -> None:
    """Write the picture."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams |= {"font.size": 9}
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(4, 3, figsize=(10.5, 9.0), sharex=True, sharey="row")
    for i, delay in enumerate(DELAYS):
        for j, host in enumerate(HOSTS):
            upper, lower = axes[2 * i : 2 * i + 2, j]
            small = upper.inset_axes((0.66, 0.5, 0.32, 0.38))
            for holding, style in STYLES.items():
                add((upper, small, lower), profile(holding, host, delay), holding, style)
            small.set_xlim(*CLOSE)
            small.set_xticks([])
            small.set_title(f"slip after {CLOSE[0]:g} s", fontsize=7, pad=2)
            small.locator_params(axis="y", nbins=4)
            small.tick_params(labelsize=7)
            small.grid(alpha=0.3)
            upper.set_title(f"host step {1e3 * host:g} ms, {PASSED[delay]}", fontsize=9)
    for i, line in enumerate(axes):
        line[0].set_ylabel("torque [N m]" if i % 2 else "slip [rad/s]")
        for panel in line:
            panel.grid(alpha=0.3)
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=2, frameon=False)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.97))
    figure.savefig(folder / "driveline.png", dpi=110)


def add(panels: Any, made: Any, holding: str, style: tuple[str, float, float]) -> None:
    color, width, alpha = style
    times, slips, torques = made
    kept = {"color": color, "lw": width, "alpha": alpha}
    upper, small, lower = panels
    upper.plot(times, slips, label=f"holding = {holding}", **kept)
    held = times > CLOSE[0]
    small.plot(times[held], slips[held], **kept)
    lower.plot(times, torques, drawstyle="steps-post", **kept)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw slip and torque over time.")
    parser.add_argument("folder", nargs="?", type=Path, default=Path("."))
    draw(parser.parse_args().folder)


if __name__ == "__main__":
    main()
