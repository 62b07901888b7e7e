"""The friction law fitted to measurements, and what they tell of it.

======================  ==========================================================================
``calibration``         Fit the clutch's friction law to measured friction, and say what the
                        points can tell
``calibration_result``  A friction law fitted to measurements: numbers, sentences, plain data
``data_warnings``       Warnings of a calibration: points that the friction law cannot follow, in
                        plain sentences
``friction_law``        The clutch's friction law as a function of its own constants: values and
                        exact derivatives
``identifiability``     What measured points can tell about the friction law: its constants, and
                        whether load acts
``least_squares``       Least squares for the clutch's friction law: several starts, bounds,
                        profiles of one constant
``measurements``        What a calibration may be asked: names, points and confidence, checked one
                        by one
======================  ==========================================================================
"""
