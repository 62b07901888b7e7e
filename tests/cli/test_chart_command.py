"""``thrustwasher chart``: one quick run from measuring to the page."""

import json
import os
import subprocess
import sys

import pytest

from thrustwasher.fidelity.work_precision import Sample


@pytest.mark.slow
def test_a_quick_run_measures_everything_and_draws_it(tmp_path):
    words = [sys.executable, "-m", "thrustwasher", "chart", "--quick", "--out", str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=1200, env=os.environ)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "" and "wrote" in done.stderr
    record = json.loads((tmp_path / "chart.json").read_text("utf-8"))
    assert set(record["models"]) == {"washer", "clutch", "gearmesh"}
    for survey in (*record["models"].values(), record["macro_steps"]):
        for sample in survey["samples"]:
            assert set(sample) == set(Sample.__dataclass_fields__)
    assert record["machine"]["threads"]["OMP_NUM_THREADS"] == "1"
    washer = {s["label"]: s for s in record["models"]["washer"]["samples"]}
    rival = washer["2006, 9 x 67, 0.0001"]
    for name in ("friction_torque", "temperature"):
        assert washer["field"]["errors"][name]["worst"] < 0.05 * rival["errors"][name]["worst"]
    assert washer["field"]["n_failed"] == 0
    lies = [c["verdict"] for g in record["stability"] for row in g["cells"] for c in row]
    assert {"ok", "LIES"} <= set(lies)
    assert all(abs(one["deviation"]) < 0.02 for one in record["limits"])
    names = {p.name for p in tmp_path.iterdir()}
    assert {"chart.html", "chart.md", "chart-washer.svg", "chart-shift.svg",
            "chart-stability.svg", "chart-clutch.svg"} <= names  # fmt: skip
