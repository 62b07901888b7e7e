"""What is tried: a few things by default, the many by mark; inputs at random."""

import pytest


def sizes(few, many, mark=pytest.mark.slow):
    """Return a test's argument ``n``: ``few`` in the default run, ``many`` under the mark."""
    return pytest.mark.parametrize("n", [few, pytest.param(many, marks=mark)])


def jump(spec, rng, anywhere=0.1):
    """Return inputs of the size met in use, a share of them from anywhere in their ranges."""
    point = {}
    for s in spec.inputs:
        size = 2.0 * (s.nominal or 1.0)
        reach = (max(s.low, -size), min(s.high, size))
        if s.name == "far_face_temperature":  # between 0, the oil's, and real ones there is a gap
            reach = (290.0, 360.0)
        elif rng.random() < anywhere:
            reach = (s.low, s.high)
        point[s.name] = rng.uniform(*sorted(reach))
    return point
