"""Slip and torque through sensors and along a prescribed sine, drawn: version over version."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from . import sensors
from .drive import Scene, run
from .plants import two_shafts
from .rows_slip import pack, stepped

ENGINE, VEHICLE, CAPACITY = 0.15, 1.0, 216.0  # kg m2, N m
DRIVES, BRAKES, FIRST, BASE = 100.0, 20.0, 200.0, 0.0  # N m, N m, rad/s, rad/s
STEP, COUNT, SHOWN = 1e-3, 660, 220  # steps, and how many of them are shown
FROM, SAMPLES = 430, 120
OLD, NEW = "0.72", "#0072b2"
SIZE = (8.4, 4.4)  # inches


def scene(sensor: Any) -> Scene:
    """Return an engine that a pack locks to a vehicle, seen through a sensor."""
    plant = two_shafts(ENGINE, VEHICLE, BASE + FIRST, BASE)
    return Scene(
        plant=plant,
        times=tuple(STEP * k for k in range(COUNT + 1)),
        load=lambda t, s: [CAPACITY * min(1.0, 0.033 + 0.967 * t / 0.3)],
        outside=lambda t: (DRIVES, BRAKES),
        capacity=CAPACITY,
        first=FIRST,
        inertia=[ENGINE * VEHICLE / (ENGINE + VEHICLE)],
        age=1,
        sensor=sensor,
    )


def engagement(fmu: str, sensor: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return time [ms], slip and torque."""
    trace = run(fmu, scene(sensor), "identified")
    return trace.times * 1e3, trace.slip[:, 0], trace.torque[:, 0]


def sine(fmu: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the same along 10 rad/s at 10 Hz, in steps of 10 ms."""
    times = np.arange(SAMPLES) * 10 * STEP
    slip = 10.0 * np.sin(2 * np.pi * 10.0 * times)
    capacity = np.full(SAMPLES, CAPACITY)
    unit = pack(fmu, "identified", CAPACITY, slip[0])
    rows = stepped(unit, slip, capacity, 10 * STEP)
    unit.close()
    return times * 1e3, slip, rows[:, unit.at["friction_torque"]]


def draw(fmus: list[str], path: Path) -> None:
    """Draw into an SVG; several FMUs: the first is today's, later ones are grey below it."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    mpl.rcParams |= {"svg.hashsalt": "judge", "svg.fonttype": "none", "font.size": 9}
    columns = {
        "12 bit": lambda f: engagement(f, sensors.quantised(sensors.TWELVE_BIT)),
        "1 rpm": lambda f: engagement(f, sensors.quantised(sensors.RPM)),
        "noise of 0.5 rpm": lambda f: engagement(f, sensors.noisy(0.5 * sensors.RPM, 3)),
        "prescribed sine": sine,
    }
    figure, axes = plt.subplots(2, 4, figsize=SIZE, sharex="col", layout="constrained")
    for column, (title, make) in zip(axes.T, columns.items(), strict=True):
        for fmu in reversed(fmus):
            time, slip, torque = make(fmu)
            new = fmu == fmus[0]
            style = {"color": NEW if new else OLD, "lw": 1.1 if new else 0.8}
            some = slice(SAMPLES // 2, None) if make is sine else slice(FROM, FROM + SHOWN)
            column[0].plot(time[some], slip[some], **style, zorder=2 + new)
            column[1].plot(time[some], torque[some], **style, zorder=2 + new)
        column[0].set_title(title, fontsize=9)
        column[1].set_xlabel("time [ms]")
        for axis in column:
            axis.grid(color="0.92", lw=0.6)
            axis.spines[["top", "right"]].set_visible(False)
        column[1].set_ylim(-240, 240)
    axes[0, 0].set_ylabel("slip [rad/s]")
    axes[1, 0].set_ylabel("torque [N m]")
    if len(fmus) > 1:
        axes[0, 3].plot([], [], color=OLD, label="0.22.0")
        axes[0, 3].plot([], [], color=NEW, label="now")
        figure.legend(loc="outside upper right", ncols=2, frameon=False)
    figure.savefig(path, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    text = path.read_text("utf-8")
    text = re.sub(r"-?\d+\.\d{3,}", lambda m: f"{float(m[0]):.1f}".removesuffix(".0"), text)
    path.write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n", "utf-8")
