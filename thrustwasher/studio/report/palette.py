"""Colours told apart by everyone, and what axis labels share."""

import math

# Okabe & Ito's palette, safe for the usual kinds of colour blindness; yellow is too pale for lines.
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
SKY, PURPLE, BLACK, GREY = "#56B4E9", "#CC79A7", "#222222", "#8A8A8A"

SIGMA = "\N{GREEK SMALL LETTER SIGMA}"
CELSIUS = 273.15  # K
RPM = 30.0 / math.pi  # in 1 rad/s
