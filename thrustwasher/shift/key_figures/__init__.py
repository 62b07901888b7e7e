"""What is read from the signals of a finished shift.

=====================  ===================================================
``figure_list``        the key figures there are: name, words, unit
``key_figures``        their values, and where the energy went
``comfort``            what passengers feel: jerk, torque hole, flare
``events_and_phases``  what happened when
=====================  ===================================================
"""
