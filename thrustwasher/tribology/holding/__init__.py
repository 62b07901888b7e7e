"""Units that hold between two shafts of a driveline they do not know.

==============  ================================================================================
``memory``      what a unit remembers: places of slips, steps, torques, sums
``asking``      the code by which a pack asks: it lowers its torque
``plant``       inertia and delay of the driveline, proved by the slip that answers the code
``reversals``   reversals of the slip, and which of them are chatter
``doubts``      a driveline that was proved and may be another one by now
``sampling``    a speed that comes anew every few steps: the unit steps with it
``torque``      the torque that ends the slip with the step
``work``        the heat: the work that the shafts do to the unit
``drag``        friction that asks and holds nothing, but comes to rest without chatter
``figures``     the numbers in what a unit says when it cannot hold
``parameters``  the parameters that say how a unit holds; those of a bristle
==============  ================================================================================
"""
