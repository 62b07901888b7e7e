"""Pictures of a shift over time.

==================  =============================================================================
``contact_panels``  Panels of what happens in the contacts of a shift: oil films, friction, tooth
                    stress
``motion_panels``   Panels over the time of a shift: speeds, torques, temperatures, energy, a
                    swinging shaft
``panel_base``      What all panels over the time of a shift share: lines, phases, events
``shift_plots``     What happened over time in a shift: one figure per question
==================  =============================================================================
"""
