"""Computes the reference cases of ties (t*) and of one-sided rocking (o*) from the mechanics of a block.

    python tests/data/restraints.py [NAME...]

A block of mass m, height h and thickness b turns by a small angle about its toe. SciPy integrates the moment
equation between events (the zero of the angle, the corners of the force, the slack of the tie), each located
by integrating up to it again. It shares nothing with the library but the equations.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

FOLDER = Path(__file__).parent / "cases"
G, H, B, WEIGHT = 9.81, 4.0, 0.4, 28252.8
PROBE = 1e-7
# flights shorter than this are those of a constant acceleration
SHORT = 1e-5

CDC = {"damping_model": "constant_coefficient"}
CDR = {"damping_model": "constant_ratio"}
SDR = {"damping_model": "stiffness_proportional"}
NONE = {"damping_model": "none"}
CASES = {
    "t01_tie_stiff_free": {
        "law": "bilinear", "damping": CDC | {"xi": 0.02}, "u0": -0.8, "t_end": 12.0,
        "tie": {"tie_height": 4.0, "tie_stiffness": 2.25e7, "tie_slack": 0.05, "tie_side": "positive"},
    },
    "t02_tie_sdr_record": {
        "law": "bilinear", "damping": SDR | {"xi": 0.05}, "record": 0.6, "t_end": 20.0,
        "tie": {"tie_height": 3.0, "tie_stiffness": 2.0e5, "tie_slack": 0.0, "tie_side": "both"},
    },
    "t03_tie_rigid_record": {
        "law": "rigid_linear", "damping": NONE, "restitution": 0.93, "record": 0.6, "t_end": 6.0,
        "tie": {"tie_height": 3.0, "tie_stiffness": 2.0e5, "tie_slack": 0.03, "tie_side": "positive"},
    },
    "t04_tie_cdr_free": {
        "law": "bilinear", "damping": CDR | {"xi": 0.03}, "u0": 0.9, "t_end": 15.0,
        "tie": {"tie_height": 2.0, "tie_stiffness": 3.0e4, "tie_slack": 0.05, "tie_side": "both"},
    },
    "o01_one_sided_free": {
        "law": "rigid_linear", "damping": NONE, "restitution": 0.47, "u0": 0.9, "t_end": 8.0, "side": 1.0,
    },
    "o02_one_sided_pulse": {
        "law": "bilinear", "damping": CDC | {"xi": 0.02}, "restitution": 0.4, "ricker": [3.0, 0.9, 1.5],
        "t_end": 8.0, "side": 1.0,
    },
    "o03_one_sided_record": {
        "law": "rigid_linear", "damping": NONE, "restitution": 0.48, "record": 0.9, "t_end": 20.0,
        "side": -1.0,
    },
    "o04_one_sided_elastic_record": {
        "law": "bilinear", "damping": NONE, "restitution": 0.35, "record": 0.7, "t_end": 20.0, "side": 1.0,
    },
    "o05_one_sided_tie_record": {
        "law": "bilinear", "damping": CDC | {"xi": 0.03}, "restitution": 0.45, "record": 0.7, "t_end": 15.0,
        "side": 1.0,
        "tie": {"tie_height": 3.5, "tie_stiffness": 5.0e4, "tie_slack": 0.01, "tie_side": "positive"},
    },
}


class Block:
    """The block, its moments, and what moves it."""

    def __init__(self, case, factor):
        self.mass = WEIGHT / G
        self.inertia = self.mass * H**2 / 3
        self.strength, self.slope = WEIGHT * B / H, 2 * WEIGHT / H
        self.u_ins = self.strength / self.slope
        self.rigid = case["law"] == "rigid_linear"
        self.end = 0.0 if self.rigid else 0.03 * self.u_ins
        self.elastic = None if self.rigid else self.slope * (self.u_ins - self.end) / self.end
        self.damping, self.restitution = case["damping"], case.get("restitution")
        self.tie, self.side = case.get("tie"), case.get("side")
        effective = self.inertia / (H / 2) ** 2
        self.omega = None if self.rigid else math.sqrt(self.elastic / effective)
        self.effective, self.rate = effective, math.sqrt(self.slope / effective)
        self.factor = factor
        self.ricker = case.get("ricker")
        self.samples = None
        if "record" in case:
            lines = (FOLDER / "records/R1_dt005.csv").read_text().splitlines()
            values = np.array([float(line) for line in lines if not line.startswith("#")])
            self.samples = case["record"] * factor * values
        marks = {self.end, self.u_ins} - {0.0}
        marks |= {10.0}
        self.marks = sorted({0.0} | marks | {-mark for mark in marks} | set(self.onsets()))

    def onsets(self):
        if self.tie is None:
            return []
        u = self.tie["tie_slack"] * H / (2 * self.tie["tie_height"])
        return {"positive": [u], "negative": [-u], "both": [-u, u]}[self.tie["tie_side"]]

    def ground(self, t):
        if self.samples is not None:
            place = t / 0.005
            index = min(int(place), len(self.samples) - 2)
            return self.samples[index] + (self.samples[index + 1] - self.samples[index]) * (place - index)
        if self.ricker is not None:
            amplitude, frequency, centre = self.ricker
            z = (math.pi * frequency * (t - centre)) ** 2
            return self.factor * amplitude * (1 - 2 * z) * math.exp(-z)
        return 0.0

    def own(self, u, sign):
        """Force of the wall alone at mid-height, on the side of a sign."""
        if not self.rigid and abs(u) <= self.end:
            return self.elastic * u
        return sign * (self.strength - self.slope * abs(u))

    def pull(self, u):
        """Force of the tie."""
        if self.tie is None:
            return 0.0
        w = 2 * u * self.tie["tie_height"] / H
        reach = {"positive": w, "negative": -w, "both": abs(w)}[self.tie["tie_side"]] - self.tie["tie_slack"]
        return math.copysign(self.tie["tie_stiffness"] * max(0.0, reach), u)

    def coefficient(self, u):
        if self.damping == NONE:
            return 0.0
        inside = abs(u) <= self.end
        secant = self.elastic if inside else max(0.0, self.own(abs(u), 1.0) / abs(u))
        omega = math.sqrt(secant / self.effective)
        shares = {
            "constant_coefficient": self.omega,
            "constant_ratio": omega,
            "stiffness_proportional": omega**2 / self.omega,
        }
        share = shares[self.damping["damping_model"]]
        return 2 * self.effective * self.damping["xi"] * share

    def acceleration(self, t, u, v, sign):
        """u is the displacement at mid-height, u = angle h/2."""
        moment = (self.own(u, sign) + self.coefficient(u) * v + self.mass * self.ground(t)) * H / 2
        if self.tie is not None:
            moment += self.pull(u) * self.tie["tie_height"]
        return -moment / self.inertia * H / 2


class Run:
    def __init__(self, case, factor=1.0):
        self.block = Block(case, factor)
        self.t, self.u, self.v = 0.0, case.get("u0", 0.0) * self.block.u_ins * factor, 0.0
        self.resting = self.can_rest() and self.u == 0.0 and self.holds(0.0)
        self.impacts, self.peak = 0, abs(self.u)
        # a wall that cannot rest follows the ground at once
        self.heading = math.copysign(1.0, -self.block.ground(0.0025))

    def can_rest(self):
        return self.block.rigid or self.block.side is not None

    def driving(self, t, sign):
        """Acceleration at u = 0 towards a side, if the wall is on it."""
        return sign * self.block.acceleration(t, 0.0, 0.0, sign)

    def holds(self, t):
        sides = [1.0, -1.0] if self.block.side is None else [self.block.side]
        return all(self.driving(t, sign) <= 0.0 for sign in sides)

    def flow(self, t, u, v, duration, sign, events=(), dense=False):
        right = lambda t, y: [y[1], self.block.acceleration(t, y[0], y[1], sign)]
        scale = self.block.u_ins
        return solve_ivp(right, (t, t + duration), [u, v], method="DOP853", rtol=3e-14,
                         atol=[1e-16 * scale, 1e-16 * scale * self.block.rate], events=events,
                         max_step=max(duration, 1e-12) / 2)

    def advance(self, end):
        for _ in range(100000):
            if self.t >= end:
                return
            if self.resting:
                self.rest(end)
            else:
                self.move(end)
        raise RuntimeError("too many events")

    def rest(self, end):
        sides = [1.0, -1.0] if self.block.side is None else [self.block.side]
        pushes = [sign for sign in sides if self.driving(end, sign) > 0.0]
        if not pushes:
            self.t = end
            return
        sign = pushes[0]
        start = self.driving(self.t, sign)
        root = self.t if start >= 0.0 else brentq(lambda t: self.driving(t, sign), self.t, end, xtol=1e-16)
        # a little later, so that the wall is pushed away
        self.t, self.u, self.v, self.resting = min(root + 1e-11, end), 0.0, 0.0, False
        self.heading = sign

    def move(self, end):
        block = self.block
        sign = math.copysign(1.0, self.u if self.u != 0.0 else self.v if self.v != 0.0 else self.heading)
        low, high = self.interval(sign)
        start = (self.t, self.u, self.v)
        duration = end - self.t
        at_corner = self.u in (low, high)
        if at_corner and duration > 0.0:
            # leave the corner before looking for the next
            a = block.acceleration(self.t, self.u, self.v, sign)
            inwards = 1.0 if self.u == low else -1.0
            flight = 2 * abs(self.v / a) if a * inwards < 0.0 else math.inf
            if flight < SHORT and self.u == 0.0:
                self.hop(min(flight, duration), flight, a, sign)
                return
            first = 1e-3 * min(flight, duration)
            path = self.flow(*start, first, sign)
            start = (self.t + first, path.y[0][-1], path.y[1][-1])
            duration -= first
        events = []
        for corner, direction in ((low, -1.0), (high, 1.0)):
            event = lambda t, y, corner=corner: y[0] - corner
            event.terminal, event.direction = True, direction
            events.append(event)
        events.append(lambda t, y: y[1])
        path = self.flow(*start, duration, sign, events)
        if path.status != 1:
            self.t, self.u, self.v = end, path.y[0][-1], path.y[1][-1]
            self.see(path)
            return
        corner = low if len(path.t_events[0]) else high
        time = path.t[-1]
        for _ in range(3):
            again = self.flow(*start, time - start[0], sign)
            u, v = again.y[0][-1], again.y[1][-1]
            time -= (u - corner) / v
        self.see(path)
        self.t, self.u, self.v = time, corner, v
        if corner == 0.0:
            self.pass_zero(sign)

    def hop(self, length, flight, a, sign):
        """A flight so short that its acceleration is constant."""
        if length < flight:
            self.u, self.v = self.v * length + a * length**2 / 2, self.v + a * length
            self.t += length
            return
        self.t += flight
        self.u, self.v = 0.0, -self.v
        self.pass_zero(sign)

    def pass_zero(self, sign):
        block = self.block
        e = 1.0 if block.restitution is None else block.restitution
        if block.restitution is not None:
            self.impacts += 1
        self.v *= e if block.side is None else -e
        self.heading = sign if block.side is not None else -sign
        slow = abs(self.v) < 1e-13 * block.u_ins * block.rate
        if self.can_rest() and slow:
            self.v = 0.0
            self.resting = self.holds(self.t)

    def interval(self, sign):
        """The corners around the place of the wall."""
        marks = self.block.marks
        if self.u in marks:
            heading = self.v if self.v != 0.0 else sign
            index = marks.index(self.u)
            return (marks[index], marks[index + 1]) if heading > 0.0 else (marks[index - 1], marks[index])
        index = next(i for i, mark in enumerate(marks) if mark > self.u)
        return marks[index - 1], marks[index]

    def see(self, path):
        turns = np.abs(path.y_events[2][:, 0]) if len(path.y_events[2]) else [0.0]
        self.peak = max(self.peak, np.abs(path.y[0]).max(), max(turns))


def history(case, factor=1.0):
    run = Run(case, factor)
    rows = [(0.0, run.u, run.v)]
    for n in range(1, round(case["t_end"] / 0.01) + 1):
        for half in (n / 100 - 0.005, n / 100):
            run.advance(half)
        rows.append((n / 100, run.u, run.v))
    return np.array(rows), run


def scene(case, block):
    """Returns the case as the text of a scene file."""
    geometry = {
        "mechanism": "parapet", "height": H, "thickness": B, "density": WEIGHT / (G * H * B), "gravity": G,
    }
    law = {"force_law": case["law"]}
    if not block.rigid:
        law |= {"a1": 0.03, "a3": 1.0, "softening": "parallel"}
    impact = {}
    if block.restitution is not None:
        impact = {"impact": "restitution", "restitution": block.restitution}
    if block.side is not None:
        impact["rocking"] = "one_sided_positive" if block.side > 0.0 else "one_sided_negative"
    motion = {}
    if block.samples is not None:
        record = "records/R1_dt005.csv"
        motion = {"record": record, "unit": "m/s2", "step": 0.005, "scale": case["record"]}
    elif block.ricker is not None:
        amplitude, frequency, centre = block.ricker
        motion = {"ricker": {"amplitude": amplitude, "frequency": frequency, "centre": centre}}
    tables = {
        "geometry": geometry, "force_law": law, "damping": case["damping"], "impact": impact,
        "tie": case.get("tie"), "start": {"u_start": case.get("u0", 0.0) * block.u_ins, "u_dot_start": 0.0},
        "solver": {"tolerance": 1e-12}, "motion": motion,
    }
    lines = [f"stop_time = {case['t_end']}"] if motion else ["inputs = []", f"stop_time = {case['t_end']}"]
    for name, table in tables.items():
        if table:
            lines += ["", f"[{name}]", *(f"{key} = {toml(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    return json.dumps(value)


def write(name):
    case = CASES[name]
    rows, run = history(case)
    block = run.block
    sensitivity = np.ones(len(rows))
    for probe in (PROBE, -PROBE):
        other, _ = history(case, 1 + probe)
        apart = np.abs(other[:, 1] - rows[:, 1]) / (PROBE * block.u_ins)
        sensitivity = np.maximum(sensitivity, np.maximum.accumulate(apart))
    beyond = np.nonzero(sensitivity > 1e5)[0]
    horizon = float(rows[beyond[0], 0]) if len(beyond) else case["t_end"]
    (FOLDER / f"{name}.toml").write_text(scene(case, block))
    reference = {
        "u_ins": block.u_ins, "u_max": run.peak, "overturn_time": None, "horizon": horizon,
        "error_in_double": 0.0,
    }
    (FOLDER / f"{name}.json").write_text(json.dumps(reference, indent=1) + "\n")
    lines = [f"{t:.6f},{u!r},{v!r},{s:.6g}" for (t, u, v), s in zip(rows.tolist(), sensitivity)]
    (FOLDER / f"{name}.csv").write_text("\n".join(["t,u,v,sensitivity", *lines]) + "\n")
    print(name, "peak", run.peak / block.u_ins, "impacts", run.impacts, "S", sensitivity.max(), horizon)


for chosen in sys.argv[1:] or CASES:
    write(chosen)
