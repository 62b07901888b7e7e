"""A gearbox of gear pairs on parallel shafts: an EV's reducer, a manual gearbox in a gear, an axle.

================  =======================================================================
``parameters``    shafts, bearings, meshes, oil: flat, for up to three meshes
``train_signals`` inputs and outputs, what a figure of them is called
``model``         its record
``train_file``    a scene ``[train]``: shafts and meshes by name, made into a part
``train_text``    such a scene as text
``solve``         forces, losses and limits at one operating point
``train_map``     efficiency, losses by source and limits over torque, speed, oil temperature
``kernels``       compiled code
================  =======================================================================
"""
