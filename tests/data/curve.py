"""Prints the references of tests/it/curve.rs: u of an oscillator with a capacity curve of two sides.

    python tests/data/curve.py

m_eff ü + c u̇ + F(u) = −λ m_eff a_g with a_g linear between samples and F between points, beyond them along
the outermost lines. SciPy integrates from one sample or point to the next.
"""

import numpy as np
from scipy.integrate import solve_ivp

MASS, PARTICIPATION, DAMPING_RATIO, STEP = 1200.0, 1.3, 0.05, 0.1
U = np.array([-0.30, -0.18, -0.07, -0.03, -0.01, 0.0, 0.012, 0.03, 0.06, 0.11, 0.2, 0.26])
F = 1000.0 * np.array([0.0, -1.5, -2.6, -2.4, -1.1, 0.0, 1.3, 2.2, 2.5, 2.3, 0.9, 0.2])
GROUND = np.array([5.0 * ((7 * i) % 11 - 5) / 5 for i in range(60)])
STIFFNESS = F[6] / U[6]
DAMPING = 2.0 * DAMPING_RATIO * np.sqrt(STIFFNESS * MASS)


def force(line, u):
    """Returns the force of a line between two points, or of its continuation."""
    return F[line] + (F[line + 1] - F[line]) * (u - U[line]) / (U[line + 1] - U[line])


def run(times):
    """Returns u at times."""
    found, state, line, time = [], np.array([0.0, 0.0]), 5, 0.0
    for sample in range(len(times)):
        a0, a1 = GROUND[sample], GROUND[sample + 1]
        start, end = sample * STEP, (sample + 1) * STEP
        while time < end:

            def motion(t, y, line=line):
                ground = a0 + (a1 - a0) * (t - start) / STEP
                acceleration = -(DAMPING * y[1] + force(line, y[0])) / MASS - PARTICIPATION * ground
                return [y[1], acceleration]

            events = []
            for corner in (line, line + 1):
                outwards = 1.0 if corner == line + 1 else -1.0
                if 0 < corner < len(U) - 1:
                    event = lambda t, y, corner=corner: y[0] - U[corner]  # noqa: E731
                    event.terminal, event.direction = True, outwards
                    events.append((event, int(outwards)))
            tolerances = {"rtol": 1e-13, "atol": 1e-16, "method": "DOP853", "max_step": STEP / 20}
            passages = [event for event, _ in events]
            result = solve_ivp(motion, [time, end], state, events=passages, **tolerances)
            time, state = result.t[-1], result.y[:, -1]
            for (_, side), passed in zip(events, result.t_events, strict=True):
                line += side * int(len(passed) > 0)
        found.append(state[0])
    return found


if __name__ == "__main__":
    u = run(range(len(GROUND) - 1))
    print([float(value) for value in u[9::10]], max(map(abs, u)))
