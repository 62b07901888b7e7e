"""FMUs that need no Python: compiled kernels behind a shell in C."""
