"""Tie cards to the kernels as they are now: ``python benchmarks/stamp.py``.

For a change of the kernels' sources that moves no number: files renamed or split, comments, a
function beside the others. The errors in the cards stay as they were measured; the tests of the
shipped cards solve points of each again. After any other change measure anew:
``python -m thrustwasher.study.verify``.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from thrustwasher.ladder.card import Card, files_of, read_card
from thrustwasher.ladder.card_parts import Sources
from thrustwasher.storage.digests import DATA, kernel_digest
from thrustwasher.study.card_writer import write_card


def stamped(card: Card) -> Card:
    """Return a card tied to today's kernels."""
    files = (*files_of(card.model, card.fidelity), *card.built)
    return replace(card, kernels=Sources(files, kernel_digest(files)))


def main(arguments: Sequence[str]) -> int:
    """Stamp the stale cards of a folder, the package's if none is named."""
    if len(arguments) > 1:
        print("usage: python benchmarks/stamp.py [FOLDER]", file=sys.stderr)
        return 2
    folder = Path(arguments[0]) if arguments else DATA / "cards"
    cards = [read_card(path) for path in sorted(folder.rglob("*.json"))]
    stale = [card for card in cards if card.stale()]
    for card in stale:
        write_card(stamped(card), folder)
    print(f"{len(stale)} of {len(cards)} cards stamped")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
