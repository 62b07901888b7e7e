"""The documentation's site: its checker finds what is broken, its reference has all names."""

import ast
import sys
from pathlib import Path

import pytest

import thrustwasher

SITE = Path(__file__).parents[2] / "lab" / "site"
sys.path.insert(0, str(SITE))

import api_pages  # noqa: E402
import check_links  # noqa: E402
import gallery  # noqa: E402


@pytest.mark.parametrize(
    ("link", "words"),
    [
        ("other.html", ""),
        ("other.html#there", ""),
        ("https://example.org", ""),
        ("gone.html", "index.html: gone.html"),
        ("other.html#gone", "index.html: other.html#gone"),
        ("#gone", "index.html: #gone"),
    ],
)
def test_broken_links_and_anchors_are_found(tmp_path, link, words):
    (tmp_path / "index.html").write_text(f'<a href="{link}">x</a>', "utf-8")
    (tmp_path / "other.html").write_text('<h1 id="there">x</h1>', "utf-8")
    assert check_links.broken(tmp_path) == ([words] if words else [])


def test_what_a_page_fetches_from_elsewhere_is_found(tmp_path):
    (tmp_path / "index.html").write_text('<script src="https://example.org/a.js">', "utf-8")
    assert check_links.broken(tmp_path) == ["index.html: https://example.org/a.js is fetched"]


def test_the_reference_has_every_public_name_once(tmp_path):
    api_pages.write_api(tmp_path)
    text = "".join(path.read_text("utf-8") for path in (tmp_path / "api").glob("*.md"))
    for name in thrustwasher.__all__:
        assert text.count(f"::: thrustwasher.{name}\n") == 1, name


def test_the_gallery_shows_short_code(tmp_path):
    for title, words, code in gallery.PICTURES:
        assert len(code.strip().splitlines()) <= 12, title
        assert words.endswith(".")
        names = [n.id for n in ast.walk(ast.parse(code)) if isinstance(n, ast.Name)]
        assert "figure" in names
