"""Units that hold between two shafts of a driveline they do not know.

==============  ================================================================================
``memory``      what a unit remembers: places of slips, steps, torques, sums
``plant``       inertia and delay of the driveline, identified from the slip that answers the torque
``reversals``   reversals of the slip, and which of them are chatter
``torque``      the torque that ends the slip with the step
``work``        the work that the shafts do to the unit
``drag``        friction that holds only where its shaft could stand
``parameters``  the parameters that say how a unit holds
==============  ================================================================================
"""
