"""Tests how the wall's FMU answers a real importer.

What every FMU of this project answers (order of calls, wrong arguments, states, reset, threads) is tested at
the C boundary: crates/fmu-export/tests/exported. Here is what is the wall's own, and each law once.
"""

import csv
import json
import math
import random
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from fmpy.fmi1 import FMICallException

from conftest import ROOT
from unit import Unit


@pytest.fixture
def unpacked(either):
    """Tests run in both versions of FMI."""
    return either


SHAKEN = {"u_start": 0.0, "a1": 0.02, "damping_model": "constant_ratio"}
NAMES = ["u", "u_dot", "u_ddot", "u_ratio", "restoring_force", "damping_force",
         "reaction_bottom", "reaction_top", "impulse_bottom", "impulse_top",
         "overturn_time", "u_max", "overturned"]  # fmt: skip


def shake(unit, steps, seed=1, step=0.01):
    """Applies random accelerations, held in some steps and with a slope in others."""
    noise = random.Random(seed)
    for _ in range(steps):
        unit.set(a_bottom=noise.uniform(-3, 3), a_top=noise.uniform(-3, 3))
        unit.rates(a_bottom=noise.uniform(-50, 50))
        unit.step(step)
    return unit


def values(unit):
    return unit.get(*NAMES)


def refused(unit, call, *words):
    """Expects a call to fail, with an error in the log that contains every word."""
    unit.messages.clear()
    with pytest.raises(FMICallException) as caught:
        call()
    assert caught.value.status == 3, "fmi2Error"
    errors = [text for status, category, text in unit.messages if category == "logStatusError"]
    assert errors, "an error is always logged"
    for word in words:
        assert word in errors[-1], errors[-1]


# --- limits and relations -----------------------------------------------------------------------------------


def test_every_limit_is_checked_and_named(unpacked):
    checked = 0
    for variable in unpacked.description.modelVariables:
        if variable.type != "Real" or variable.causality not in ("parameter", "input"):
            continue
        low, high = (float(limit) for limit in (variable.min, variable.max))
        for value in (math.nextafter(low, -math.inf), math.nextafter(high, math.inf)):
            with Unit(unpacked) as unit:
                limit = low if value < low else high
                refused(unit, lambda: unit.set(**{variable.name: value}), variable.name)
                unit.slave.reset()
                unit.set(**{variable.name: limit})
        checked += 1
    assert checked == 40


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"solver": "exact"}, ("exact", "constant_ratio", "adaptive")),
        ({"u_start": 2.5}, ("u_start = 2.5", "u_ins = 0.2", "set u_start = 0")),
    ],
)
def test_relations_are_checked_at_the_end_of_initialisation(unpacked, settings, words):
    with Unit(unpacked) as unit:
        refused(unit, lambda: unit.start(**settings), *words)
        unit.slave.reset()
        unit.start().step(0.01)


# --- time ---------------------------------------------------------------------------------------------------


def test_the_clock_does_not_matter(unpacked):
    with Unit(unpacked) as early, Unit(unpacked) as late:
        early.start(**SHAKEN)
        late.start(time=1000.0, **SHAKEN)
        shake(early, 200)
        shake(late, 200)
        # steps differ by the rounding of 1000 s, 1e-13 s
        assert early.get("u") == pytest.approx(late.get("u"), abs=1e-10)


def test_the_work_of_a_step_is_bounded(unpacked):
    """A wall of 0.1 mm under 10^12 N vibrates 10^5 times in a step."""
    for step in (0.01, 1e6):
        with Unit(unpacked, logging=True) as unit:
            unit.start(
                height=0.00658, thickness=0.000122, overburden=7.88e11, damping_model="none", u_start=1e-5
            )
            assert any("omega1" in text for status, _, text in unit.messages if status == 1), "a warning"
            refused(unit, lambda: unit.step(step), "more samples, impacts, turns", "use smaller steps")


def test_overturning_is_an_ordinary_state(unit):
    unit.start(u_start=0.15, u_dot_start=1.0)
    for _ in range(600):
        unit.step(0.01)
    assert unit.get("overturned") is True
    assert 0.0 < unit.get("overturn_time") < 1.0
    assert unit.get("u") == pytest.approx(2.0), "at the end of its fall, h/2"
    assert unit.get("u_dot", "u_ddot", "reaction_bottom", "impulse_bottom") == [0.0, 0.0, 0.0, 0.0]


# --- inputs, outputs, derivatives ---------------------------------------------------------------------------


@pytest.mark.parametrize("name, limit", [("a_bottom", 1e6), ("a_top", 1e6), ("drift", 1e3)])
def test_slopes_lead_inputs_to_their_limits_and_not_beyond(unpacked2, name, limit):
    with Unit(unpacked2, logging=True) as unit:
        unit.start(mechanism="vertical_spanning", u_start=0.0)
        for sign in (1.0, -1.0):
            # both products and sums are exact
            unit.set(**{name: sign * limit / 2})
            unit.rates(**{name: sign * limit})
            unit.step(0.5)
            assert unit.get(name) == sign * limit
            unit.set(**{name: sign * limit / 2})
            unit.rates(**{name: sign * limit})
            state, time = unit.slave.getFMUState(), unit.time
            side = "above its maximum" if sign > 0 else "below its minimum"
            refused(unit, lambda: unit.slave.doStep(time, 1.0), f"{name} = ", side)
            unit.slave.setFMUState(state)


