"""What the package ships and reads back, and what is kept of unfinished work.

===============  =================================================================================
``digests``      fingerprints: of parameters, of the kernels of a rung; checksums in JSON files
``whole_files``  files and folders that are written whole or not at all
``journal``      finished work on disk, so that what was stopped goes on
``card_parts``   the parts of a card
``cards``        the verified error and the cost of a rung: reading, finding, asking
``maps``         files of washer maps
===============  =================================================================================
"""
