"""Build FMUs: ``python build_fmu.py [MODEL ...] [OPTION ...]`` is ``thrustwasher build``."""

import sys

from thrustwasher.cli import main

if __name__ == "__main__":
    sys.exit(main(["build", *sys.argv[1:]]))
