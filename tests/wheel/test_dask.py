"""A study on Dask: two workers on this machine, one of them killed, and the bytes of `wall study ida`."""

import os
import pickle
import signal
import threading
import time

import pytest

import rocking_wall as rw

STUDY = """
title = "Two workers"
models = ["CR", "CDC"]
levels = { method = "hunt", first = 0.05, increase = 0.05, top = 8, gap = 0.1 }
records = { files = ["beat.csv"], unit = "g", synthetic = { count = 3, duration = 10, step = 0.01 } }
report = { resamples = 100 }
classes = [{ name = "all" }]
hazard = { points = [[0.05, 0.03], [0.2, 0.002], [0.8, 1e-4]] }

[[walls]]
name = "parapet"
geometry = { height = 3, thickness = 0.3 }

[[walls]]
table = "walls.csv"
"""


@pytest.fixture
def study(tmp_path):
    """A study of 13 walls with a record from a file, and its path; twelve walls have ties that may yield."""
    tie = "name,height,thickness,tie_height,tie_stiffness,tie_slack,tie_strength,tie_ultimate\n"
    rows = (f"wall {k},{2 + 0.2 * k},0.25,2,2e5,{0.001 * k},{500 + 100 * k},0.03\n" for k in range(12))
    (tmp_path / "walls.csv").write_text(tie + "".join(rows), encoding="utf-8")
    samples = "".join(f"{0.01 * k:.2f},{0.2 * ((k % 40) - 20) / 20:.4f}\n" for k in range(800))
    (tmp_path / "beat.csv").write_text("time,a_g\n" + samples, encoding="utf-8")
    path = tmp_path / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


def files(folder):
    """Every file of a folder with its bytes."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_a_study_is_sent_as_it_is(study):
    sent = rw.Study(study)
    received = pickle.loads(pickle.dumps(sent))
    assert received._native.part(3) == sent._native.part(3)
    with pytest.raises(IndexError, match="part"):
        received._native.part(received._native.parts)


def test_two_workers_one_killed(study, program, tmp_path):
    # large packages are imported by the process that needs them
    import dask
    import distributed

    program("study", "ida", study, "-o", tmp_path / "alone")
    # workers are forks of one process that has imported distributed
    forks = dask.config.set({"distributed.worker.multiprocessing-method": "forkserver"})
    local = {"processes": True, "dashboard_address": None, "host": "127.0.0.1"}
    with (
        forks,
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, **local) as cluster,
        distributed.Client(cluster) as client,
    ):
        victim = next(iter(client.run(os.getpid).values()))
        out = tmp_path / "dask"
        killed = []

        def kill():
            # in the middle: some parts are there, others are not
            end = time.monotonic() + 60
            while time.monotonic() < end and not list(out.rglob("*.parquet")):
                time.sleep(0.001)
            os.kill(victim, signal.SIGKILL)
            killed.append(len(list(out.rglob("*.parquet"))))

        killer = threading.Thread(target=kill)
        killer.start()
        assert rw.dask.run(rw.Study(study), client, out, progress=False) == out
        killer.join()
    parts = len(list(out.rglob("*.parquet")))
    assert 0 < killed[0] < parts, "the worker was killed before or after the run"
    assert files(out) == files(tmp_path / "alone")
    ties = rw.read_results(out).ties
    assert set(ties["wall"]) == {f"wall {k}" for k in range(12)}
    assert ties["yielded"].all() and ties["broken"].any()


def test_a_folder_goes_on_and_is_read(study, tmp_path):
    import distributed
    import duckdb
    import pandas
    import polars

    out = tmp_path / "out"
    with distributed.Client(processes=False, dashboard_address=None, n_workers=1) as client:
        rw.dask.run(rw.Study(study), client, out, progress=False)
        whole = files(out)
        parts = sorted((out / "runs").rglob("*.parquet"))
        parts[1].unlink()
        parts[2].write_bytes(parts[2].read_bytes()[:-20])
        with pytest.warns(UserWarning, match="1 of .* parts are damaged"):
            rw.dask.run(rw.Study(study), client, out, progress=False)
        assert files(out) == whole
        (tmp_path / "walls.csv").write_text("name,height\nother,3\n", encoding="utf-8")
        with pytest.raises(ValueError, match="another study"):
            rw.dask.run(rw.Study(study), client, out, progress=False)
    runs = pandas.read_parquet(out / "runs")
    everywhere = str(out / "runs/**/*.parquet")
    assert polars.read_parquet(everywhere)["wall"].to_list() == runs["wall"].tolist()
    assert duckdb.sql(f"SELECT count(*) FROM '{everywhere}'").fetchall() == [(len(runs),)]
    csv = pandas.read_csv(out / "levels.csv")
    assert runs["wall"].tolist() == csv["wall"].tolist()
    assert runs["u_max_over_u_ins"].tolist() == csv["u_max_over_u_ins"].tolist()
    assert (runs["intensity_m_s2"] / 9.80665).tolist() == csv["intensity_g"].tolist()
