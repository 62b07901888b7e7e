"""What is simulated.

===================  ==============================================================================
``scene``            ``Scene`` and its parts, checked; which level or tolerance is requested
``scene_file``       TOML file -> ``Scene``; the built-in ones lie in ``../scenes``
``scene_tables``     numbers with their units; engine, vehicle, pressures, thrust bearings
``profile_file``      profiles of pressure, torque, road load in files, as numbers of the scene
``polyline``         a recorded profile as a few points
``doubts``           what a scene says that is hardly meant
``places``           what can scatter, by the path of its value
``variation``        a scene with other values at some paths, and the text of its file
``sequence``         several shifts in one run, each as a scene
``connections``      which parts there are, of which models, and who passes what to whom
===================  ==============================================================================
"""
