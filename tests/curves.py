"""Load curves that several tests look at, each traced once."""

from functools import cache

from thrustwasher import WasherParams, load_curve


@cache
def traced(*, speed=545.0, tilt=0.002, **options):
    """Return the load curve of the default washer; nobody may change it."""
    return load_curve(WasherParams(), speed=speed, tilt=tilt, **options)
