"""The scripts and styles of pages, as ``lab/pages/bundle.mjs`` has put them together."""

from pathlib import Path

FOLDER = Path(__file__).parent / "web" / "bundle"


def bundle(name: str) -> str:
    """Return a script or style, one of those in ``web/bundle``."""
    return (FOLDER / name).read_text("utf-8")
