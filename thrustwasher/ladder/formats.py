"""How errors, times and shares are written for a person."""

import math


def shown_error(error: float, kind: str, unit: str | None) -> str:
    """Return "0.8 %" for a relative error, "0.03 K" for an absolute one."""
    if math.isinf(error):
        return "not verified"
    if kind == "relative":
        return f"{plain(100.0 * error)} %"
    return f"{plain(error)} {unit}" if unit and unit != "1" else plain(error)


def plain(value: float) -> str:
    """Return two significant digits, without an exponent where that is short."""
    text = f"{value:.2g}"
    if "e" in text and 1e-3 <= abs(value) < 1e5:
        return f"{float(text):.0f}"
    return text


def shown_seconds(seconds: float) -> str:
    """Return a time in the largest unit that gives 0.1 or more."""
    for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "us")):
        if seconds >= 0.0995 * scale:
            return f"{plain(seconds / scale)} {unit}"
    return f"{plain(seconds / 1e-9)} ns"


def shown_share(share: float) -> str:
    """Return a share of the box; a small one is not called none."""
    return "under 0.1 %" if share < 1e-3 else f"{plain(100.0 * share)} %"
