"""Keep compiled kernels in the checkout's own cache (its subfolder is keyed by the sources)."""

import os
from pathlib import Path

os.environ.setdefault("NUMBA_CACHE_DIR", str(Path(__file__).parents[1] / ".cache"))
os.environ.setdefault("MPLBACKEND", "Agg")

# pytest looks for doctests in conftest.py too, and knows one module of that name at a time
collect_ignore_glob = ["*conftest.py"]
