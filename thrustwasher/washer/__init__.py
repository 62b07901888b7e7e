"""The thrust washer in mixed lubrication.

====================  ===========================================================================
``parameters``        parameters; with ``interface.toml`` the one list all interfaces come from
``model``             its record: command, levels, sweeps
``kernel_arguments``  what its kernels take: constants, and memory that each thread keeps
``solve``             one operating point
``washer_result``     what a solve returns, and the error to expect of it
``load_curve``        all solutions over load, with the folds: continuation in the film
``draws``             many washers side by side: scattered parameters, on a branch by its history
``draw_constants``    what the kernels take of many washers
``neighbours``        what solved draws say about the next one
``follow``            inputs are given over time, friction and heat follow
``map``               solutions on both branches, charted for look-up
``kernels``           compiled code
``exchange``          what it shows for model exchange
``fits``              what of a washer can be fitted in addition to its outputs
``mesh_error``        what a washer's torque owes to its mesh, from the solution itself
``sensitivities``     derivatives of a washer's results and of its fold loads over its parameters
====================  ===========================================================================
"""
