"""``slave``: FMUs that run in Python, the protocol of pythonfmu around ``Core``."""
