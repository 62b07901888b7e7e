"""What the FMUs of both targets carry: description, page, icon, terminals, licences, results."""

from collections.abc import Sequence
from pathlib import Path

from ..models._spec import ModelSpec
from . import xml, xml3
from .icon import icon
from .licences import licences
from .page import page
from .reference import reference_files
from .registry import has_derivatives
from .terminals import terminals_and_icons
from .xml_parts import text


def common_contents(
    spec: ModelSpec, *, target: str, fmi: int, guid: str, equations: str, platforms: Sequence[str],
    runs: bool = True,
) -> dict[str, bytes]:  # fmt: skip
    """Return the files that describe an FMU; only FMI 2 tools look for ``model.png``.

    Unless it ``runs``, the model need not be compiled for this Python: the page has no curve then,
    and there are no reference results.
    """
    derivatives = target == "native" and has_derivatives(spec)
    written = (xml if fmi == 2 else xml3).description(spec, guid=guid, derivatives=derivatives)
    picture = icon(spec.name)
    told = page(spec, target=target, fmi=fmi, guid=guid, equations=equations, platforms=platforms,
                runs=runs)  # fmt: skip
    return {
        "modelDescription.xml": text(written),
        **({"model.png": picture} if fmi == 2 else {}),
        "terminalsAndIcons/icon.png": picture,
        "terminalsAndIcons/terminalsAndIcons.xml": text(terminals_and_icons(spec)),
        "documentation/index.html": told.encode(),
        **licences(target, platforms),
        **(reference_files(spec) if runs else {}),
    }


def readme(folder: Path) -> str:
    """Return the text of a model's equations; a model without one has an empty text."""
    file = folder / "readme.md"
    return file.read_text("utf-8") if file.is_file() else ""
