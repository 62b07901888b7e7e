"""What is read from the signals of a finished shift.

=====================  ============================================================================
``figure_list``        the key figures there are: name, words, unit
``key_figures``        their values
``part_figures``       those of packs, washer and mesh
``events_and_phases``  what happened when
``energy_balance``     where the energy went
=====================  ============================================================================
"""
