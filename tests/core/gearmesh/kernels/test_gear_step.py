"""The gear mesh's step: the common contract of kernels, zero, signs, smoothness."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kernel_part import Part

from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.parameters import SPEC, GearMeshParams

NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]


class Mesh(Part):
    def __init__(self, preset=None, **params):
        made = GearMeshParams.preset(preset, **params) if preset else GearMeshParams(**params)
        super().__init__("gearmesh", "field", made)

    def outputs(self, load, speed, oil=299.85):
        assert self.step((load, speed, oil)) == 0
        return self.out.copy()


@given(
    st.floats(-1e5, 1e5),
    st.floats(-5000.0, 5000.0),
    st.floats(233.15, 473.15),
    st.sampled_from(["paper", None]),
)
def test_only_the_loss_has_a_sign_and_it_opposes_motion(load, speed, oil, preset):
    mesh = Mesh(preset=preset)
    out = mesh.outputs(load, speed, oil)
    assert np.isfinite(out).all() and out[L.F_POWER] >= 0.0 and out[L.F_TORQUE] * speed >= 0.0
    assert abs(out[L.F_TORQUE]) <= 0.2 * abs(load)
    turned = mesh.outputs(load, -speed, oil)
    assert turned[L.F_TORQUE] == -out[L.F_TORQUE]
    assert (np.delete(turned, L.F_TORQUE) == np.delete(out, L.F_TORQUE)).all()
    assert (mesh.outputs(-load, speed, oil) == out).all()


def largest_jump(mesh, points):
    """Return, for each output, the largest jump between neighbouring slopes over its variation."""
    values = np.array([mesh.outputs(*p) for p in points])
    steps = np.diff(values, axis=0)
    spread = np.maximum(np.abs(steps).max(axis=0), 1e-30)
    return np.abs(np.diff(steps, axis=0)).max(axis=0) / spread


@pytest.mark.parametrize(
    ("line", "changes"),
    [
        (lambda s: (0.02 * s, 180.0), {}),
        (lambda s: (40.0, 0.01 * s), {}),
        (lambda s: (40.0, 0.5 * s), {}),
        (lambda s: (0.02 * s, 0.01 * s), {}),
        (lambda s: (40.0, 150.0 + 60.0 * s), {}),  # film ratio 1.03 .. 1.5
        (lambda s: (40.0, 250.0 + 100.0 * s), {}),  # through 1.8: the asperities let go
        (lambda s: (1.0, 100.0 + 50.0 * s), {}),  # film switch and hardness bound together
        (lambda s: (40.0, 20.0 + 15.0 * s), {"friction_law": "iso"}),
        (lambda s: (40.0, 180.0 + 150.0 * s), {"traction_law": "limited"}),
        (lambda s: (40.0, 180.0 + 150.0 * s), {"area_law": "greenwood-williamson"}),
        (lambda s: (4.0 * s, 180.0), {"preset": None}),
        (lambda s: (40.0, 0.01 * s), {"preset": None}),
        (lambda s: (40.0, 3.0 + 2.0 * s), {"preset": None}),  # the least rolling speed
    ],
)
def test_outputs_have_continuous_slopes(line, changes):
    """A corner would keep its jump however fine the points; here it shrinks with their distance."""
    mesh = Mesh(**{"preset": "paper", **changes})
    jumps = [largest_jump(mesh, [line(s) for s in np.linspace(-1.0, 1.0, n)]) for n in (801, 6401)]
    moving = jumps[0] > 1e-6
    assert moving.any()
    assert (jumps[1][moving] < 0.3 * jumps[0][moving]).all(), dict(
        zip(np.array(NAMES)[moving], jumps[1][moving] / jumps[0][moving], strict=True)
    )


def test_mixed_friction_loses_power_and_warms_with_continuous_slopes():
    """Contact and temperatures belong to the hottest position, which may be another one."""
    mesh, kept = Mesh(friction_law="mixed"), [L.F_TORQUE, L.F_POWER, L.F_BULK, L.F_OIL_HEAT]
    jumps = [
        largest_jump(mesh, [(40.0, 3.0 + 2.0 * s) for s in np.linspace(-1.0, 1.0, n)])[kept]
        for n in (801, 6401)
    ]
    assert (jumps[1] < 0.3 * jumps[0]).all()


def test_advice_is_given_for_hot_films_and_stretched_laws_and_not_in_between():
    mesh = Mesh(preset="paper")
    for point, advice in (
        ((40.0, 180.0, 299.85), Status.OK),
        ((40.0, 180.0, 250.0), Status.HOT),
        ((40.0, 1.0, 250.0), Status.OUTSIDE_VERIFIED),
        ((40.0, 180.0, 430.0), Status.OUTSIDE_VERIFIED),
        ((9e4, 180.0, 330.0), Status.OUTSIDE_VERIFIED),
    ):
        mesh.outputs(*point)
        assert mesh.iout[L.IO_STATUS] == advice, point
