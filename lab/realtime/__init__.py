"""How long the longest step of an FMU takes, and what bounds it.

===================  ======================================================================
``host``             an FMU of FMI 2.0 called by address: no Python in a step
``longest_step``     mean, rare and longest times of a level, and the work in its steps
``loop_bounds``      every loop of the kernels that ends by a test: its bound, what comes out
``timed_steps``      compiled code: steps, their times, repeats of the slow ones
``walk``             inputs, steps and restarts: at random over a box, with jumps
===================  ======================================================================
"""

from thrustwasher.model.registry import OTHERS

OTHERS.append(__name__)  # compiled when it is used: no library of it is shipped
# What Python calls: module of the library -> functions, each with its arrays of two dimensions.
CALLED = {
    "lab.realtime.timed_steps": ("lab.realtime.timed_steps.run_steps parameters outputs inputs",),
}
