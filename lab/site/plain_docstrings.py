"""Docstrings whose lines read ``name : words`` as the reference's reader takes them."""

import re

import griffe

SECTION = re.compile(r"(?m)^(Parameters|Raises|Attributes|Returns)\n-+\n")
LINE = re.compile(r"(?m)^(?P<names>[\w*][\w*, ]*) : (?P<words>.+)$")


class PlainDocstrings(griffe.Extension):
    """Puts the words behind a name on the line below: types stand in the signature already."""

    def on_object(self, *, obj: griffe.Object, **_: object) -> None:
        """Change the docstring of a function, class or attribute."""
        if obj.docstring and SECTION.search(obj.docstring.value):
            obj.docstring.value = plain(obj.docstring.value)


def plain(text: str) -> str:
    """Return a docstring with the words of its sections below their names."""
    parts = SECTION.split(text)
    found = [parts[0]]
    for title, body in zip(parts[1::2], parts[2::2], strict=True):
        end = re.search(r"(?m)^\w+\n-+\n", body)
        own, rest = (body[: end.start()], body[end.start() :]) if end else (body, "")
        lines = LINE.sub(r"\g<names>\n    \g<words>", own)
        found.append(f"{title}\n{'-' * len(title)}\n{lines}{rest}")
    return "".join(found)
