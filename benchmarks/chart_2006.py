"""``thrustwasher chart`` with the method of the washer's paper beside the package's own rungs.

    python benchmarks/chart_2006.py [options of thrustwasher chart]

The method's loops compile for a minute when they are first run.
"""

import sys
from dataclasses import replace
from typing import Any

from failures.plain2006 import charted

from thrustwasher.cli import main
from thrustwasher.study.charts import washer_chart
from thrustwasher.study.charts.washer_chart import WASHER


def with_rival(spec: Any, *, quick: bool = False) -> list[Any]:
    """Return the package's own series, then those of the paper's method."""
    return [*WASHER.series(spec, quick=quick), *charted(quick=quick)]


if __name__ == "__main__":
    washer_chart.WASHER = replace(WASHER, series=with_rival)
    sys.exit(main(["chart", *sys.argv[1:]]))
