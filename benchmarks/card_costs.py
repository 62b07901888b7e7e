"""Time the rungs of fresh cards anew, on a machine that is idle now; their errors stay.

python benchmarks/card_costs.py [MODEL]
"""

import argparse
from dataclasses import replace

from thrustwasher.ladder.card import fresh_cards
from thrustwasher.ladder.card_parts import Cost
from thrustwasher.model.registry import ladder_of, models_with_cards
from thrustwasher.storage.digests import DATA
from thrustwasher.study.card_cases import Case, cases
from thrustwasher.study.card_writer import seconds_of, write_card
from thrustwasher.study.costs import call_cost, first_call
from thrustwasher.study.surroundings import this_machine
from thrustwasher.study.verify import case_of, known_points


def time_again(case: Case) -> None:
    """Write the fresh cards of a parameter set with the times of this machine."""
    for rung in ladder_of(case.spec.key).kernels:
        cards = fresh_cards(case.spec.key, rung, case.params)
        known = known_points(case_of(case, rung), case.n) if cards else []
        for card in cards:
            mine = [t for t in known if t.chart == card.chart]
            timing = call_cost(case.spec, case.params, rung, mine)
            times = seconds_of(timing, first_call(case.spec.key, rung))
            cost = Cost(*times, card.cost.build_s)
            write_card(replace(card, cost=cost, machine=this_machine()), DATA / "cards")
            print(f"{card.name}: {1e6 * timing.median:.3g} us", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", nargs="?", choices=list(models_with_cards()), help="default: all")
    only = parser.parse_args().model
    for model in [only] if only else models_with_cards():
        for case in cases(model):
            time_again(case)
