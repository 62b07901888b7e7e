"""What a unit remembers of the driveline it sits in: places in its memory.

Of slips seen, steps, torques given and coded parts the newest come first. For each age of the
torque there are sums of the least squares, and the work of the torques.
"""

(
    COUNT,  # steps
    SLIP,
    STEP,
    TORQUE,
    CODED,  # part of the torque that follows the code
    ZZ,  # sums: coded part, what else the torque did, answer
    ZF,
    FF,
    ZY,
    FY,
    YY,
    WEIGHT,  # of the samples
    KNOWN,  # 1: the coded part was answered
    INERTIA,  # kg m2
    AGE,
    ERROR,  # of the inertia: relative standard deviation
    NOISE,  # of the slip: standard deviation [rad/s]
    ROUGH,  # mean square of the third difference of the slip where nothing is coded
    PROOF,  # largest ratio of an answer to its standard deviation
    TURN,  # place in the code
    REGISTER,  # its shift register
    ASKED,  # steps near zero with a code in this engagement
    TOLD,  # step in which it asked for the last time that costs nothing
    CLOSED,  # steps of this engagement
    SPENT,  # heat that was not made for asking [J]
    AWAY,  # steps since the slip was near zero
    HELD,  # steps since the pack last slid
    QUIET,  # steps since the slip last was beyond the bound of a lock
    OUTSIDE,  # acceleration of the slip by all other torques [rad/s2]
    DOUBT,
    REFUSED,  # 1: the values that were given are refuted in this engagement
    CONFIRMED,  # 1: the slip has answered as what was given says, in this engagement
    LOST,  # 1: the noise of the speeds is too large to hold by what was given
    CAREFUL,  # 1: what was given ends the slip in part; 2: an answer refuted it
    STUCK,  # the pack was stuck at the start
    FELT,  # steps of slip since then
    SIGN,  # of the slip
    SWING,  # largest change of the torque in a step since the slip last reversed [N m]
    REVERSALS,  # of late
    REVERSES,  # it does so in this step
    REVERSED,  # times of the last four [s]
    CHATTER,  # until this step
    WIDTH,  # slip over which the torque of a unit that never asks rises [rad/s]
    CALM,  # steps since its torque last swung to the other side
    MEAN,  # of its torque, fading [N m]
    LEANS,  # sign of its last swing from that
    AMPLITUDE,  # largest slip of the last three half swings, fading
    CLOCK,  # s
    REPEATED,  # steps over which the slip was the same to the bit, now, then at last
    REPEATS,  # how often it was so
    JUMP,  # of the slip when it last changed [rad/s]
    LEAST,  # capacity at the start of this engagement [N m]
    MOST_CAPACITY,
    MOST_SLIP,
    LONGEST,  # step [s], of late
    CAPACITY,  # after the last step [N m]
    DEBT,  # negative work that is not paid back [J]
    WORK,  # of the torques [J], were they of each age; by the power where they were given; counted
    HEAT_AGE,  # the age that heat is booked with, and one more; 0: not yet
    HEAT_INERTIA,  # kg m2, the one it is foreseen with
    OWED,  # heat that was booked and is not due [J]
    RISES,  # torque with which it grows with the turn of the slip in the step that ended [N m]
    HEAT,  # since the start [J]
    BOOKED,  # of it, what film and temperatures have had, and what is foreseen
    FIRST,  # torque at initialization, then rates and slips of the first three steps
    LATE,  # heat that is not made if a torque of each age acts late [J]
    BEFORE,  # capacities before the last step [N m]
    ALONE,  # 1: no driveline makes its torque act late
    PUSHED,  # first acceleration of the slip of a pack that was stuck at the start [rad/s2]
    EVERY,  # steps after which a new slip comes, where it is held; 0: it comes with each
    PHASE,  # of them, how many are over
    SINCE,  # steps before which they were of another length
    PART,  # of the age: what it is more than a whole number of steps
    MISSED,  # changes of the torque that the slip did not answer, of the capacity squared
    USUAL,  # slip of this hold [rad/s]
    STRAYS,  # steps of late in which it was larger
    AGAIN,  # steps in which a pack that holds has still to ask
    UNSURE,  # rounds of it that the slip has still to answer, or never did
    N_MEMORY,
) = (
    *(0, 1, 6, 11, 16, 21, 26, 31, 36, 41, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58),
    *(59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 80, 81, 82, 83),
    *(84, 85, 88, 89, 91, 92, 93, 94, 95, 96, 97, 98, 99, 104, 105, 106, 107, 108, 109, 110),
    *(118, 121, 123, 124, 125, 126, 127, 128, 129, 130, 131, 132, 133, 134),
)

# Numbers in what a unit says when it cannot hold.
(
    T_TESTS,  # near zero slip in this engagement
    T_NOISE,  # of the speed: standard deviation [rad/s]
    T_MOVE,  # what the capacity moves the slip in a step, at most [rad/s]; 0: not known
    T_SLIP,  # rad/s, where what was given was refuted
    T_EXPECTED,  # rad/s, the largest one that was
    T_REPEATS,  # steps over which the speed is the same, 0: it changes with every step
    T_ENGAGEMENT,  # a number of its own
    T_ANSWER,  # inertia that answered where another one was given, 0: none did [kg m2]
    N_FIGURES,
) = range(9)

IDENTIFIED, GIVEN, OFF = 1, 2, 3  # how it holds
NOT_LOCKED, BY_ASKING, BY_GIVEN, BY_TRUST = range(4)  # what a lock rests on

# How a unit holds: one of these; inertia [kg m2] and age, if given; the slip [rad/s] over which its
# torque rises where nothing is held; if it may ask.
Coupling = tuple[int, float, int, float, bool]
