"""How sure figures are: the page of a study, and what a shift's report takes of it.

================  ===========================================================================
``decides``       what decides a figure: total indices, else rank correlations
``how_sure``      the section of a shift's report
``scatter_page``  the page of a study
``scatter_plots`` bands over time, distributions, bars of what decides
``scatter_tables`` the tables as rows of text
``words``         figures, bands and probabilities as a person reads them
================  ===========================================================================

A study is taken as its record has it (``thrustwasher.scatter.result.ScatterResult``).
"""

from .scatter_page import scatter_page as scatter_page
