"""The files of ``thrustwasher shift``: the report, its pictures, the table, the live page."""

from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import ParameterError

if TYPE_CHECKING:
    from ...shift.shift_result import ShiftResult
    from ..scatter.result import ScatterResult


REPORT, TABLE, LIVE = "report.html", "shift.csv", "try.html"


def load() -> None:
    """Load what draws and read the templates while the shift runs: its steps leave Python free."""
    from scipy import special  # noqa: F401 (the laws of the live page's draws)

    from ...templates import template
    from ..explore import scene_page  # noqa: F401
    from ..report.html import PAGE
    from ..report.shift import shift_report  # noqa: F401 (it draws)

    template(PAGE)


def write(result: "ShiftResult", study: "ScatterResult | None", folder: Path) -> None:
    """Write page, plots and time series into a folder that is still a draft."""
    from ..report.html import render, save_plots

    if result.scene.sequence:
        from ..report.shift.sequence_report import sequence_page

        page = sequence_page(result)
    else:
        from ...shift.account.shift_record import record_of
        from ..report.shift.shift_report import shift_page

        live = _live(result, folder)
        page = shift_page(record_of(result, study), live)
    (folder / REPORT).write_text(render(page), encoding="utf-8")
    save_plots(page, folder)
    result.write_csv(folder / TABLE)


def _live(result: "ShiftResult", folder: Path) -> str:
    """Write the page in which the scene is run again; return its name, "" where there is none."""
    from ..explore.scene_page import scene_page

    try:
        text = scene_page(result.scene, result)
    except ParameterError:  # a master that no page runs
        return ""
    (folder / LIVE).write_text(text, encoding="utf-8")
    return LIVE
