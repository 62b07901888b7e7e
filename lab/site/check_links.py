"""Every link of a built site leads to a file, and every anchor to an element.

``python -m lab.site.check_links [site]`` lists what does not and exits with status 1.
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parents[2]
TEXTS = {"href", "src"}


class Reader(HTMLParser):
    """Links and anchors of a page."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.loads: set[tuple[str, bool]] = set()

    def handle_starttag(self, tag: str, given: list[tuple[str, str | None]]) -> None:
        """Keep what an element links to and is named."""
        for name, value in given:
            if name in TEXTS and value:
                self.links.append(value)
                fetched = tag in ("script", "img", "link") and value.startswith("http")
                self.loads.add((value, fetched and dict(given).get("rel") != "canonical"))
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def broken(site: Path) -> list[str]:
    """Return the broken links, and those that load something from elsewhere, page by page."""
    pages = {}
    for path in site.rglob("*.html"):
        pages[path.resolve()] = reader = Reader()
        reader.feed(path.read_text("utf-8"))
    found = []
    for path, reader in sorted(pages.items()):
        for link in reader.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if (link, True) in reader.loads:
                    found.append(f"{path.relative_to(site.resolve())}: {link} is fetched")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if parts.path.startswith("/"):
                target = (site / parts.path.lstrip("/")).resolve()
            if target.is_dir():
                target /= "index.html"
            anchor = unquote(parts.fragment)
            gone = not target.exists()
            if gone or (anchor and target in pages and anchor not in pages[target].anchors):
                found.append(f"{path.relative_to(site.resolve())}: {link}")
    return found


def main() -> int:
    """Print the broken links."""
    site = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "site"
    if not (site / "index.html").is_file():
        print(f"{site}: no site; build it with python -m lab.site.build")
        return 1
    found = broken(site)
    print("\n".join(found) or f"{site}: no broken link")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
