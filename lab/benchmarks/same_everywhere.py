"""What the chart shows that is the same on every machine.

``python -m lab.benchmarks.same_everywhere``.

Where methods fail, the limits of coupling, what the corrections of the physics moved; some minutes
on one core. Writes ``lab/charts/same_everywhere.json``, which ``python -m lab.chart`` draws,
and ``docs/stability.md``.
"""

import json
from pathlib import Path

from lab.benchmarks.corrections import corrections
from lab.benchmarks.failures.coupling_limits import limits
from lab.benchmarks.failures.failure_map import stability
from lab.charts.chart_page import SAME_EVERYWHERE, stability_markdown
from lab.charts.surroundings import surroundings

PAGE = Path(__file__).parents[2] / "docs" / "stability.md"


def main() -> None:
    """Measure, then write record and page."""
    record = surroundings("python -m lab.benchmarks.same_everywhere")
    record |= {"quick": False, "models": {}, "corrections": corrections()}
    record |= {"stability": stability(), "limits": limits()}
    SAME_EVERYWHERE.write_text(json.dumps(record, indent=1, allow_nan=False) + "\n", "utf-8")
    PAGE.write_text(stability_markdown(record), "utf-8")


if __name__ == "__main__":
    main()
