"""The chart of the gear mesh: its rungs."""

from .chart_series import KELVIN, WARM, Chart, Quantity, rungs

GEARMESH = Chart((Quantity("friction_torque", True, 1e-4), KELVIN), WARM, rungs)
