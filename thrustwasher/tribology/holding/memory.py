"""What a unit remembers of the driveline it sits in: places in its memory.

Of slips seen, steps and torques given the newest come first. For each age of the torque there are
sums of the least squares, and the work of the torques.
"""

(
    COUNT,  # steps
    SLIP,
    STEP,
    TORQUE,
    XX,
    XY,
    YY,
    WEIGHT,  # of the samples
    AGE,  # identified, and one more; 0: not yet
    INERTIA,  # kg m2
    ERROR,  # of it: relative standard deviation
    OUTSIDE,  # acceleration of the slip by all other torques [rad/s2]
    FOLLOWS,  # it may be filtered
    HELD,  # steps since the pack last slid
    DIPS,  # steps with dips in this engagement, short ones in part
    STUCK,  # the pack was stuck at the start
    NARROWED,  # 1 - share of the width over which the torque of an unknown plant rises
    SIGN,  # of the slip
    SWING,  # largest change of the torque in a step since the slip last reversed [N m]
    REVERSES,  # it does so in this step
    REVERSED,  # the steps of the last two reversals
    CHATTER,  # until this step
    CAUTION,  # 1 - largest share of the slip that is ended in a step
    MOST_CAPACITY,
    MOST_SLIP,
    CAPACITY,  # of asperities, then of oil [N m], after the last step
    WORK,  # of the torques since the start [J], were they of each age
    LONGEST,  # step [s], of late
    CLOSED,  # steps since the start, or since the unit was open
    BOOKED,  # heat that film and temperatures have had of it [J]
    N_MEMORY,
) = (
    *(0, 1, 4, 7, 12, 15, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32),
    *(34, 35, 36, 37, 38, 40, 43, 44, 45, 46),
)

IDENTIFIED, GIVEN, OFF = 1, 2, 3  # how it holds

# How a unit holds: one of these; inertia [kg m2] and age, if given; the slip [rad/s] over which its
# torque rises where nothing is held; if it may dip.
Coupling = tuple[int, float, int, float, bool]
