"""The paper's equations as they were before any other heat was known: equal to the last bit.

recorded.json holds outputs and directional derivatives of random meshes, made with version 0.6.0.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from thrustwasher.gearmesh.kernels import step as k
from thrustwasher.gearmesh.parameters import SPEC, GearMeshParams
from thrustwasher.gearmesh.solve import prepare

RECORDED = json.loads(Path(__file__).with_name("recorded.json").read_text("utf-8"))
PLACES = [SPEC.real_outputs.index(name) for name in RECORDED["outputs"]]


@pytest.mark.parametrize("row", RECORDED["rows"], ids=lambda r: f"{r['preset']}-{r['rung']}")
def test_the_papers_heat_gives_what_it_gave(row):
    params = GearMeshParams.preset(row["preset"], **row["changes"])
    par, state, work = prepare(params, row["rung"]), np.zeros(k.NSTATE), np.zeros(k.NWORK)
    out, flags, slope = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32), np.zeros(k.NOUT)
    point = np.array(row["point"])
    k.step(par, point, state, work, out, flags, 0.0, 1e-3)
    k.sens(par, point, state, work, np.array([0.3, 0.2, 1.0]) * [*point[:2], 5.0], slope)
    assert flags.tolist() == row["status"]
    assert [x.hex() for x in out[PLACES].tolist()] == row["out"]
    assert [x.hex() for x in slope[PLACES].tolist()] == row["slope"]
