"""How many examples are tried: the same ones in every run, without a limit of time for each."""

from hypothesis import HealthCheck, settings


def examples(n):
    """Return the settings of a test with ``n`` examples."""
    return settings(
        max_examples=n,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
    )
