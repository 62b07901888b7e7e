"""Compiled code of the gear mesh.

==========================  ======================================================================
``constants``               What the parameters of a gear mesh come to before any speed or torque
                            is known
``contact``                 Line contact of two flanks: Hertz, oil film, friction, thermal stress
                            and endurance
``directional_derivative``  How the outputs of the gear mesh change with its inputs: exact, from
                            the numbers of a step
``flank_temperature``       Temperature rises at a sliding line contact: friction on the flank,
                            shear of the oil film
``layout``                  Where each number of the gear mesh lies in its arrays
``line_of_action``          Rung `fine` of the gear mesh: resolved along the line of action
``mesh_point``              The mesh at one operating point: load, film, heat, stress
``step``                    One co-simulation step of the gear mesh: it follows its inputs at once
                            and remembers nothing
==========================  ======================================================================
"""
