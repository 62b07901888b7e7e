"""Scenes, connected instances, masters and what a shift run leaves.

================  =================================================================================
``scene``         ``Scene``: what is simulated
``scene_file``    TOML file -> checked ``Scene``; ``scenes/`` holds the built-in ones
``asked``         which rung of a part is asked for, or which tolerance
``parts``         which parts there are and who passes what to whom
``system``        instances with their present inputs and outputs
``master``        the list of masters; ``jacobi``, ``gauss_seidel``, ``linearly_implicit``,
                  ``step_doubling``: one each; ``moves``: words; ``state``, ``rollback``,
                  ``slopes``, ``events``: what they need; ``adaptive``: runs that choose steps
``loop``          the loop over communication points; ``program``, ``compiled_loop``: compiled
``shift``         ``run_shift``: one run, and the result
``auto``          ``run_auto``: ``scout``, ``selection`` of rungs, a run under guard
``guard``         changes a rung while a shift runs; ``sentry``: the guard of one part;
                  ``guard_rules``: its decisions; ``budget``: how often it looks
``course``        events and phases; ``book``: energy book and key figures
``judder``        what a swing of the output shaft is; ``judder_search``: how it is found;
                  ``swing``, ``torsion``, ``pack_slope``: fit, eigenvalues, slope of friction
``chatter``       packs whose slip flips from step to step
``result``        ``ShiftResult``
================  =================================================================================
"""

from .asked import with_fidelities
from .auto import run_auto
from .figure_list import FIGURES, KeyFigure
from .result import Cost, Event, Phase, ShiftResult
from .scene import Part, Published, Scene
from .scene_file import builtin_scenes, load_scene
from .shift import run_shift

__all__ = [
    "FIGURES", "Cost", "Event", "KeyFigure", "Part", "Phase", "Published", "Scene", "ShiftResult",
    "builtin_scenes", "load_scene", "run_auto", "run_shift", "with_fidelities",
]  # fmt: skip
