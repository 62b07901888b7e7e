"""Documentation, messages and docstrings are written in the terms of the field: lab/words.txt."""

import ast
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from token import NAME
from tokenize import tokenize
from typing import NamedTuple

import pytest

from thrustwasher import cli

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "thrustwasher"
COMPILED = {"kernels", "native", "numerics", "tribology"}  # whose bytes name what is shipped
FENCED = re.compile(r"(?ms)^```.*?^```$|`[^`\n]+`|\]\([^)\s]*\)|<!--.*?-->")
NEWEST = re.compile(r"(?ms)^## .*?(?=^## |\Z)")
SCRIPT_TEXT = re.compile(
    r'(?m)(?<=[(,=:?+] )"(?:[^"\\\n]|\\.)* (?:[^"\\\n]|\\.)*"|^ *"[^"\n]* [^"\n]*"'
)
# no part of a name in the code
PRIVATE = re.compile(r"(?i)(?<![a-z])(?:rungs?|courses?|crew|shelf)(?![a-z])")
NAMES = re.compile(r"``.*?``|`[^`\n]+`|(?<![\w.])[\w.]*_[\w.]+|[\w-]+/[\w./-]+", re.S)


class Word(NamedTuple):
    """A word to leave out."""

    pattern: re.Pattern[str]
    instead: str
    allowed: re.Pattern[str] | None


@cache
def words() -> list[Word]:
    lines = (ROOT / "lab" / "words.txt").read_text("utf-8").splitlines()
    found = []
    for line in lines:
        if "->" not in line or line.startswith("#"):
            continue
        word, _, rest = line.partition("->")
        term, _, allowed = rest.partition("|")
        right = [re.escape(text.strip()) for text in allowed.split(",") if text.strip()]
        spaced = r"\s+".join(word.split())
        pattern = re.compile(rf"(?<![\w-]){spaced}s?(?![\w-])", re.I)
        found.append(
            Word(pattern, term.strip(), re.compile("|".join(right), re.I) if right else None)
        )
    return found


def left(text: str) -> list[str]:
    """Return the words of the list that stand in a text, each with what to write instead."""
    found = []
    for word in words():
        bare = word.allowed.sub("", text) if word.allowed else text
        for match in word.pattern.finditer(bare):
            around = " ".join(bare[max(match.start() - 40, 0) : match.end() + 30].split())
            found.append(f"{match[0]} -> {word.instead}: ...{around}...")
    return found


def texts_of(path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and text of messages and docstrings: literals with a space in them."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.JoinedStr):
            parts = (x.value if isinstance(x, ast.Constant) else "0" for x in node.values)
            yield node.lineno, NAMES.sub("", "".join(map(str, parts)))
        elif (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and " " in node.value.replace(" | ", "")
        ):
            yield node.lineno, NAMES.sub("", node.value)


def strings(value: object) -> Iterator[str]:
    """Yield the texts of a table."""
    if isinstance(value, str):
        yield NAMES.sub("", value)
    elif isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            yield from strings(item)


def prose(text: str) -> str:
    """Return a page without its blocks, code and addresses."""
    return FENCED.sub("", text)


def test_the_pages_are_in_the_terms_of_the_field() -> None:
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    texts = {str(page.relative_to(ROOT)): page.read_text("utf-8") for page in pages}
    newest = NEWEST.search((ROOT / "CHANGELOG.md").read_text("utf-8"))
    texts["CHANGELOG.md"] = newest[0] if newest else ""
    found = [f"{name}: {line}" for name, text in texts.items() for line in left(prose(text))]
    assert not found, "\n".join(found)


@pytest.mark.slow
def test_messages_and_docstrings_are_in_the_terms_of_the_field() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{n}: {line}"
        for path in sorted(PACKAGE.rglob("*.py"))
        if not COMPILED & set(path.parts)
        for n, text in texts_of(path)
        for line in left(text)
    ]
    assert not found, "\n".join(dict.fromkeys(found))


def named_otherwise(path: Path) -> list[str]:
    """Return which names of a source of Python, C or JavaScript are not the field's."""
    words = set(re.findall(r"[^\W\d]\w*", path.read_text("utf-8")))
    found = {w for w in words if PRIVATE.search(re.sub(r"(?<=[a-z])(?=[A-Z])", "_", w))}
    if found and path.suffix == ".py":  # no words of texts; reading tokens takes long
        with path.open("rb") as file:
            found &= {t.string for t in tokenize(file.readline) if t.type == NAME}
    return sorted(found)


def test_names_in_the_code_are_in_the_terms_of_the_field() -> None:
    sources = [p for end in ("py", "js", "c", "h") for p in PACKAGE.rglob(f"*.{end}")]
    sources += [*(ROOT / "fmu_src").rglob("*.[ch]"), *(ROOT / "lab").glob("**/*.py")]
    found = [
        f"{path.relative_to(ROOT)}: {name}"
        for path in sorted(sources)
        if "bundle" not in path.parts
        for name in named_otherwise(path)
    ]
    assert len(sources) > 500 and not found, "\n".join(found)


def test_tables_are_in_the_terms_of_the_field() -> None:
    found = [
        f"{path.relative_to(ROOT)}: {line}"
        for path in sorted(PACKAGE.rglob("*.toml"))
        if "data" not in path.parts
        for text in strings(tomllib.loads(path.read_text("utf-8")))
        for line in left(text)
    ]
    assert not found, "\n".join(found)


def test_pages_in_the_browser_are_in_the_terms_of_the_field() -> None:
    web = PACKAGE / "studio" / "report" / "web"
    found = [
        f"{path.relative_to(ROOT)}: {line}"
        for path in sorted(web.rglob("*.js"))
        if not {"bundle", "vendor"} & set(path.parts)
        for match in SCRIPT_TEXT.finditer(path.read_text("utf-8"))
        for line in left(NAMES.sub("", match[0]))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("command", ["", *cli.COMMANDS])
def test_help_is_in_the_terms_of_the_field(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    cli.main([*([command] if command else []), "--help"])
    assert not left(NAMES.sub("", capsys.readouterr().out))
