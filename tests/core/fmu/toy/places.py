"""Where the tests of FMUs keep their files, and where the toy starts."""

from pathlib import Path

HERE = Path(__file__).parents[1]
TOY_SLAVES = HERE / "toy" / "texts"  # of a page; there are none
TOY_START = {"load": 500.0, "speed": 20.0, "oil_temperature": 310.0}
