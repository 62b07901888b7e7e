"""What the chart shows that is the same on every machine: ``python benchmarks/same_everywhere.py``.

Where methods fail, the limits of coupling, what the corrections of the physics moved; some minutes
on one core. Writes ``thrustwasher/data/same_everywhere.json``, which ``thrustwasher chart`` draws,
and ``docs/stability.md``.
"""

import json
from pathlib import Path

from corrections import corrections
from failures.coupling_limits import limits
from failures.failure_map import stability

from thrustwasher.study.charts.chart_page import SAME_EVERYWHERE, stability_markdown
from thrustwasher.study.surroundings import surroundings

PAGE = Path(__file__).parents[1] / "docs" / "stability.md"


def main() -> None:
    """Measure, then write record and page."""
    record = surroundings("python benchmarks/same_everywhere.py")
    record |= {"quick": False, "models": {}, "corrections": corrections()}
    record |= {"stability": stability(), "limits": limits()}
    SAME_EVERYWHERE.write_text(json.dumps(record, indent=1, allow_nan=False) + "\n", "utf-8")
    PAGE.write_text(stability_markdown(record), "utf-8")


if __name__ == "__main__":
    main()
