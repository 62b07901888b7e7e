"""Pictures of one model.

===================  ===========================================================================
``clutch_plot``      a wet pack: friction against slip, an engagement over time
``fit_plot``         a calibration: measured values, the fit with its confidence band, residuals
``gearmesh_plot``    temperatures of a gear mesh and what they leave of its endurance
``losses_plot``      driveline losses: heat by source over speed and oil temperature
``ranking_plot``     what one percent more of each parameter changes
``trace_plot``       recordings over time: measured, fitted, what is left
``train_plot``       a gear train: losses by source, and over torque of either sign
``contours``         lines of equal value over a map, each with its number
``reducer_plots``    a reducer's report: loss map with operating points, sources, lives
``sweep_plot``       the first outputs of a sweep over what is varied
``matrix_plot``      points of a sweep that are no grid: outputs over what was varied
``washer_plots``     the washer: maps over its annulus, its load curve with the folds
``efficiency_plot``  efficiency over torque and speed, and the losses by source along both
``optimum_plot``     designs that a search has tried: the front between two figures
``comparison_plot``         measured values of a measured data set with their errors
===================  ===========================================================================
"""

from collections.abc import Callable

from matplotlib.figure import Figure

from .clutch_plot import slip_figure
from .gearmesh_plot import gearmesh_figure
from .losses_plot import losses_figure
from .ranking_plot import ranking_figure as ranking_figure
from .train_plot import train_figure
from .washer_plots import field_figure

# What --plot of a model's command draws, by the models' keys: of (result, point, parameters).
FIGURES: dict[str, Callable[..., Figure]] = {
    "washer": field_figure,
    "clutch": slip_figure,
    "gearmesh": gearmesh_figure,
    "losses": losses_figure,
    "train": train_figure,
}
