"""Run the blocks of the documentation's pages as a reader would, and compare what they print.

    python -m lab.blocks [--write] [--jobs N] [PAGE ...]      default: README and all of docs

Each page has a fresh folder that holds ``examples``, and the Python that runs this script:
nothing but the standard library is imported here, so that an environment made by
``pip install .`` can run it as ``python lab/blocks.py``. Blocks of a page run in their order:

- ``sh``: one command after the other, until one does not end with status 0;
- ``python``: in one namespace for the page;
- ``text`` right after one of these: what it prints, where a line ``...`` stands for any lines and
  ``...`` within a line for any characters;
- ``toml`` or ``csv`` that begins with a comment ``# NAME.toml``: written to this file.

A comment above a block leaves it out: ``<!-- not run: REASON -->``, or ``<!-- extra: NAME -->``
where the packages of that extra are missing.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCE = re.compile(r"(?ms)((?:^<!--[^\n]*-->\n)*)^```(\w*)\n(.*?)^```$")
NOT_RUN = re.compile(r"<!-- not run: (.+?) -->")
EXTRA = re.compile(r"<!-- extra: (\w+) -->")
NAMED = re.compile(r"# *([\w.-]+\.(?:toml|csv))\s*\n")
LONGEST = 300.0  # s that a block may take
INSTALLS = "pip install"  # the environment is there already
MARK = "--- the last block ---"


class Block(NamedTuple):
    """A fenced block of a page."""

    line: int  # of its fence
    kind: str
    text: str
    comment: str
    span: tuple[int, int]  # of the text, in the page


def blocks_of(text: str) -> list[Block]:
    """Return the fenced blocks of a page in their order."""
    return [
        Block(text.count("\n", 0, m.start(2)) + 1, m[2], m[3], m[1], m.span(3))
        for m in FENCE.finditer(text)
    ]


def is_missing(extra: str) -> bool:
    """Return whether a package of an extra is not installed here."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    for needed in project["optional-dependencies"][extra]:
        try:
            metadata.distribution(re.split(r"[^\w.-]", needed, maxsplit=1)[0])
        except metadata.PackageNotFoundError:
            return True
    return False


def left_out(block: Block) -> bool:
    """Return whether a block is not run here."""
    extra = EXTRA.search(block.comment)
    return bool(NOT_RUN.search(block.comment)) or bool(extra and is_missing(extra[1]))


def agrees(printed: str, expected: str) -> bool:
    """Return whether a text is as expected, with ``...`` for what may be anything."""
    pattern = ""
    for line in expected.strip("\n").split("\n"):
        if line.strip() == "...":
            pattern += r"(?:[^\n]*\n)*?"
        else:
            pattern += r"[^\n]*?".join(map(re.escape, line.rstrip().split("..."))) + r"\s*\n"
    lines = [line.rstrip() for line in printed.strip("\n").split("\n")]
    return re.fullmatch(pattern, "\n".join(lines) + "\n") is not None


def commands(block: str) -> str:
    """Return a script that ends at the first command that fails; installing is left out."""
    lines = block.replace("\\\n", " ").splitlines()
    return "set -e\n" + "\n".join(line for line in lines if INSTALLS not in line) + "\n"


def run(command: list[str], source: str, folder: Path) -> tuple[str, str]:
    """Return what a source printed, and what is wrong with it."""
    env = {**os.environ, "MPLBACKEND": "Agg", "COLUMNS": "100"}
    env["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{env['PATH']}"
    try:
        done = subprocess.run(
            command, cwd=folder, env=env, input=source, capture_output=True, text=True,
            timeout=LONGEST,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return "", f"takes more than {LONGEST:.0f} s"
    wrong = f"ends with status {done.returncode}: {done.stderr.strip()[-400:]}"
    return done.stdout.rpartition(MARK + "\n")[2], wrong if done.returncode else ""


def run_page(page: Path, write: bool = False) -> tuple[int, list[str]]:
    """Run the blocks of a page; return how many ran and what is wrong, a line each.

    A Python block is run after those before it anew.
    """
    text = page.read_text("utf-8")
    blocks, name = blocks_of(text), page.relative_to(ROOT)
    wrong: list[str] = []
    renewed: list[tuple[tuple[int, int], str]] = []
    count, before = 0, list[str]()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        shutil.copytree(ROOT / "examples", folder / "examples")
        for i, block in enumerate(blocks):
            after = blocks[i + 1] if i + 1 < len(blocks) else None
            if left_out(block):
                continue
            if block.kind == "toml":
                try:
                    tomllib.loads(block.text)
                except tomllib.TOMLDecodeError as error:
                    wrong.append(f"{name}:{block.line}: {error}")
            if block.kind in ("toml", "csv") and (named := NAMED.match(block.text)):
                body = block.text[named.end() :] if block.kind == "csv" else block.text
                (folder / named[1]).write_text(body, "utf-8")
            if block.kind not in ("sh", "python") or not commands(block.text)[7:].strip():
                continue
            count += 1
            if block.kind == "python":
                source = "".join([*before, f"print({MARK!r})\n", block.text])
                printed, bad = run([sys.executable, "-"], source, folder)
                before.append(block.text)
            else:
                printed, bad = run(["bash"], commands(block.text), folder)
            if bad:
                wrong.append(f"{name}:{block.line}: {bad}")
            elif after is not None and is_output(text, block, after):
                if not agrees(printed, after.text):
                    renewed.append((after.span, printed.strip("\n") + "\n"))
                    if not write:
                        wrong.append(f"{name}:{after.line}: prints\n{printed.strip()}")
    if write and renewed:
        for (first, last), fresh in reversed(renewed):
            text = text[:first] + fresh + text[last:]
        page.write_text(text, "utf-8")
    return count, wrong


def is_output(text: str, block: Block, after: Block) -> bool:
    """Return whether a block is what the one before it prints: nothing lies between them."""
    return after.kind == "text" and not text[block.span[1] + 3 : after.span[0] - 8].strip()


def main() -> None:
    """Run the pages that are given; status 1 where a block does not do as it says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("pages", nargs="*", type=Path, help="default: README and all of docs")
    parser.add_argument("--write", action="store_true", help="renew outputs that differ")
    parser.add_argument("--jobs", type=int, default=2, help="pages at once")
    arguments = parser.parse_args()
    pages = [page.resolve() for page in arguments.pages] or PAGES
    with ThreadPoolExecutor(arguments.jobs) as pool:
        found = list(pool.map(lambda page: run_page(page, arguments.write), pages))
    wrong = [line for _, lines in found for line in lines]
    print("\n".join([*wrong, f"{sum(n for n, _ in found)} blocks of {len(pages)} pages run"]))
    raise SystemExit(bool(wrong))


if __name__ == "__main__":
    main()
