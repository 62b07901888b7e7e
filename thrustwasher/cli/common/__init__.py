"""What commands have in common.

==============  ==================================================================
``_solve``      the command that solves a model at one point, made from its record
``_options``    options made from a model's inputs and parameters
``_table``      columns of a file, found by their names, and ``--column``
``_progress``   how far a command is, the time left, how it goes on when stopped
``_output``     JSON, tables, files that are written whole or not at all
==============  ==================================================================
"""
