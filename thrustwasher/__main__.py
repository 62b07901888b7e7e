# PYTHON_ARGCOMPLETE_OK
"""``python -m thrustwasher`` is the command line."""

import sys

from .cli import main

sys.exit(main())
