"""What is simulated.

===================  ==============================================================================
``scene``            ``Scene`` and its parts, checked; which rung or tolerance is asked for
``scene_file``       TOML file -> ``Scene``; the built-in ones lie in ``../scenes``
``connections``      which parts there are, of which models, and who passes what to whom
===================  ==============================================================================
"""