def test_the_tighter_tolerance_applies(unpacked):
    def end(tolerance, parameter):
        with Unit(unpacked) as unit:
            unit.start(importer_tolerance=tolerance, **{**SHAKEN, "tolerance": parameter, "u_start": 0.15})
            for _ in range(20):
                unit.step(0.5)
            return unit.get("u")

    coarse, fine = end(None, 1e-3), end(None, 1e-12)
    assert coarse != fine
    assert end(1e-12, 1e-3) == fine
    assert end(1e-3, 1e-12) == fine


# --- log ----------------------------------------------------------------------------------------------------


def test_log_of_starts_and_events(unpacked):
    with Unit(unpacked, logging=True) as unit:
        unit.start(u_start=0.15, u_dot_start=1.0)
        told = [text for _, category, text in unit.messages if category == "logAll"]
        assert "released from u_start = 0.15 m" in told
        for _ in range(200):
            unit.step(0.01)
        events = [text for _, category, text in unit.messages if category == "logEvents"]
        assert any("overturned" in text for text in events) and any("supports" in text for text in events)


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        ({}, "solver: exact"),
        ({"solver": "adaptive"}, "solver: adaptive, tolerance 1e-8"),
        ({"solver": "newmark", "newmark_step": 0.002}, "solver: newmark, step 0.002 s"),
    ],
)
def test_the_log_names_the_solver(unpacked, settings, text):
    with Unit(unpacked, logging=True) as unit:
        unit.start(damping_model="none", **settings)
        assert [found for _, _, found in unit.messages if "solver" in found] == [text]


# --- many instances -----------------------------------------------------------------------------------------


def test_eight_threads(unpacked):
    results = [None] * 8

    def run(index):
        with Unit(unpacked, name=f"wall {index}") as unit:
            unit.start(**SHAKEN)
            results[index] = values(shake(unit, 500))

    threads = [threading.Thread(target=run, args=(index,)) for index in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(result == results[0] for result in results) and results[0] is not None


QUIET = """
import sys
sys.path.insert(0, sys.argv[1])
from test_behaviour import shake
from unit import Unit
with Unit.unpack(sys.argv[2]) as unpacked, Unit(unpacked, logging=True) as unit:
    unit.start()
    shake(unit, 100)
    for bad in (lambda: unit.set(height=3.0), lambda: unit.step(float("nan"))):
        try:
            bad()
        except Exception:
            pass
"""


def test_nothing_is_printed(fmu):
    answer = subprocess.run(
        [sys.executable, "-c", QUIET, Path(__file__).parent, fmu], check=True, capture_output=True
    )
    assert answer.stdout == b"" and answer.stderr == b""


# --- the command line of FMPy -------------------------------------------------------------------------------


def fmpy_command(*arguments):
    program = shutil.which("fmpy", path=Path(sys.executable).parent)
    return subprocess.run(
        [program, *map(str, arguments)], check=True, capture_output=True, text=True, cwd=ROOT
    )


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: [row[name] for row in rows] for name in rows[0]}


def test_a_bare_fmpy_simulate_rocks_to_rest(fmu, tmp_path):
    out = tmp_path / "out.csv"
    fmpy_command("simulate", fmu, "--output-file", out)
    u = [float(value) for value in columns(out)["u"]]
    assert u[0] == 0.18
    crossings = sum(a * b < 0 for a, b in zip(u, u[1:]))
    assert crossings > 20, "it rocks"
    fifth = len(u) // 5
    parts = [max(map(abs, u[part * fifth : (part + 1) * fifth])) for part in range(5)]
    assert all(later < earlier for earlier, later in zip(parts, parts[1:])), "it decays"
    assert parts[-1] < 0.02 * parts[0], "to rest"
    assert set(columns(out)["overturned"]) == {"False"}


def test_an_input_file_gives_the_held_answer(fmu, wall, tmp_path):
    record, out = tmp_path / "record.csv", tmp_path / "out.csv"
    subprocess.run(
        [wall, "record", "--synthetic", "--pga", "2.5", "--samples", record], check=True, capture_output=True
    )
    fmpy_command(
        "simulate",
        fmu,
        "--input-file",
        record,
        "--stop-time",
        "12",
        "--start-values",
        "u_start",
        "0",
        "--output-file",
        out,
    )
    found = float(columns(out)["u_max"][-1])

    def on_the_command_line(*extra):
        command = [
            wall,
            "simulate",
            "--record",
            record,
            "--unit",
            "m/s2",
            "--stop-time",
            "12",
            "--json",
            *extra,
        ]
        return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["u_max"]

    assert found == pytest.approx(on_the_command_line("--hold"), abs=1e-6)
    linear = on_the_command_line()
    print(f"u_max {found:.8f} m held, {linear:.8f} m linear: {100 * (found / linear - 1):.3f} %")
