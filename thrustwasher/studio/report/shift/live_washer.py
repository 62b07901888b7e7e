"""The washer's kernels as the page's scripts call them: it is solved again at the cursor's time."""

import base64
import zlib
from typing import Any

from ....model.parameters import as_numbers
from ....native import shipped
from ....numerics.banded import N_SIDES
from ....shift.account.shift_record import Record
from ....shift.account.worst_moments import level_with_fields
from ....shift.checks.rule_data import LEAST_LOAD
from ....washer.kernels import layout, newton, workspace
from ....washer.kernels.constants import size_of_par
from ....washer.kernels.workspace import size_of_state, size_of_work
from ....washer.parameters import SPEC
from ....washer.solve import GRIDS
from ..web_worker import WebWorker, numbers_of

WORKER = WebWorker(
    script="washer_worker",
    calls=(
        "step",
        "broken_rule",
        "derive_grid",
        "begin_curve",
        "next_point",
        "pass_fold",
        "start_at",
        "go_to_film",
        "note",
        "newton",
        "outputs_at",
    ),
    layout=numbers_of(
        layout,
        MODE_LOAD=newton.LOAD,
        NO_FLOOR=newton.NO_FLOOR,
        N_SIDES=N_SIDES,
        N_NODAL=workspace.N_NODAL,
    ),
    levels={
        name: {
            "grid": GRIDS[name],
            "code": list(SPEC.fidelities).index(name) + 1,
            "sizes": {
                "par": size_of_par(*GRIDS[name]),
                "state": size_of_state(*GRIDS[name]),
                "work": layout.N_HEAD + size_of_work(*GRIDS[name]),
            },
        }
        for name in ("field", "fine")
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
