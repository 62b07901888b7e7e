"""The washer's map: solutions on both branches, charted for look-up.

==============  ===================================================================================
``look_up``     one look-up, rows of look-ups, folds
``map_file``    the file: an archive with the numbers and their metadata
``map_plan``    what a map covers and how finely: box, patches, pieces; its header
``map_line``    one line: the curve at one speed, tilt and oil temperature
``map_build``   from parameters to a file: lines solved side by side, check, metadata
``map_check``   random points that it was not built from, solved on a mesh
``map_tables``  the maps as the rest of the package knows them: found, built, kept
``map_alone``   the washer as an FMU that only looks up in its map: no solver
``map_mesh``    what a finer mesh changes on the lines of a map, told by a few lines solved on both
``map_survey``  how finely a map has to be cut: measured on some lines that cross its box
==============  ===================================================================================
"""
