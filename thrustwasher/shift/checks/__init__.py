"""What a finished run is worth: checks after it, whose findings are warnings.

====================  ===========================================================================
``guard``             both checks below, and what follows from them
``step_error``        a second run with shorter steps: errors of the communication step
``step_estimate``     what it found: plain data
``washer_in_time``    washers followed in time along the run: whether steady states hold
``run_doubts``        what a scene and its signals show without a further run
``rule_data``         what the rules of warnings know of a scene, for Python and for pages
``capacity``          what a pack can carry, and what its gear asks for
``steady_doubts``     what must not be missed at a steady point of a gearbox
``windows``           windows of a run of several shifts: where each began
====================  ===========================================================================
"""
