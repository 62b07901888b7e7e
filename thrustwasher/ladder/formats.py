"""How errors and shares are written for a person."""

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


def shown_share(share: float) -> str:
    """Return a share of the box; a small one is not called none."""
    return "under 0.1 %" if share < 1e-3 else f"{plain(100.0 * share)} %"
