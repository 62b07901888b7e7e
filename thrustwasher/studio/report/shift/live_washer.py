"""The washer's kernels as the page's scripts call them: it is solved again at the cursor's time."""

import base64
import zlib
from typing import Any

from ....model.parameters import as_numbers
from ....native import shipped
from ....shift.account.shift_record import Record
from ....shift.account.worst_moments import level_with_fields
from ....shift.checks.rule_data import LEAST_LOAD
from ....washer.kernels import layout, outputs
from ....washer.kernels.constants import size_of_par
from ....washer.kernels.whole_curve import over_loads, points
from ....washer.kernels.workspace import size_of_state, size_of_work
from ....washer.parameters import SPEC
from ....washer.solve import GRIDS
from ....washer.washer_result import BRANCH_NAMES
from ..web_worker import WebWorker, numbers_of

LOADS = tuple(20.0 * 150.0 ** (i / 23) for i in range(24))  # [N] at which draws are solved

WORKER = WebWorker(
    script="washer_worker",
    calls=(
        "step",
        "step_rows",
        "broken_rule",
        "derive_grid",
        "fill_fields",
        "follow_curve",
        "follow_loads",
        "name_branches",
    ),
    layout=numbers_of(
        layout,
        **{n: v for n, v in vars(outputs).items() if n.startswith("F_")},
        N_FIELDS=outputs.N_FIELDS,
        N_POINT=points.ROW,
        N_SOLUTION=over_loads.ROW,
        WALK_ENDED=over_loads.ENDED,
    ),
    levels={
        name: {
            "grid": GRIDS[name],
            "code": list(SPEC.fidelities).index(name) + 1,
            "sizes": {
                "par": size_of_par(*GRIDS[name]),
                "state": size_of_state(*GRIDS[name]),
                "work": layout.N_HEAD + size_of_work(*GRIDS[name]),
                "walk": over_loads.size_of_walk(*GRIDS[name], len(LOADS)),
            },
        }
        for name in ("field", "fine")
    },
    more={
        "branches": {int(number): name for number, name in BRANCH_NAMES.items()},
        "folds": {1: "film_lost", -1: "film_regained"},
    },
)


def live_washer(record: Record) -> dict[str, Any] | None:
    """Return module, scripts and parameters as JSON types.

    None without a washer, or where its kernels are not those that are shipped for browsers.
    """
    part = record.part("washer")
    module = shipped.web_file(part.spec.kernel) if part else None
    if part is None or module is None:
        return None
    packed = zlib.compress(module.read_bytes(), 9)
    return {
        "module": base64.b64encode(packed).decode("ascii"),
        "script": WORKER.source(),
        "about": WORKER.data(part.spec),
        "parameters": as_numbers(part.params()),
        "level": level_with_fields(part),
        "least_load": LEAST_LOAD,
    }
