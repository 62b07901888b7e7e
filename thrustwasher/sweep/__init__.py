"""Many operating points at once: grids of inputs and parameters, in parallel, resumable."""
