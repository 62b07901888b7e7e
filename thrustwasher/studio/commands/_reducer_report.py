"""The report of a reducer that ``train``, ``efficiency`` and ``optimise`` write."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...cli.common import _output

if TYPE_CHECKING:
    from ...model.part_file import PartFile
    from ...train.train_file import TrainScene

RUNS = 256  # of the scatter about the first point
HELP = "of a gear train: write a report of a few pages as HTML"


def target(path: str | None) -> Path | None:
    """Return the file of a report, checked before any work is done."""
    return _output.check_file(path, "--report", (".html",)) if path else None


def write(
    file: Path, part: "PartFile | TrainScene", points: Sequence[Mapping[str, float]], **more: Any
) -> None:
    """Write the report of a reducer at operating points; ``more``: as of ``reducer_page``."""
    from ...train.train_file import TrainScene, train_of
    from ..report.html import render
    from ..report.reducer_report import reducer_page

    scene = part if isinstance(part, TrainScene) else train_of(part)
    study = None
    if scene.part.scatter:
        from ..scatter.propagate import propagate

        study = propagate(scene.part, at=dict(points[0]), runs=RUNS, indices=False, workers=1)
    show = _output.time_left("report:")
    page = reducer_page(scene, points, study=study, progress=show, **more)
    _output.write_text(file, render(page))
    _output.note(f"wrote {file}")
