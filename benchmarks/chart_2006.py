"""``thrustwasher chart`` with the method of the washer's paper beside the package's own rungs.

    python benchmarks/chart_2006.py [options of thrustwasher chart]

The method's loops compile for a minute when they are first run.
"""

import sys

from failures.plain2006 import charted

from thrustwasher.cli import main
from thrustwasher.study.charts.chart_series import RIVALS

if __name__ == "__main__":
    RIVALS["washer"] = charted
    sys.exit(main(["chart", *sys.argv[1:]]))
