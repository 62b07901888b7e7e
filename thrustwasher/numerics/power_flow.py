"""Which way power runs between two shafts, and the efficiency in that direction."""

import math

FORWARD, BACKWARD = "input to output", "output to input"
BOTH, NONE_OUT, AT_REST = "both shafts feed in", "no power comes out", "at rest"
SELF_LOCKING = "self-locking"
FLOWS = {
    FORWARD: "the input drives: efficiency is output over input",
    BACKWARD: "coasting, the output drives: efficiency is what comes out at the input over that",
    BOTH: "the losses take more than either shaft alone brings: no efficiency",
    NONE_OUT: "one shaft has no torque, the other one feeds the losses: no efficiency",
    AT_REST: "nothing turns: no efficiency",
    SELF_LOCKING: "losses grow faster than what drives: no torque of that shaft alone turns it",
}


def power_flow(power_in: float, power_out: float) -> tuple[float, str]:
    """Return (efficiency [-], flow): what comes out over what goes in, and a word of ``FLOWS``.

    ``power_in`` goes in at the input, ``power_out`` comes out at the output [W], of either sign.
    NaN where nothing comes out; the word says why.
    """
    if power_in > 0.0 and power_out > 0.0:
        return power_out / power_in, FORWARD
    if power_in < 0.0 and power_out < 0.0:
        return power_in / power_out, BACKWARD
    if power_in == 0.0 and power_out == 0.0:
        return math.nan, AT_REST
    return math.nan, NONE_OUT if power_in == 0.0 or power_out == 0.0 else BOTH
