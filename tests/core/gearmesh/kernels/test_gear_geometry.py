"""Involute geometry of the gear mesh: the start of contact, speeds there, loss over the path."""

import math

import numpy as np
import pytest
from closed_forms import involute_mesh
from hypothesis import assume, given
from hypothesis import strategies as st

from thrustwasher.gearmesh.kernels import constants as g

PHI = math.radians(20.0)


def mesh(ratio, teeth, angle=PHI, addendum=1.0):
    return involute_mesh.Mesh(ratio, teeth, 0.254, angle, addendum)


@pytest.mark.parametrize(("ratio", "least"), [(2.0, 14.16), (5.0, 15.74)])
def test_at_the_least_number_of_teeth_contact_starts_on_the_base_circle(ratio, least):
    found = g.least_teeth(ratio, PHI, 1.0)
    assert found == pytest.approx(least, abs=5e-3)
    assert g.start_of_contact(ratio, found, PHI, 1.0, 1.0) == pytest.approx(0.0, abs=1e-14)
    assert found == pytest.approx(involute_mesh.least_pinion_teeth(ratio, PHI), rel=1e-13)


@given(st.floats(0.3, 3.0), st.floats(0.3, 3.0))
def test_the_loss_is_the_mean_sliding_of_equally_loaded_pairs_however_many(approach, recess):
    """Watch one base pitch pass: average over the pairs in contact, then over the phases."""
    assume(approach + recess >= 1.0)
    n = 2000
    phases = -approach + (np.arange(n) + 0.5) / n
    pairs = phases[:, None] + np.arange(7)
    inside = pairs < recess
    means = (np.abs(pairs) * inside).sum(axis=1) / inside.sum(axis=1)
    found = g.loss_factor(2.0, 20.0, approach, recess, 1.0)
    assert found == pytest.approx(2.0 * math.pi * 3.0 / 40.0 * means.mean(), rel=3e-3)
