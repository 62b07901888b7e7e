"""The washer as an FMU that only looks up in its map: no solver, no parameter of the washer."""

from dataclasses import dataclass, fields, replace

from ...errors import ParameterError
from ...model.parameters import check_ranges, choice
from ...model.spec import ModelSpec, tailored
from ...tribology.holding.parameters import coupling_age, coupling_inertia, holding_choice
from ..kernels.map import alone
from ..parameters import OUTSIDE_MAP
from .look_up import WasherMap

FIDELITY = "map"
KERNEL = "thrustwasher.washer.kernels.map.alone"


@dataclass(frozen=True, slots=True, kw_only=True)
class MapParams:
    """What may differ between runs of one washer that is in a map."""

    holding: str = holding_choice("the washer")
    coupling_inertia: float = coupling_inertia()
    coupling_age: int = coupling_age()
    outside_map: str = choice(
        "hold",
        {name: text for name, text in OUTSIDE_MAP.items() if name != "solve"},
        "OutsideMap",
        "what is done outside the map's box",
        of_a_run=True,
    )

    def __post_init__(self) -> None:
        check_ranges(self)


def map_alone(spec: ModelSpec) -> ModelSpec:
    """Return a washer, or one with the values of a part, as a model that only looks up.

    ParameterError if no map was made for it, or one that is too large.
    """
    params = spec.params()
    chart = WasherMap(params)
    if len(chart.data) > alone.ROOM:
        raise ParameterError(
            f"the map of {spec.name} has {len(chart.data)} numbers, allowed in an FMU of the map "
            f"alone: {alone.ROOM}; make one with a larger --tol or a smaller box"
        )
    inputs = spec.inputs[: alone.NINP]
    names = {s.name for s in inputs}
    outputs = (
        replace(s, depends=tuple(name for name in s.depends if name in names)) for s in spec.outputs
    )
    made = replace(
        spec,
        params=MapParams,
        fidelities={FIDELITY: spec.fidelities[FIDELITY].partition(";")[0]},
        default_fidelity=FIDELITY,
        successors={},
        inputs=inputs,
        outputs=tuple(outputs),
        kernel=KERNEL,
        rules=(),
        counted=tuple,
        profile=tuple(row[: 1 + len(inputs)] for row in spec.profile),
        table_of=params,
        exchange=None,
    )
    own = {f.name: getattr(params, f.name) for f in fields(MapParams)}
    if own["outside_map"] == "solve":
        del own["outside_map"]
    return tailored(made, own, {}, profile=made.profile, kind=spec.kind)
