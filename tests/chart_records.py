"""Records of charts as ``python -m lab.chart`` writes them, made up for tests."""

QUANTITY = {"name": "friction_torque", "kind": "relative", "unit": "1", "floor": 1e-3}
MACHINE = {"cpu": "a cpu", "cores": 2, "os": "an os", "python": "3", "numpy": "2", "numba": "1"}
CASES = [
    {"name": "a < b", "point": [300.0, 545.0, 2e-3, 297.15], "before": []},
    {"name": "b", "point": [200.0, 545.0, 2e-3, 297.15], "before": []},
]


def cell(verdict="ok", figure="", words=""):
    return {"verdict": verdict, "figure": figure, "words": words}


def group(*rows, hazards=("a",), methods=("good",)):
    """Return a group of methods and hazards; ``rows``: cells of each method."""
    named = {"hazards": list(hazards), "methods": list(methods)}
    return {"name": "films", "judged": "load off", **named, "cells": [list(row) for row in rows]}


def sample(label, cost, error, **other):
    """Return a measured way; None of a cost or an error that is not known."""
    known = error is not None
    errors = {"worst": error, "rms": 0.4 * error if known else None, "case": "a < b"}
    where = {
        "family": "fidelity levels",
        "label": label,
        "knob": "level",
        "value": label,
        "cases": "0",
    }
    costs = {"call_median": cost, "call_min": cost, "first_call_s": cost, "slowest_call_s": cost}
    return {
        **where,
        **costs,
        "errors": {"friction_torque": errors if known else {**errors, "case": None}},
        "ref_uncertainty": {"friction_torque": 1e-5},
        "call_iqr": 0.05 * cost if cost else None,
        "slowest_case": "b" if cost else None,
        **{"repeats": 9, "setup_s": 1e-3, "build_s": 0.0, "count": 3.0, "count_of": "turns"},
        **{"n_cases": 2, "n_failed": 0, "failures": {}, "is_rival": False},
        **other,
    }


def record(model, samples, groups, **more):
    """Return the record of one model."""
    of_cases = {"cases": CASES, "cases_digest": "0", "cost_of": "a call [s]"}
    survey = {**of_cases, "quantities": [QUANTITY], "truths": [], "samples": samples}
    return {
        "schema": 1,
        "command": "python -m lab.chart",
        "date": "2026-11-21T18:00:00Z",
        "machine": {**MACHINE, "compiled": True, "threads": {}, "load": 0.1},
        "package": {"version": "0", "kernels": "0", "commit": "abc", "dirty": True},
        **{"calibration_s": 0.01, "quick": False, "run_s": 1.0},
        "models": {model: survey},
        "stability": groups,
        **more,
    }
