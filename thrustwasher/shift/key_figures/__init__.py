"""What is read from the signals of a finished shift.

=====================  ===================================================
``figure_list``        the key figures there are: name, words, unit
``key_figures``        their values, and where the energy went
``events_and_phases``  what happened when
=====================  ===================================================
"""
