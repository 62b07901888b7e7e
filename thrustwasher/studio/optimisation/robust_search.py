"""Designs under scatter: decisive scenarios, and the best design checked by fresh draws."""

from collections.abc import Collection
from dataclasses import replace
from typing import NamedTuple

from ...errors import SolveError
from .archive import Archive
from .confirmation import best_design
from .designs import Array
from .front import apart
from .multistart import NEAR, Means, restore_feasibility, search_goals
from .optimum import Design
from .robustness import DRAWS, JUDGED, Share, critical, drawn, judged

KEPT = 12  # designs that are judged anew by other draws


class Validated(NamedTuple):
    """The best design, its share of fresh draws, and what must be said of it."""

    best: Design
    share: Share
    archive: Archive
    warnings: tuple[str, ...] = ()


def with_critical_scenarios(means: Means, archive: Archive) -> Archive:
    """Choose the draws by the best design so far, and judge the next best by them."""
    share = archive.problem.robust
    if share is None:
        return archive
    row = archive.row(int(archive.ranked(0)[0]))
    straight = means.budget.polish > 0
    found = drawn(means.pool, row, DRAWS, means.seed, straight=straight)
    return _judged_by(means, archive, critical(archive.problem, *found, share))


def _judged_by(means: Means, archive: Archive, more: Collection[tuple[float, ...]]) -> Archive:
    """Return the best designs alone, evaluated by more scenarios."""
    scenarios = tuple(sorted({*archive.scenarios, *more}))
    places = apart(archive.points, archive.ranked(0), KEPT)
    rows = [archive.row(place) for place in places]
    values = means.pool.figures(rows, archive.problem.figures, uniforms=scenarios, each=2)
    return replace(archive, points=archive.points[places], values=values, scenarios=scenarios)


def validated(means: Means, archive: Archive, best: Design, robust: float) -> Validated:
    """Return the best design with the share of fresh draws that meet the limits.

    If that is below ``robust``, more scenarios count, once; a front is not searched again.
    """
    share, uniforms, draws = _fresh_share(means, best, means.seed + 1)
    how = "one design of the front is judged"
    if share.value < robust and len(archive.problem.goals) == 1:
        how = "which were tightened once"
        level = 1.0 - (1.0 - robust) / (len(archive.problem.limits) + 1)
        archive = _judged_by(means, archive, critical(archive.problem, uniforms, draws, level))
        try:
            archive, best = _searched_again(means, archive)
        except SolveError as problem:
            how = f"which cannot be tightened ({problem})"
        else:
            share = _fresh_share(means, best, means.seed + 2)[0]
    if share.value >= robust:
        return Validated(best, share, archive)
    warning = (
        f"robust: {100.0 * share.value:.3g} % of {share.draws} fresh draws meet the "
        f"limits, {how}; {100.0 * robust:.3g} % were requested"
    )
    return Validated(best, share, archive, (warning,))


def _searched_again(means: Means, archive: Archive) -> tuple[Archive, Design]:
    archive = restore_feasibility(means, search_goals(means, archive, NEAR))
    return best_design(means, archive)


def _fresh_share(means: Means, design: Design, seed: int) -> tuple[Share, Array, Array]:
    """Return the share of fresh draws that meet the limits; their uniforms and figures."""
    found = drawn(means.pool, design.values, JUDGED, seed, straight=False)
    return judged(means.pool.problem, found[1]), *found
