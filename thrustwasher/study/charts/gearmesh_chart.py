"""The chart of the gear mesh: its operating points."""

from .chart_series import KELVIN, WARM, Chart, Quantity, rungs
from .methods import ChartCase

# pinion torque N m, speed rad/s, oil K
CASES = (
    ChartCase("centre", (7500.0 / 180.0, 180.0, 299.85)),
    ChartCase("light", (5.0, 180.0, 299.85)),
    ChartCase("heavy", (120.0, 180.0, 299.85)),
    ChartCase("slow", (40.0, 10.0, 299.85)),
    ChartCase("fast", (40.0, 1000.0, 299.85)),
    ChartCase("hot oil", (40.0, 180.0, 373.15)),
    ChartCase("fast, light, hot", (5.0, 1000.0, 373.15)),
    ChartCase("slow, heavy, cold", (120.0, 10.0, 263.15)),
)
GEARMESH = Chart(
    (Quantity("friction_torque", True, 1e-4), KELVIN), WARM, rungs, CASES, (0, 2, 3, 4)
)
