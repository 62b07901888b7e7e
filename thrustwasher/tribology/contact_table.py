"""Greenwood & Tripp's integral F_5/2 over the heights, at knots.

It is kept in a file: computed anew, its last bits would depend on the processor, and with them
compiled code. A test computes it.
"""

from pathlib import Path

import numpy as np

FILE = Path(__file__).parents[1] / "data" / "greenwood_tripp.npy"
# (3, knots): ln F_5/2, its slope and curvature times the distance of the knots
TABLE = np.load(FILE)
