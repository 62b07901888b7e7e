"""Golden records: numbers kept as they are, so that a change of the code says which of them moved.

``python -m lab.golden --check [NAME ..]`` computes and compares, ``--write [NAME ..] --why TEXT``
renews records. Records of *bits* hold digests of numbers that only kernels make, which every
platform computes alike; records of *numbers* hold values that NumPy and SciPy have a part in, with
the versions that made them. Times, paths and versions are in neither.

============  ==================================================================================
``cases``     what is recorded of FMUs, shifts, sweeps, fits, searches, scatter, tables
``record``    columns as bits, results as numbers; a record's file; where two of them differ
``*.json``    the records
============  ==================================================================================
"""
