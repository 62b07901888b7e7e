"""What is studied, in one form: values by path in, figures by name out.

=================  ==========================================================================
``evaluator``      The form: quantities, figures, ``evaluate``, ``gradient``, ``file``
``make``           An evaluator from a name, a path, a part, a scene or a function
``part``           A part at a point, a steady state in every row
``part_curve``     The loads at which a washer loses its film and gets it back
``lines``          Rows of a part, each solved warm from the one before; runs in the workers
``limits``         Rows with outputs beyond what a part bears: counted by pieces
``scene``          A gear shift
``scene_figures``  What is read from a run of a scene
``scene_runs``     Many runs of one scene: the loop, then its washers apart
``scene_shortcut``  The error of that
``gearbox``        A gearbox that runs steadily in a gear
``engagement``     A wet pack that closes under a rising force while its slip runs out
``function``       A Python function
=================  ==========================================================================

All services are algorithms on this form: a sweep evaluates the rows of a grid, scatter those of a
design, a search rows one after the other. Below ``make`` nothing sees a path, a part or a scene.
"""
