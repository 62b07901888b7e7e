"""Five hundred random requests against a truth that the cards know from random samples only."""

import math
from dataclasses import replace

import numpy as np
import pytest
from synthetic import ENVELOPE, RUNGS, card

from thrustwasher import SolveError
from thrustwasher.ladder import candidates as home
from thrustwasher.ladder.card_parts import worst_near
from thrustwasher.ladder.choose import choose
from thrustwasher.model.registry import find_model
from thrustwasher.washer.parameters import SPEC

# typical error and seconds per call
LADDER = {"map": (0.2, 3e-6), "coarse": (0.02, 6e-5), "field": (3e-3, 2e-4), "fine": (4e-4, 2e-3)}
NAMES = list(ENVELOPE)
LOW = np.array([math.log(ENVELOPE[n].min) for n in NAMES])
HIGH = np.array([math.log(ENVELOPE[n].max) for n in NAMES])
CELLS, POINTS, REQUESTS, SAFETY = 2, 300, 500, 1.5


def scaled(values):
    """Return points (n, 4) of inputs in the unit box."""
    return (np.log(values) - LOW) / (HIGH - LOW)


def truth(rung, x, phase):
    """Return the error at points x (n, 4) of the unit box: trends, a ridge, and a fine grain."""
    base = LADDER[rung][0]
    trend = phase[0] * x[:, 0] - phase[1] * x[:, 1] + 0.3 * x[:, 2] - 0.2 * x[:, 3]
    ridge = 1.0 + 2.0 * np.exp(-(((x[:, 0] - phase[2]) / 0.15) ** 2))
    grain = 0.6 + 0.4 * np.sin(9.0 * x @ np.arange(1.0, 5.0) + 7.0 * phase[3])
    return base * np.exp(trend) * ridge * grain


def sampled_card(rung, phase, rng):
    """Return a card from random held-out points, as they are made for a real rung."""
    x = rng.random((POINTS, 4))
    e = truth(rung, x, phase)
    where = np.minimum((x[:, :2] * CELLS).astype(int), CELLS - 1)
    worst = [[0.0] * CELLS for _ in range(CELLS)]
    n = [[0] * CELLS for _ in range(CELLS)]
    for (i, j), value in zip(where, e, strict=True):
        worst[i][j], n[i][j] = max(worst[i][j], float(value)), n[i][j] + 1
    edges = tuple(tuple(np.geomspace(ENVELOPE[a].min, ENVELOPE[a].max, CELLS + 1).tolist())
                  for a in ("load", "speed"))  # fmt: skip
    return card(rung, worst, LADDER[rung][1], n=n, edges=edges, first=0.0, uncertainty=1e-6)


def request(rng):
    """Return a box of random size inside the envelope, its corners in the unit box, a tolerance."""
    a, b = np.sort(rng.random((2, 4)), axis=0)
    low, high = np.exp(LOW + a * (HIGH - LOW)), np.exp(LOW + b * (HIGH - LOW))
    box = {n: (float(lo), float(hi)) for n, lo, hi in zip(NAMES, low, high, strict=True)}
    return box, a, b, float(10.0 ** rng.uniform(-3.0, 0.5))


def worst_in(rung, a, b, phase, rng):
    return float(truth(rung, a + (b - a) * rng.random((400, 4)), phase).max())


def worst_of_cells(rung, a, b, phase, rng):
    """Return the true worst error over the cells that a box touches."""
    low = np.floor(a[:2] * CELLS) / CELLS
    high = np.minimum(np.ceil(b[:2] * CELLS) / CELLS, 1.0)
    a, b = np.array([*low, 0.0, 0.0]), np.array([*high, 1.0, 1.0])
    return float(truth(rung, a + (b - a) * rng.random((1500, 4)), phase).max())


@pytest.fixture(scope="module")
def record():
    """Return what came of the requests, each among cards sampled anew for every fifty."""
    rng, rows = np.random.default_rng(20), []
    with pytest.MonkeyPatch.context() as patch:
        washer = replace(SPEC, fidelities=dict.fromkeys(RUNGS, ""))
        patch.setattr("thrustwasher.washer.parameters.SPEC", washer)
        patch.setitem(
            find_model("washer").ladder.kernels,
            "coarse",
            find_model("washer").ladder.kernels["field"],
        )
        for k in range(REQUESTS):
            if k % 50 == 0:
                phase = {r: rng.random(4) for r in LADDER}
                cards = [sampled_card(r, phase[r], rng) for r in LADDER]
                patch.setattr(home, "load_cards", lambda model, cards=cards: cards)
            rows.append(answered(*request(rng), phase, rng))
    return rows


def answered(box, a, b, tol, phase, rng):
    """Return tolerance, choice, its true error, and the cheapest rung by the truth."""
    try:
        chosen = choose("washer", box, tol=tol, n_calls=1e4, safety=SAFETY).fidelity
    except SolveError:
        chosen = None
    error = None if chosen is None else worst_in(chosen, a, b, phase[chosen], rng)
    cells = {r: SAFETY * worst_of_cells(r, a, b, phase[r], rng) for r in LADDER}
    holds = [r for r in LADDER if cells[r] <= tol]
    return tol, chosen, error, holds[0] if holds else None


def test_the_true_error_is_within_tolerance_nearly_always(record):
    kept = [error <= tol for tol, chosen, error, _ in record if chosen]
    assert len(kept) > 300
    assert sum(kept) >= 0.99 * len(kept)


def test_the_cheapest_that_holds_is_chosen_nearly_always(record):
    """It holds, and none cheaper has 1.5 x its true worst error over the same cells within tol.

    Where samples missed the worst point a cheaper one may be taken: if it holds, nothing is lost.
    """
    rank = [*LADDER, None]
    right = [
        rank.index(chosen) <= rank.index(cheapest) and (chosen is None or error <= tol)
        for tol, chosen, error, cheapest in record
    ]
    assert sum(right) >= 0.95 * len(right)


def test_every_rung_gets_its_turn_and_some_requests_are_refused(record):
    assert {chosen for _, chosen, _, _ in record} == {*LADDER, None}


def test_samples_come_close_to_the_truth_of_their_cell():
    """What the safety factor has to cover: 300 points find 70 % of the worst error or more."""
    rng = np.random.default_rng(3)
    phase = rng.random(4)
    found = sampled_card("field", phase, rng).errors["friction_torque"]
    for i in range(CELLS):
        for j in range(CELLS):
            a = np.array([i, j, 0, 0]) / CELLS
            b = np.array([i + 1, j + 1, CELLS, CELLS]) / CELLS
            true = float(truth("field", a + (b - a) * rng.random((1500, 4)), phase).max())
            assert worst_near(found, i, j) >= 0.7 * true
