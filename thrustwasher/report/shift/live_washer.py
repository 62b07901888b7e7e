"""The washer's kernels as the page's scripts call them: it is solved again at the cursor's time."""

import base64
import zlib
from typing import Any

from ...model.parameters import as_numbers
from ...model.record import resolve
from ...model.registry import models_with_points
from ...native import shipped
from ...native.targets import WEB
from .shift_record import Record
from .worst_moments import LEAST_LOAD, rung_with_fields


def live_washer(record: Record) -> dict[str, Any] | None:
    """Return module, scripts and parameters as JSON types.

    None without a washer, or where its kernels are not those that are shipped for browsers.
    """
    part = record.part("washer")
    model = models_with_points().get(part.spec.key) if part else None
    module = shipped.library_file(part.spec.kernel, WEB.name) if part else None
    if part is None or model is None or not model.explore or module is None:
        return None
    view = resolve(model.explore)
    packed = zlib.compress(module.read_bytes(), 9)
    return {
        "module": base64.b64encode(packed).decode("ascii"),
        "script": view.worker_script(),
        "about": view.worker_data(part.spec),
        "parameters": as_numbers(part.params()),
        "rung": rung_with_fields(part),
        "least_load": LEAST_LOAD,
    }
