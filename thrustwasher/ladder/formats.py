"""How errors are written for a person."""

UNKNOWN = 1e6  # an error from here on says that there is no answer


def shown_error(error: float, unit: str | None) -> str:
    """Return "0.8 %" for a relative error (unit None), "0.03 K" for an absolute one."""
    if not error < UNKNOWN:
        return "not known"
    value = 100.0 * error if unit is None else error
    text = f"{value:.2g}"
    if "e" in text and 1e-3 <= abs(value) < 1e5:  # short without an exponent
        text = f"{float(text):.0f}"
    return f"{text} {unit or '%'}" if unit != "1" else text
