"""The gear train's page: losses by source, bearings, and both over the torque."""

from typing import Any

from ...numerics.power_flow import AT_REST, BACKWARD, BOTH, FORWARD, NONE_OUT, SELF_LOCKING
from ...train.kernels import layout
from ...train.parameters import PAIR, SPEC
from ...train.solve import MORE
from ..report.web_worker import WebWorker, numbers_of
from .view import View

FLOWS = {
    "forward": FORWARD,
    "backward": BACKWARD,
    "both": BOTH,
    "none_out": NONE_OUT,
    "at_rest": AT_REST,
    "self_locking": SELF_LOCKING,
}
EXTRA = {
    "efficiency": ("1", "what comes out over what goes in"),
    "flow": ("1", "which way power runs, or why there is no efficiency"),
}
ABSENT = " (-1: no such mesh)", " (-1: no such shaft)"


def _outputs() -> dict[str, tuple[str, str]]:
    """Return unit and meaning of each result, without the number that an FMU has for none."""
    found: dict[str, tuple[str, str]] = {}
    for s in SPEC.outputs:
        if s.kind == "real" and s.name != "oil_energy":  # of a step, not of a point
            words = s.help
            for text in ABSENT:
                words = words.removesuffix(text)
            found[s.name] = (s.unit, words)
    return found | EXTRA


def _numbers() -> dict[str, Any]:
    """Return the layout, with where a mesh's limit of root stress lies in its row."""
    root = layout.A_PAIR + [PAIR[k] for k in layout.OWN].index("root_limit")
    return numbers_of(layout, A_ROOT_LIMIT=root, MORE=MORE)


VIEW = View(
    worker=WebWorker(
        script="train_worker",
        calls=("broken_rule", "derive", "step"),
        layout=_numbers(),
        levels={name: {"code": k} for k, name in enumerate(SPEC.fidelities, 1)},
        more={"flows": FLOWS},
    ),
    page="train",
    main="mesh_1_helix_angle mesh_1_face_width mesh_2_helix_angle mesh_2_face_width "
    "mesh_2_gear_immersion oil_volume".split(),
    figures="efficiency flow loss mesh_loss bearing_loss seal_loss churning_loss "
    "pitting_safety root_safety scuffing_safety bearing_life mesh_1_bulk_temperature "
    "mesh_2_bulk_temperature".split(),
    solve="solve_train",
    params="TrainParams",
    load="torque",
    outputs=_outputs(),
    terms="Meshes and shafts count from the input. Torque against the speed: the output drives. "
    "A safety below 1 is a limit passed; a root_safety takes a root_limit.",
    spans={
        "torque": (-400.0, 400.0),
        "speed": (-1600.0, 1600.0),
        "oil_temperature": (253.15, 423.15),
        "mesh_1_helix_angle": (0.0, 0.6),
        "mesh_2_helix_angle": (0.0, 0.6),
        "mesh_1_face_width": (0.005, 0.1),
        "mesh_2_face_width": (0.005, 0.1),
        "oil_volume": (1e-4, 0.02),
    },
)
