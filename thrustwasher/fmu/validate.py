"""Ask FMPy whether an FMU keeps to the standard."""

import os


def validate(path: str | os.PathLike[str]) -> list[str]:
    """Return FMPy's findings on an FMU; an empty list is a pass."""
    from fmpy.validation import validate_fmu

    return [str(finding) for finding in validate_fmu(str(path))]
