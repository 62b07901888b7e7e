"""What docstrings and comments name is there: modules, functions, files, words of the data."""

import ast
import io
import re
import tokenize
from functools import cache

import pytest
from kernel_files import PACKAGE, ROOT

CITED = re.compile(r"(?<!`)`{1,2}(\.?[A-Za-z_]\w*(?:[./-]\w+)*)(?:\([^`]*\))?`{1,2}(?!`)")
FILES = {"toml", "jinja", "js", "css", "c", "h", "py", "md", "csv", "json", "xml", "html", "npz"}
OTHERS = {"scipy", "numpy", "matplotlib", "pandas", "tsv", "PATH"}
STRINGS = {tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING)}
SOURCES = sorted(p for p in PACKAGE.rglob("*.py"))


@cache
def docstrings(path):
    """Return the docstrings of a file, also those of fields."""
    found = []
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            found.append(str(node.value.value))
    return found


def cited(path):
    """Return the names between backticks in docstrings and comments."""
    tokens = tokenize.generate_tokens(io.StringIO(path.read_text("utf-8")).readline)
    comments = [t.string for t in tokens if t.type == tokenize.COMMENT]
    return sorted({m[1] for text in (*docstrings(path), *comments) for m in CITED.finditer(text)})


@cache
def words():
    """Return the words of the code without docstrings and comments, of data and file names."""
    found = {p.stem for home in (PACKAGE, ROOT / "fmu_src") for p in home.rglob("*")}
    for path in PACKAGE.rglob("*.py"):
        own = {text.strip() for text in docstrings(path)}
        for token in tokenize.generate_tokens(io.StringIO(path.read_text("utf-8")).readline):
            if token.type == tokenize.NAME:
                found.add(token.string)
            elif token.type in STRINGS and token.string.strip("rb\"' \n") not in own:
                found.update(re.findall(r"\w+", token.string))
    for folder in (PACKAGE, ROOT / "fmu_src"):
        for path in folder.rglob("*.*"):
            if path.suffix in (".toml", ".jinja", ".js", ".c", ".h", ".py"):
                found.update(re.findall(r"\w+", path.read_text("utf-8")))
    return found


@cache
def files():
    """Return the files and folders of the checkout, without what tools have put there."""
    tops = [p for p in ROOT.iterdir() if p.name[0] != "." and p.name != "node_modules"]
    found = {p.relative_to(ROOT).as_posix() for top in tops for p in (top, *top.rglob("*"))}
    return {name for name in found if "node_modules" not in name}


@cache
def modules():
    """Return every module by its dotted name, with the names that its text holds."""
    found = {}
    for path in PACKAGE.rglob("*.py"):
        dotted = ".".join(path.relative_to(ROOT).with_suffix("").parts)
        text = path.read_text("utf-8")
        found[dotted.removesuffix(".__init__")] = set(re.findall(r"\w+", text))
    return found


def with_tail(parts):
    """Return the modules whose dotted names end so."""
    tail = "." + ".".join(parts)
    return [name for name in modules() if f".{name}".endswith(tail)]


@cache
def is_there(name):
    """Tell if a cited name is a module, a file, an attribute of a module, or a word in use."""
    parts = name.lstrip(".").split(".")
    if "/" in name or (len(parts) > 1 and parts[-1] in FILES):
        here = any(f"/{file}".endswith(f"/{name}") for file in files())
        return here or all(w.isupper() or w in words() for w in re.findall(r"[^\W_]+", name))
    if with_tail(parts) or parts[0] in OTHERS:
        return True
    if len(parts) > 2 and (homes := with_tail(parts[:-1])):
        return any(parts[-1] in modules()[home] for home in homes)
    return all(part in words() for part in re.findall(r"\w+", name))


@pytest.mark.slow
def test_what_a_docstring_names_is_there():
    gone = {path: [name for name in cited(path) if not is_there(name)] for path in SOURCES}
    assert {path: names for path, names in gone.items() if names} == {}


@pytest.mark.slow
def test_a_name_that_is_gone_is_found():
    assert not is_there("solve_gone_washer") and not is_there("washer.solve.solve_gone")


def table(path):
    """Return the modules that a package's docstring lists; None: it has no list."""
    text = ast.get_docstring(ast.parse(path.read_text("utf-8"))) or ""
    head = re.split(r"^=+ +=+$", text, flags=re.MULTILINE)
    rows = re.findall(r"^(``.*?``)(?: |$)", head[1], flags=re.MULTILINE) if len(head) > 2 else []
    return {name for row in rows for name in re.findall(r"``([^`]+)``", row)} or None


PACKAGES = [p for p in SOURCES if p.name == "__init__.py" and table(p)]


@pytest.mark.parametrize("path", PACKAGES, ids=lambda p: str(p.parent.relative_to(PACKAGE)))
def test_a_package_lists_the_modules_it_has(path):
    here = {p.stem for p in path.parent.glob("[a-z]*.py")}
    here |= {p.parent.name for p in path.parent.glob("[a-z]*/__init__.py")}
    files = {p.name for p in path.parent.iterdir()}
    listed = table(path)
    assert listed <= here | files | {p.stem for p in path.parent.iterdir()}
    assert here - listed - {"kernels"} == set()
