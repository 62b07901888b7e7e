"""Pictures of a shift over time.

==================  ===============================================================
``contact_panels``  what happens in the contacts: oil films, friction, tooth stress
``motion_panels``   speeds, torques, pressures, jerk, temperatures, energy
``panel_base``      what all panels share: lines, phases, events
``sequence_plot``   several shifts: temperatures of oil and packs, speeds
``shift_plots``     one figure per question, made of panels
==================  ===============================================================
"""
