"""Compiled code of the journal bearing."""

CALLED = {
    "journal.kernels.step": ("journal.kernels.step: derive step",),
}
