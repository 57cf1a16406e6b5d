"""Compares full rotations with Newton's and Euler's equations, body by body.

The bodies are plane and rigid. The unknowns are the accelerations of each body and the forces at its joints:
the toe, the hinge, and the corner that slides up along the top support. The wall's equation of motion and its
coordinate are not used here.
"""

import json
import subprocess

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

STEP, COUNT = 0.01, 200
WALL = {
    "height": 3.0,
    "thickness": 0.3,
    "width": 1.0,
    "density": 1800.0,
    "gravity": 9.81,
    "restitution": 0.9,
    "u_start": 0.1,
}
CASES = {
    "parapet": {"mechanism": "parapet"},
    "loaded parapet": {
        "mechanism": "parapet",
        "overburden": 8000.0,
        "overburden_eccentricity": 0.04,
        "u_start": 0.05,
    },
    "strip": {"mechanism": "vertical_spanning", "hinge_ratio": 0.5},
    "loaded strip": {
        "mechanism": "vertical_spanning",
        "hinge_ratio": 0.58,
        "overburden": 8000.0,
        "overburden_eccentricity": 0.05,
    },
    "follows the pivot": {
        "mechanism": "vertical_spanning",
        "hinge_ratio": 0.4,
        "u_start": 0.2,
        "overburden": 8000.0,
        "overburden_eccentricity": -0.03,
        "eccentricity_mode": "follows_pivot",
    },
}


def turned(angle, point):
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([cosine * point[0] - sine * point[1], sine * point[0] + cosine * point[1]])


def cross(r, force):
    return r[0] * force[1] - r[1] * force[0]


class Bodies:
    """The wall leaning towards +x; `side` = -1 mirrors it."""

    def __init__(self, wall, side):
        follows = wall.get("eccentricity_mode") == "follows_pivot"
        self.eccentricity = wall.get("overburden_eccentricity", 0.0) * (1 if follows else side)
        self.b, h, self.g = wall["thickness"], wall["height"], wall["gravity"]
        self.load = wall.get("overburden", 0.0)
        strip = wall["mechanism"] == "vertical_spanning"
        self.heights = [wall["hinge_ratio"] * h, (1 - wall["hinge_ratio"]) * h] if strip else [h]
        self.masses = [wall["density"] * wall["width"] * self.b * height for height in self.heights]
        self.total = sum(self.masses)

    def place(self, theta):
        """Returns the angles of the bodies, anticlockwise."""
        if len(self.heights) == 1:
            return [-theta]
        h1, h2 = self.heights
        hinge = turned(-theta, [-self.b, h1])[0]
        top = lambda angle: hinge + turned(angle, [self.b, h2])[0]  # noqa: E731
        return [-theta, brentq(top, -0.5, np.pi / 2, xtol=1e-15, rtol=1e-15)]

    def displacement(self, theta):
        """Returns the displacement of a parapet's centre or of a strip's hinge."""
        corner = [-self.b, self.heights[0]]
        moved = turned(-theta, corner)[0] - corner[0]
        return (
            moved if len(self.heights) == 2 else turned(-theta, [-self.b / 2, corner[1] / 2])[0] + self.b / 2
        )

    def solve(self, theta, rate, ground):
        """Returns the angular acceleration of the lower body and the horizontal force of the supports."""
        angles, rates, n = self.place(theta), [-rate], len(self.heights)
        if n == 2:
            # the top corner slides upwards
            hinge_speed = rates[0] * -turned(angles[0], [-self.b, self.heights[0]])[1]
            rates.append(hinge_speed / turned(angles[1], [self.b, self.heights[1]])[1])
        arms = [
            {name: turned(angle, point) for name, point in self.corners(height).items()}
            for angle, height in zip(angles, self.heights)
        ]
        # unknowns: ax, ay, angular acceleration of each body; toe (2), hinge (2) on the upper body, top (1)
        size = 5 if n == 1 else 11
        matrix, right = np.zeros((size, size)), np.zeros(size)
        joints = [("toe", 0, 3 * n, 1.0)] + (
            [("far", 0, 8, -1.0), ("low", 1, 8, 1.0), ("top", 1, 10, 1.0)] if n == 2 else []
        )
        for i, (mass, height) in enumerate(zip(self.masses, self.heights)):
            matrix[3 * i, 3 * i] = matrix[3 * i + 1, 3 * i + 1] = mass
            matrix[3 * i + 2, 3 * i + 2] = mass * (height**2 + self.b**2) / 12
            right[3 * i], right[3 * i + 1] = -mass * ground, -mass * self.g
        for name, i, column, sign in joints:
            r = arms[i][name]
            for axis in range(1 if name == "top" else 2):
                unit = np.eye(2)[axis]
                matrix[3 * i + axis, column + axis] -= sign
                matrix[3 * i + 2, column + axis] -= sign * cross(r, unit)
        # the load on a point of the top section
        r = arms[-1]["load"]
        right[3 * n - 2] -= self.load
        right[3 * n - 1] += cross(r, [0.0, -self.load])

        def point(row, i, name, sign, axes):
            """Returns the acceleration of a point of body i."""
            r = arms[i][name]
            for k, axis in enumerate(axes):
                matrix[row + k, 3 * i + axis] += sign
                matrix[row + k, 3 * i + 2] += sign * (-r[1] if axis == 0 else r[0])
                right[row + k] += sign * rates[i] ** 2 * r[axis]

        point(3 * n, 0, "toe", 1.0, (0, 1))
        if n == 2:
            point(8, 0, "far", 1.0, (0, 1))
            point(8, 1, "low", -1.0, (0, 1))
            point(10, 1, "top", 1.0, (0,))
        found = np.linalg.solve(matrix, right)
        supports = found[3 * n] + (found[10] if n == 2 else 0.0)
        return -found[2], supports

    def corners(self, height):
        b = self.b
        return {
            "toe": [b / 2, -height / 2],
            "far": [-b / 2, height / 2],
            "low": [-b / 2, -height / 2],
            "top": [b / 2, height / 2],
            "load": [self.eccentricity, height / 2],
        }


