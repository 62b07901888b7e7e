"""Uncertainty of a shift's figure: what the scatter of inputs makes of them, and what decides."""

from markupsafe import Markup

from ....shift.account.shift_record import Record
from ..html import Section, Table
from ..scatter import scatter_tables
from ..scatter.decides import chances, lost_texts, shares, verdict
from ..scatter.study_page import (
    ERROR_TEXT,
    MOST_FIGURES,
    decided_sections,
    film_figures,
    main_figures,
    over_time_sections,
    source_texts,
    washer_figures,
)
from ..scatter.words import joined, not_expected, sentence, spoken, steady_texts

MOST = 6  # figures with bars
STUDY = "scatter/scatter.html"  # next to the report
DOUBTED = (
    "In the nominal run steady washers do not hold or could not be followed, see the warning: the "
    "bands of washer temperatures are as doubtful."
)
OF_THE_SHIFT = (
    *("lock_after_ramp_start", "lock_after_half_ramp", "slip_energy", "peak_jerk"),
    *("torque_hole", "flare"),
)


def how_sure_sections(record: Record) -> list[Section]:
    """Return what a study of the scene says; nothing without one."""
    result = record.scatter
    if result is None:
        return []
    chosen, main = _chosen(record), main_figures(result, MOST_FIGURES)
    title, texts = (
        "Uncertainty",
        [*_verdicts(record), *not_expected(result, main), *_study_texts(record)],
    )
    figures = scatter_tables.figure_table(result, main)
    decided = decided_sections(result, chosen)
    sources, errors = scatter_tables.source_table(result), scatter_tables.error_table(result, main)
    return [
        Section("how-sure", title, texts=texts, tables=[figures]),
        *decided,
        *over_time_sections(result),
        Section(
            "scatter",
            "Inputs with a scatter (uncertainty), and numerical errors",
            texts=[*source_texts(result), ERROR_TEXT, *map(sentence, result.notes)],
            tables=[sources, errors, *_failed(record)],
        ),
    ]


def _failed(record: Record) -> list[Table]:
    return [scatter_tables.failed_table(record.scatter)] if record.scatter.failed else []


def _chosen(record: Record) -> list[str]:
    """Return the figures that get bars: of the shift, then of the washers."""
    result = record.scatter
    washers = [*film_figures(result), "washer_torque", *washer_figures(result)]
    found = [n for n in (*OF_THE_SHIFT, *washers) if n in result.figures]
    decided = [name for name in dict.fromkeys(found) if shares(result, name)]
    shift = [name for name in decided if name in OF_THE_SHIFT][: MOST // 2]
    washers = [name for name in decided if name not in OF_THE_SHIFT]
    return [*shift, *washers[: MOST - len(shift)]]


def _verdicts(record: Record) -> list[str]:
    """Return what the verdicts on washers and shift rest on, and the probabilities."""
    result = record.scatter

    def words(name: str) -> str:
        return source_words(record, name)

    texts = verdict(result, "the washers", film_figures(result), words)
    texts += verdict(result, "the shift", OF_THE_SHIFT[:4], words)
    said = sentence("; ".join(chances(result)))
    return [*texts, *([said] if said else []), *lost_texts(result)]


def _study_texts(record: Record) -> list[str]:
    """Return what the study was, and what must be known of it."""
    r = record.scatter
    return [
        f"{r.runs} base points, {r.solves} runs. {scatter_tables.share_of_failed(r)} Bands are "
        "shaded in the plots above.",
        *steady_texts(r),
        *([DOUBTED] if steady_is_doubted(record) else []),
        Markup('The whole study: <a href="{0}">{0}</a> next to this page.').format(STUDY),
        *map(sentence, r.warnings),
    ]


def steady_is_doubted(record: Record) -> bool:
    """Return whether the nominal run, followed in time, warns of its steady washers."""
    return any(found.differences or found.stopped for found in record.in_time.values())


def source_words(record: Record, name: str) -> str:
    """Return what a source is in the words of its model, its name where they have none."""
    if " + " in name:
        return " + ".join(source_words(record, one) for one in name.split(" + "))
    part, _, own = name.partition(".")
    found = record.part(part)
    field = found.spec.params.__dataclass_fields__.get(own) if found else None
    help = str(field.metadata.get("help", "")) if field else ""
    return f"“{spoken(help)}” ({name})" if help else joined(name)
