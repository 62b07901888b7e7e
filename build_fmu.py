"""Build FMUs: ``python build_fmu.py [MODEL ...] [--target python] [--fmi 2] [--out dist]``."""

import argparse
import sys
from pathlib import Path

from thrustwasher.errors import EnvironmentProblem, ParameterError
from thrustwasher.fmu.build import build
from thrustwasher.fmu.validate import validate


def main() -> int:
    """Build and check; print one path a line."""
    parser = argparse.ArgumentParser(description="Build the FMUs of thrustwasher.")
    parser.add_argument("models", nargs="*", metavar="MODEL", help="FMU names; default: all")
    parser.add_argument("--target", default="python", choices=["python", "native"])
    parser.add_argument("--fmi", type=int, default=2, choices=[2, 3])
    parser.add_argument("--out", type=Path, default=Path("dist"), help="default: dist")
    given = parser.parse_args()
    try:
        paths = build(given.models, target=given.target, fmi=given.fmi, out=given.out)
    except (ParameterError, EnvironmentProblem) as problem:
        print(problem, file=sys.stderr)
        return 2
    findings = [f"{path}: {finding}" for path in paths for finding in validate(path)]
    print(*paths, sep="\n")
    print(*findings, sep="\n", end="", file=sys.stderr)
    return 3 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
