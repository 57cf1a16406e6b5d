"""Tests `wall building --record` against the system integrated as one, and against FMPy on its SSP.

The record is El Centro where `ROCKING_WALL_RECORDS` has it, and the synthetic one otherwise.
"""

import os
import re
import subprocess
import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp

from conftest import ROOT
from monolith import Monolith, Wall

SCENES = ROOT / "scenes/building"
EL_CENTRO = Path(os.environ.get("ROCKING_WALL_RECORDS", "no records")) / "RSN6_IMPVALL.I_I-ELC180.AT2"
# without the quiet start of the record
START, END = 1.25, 2.5
# the motion and its factor: walls rock, and none falls
MOTION = [EL_CENTRO, "--scale", "0.5"] if EL_CENTRO.is_file() else ["--synthetic", "--scale", "1"]


@pytest.fixture(scope="module")
def document():
    return tomllib.loads((SCENES / "three_storeys.toml").read_text())


@pytest.fixture(scope="module")
def record(wall, tmp_path_factory):
    """A part of the record as CSV, and as a function of time."""
    path = tmp_path_factory.mktemp("record") / "record.csv"
    subprocess.run([wall, "record", *MOTION, "--samples", path], check=True)
    head, *rows = path.read_text().splitlines()
    times, samples = np.loadtxt(rows, delimiter=",").T
    part = (times >= START) & (times <= END)
    times, samples = times[part] - START, samples[part]
    rows = [f"{time:.6f},{sample}" for time, sample in zip(times, samples, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n")
    return path, lambda t: np.interp(t, times, samples, right=0.0)


@pytest.fixture(scope="module")
def history(wall, record, tmp_path_factory):
    path = tmp_path_factory.mktemp("history") / "history.csv"
    subprocess.run(
        [wall, "building", SCENES / "three_storeys.toml", "--record", record[0], "--tail", "0"]
        + ["--tolerance", "5e-4", "--csv", path],
        check=True,
    )
    return np.genfromtxt(path, delimiter=",", names=True, deletechars="")


def parameters(scene):
    document = tomllib.loads((SCENES / scene).read_text())
    tables = [document[name] for name in ("geometry", "force_law", "damping")]
    return {key: value for table in tables for key, value in table.items()} | {"u_start": 0.0}


def test_the_run_is_that_of_the_system_integrated_as_one(document, record, history):
    names = [floor["name"] for floor in document["floor"]]
    walls = []
    for wall in document["wall"]:
        bottom, top = (names.index(wall[end]) if end in wall else None for end in ("bottom", "top"))
        walls.append(Wall(parameters(wall["scene"]), bottom, top, drift=top is not None))
    model = Monolith(document["floor"], walls, record[1])
    times = history["time_s"][1:]
    states = model.solve(times)
    size = model.n + len(walls)
    rocking = [np.abs(states[:, model.n + j]).max() / wall.u_ins for j, wall in enumerate(walls)]
    assert max(rocking) > 0.2, rocking
    for j, wall in enumerate(document["wall"]):
        own, truth = history[f"{wall['name']}.u_m"][1:], states[:, model.n + j]
        assert np.abs(own - truth).max() < 5e-3 * np.abs(truth).max(), wall["name"]
    found = np.array([
        model.accelerations(t, state, [branch(w, u) for w, u in zip(walls, state[model.n : size])])
        for t, state in zip(times, states)
    ])  # fmt: skip
    for i, name in enumerate(names):
        own, truth = history[f"{name}.acceleration_m_s2"][1:], found[:, i]
        assert np.abs(own - truth).max() < 1e-3 * np.abs(truth).max(), name


def branch(wall, u):
    return 0 if abs(u) <= wall.u1 else int(np.sign(u))


def test_the_run_is_that_of_fmpy(wall, fmu, floor_fmu, record, history, document, tmp_path):
    text = (SCENES / "three_storeys.toml").read_text()
    for part in ("strip", "parapet", "gable"):
        (tmp_path / f"{part}.toml").write_text((SCENES / f"{part}.toml").read_text())
    (tmp_path / "b.toml").write_text(f"expose_ground = true\n{text}")
    command = [wall, "building", "b.toml", "-o", "b.ssp", "--wall-fmu", fmu, "--floor-fmu", floor_fmu]
    subprocess.run(command, check=True, cwd=tmp_path)
    with zipfile.ZipFile(tmp_path / "b.ssp") as archive:
        system = archive.read("SystemStructure.ssd").decode()
    step = float(re.search('baseStepSize="([^"]+)"', system)[1])
    # a master that holds inputs takes the ground in the middle of the step
    ground = {"a_g": lambda t: record[1](t + 0.5 * step)}
    result = simulate_ssp(str(tmp_path / "b.ssp"), stop_time=END - START, step_size=step, input=ground)
    for floor in document["floor"]:
        own = np.abs(history[f"{floor['name']}.acceleration_m_s2"]).max()
        other = np.abs(result[f"{floor['name']}.acceleration_absolute"]).max()
        assert abs(own - other) < 0.01 * other, floor["name"]
    for part in document["wall"]:
        own, other = np.abs(history[f"{part['name']}.u_m"]).max(), np.abs(result[f"{part['name']}.u"]).max()
        assert abs(own - other) < 0.01 * other, part["name"]
