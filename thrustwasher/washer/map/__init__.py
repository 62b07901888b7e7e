"""The washer's map: solutions on both branches, charted for look-up.

=============  ================================================================================
``look_up``    A washer's map from Python: look-ups, rows of look-ups, folds
``map_build``  From parameters to a map file: plan, lines solved side by side, check, card
``map_check``  Checking a map: random points that it was not built from, solved on the mesh it
               stands for
``map_file``   Map files: a zip archive with the map's numbers (single precision) and its card
               (JSON)
``map_line``   One line of a map: the curve of solutions at one speed, tilt and oil temperature
``map_plan``   What a map covers and how finely: box, patches, pieces; and its header
=============  ================================================================================
"""
