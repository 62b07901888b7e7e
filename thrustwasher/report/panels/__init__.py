"""Pictures of a shift over time.

==================  ===============================================================
``contact_panels``  what happens in the contacts: oil films, friction, tooth stress
``motion_panels``   speeds, torques, temperatures, energy, a swinging shaft
``panel_base``      what all panels share: lines, phases, events
``shift_plots``     one figure per question, made of panels
==================  ===============================================================
"""
