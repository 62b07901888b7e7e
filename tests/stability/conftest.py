"""The FMUs' own files in ``loops/slaves`` are all called slave.py, and are no tests.

Neither is this file, where pytest looks for doctests.
"""

collect_ignore_glob = ["loops/slaves/*", "*conftest.py"]
