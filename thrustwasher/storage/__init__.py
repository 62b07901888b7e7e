"""Files that appear whole or not at all, work that can be resumed, digests.

===============  ===============================================================================
``digests``      Fingerprints: of parameters, of the sources of a level's numbers, of a file
``journal``      Finished work on disk, in an SQLite file: what was stopped goes on where it was
``whole_files``  Files and folders that are written whole or not at all
``tables``       Tables of measured data as spreadsheets, loggers and programs write them
===============  ===============================================================================
"""
