"""Build the documentation's site: gather the pages, make the pictures, run mkdocs.

``python -m lab.site.build`` (pip install -e ".[site]") writes ``site/index.html``, which a browser
opens from the disk. It fails for any broken link.
"""

import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

from lab.site.api_pages import write_api
from lab.site.check_links import broken
from lab.site.gallery import write_gallery

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DOCS, GATHERED, SITE = ROOT / "docs", HERE / "gathered", ROOT / "site"
# Files of the repository that are pages of the site, next to those in docs.
PAGES = {ROOT / "README.md": "readme.md", ROOT / "CHANGELOG.md": "changelog.md"}
SHIM = "https://unpkg.com/iframe-worker/shim"
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
Pair = tuple[str, str]  # title, page


def main() -> int:
    """Build the site."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    shutil.rmtree(GATHERED, ignore_errors=True)
    shutil.copytree(DOCS, GATHERED, ignore=shutil.ignore_patterns("*.md"))
    places = {path: path.relative_to(DOCS) for path in DOCS.rglob("*.md")}
    places[DOCS / "index.md"] = Path("docs.md")  # the site has a start page of its own
    places |= {path: Path(name) for path, name in PAGES.items()}
    examples = write_examples(places)
    notebooks = write_notebooks(places)
    for path, place in places.items():
        if path.suffix == ".md":
            write(place, relinked(path, place, places))
    for path in (HERE / "pages").glob("*.md"):
        write(Path(path.name), path.read_text("utf-8"))
    shutil.copy(HERE / "site.css", GATHERED / "site.css")
    write_gallery(GATHERED)
    parts = {
        "commands": pages_of("command-line"),
        "theory": pages_of("theory"),
        "papers": pages_of("papers"),
        "examples": examples,
        "notebooks": notebooks,
        "api": write_api(GATHERED),
    }
    config = HERE / "gathered.yml"
    config.write_text(with_nav((HERE / "mkdocs.yml").read_text("utf-8"), parts), "utf-8")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "-f", str(config)]
    done = subprocess.run(command, cwd=HERE, env=os.environ | {"NO_MKDOCS_2_WARNING": "1"})
    if done.returncode:
        return done.returncode
    search_from_the_disk()
    found = broken(SITE)
    print("\n".join(found) or f"{SITE / 'index.html'}: {len(list(SITE.rglob('*.html')))} pages")
    return bool(found)


def search_from_the_disk() -> None:
    """Let pages opened from the disk search without fetching a script from elsewhere."""
    place = SITE / "assets" / "javascripts" / "iframe-worker.js"
    shutil.copy(HERE / "vendor" / "iframe-worker.js", place)
    for path in SITE.rglob("*.html"):
        there = Path(os.path.relpath(place, path.parent)).as_posix()
        path.write_text(path.read_text("utf-8").replace(SHIM, there), "utf-8")


def write(place: Path, text: str) -> None:
    """Write a page."""
    target = GATHERED / place
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")


def relinked(path: Path, place: Path, places: dict[Path, Path]) -> str:
    """Return a page whose links lead to the site's pages; what is no page of it is plain text."""

    def one(found: re.Match[str]) -> str:
        picture, words, link = found.groups()
        name, _, anchor = link.partition("#")
        if "://" in link or not name:
            return found[0]
        target = (path.parent / name).resolve()
        own = places.get(target)
        if own is None and target.is_relative_to(DOCS) and target.is_file():
            own = target.relative_to(DOCS)
        if own is None:
            return words
        there = Path(os.path.relpath(own, place.parent)).as_posix()
        return f"{picture}[{words}]({there}{f'#{anchor}' if anchor else ''})"

    return LINK.sub(one, path.read_text("utf-8"))


def write_examples(places: dict[Path, Path]) -> list[Pair]:
    """Write a page per example: its docstring and its code."""
    found = []
    for path in sorted((ROOT / "examples").glob("ex*.py")):
        code = path.read_text("utf-8")
        words = (ast.get_docstring(ast.parse(code)) or "").strip()
        title, page = path.stem.partition("_")[2].replace("_", " "), f"examples/{path.stem}.md"
        write(Path(page), f"# Example: {title}\n\n{words}\n\n```python\n{code.strip()}\n```\n")
        places[path] = Path(page)
        found.append((title, page))
    return found


def write_notebooks(places: dict[Path, Path]) -> list[Pair]:
    """Run the notebooks and write each as a page with what it printed and drew.

    As notebooks they lie in the folder that THRUSTWASHER_NOTEBOOKS_RUN names, for their test.
    """
    found: list[Pair] = []
    run = Path(os.environ.get("THRUSTWASHER_NOTEBOOKS_RUN") or tempfile.mkdtemp())
    for path in sorted((ROOT / "examples" / "notebooks").glob("*.ipynb")):
        began = time.perf_counter()
        _convert(path, "notebook", run, "--execute")
        _convert(run / path.name, "markdown", GATHERED / "notebooks")
        print(f"{path.name}: {time.perf_counter() - began:.1f} s")
        places[path] = Path("notebooks") / f"{path.stem}.md"
        found.append((path.stem.replace("_", " "), f"notebooks/{path.stem}.md"))
    return found


def _convert(path: Path, to: str, folder: Path, *how: str) -> None:
    command = [sys.executable, "-m", "nbconvert", "--to", to, *how, "--log-level", "WARN"]
    subprocess.run([*command, "--output-dir", str(folder), str(path)], check=True)


def pages_of(folder: str) -> list[Pair]:
    """Return title and page of all gathered pages in a folder, those above others first."""
    found = sorted((GATHERED / folder).rglob("*.md"), key=lambda p: (len(p.parts), p.name))
    heads = [re.search(r"(?m)^# (.+)$", path.read_text("utf-8")) for path in found]
    return [
        (head[1] if head else path.stem, path.relative_to(GATHERED).as_posix())
        for head, path in zip(heads, found, strict=True)
    ]


def with_nav(text: str, parts: dict[str, list[Pair]]) -> str:
    """Return the configuration with lists of pages where it names them, as in ``!theory``."""
    lines = []
    for line in text.splitlines():
        name = re.fullmatch(r"( *)- (.+): !(\w+)", line)
        if name is None:
            lines.append(line)
        elif pages := parts[name[3]]:
            lines.append(f"{name[1]}- {name[2]}:")
            lines += [f"{name[1]}    - {yaml.dump({t: p}, width=999).strip()}" for t, p in pages]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
