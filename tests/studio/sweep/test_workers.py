"""Processes and clusters: the same rows, nothing lost or doubled, no matter who dies."""

import os
import signal
import struct
import subprocess
import sys
import threading
import time

import needed
import numpy as np
import pytest

from thrustwasher import run_sweep
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.processes import local_processes
from thrustwasher.studio.jobs import cluster as clusters
from thrustwasher.studio.sweep.run_sweep import journal_of

OVER = {"load": "1 kN:9 kN:n20", "speed": "5:300:n100"}


def same(one, two):
    def equal(a, b):  # where a row failed both have no number
        return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")

    return all(equal(one[name], two[name]) for name in one.columns)


def count_blocks(monkeypatch):
    """Collect the first rows of all blocks that are taken in."""
    from thrustwasher.storage.journal import Journal

    firsts, append = [], Journal.append

    def counting(self, first, numbers, flags):
        firsts.append((first, len(numbers)))
        append(self, first, numbers, flags)

    monkeypatch.setattr(Journal, "append", counting)
    return firsts


def once_each(firsts, n):
    rows = [row for first, size in firsts for row in range(first, first + size)]
    return sorted(rows) == list(range(n))


@pytest.mark.slow
def test_two_processes_give_the_rows_of_one(tmp_path):
    out = tmp_path / "map.csv"
    two = run_sweep("clutch", OVER, workers=2, out=out)
    assert same(two, run_sweep("clutch", OVER, workers=1))
    assert not journal_of(out).exists()


@pytest.mark.slow
def test_a_process_that_is_killed_costs_nothing_but_time(tmp_path, monkeypatch):
    import multiprocessing

    firsts = count_blocks(monkeypatch)
    killed = []

    def kill_one(done, total):
        children = multiprocessing.active_children()
        if done > 200 and not killed and children:
            os.kill(children[0].pid, signal.SIGKILL)
            killed.append(children[0].pid)

    table = run_sweep("clutch", OVER, workers=2, out=tmp_path / "map.csv", progress=kill_one)
    assert killed and once_each(firsts, len(table))
    assert same(table, run_sweep("clutch", OVER, workers=1))


def half_a_message(begun):
    """Begin to send a result of 1000 bytes, as a worker that is stopped there; for a minute."""
    frame = sys._getframe()
    while "result_queue" not in frame.f_locals:
        frame = frame.f_back
    os.write(frame.f_locals["result_queue"]._writer.fileno(), struct.pack("!i", 1000))
    begun.touch()
    time.sleep(60.0)


def test_a_worker_that_is_stopped_while_it_sends_keeps_nobody_waiting(tmp_path):
    begun = tmp_path / "begun"
    with pytest.raises(KeyboardInterrupt), local_processes(1) as executor:
        executor.submit(half_a_message, begun)
        thread = executor._executor_manager_thread
        deadline = time.monotonic() + 60.0
        while not begun.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.1)  # by now that thread is waiting for the rest
        raise KeyboardInterrupt
    thread.join(30.0)
    assert begun.exists() and not thread.is_alive()


def test_what_is_cancelled_while_workers_are_stopped_disturbs_no_thread(monkeypatch):
    failed = []
    monkeypatch.setattr(threading, "excepthook", failed.append)
    with pytest.raises(KeyboardInterrupt), local_processes(1) as executor:
        futures = [executor.submit(time.sleep, 0.05) for _ in range(20)]
        futures[0].result()
        for future in futures:
            future.cancel()
        thread = executor._executor_manager_thread
        executor.shutdown = lambda **_: None  # it hears of the dead worker first
        raise KeyboardInterrupt
    thread.join(30.0)
    assert not failed and not thread.is_alive()


@pytest.mark.slow
def test_a_script_without_a_guard_is_told_so(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "from thrustwasher import run_sweep\n"
        "run_sweep('gearmesh', {'load': '1:100:1', 'speed': '1:100:1'}, workers=2)\n"
    )
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=60)
    assert done.returncode != 0
    assert 'if __name__ == "__main__":' in done.stderr  # a resource tracker may speak after it


@pytest.mark.slow
def test_a_cluster_that_does_not_answer_is_named(monkeypatch):
    needed.package("distributed")
    monkeypatch.setattr(clusters, "ANSWER_TIME", "1s")
    for address in ("tcp://127.0.0.1:1", "nonsense"):
        with pytest.raises(EnvironmentProblem, match="does not answer"):
            run_sweep("gearmesh", {"load": [1.0]}, cluster=address)


def test_what_is_no_cluster_is_refused_by_its_value():
    needed.package("distributed")
    with pytest.raises(EnvironmentProblem, match="cluster = 5: allowed: address of a Dask sched"):
        run_sweep("gearmesh", {"load": [1.0]}, cluster=5)


@pytest.mark.slow
def test_a_client_of_a_cluster_is_taken_and_stays_open():
    distributed = needed.package("distributed")
    over = {"load": "1 kN:9 kN:n20", "speed": "5:300:n50"}
    local = run_sweep("clutch", over, workers=1)
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster) as client:
            assert same(run_sweep("clutch", over, cluster=client), local)
            assert client.status == "running"
        assert same(run_sweep("clutch", over, cluster=cluster), local)
        with pytest.raises(EnvironmentProblem, match="its client is closed"):
            run_sweep("clutch", over, cluster=client)


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker_loses_no_point(tmp_path, monkeypatch):
    distributed = needed.package("distributed")
    firsts = count_blocks(monkeypatch)
    over = {"load": "1 kN:9 kN:n20", "speed": "5:300:n1000"}
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster) as client:
            pids = client.run(os.getpid)
        killed = threading.Event()

        def kill_one(done, total):
            if done > 0.2 * total and not killed.is_set():
                os.kill(next(iter(pids.values())), signal.SIGKILL)
                killed.set()

        options = {"out": tmp_path / "map.csv", "progress": kill_one}
        table = run_sweep("clutch", over, cluster=cluster.scheduler_address, **options)
    assert killed.is_set() and once_each(firsts, len(table))
    assert same(table, run_sweep("clutch", over, workers=1))
