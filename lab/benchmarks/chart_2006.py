"""``python -m lab.chart`` with the method of the washer's paper next to the package's own levels.

    python -m lab.benchmarks.chart_2006 [options of python -m lab.chart]

The method's loops compile for a minute when they are first run.
"""

import sys
from dataclasses import replace
from typing import Any

from lab.benchmarks.failures.plain2006 import charted
from lab.chart import main
from lab.charts import washer_chart
from lab.charts.washer_chart import WASHER


def with_rival(spec: Any, *, quick: bool = False) -> list[Any]:
    """Return the package's own series, then those of the paper's method."""
    return [*WASHER.series(spec, quick=quick), *charted(quick=quick)]


if __name__ == "__main__":
    washer_chart.WASHER = replace(WASHER, series=with_rival)
    sys.exit(main())
