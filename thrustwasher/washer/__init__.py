"""The thrust washer in mixed lubrication.

====================  ============================================================================
``closed_forms``      Exact solutions that the washer is compared with
``follow``            The washer over time: inputs are given at points, friction and heat follow
``kernel_arguments``  From the washer's parameters to what its kernels take: mesh, contact tables,
                      scalars
``kernels``           Compiled code of the thrust washer
``load_curve``        The whole curve of a washer's solutions over load, with its folds:
                      continuation in the film
``map``               The washer's map: solutions on both branches, charted for look-up
``parameters``        Parameters, inputs and outputs of the thrust washer: the one list all
                      interfaces come from
``solve``             The thrust washer: one operating point
``washer_result``     What a washer solve returns, and the error to expect of it
====================  ============================================================================
"""
