"""uncertainty of figures: the page of a study, and what a shift's report takes of it.

==================  ========================================================================
``decides``         what decides a figure: total indices, else rank regression
``lost_power``      of a gear train: the efficiency as the power lost in per cent
``scatter_plots``   bands over time, distributions, bars of what decides
``scatter_tables``  the tables as rows of text
``study_data``      what they read of a study: types
``study_page``      the page of a study
``words``           figures, bands and probabilities as a person reads them
==================  ========================================================================

A study is taken as its record has it (``thrustwasher.studio.scatter.result.ScatterResult``).
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .study_page import scatter_page as scatter_page


def __getattr__(name: str) -> Any:
    """Return ``scatter_page`` when it is requested: who wants words alone waits for no drawing."""
    if name != "scatter_page":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from .study_page import scatter_page

    return scatter_page
