"""Several shifts over time: temperature of the oil and of the packs, speeds, heat of the packs."""

from typing import Any

from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, CELSIUS, COLOURS, GREEN
from ..style import label, styled, time_figure


@styled
def sequence_figure(result: Any) -> Figure:
    """Return the plot of a ``SequenceResult``; its shifts are marked by thin lines."""
    time, s = result.time, result.signals
    figure, (oil, packs, speeds) = time_figure(7.0, 3, (1.0, 1.0, 1.0))
    oil.plot(time, result.oil_temperature - CELSIUS, color=BLACK, label="oil in the sump")
    label(oil, result.scene.title, "", "oil [°C]")
    for pack in ("clutch", "brake"):
        hot = s[f"{pack}.temperature"] - CELSIUS
        packs.plot(time, hot, color=COLOURS[pack], label=f"{pack}'s plates")
    label(packs, "", "", "plates [°C]")
    for name, colour in (("engine", BLUE), ("output", GREEN)):
        speeds.plot(time, s[f"transmission.{name}_speed"], color=colour, label=name)
    label(speeds, "", "", "speed [rad/s]")
    for axes in (oil, packs, speeds):
        for start, _ in result.scene.sequence.shifts:
            axes.axvline(start, color="0.8", linewidth=0.6, zorder=0)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return figure
