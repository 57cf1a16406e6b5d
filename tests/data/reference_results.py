"""Computes the reference results inside wall.fmu (fmi-ls-ref) from the equations alone.

    python tests/data/reference_results.py

The wall is the one of the start values: a parapet of height 4 m and thickness 0.4 m, bilinear, with a
constant damping ratio. SciPy integrates Eq. (12) from corner to corner and from sample to sample at a
tolerance of 1e-13. It shares nothing with the library but the equations of docs/model.md.
"""

import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

FOLDER = Path(__file__).parents[2] / "modelDescription/extra/org.fmi-standard.fmi-ls-ref"
HEIGHT, THICKNESS, MASS, GRAVITY, A1 = 4.0, 0.4, 4.0 * 0.4 * 1800.0, 9.81, 0.03
EFFECTIVE_MASS, PARTICIPATION = 4 / 3 * MASS, 3 / 4
SLOPE = 2 * MASS * GRAVITY / HEIGHT
U_INS = THICKNESS / 2
CORNER = A1 * U_INS
STIFFNESS = SLOPE * (U_INS - CORNER) / CORNER
# 0.95 of Eq. (2), and Eq. (21)
RESTITUTION = 0.95 * (1 - 1.5 * math.sin(math.atan(THICKNESS / HEIGHT)) ** 2)
XI = -0.350 * A1**0.074 * math.log(RESTITUTION)

STOP, SPACING, SAMPLE = 10.0, 0.02, 0.01


def rate(is_elastic, ground):
    """Returns the right-hand side of Eq. (12) on one branch."""

    def of(_, state):
        u, velocity = state
        stiffness = STIFFNESS if is_elastic else SLOPE * (U_INS - abs(u)) / abs(u)
        damping = 2 * EFFECTIVE_MASS * XI * math.sqrt(max(stiffness / EFFECTIVE_MASS, 0.0))
        return velocity, -PARTICIPATION * ground - (damping * velocity + stiffness * u) / EFFECTIVE_MASS

    return of


def corner(_, state):
    return abs(state[0]) - CORNER


corner.terminal = True


def advance(state, is_elastic, start, end, ground):
    """Returns the state after a time with a constant ground acceleration, and whether it is elastic then."""
    while start < end:
        corner.direction = 1 if is_elastic else -1
        done = solve_ivp(
            rate(is_elastic, ground), (start, end), state, "DOP853", rtol=1e-13, atol=1e-16, events=corner
        )
        start, state = done.t[-1], done.y[:, -1]
        is_elastic ^= done.status == 1
    return state, is_elastic


def response(u_start, ground):
    """Returns the rows time, u, u_dot; `ground` holds one acceleration for each `SAMPLE`."""
    state, is_elastic = np.array([u_start, 0.0]), u_start < CORNER
    rows = [(0.0, *state)]
    for index, held in enumerate(ground):
        state, is_elastic = advance(state, is_elastic, index * SAMPLE, (index + 1) * SAMPLE, held)
        if (index + 1) % round(SPACING / SAMPLE) == 0:
            rows.append(((index + 1) * SAMPLE, *state))
    return rows


def write(name, columns, rows):
    lines = [columns, *(",".join(f"{value:.12g}" for value in row) for row in rows)]
    (FOLDER / name).write_text("\n".join(lines) + "\n")


count = round(STOP / SAMPLE)
# two pulses of 0.8 Hz, a second apart; four decimals, so that every reader has the same numbers
phases = [math.pi * 0.8 * (index * SAMPLE - centre) for index in range(count + 1) for centre in (1.5, 4.0)]
pulses = [(1 - 2 * phase**2) * math.exp(-(phase**2)) for phase in phases]
ground = [round(1.7 * first - 1.2 * second, 4) + 0.0 for first, second in zip(pulses[::2], pulses[1::2])]
write("free_rocking_out.csv", "time,u,u_dot", response(0.9 * U_INS, [0.0] * count))
write("shaken_wall_in.csv", "time,a_g", [(index * SAMPLE, a) for index, a in enumerate(ground)])
write("shaken_wall_out.csv", "time,u,u_dot", response(0.0, ground[:-1]))
