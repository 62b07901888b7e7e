"""Closed forms: importable, used by tests and documentation. No iteration, no numba."""
