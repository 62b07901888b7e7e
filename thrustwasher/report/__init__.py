"""Plots and the report of a shift.

================  =================================================================
``style``         colours, line widths, empty figures: one look for all plots
``washer_plots``  maps of film, pressure and temperature over the washer
``curve_plot``    the washer's load curve with its folds
``clutch_plot``   friction of a pack against slip speed
``shift_record``  what the report needs from a finished shift
``shift_plots``   speeds, torques, temperatures, film ratios, loads, energy over time
``summary``       what happened, in sentences made from the numbers
``tables``        the report's tables as rows of text
``html``          one self-contained page
================  =================================================================
"""
