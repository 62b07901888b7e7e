"""A checksum inside a JSON file: what was changed by a disk, a cable or a hand is noticed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

KEY = "check"


def seal_of(record: Mapping[str, Any]) -> str:
    """Return 16 hex digits over keys and values, however the file is laid out."""
    bare = {key: value for key, value in record.items() if key != KEY}
    text = json.dumps(bare, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def sealed(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return the record with its checksum as the last key."""
    bare = {key: value for key, value in record.items() if key != KEY}
    return {**bare, KEY: seal_of(bare)}


def is_broken(record: Mapping[str, Any]) -> bool:
    """Tell if the record has a checksum that does not fit; one without is taken as it is."""
    return KEY in record and record[KEY] != seal_of(record)