def reference(wall, samples):
    """Returns u [m] and the force of the supports [N] at the samples, and the impacts."""
    sides = {side: Bodies(wall, side) for side in (1, -1)}
    side, impacts = 1, 0
    start = brentq(lambda theta: sides[1].displacement(theta) - wall["u_start"], 0.0, 0.5, xtol=1e-16)
    state, rows = np.array([start, 0.0]), []

    def note(ground):
        bodies = sides[side]
        force = bodies.solve(*state, side * ground)[1]
        rows.append((side * bodies.displacement(state[0]), side * force))

    note(samples[0])
    touch = lambda time, y: y[0]  # noqa: E731
    touch.terminal, touch.direction = True, -1
    for low, high in zip(samples, samples[1:]):
        elapsed = 0.0
        for _ in range(10):
            if elapsed >= STEP:
                break
            bodies = sides[side]
            ground = lambda time: side * (low + (high - low) * time / STEP)  # noqa: E731, B023
            motion = lambda time, y: [y[1], bodies.solve(y[0], y[1], ground(time))[0]]  # noqa: E731, B023
            run = solve_ivp(
                motion, (elapsed, STEP), state, method="DOP853", rtol=1e-11, atol=1e-13, events=touch
            )
            elapsed, state = run.t[-1], run.y[:, -1]
            if run.status == 1:
                # the same speed of approach on the other side, times e
                state, side, impacts = np.array([0.0, -wall["restitution"] * state[1]]), -side, impacts + 1
        assert elapsed == STEP, "impacts accumulate: the case is to move on"
        note(high)
    return np.array(rows), impacts


def scene(wall, folder, record):
    def numbers(names):
        return "".join(f"{name} = {json.dumps(wall[name])}\n" for name in names if name in wall)

    geometry = [
        "mechanism",
        "height",
        "thickness",
        "width",
        "density",
        "gravity",
        "hinge_ratio",
        "overburden",
    ]
    geometry += ["overburden_eccentricity", "eccentricity_mode"]
    text = f"""output_step = {STEP}
stop_time = {COUNT * STEP}
[geometry]
kinematics = "trigonometric"
{numbers(geometry)}
[force_law]
force_law = "rigid_linear"
[damping]
damping_model = "none"
[impact]
impact = "restitution"
{numbers(["restitution"])}
[start]
{numbers(["u_start"])}
[solver]
tolerance = 1e-12
[motion]
record = "{record}"
unit = "m/s2"
step = {STEP}
"""
    path = folder / "scene.toml"
    path.write_text(text)
    return path


@pytest.mark.parametrize("case", CASES)
def test_newton_and_euler_body_by_body(wall, tmp_path, case):
    parameters = WALL | CASES[case]
    time = np.arange(COUNT + 1) * STEP
    samples = 1.2 * np.sin(2 * np.pi * 1.1 * time) * np.exp(-0.3 * time)
    (tmp_path / "record.csv").write_text("\n".join(repr(float(sample)) for sample in samples) + "\n")
    path = scene(parameters, tmp_path, "record.csv")
    history = tmp_path / "history.csv"
    subprocess.run([wall, "simulate", path, "--csv", history], check=True, capture_output=True)
    table = np.genfromtxt(history, delimiter=",", names=True)
    expected, impacts = reference(parameters, samples)
    assert impacts >= 2
    u_ins = parameters["thickness"] / (2 if parameters["mechanism"] == "parapet" else 1)
    # each of 200 calls of DOP853 leaves an error of at most 1e-11 of θ, which both amplify; they agree to
    # 2e-14
    assert table["u_m"] == pytest.approx(expected[:, 0], abs=1e-10 * u_ins)
    # the sum of the reactions, up to the last sample, after which a record is zero
    force = (table["reaction_bottom_n"] + table["reaction_top_n"])[:-1]
    weight = parameters["density"] * parameters["thickness"] * parameters["height"] * parameters["gravity"]
    away = np.abs(expected[:-1, 0]) > 1e-6
    assert away.sum() > COUNT / 2
    # near an impact the sample may be on the other side of it
    assert force[away] == pytest.approx(expected[:-1, 1][away], abs=1e-10 * weight)
