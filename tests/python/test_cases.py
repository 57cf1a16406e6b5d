"""Runs the reference cases of tests/data/cases in the FMU, with input derivatives on a_bottom and a_top.

A case passes if |error|/u_ins stays within max(1e-9, 100 eps sensitivity, 100 double_vs_quad) up to its
horizon, as in the Rust tests.
"""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest

CASES = Path(__file__).parents[1] / "data/cases"
NAMES = sorted(path.stem for path in CASES.glob("*.json"))
EPSILON = 2.2e-16
LAWS = {"rigid": "rigid_linear", "bilinear": "bilinear", "trilinear": "trilinear"}
MODELS = {
    "none": "none",
    "CDC": "constant_coefficient",
    "CDCFS": "free_standing_block",
    "CDR": "constant_ratio",
    "SDR": "stiffness_proportional",
}


@pytest.fixture
def unpacked(either):
    """Each case runs in both versions of FMI; in FMI 3.0 the instance asks for the inputs at each end."""
    return either


def parameters(case):
    wall, law, damping = case["wall"], case["law"], case["damping"]
    values = {
        "mechanism": {"PW": "parapet", "VSSW": "vertical_spanning"}[wall["kind"]],
        "height": wall["h"],
        "thickness": wall["b"],
        "gravity": case["g"],
        "density": wall["W"] / (case["g"] * wall["h"] * wall["b"]),
        "overburden": wall.get("O", 0.0),
        "overburden_eccentricity": wall.get("c", 0.0),
        "eccentricity_mode": {"mirrored": "fixed_to_wall", "same": "follows_pivot"}[case["c_mode"]],
        "force_law": LAWS[law["typ"]],
        "damping_model": MODELS[damping["kind"]],
        "u_start": case["u0"],
        "u_dot_start": case["v0"],
        "tolerance": 1e-12,
    }
    if "h1" in wall:
        values["hinge_ratio"] = wall["h1"] / wall["h"]
    for key in ("a1", "a3", "d1"):
        if key in law:
            values[key] = law[key]
    if "soften" in law:
        values["softening"] = law["soften"]
    if "xi" in damping:
        values["xi"] = damping["xi"]
    if "cbar" in damping:
        values["c_bar"] = damping["cbar"]
    if "e" in damping:
        values |= {"impact": "restitution", "restitution": damping["e"]}
    if "tie" in case:
        keys = {"y": "height", "K": "stiffness", "g0": "slack", "side": "side"}
        values |= {f"tie_{keys[key]}": value for key, value in case["tie"].items()}
    if "rocking" in case:
        values["rocking"] = case["rocking"]
    return values


def nodes(case):
    """Returns times and accelerations, linear between; formulas are sampled as a - dt²/12 a''."""
    motion, end = case["excitation"], case["t_end"]
    if motion["kind"] == "record":
        lines = (CASES / motion["file"]).read_text().splitlines()
        samples = motion["scale"] * np.array([float(line) for line in lines if not line.startswith("#")])
        return np.arange(len(samples)) * motion["dt"], samples
    if motion["kind"] == "none":
        return np.array([0.0, end]), np.zeros(2)
    step = 5e-4
    times = np.arange(round(end / step) + 1) * step
    amplitude, omega = motion["A"], 2 * math.pi * motion["f"]
    if motion["kind"] == "harmonic":
        assert "t_end" not in motion, "a harmonic that ends needs its end as a node"
        phase = omega * times + motion.get("phi", 0.0)
        return times, amplitude * np.sin(phase) * (1 + (omega * step) ** 2 / 12)
    z = math.pi * motion["f"] * (times - motion["t0"])
    second = (math.pi * motion["f"]) ** 2 * (-6 + 24 * z**2 - 8 * z**4) * np.exp(-(z**2))
    return times, amplitude * ((1 - 2 * z**2) * np.exp(-(z**2)) - step**2 / 12 * second)


def rows(name):
    with open(CASES / f"{name}.csv", newline="") as file:
        reader = csv.DictReader(file)
        return [{key: float(value) for key, value in row.items()} for row in reader]


@pytest.mark.parametrize("name", NAMES)
def test_case(name, unit):
    case = json.loads((CASES / f"{name}.json").read_text())
    times, accelerations = nodes(case)
    supports = ["a_bottom"] + (["a_top"] if case["wall"]["kind"] == "VSSW" else [])
    unit.start(**parameters(case), **dict.fromkeys(supports, accelerations[0]))
    u_ins, accuracy = case["derived"]["uinsp"], case["accuracy"]
    overturn = case["result"]["t_overturn"]

    def advance(until):
        """Advances to `end`, one step for each piece between nodes of the excitation."""
        while unit.time < until - 1e-9:
            index = int(np.searchsorted(times, unit.time + 1e-9)) - 1
            if index + 1 < len(times):
                end = min(times[index + 1], until)
                rate = (accelerations[index + 1] - accelerations[index]) / (times[index + 1] - times[index])
                value = accelerations[index] + rate * (unit.time - times[index])
            else:
                end, rate, value = until, 0.0, 0.0
            unit.set(**dict.fromkeys(supports, value))
            unit.rates(**dict.fromkeys(supports, rate))
            before = unit.time
            unit.step(end - unit.time)
            unit.time = end
            if overturn is not None:
                # the flag is set in the step in which |u| exceeds u_ins
                assert unit.get("overturned") == (end >= overturn), f"flag after {before} s ... {end} s"

    compared = 0
    for row in rows(name):
        if row["t"] > accuracy["horizon_S_below_1e5"] or math.isnan(row["u"]):
            break
        advance(row["t"])
        error = abs(unit.get("u") - row["u"]) / u_ins
        bound = max(1e-9, 100 * EPSILON * row["sensitivity"], 100 * accuracy["double_vs_quad_over_uins"])
        assert error <= bound, f"t = {row['t']} s: error {error:.3e} u_ins, bound {bound:.3e}"
        compared += 1
    assert compared > 10
    if overturn is None:
        assert unit.get("overturned") is False
        assert unit.get("overturn_time") == -1.0
    else:
        advance(overturn + 0.02)
        assert unit.get("overturn_time") == pytest.approx(overturn, abs=1e-6)
