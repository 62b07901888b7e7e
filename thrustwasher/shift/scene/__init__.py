"""What is simulated.

===================  ==============================================================================
``scene``            ``Scene`` and its parts, checked
``scene_file``       TOML file -> ``Scene``; the built-in ones lie in ``../scenes``
``fidelity_option``  which rung of a part is asked for, or which tolerance
``connections``      which parts there are, of which models, and who passes what to whom
===================  ==============================================================================
"""
