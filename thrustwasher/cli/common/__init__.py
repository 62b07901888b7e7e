"""What commands have in common.

==============  ==================================================================
``_solve``      the command that solves a model at one point, made from its record
``_two_shifts`` two shifts on one page
``_options``    options made from a model's inputs and parameters
``_table``      columns of a CSV file, found by their names
``_output``     JSON, tables, progress, files that are written whole or not at all
==============  ==================================================================
"""
