"""SciPy: solve_ivp, restarted at each corner on the next branch."""

import numpy as np
from measuring import in_short, measure
from scipy.integrate import solve_ivp

# without those that take seconds, and are stricter than the comparison asks for
TOLERANCES = {
    "RK45": (1e-4, 1e-6, 1e-8),
    "DOP853": (1e-4, 1e-6, 1e-8),
    "LSODA": (1e-4, 1e-6, 1e-8),
    "Radau": (1e-4,),
}
SETTINGS = [(method, value) for method, values in TOLERANCES.items() for value in values]
RESTARTS = 100_000


def run(writer, problem):
    for method, tolerance in SETTINGS:
        setting = f"{method} {in_short(tolerance, 0)} events"
        measure(writer, problem, "SciPy", setting, lambda: solve(problem, method, tolerance))


def solve(problem, method, tolerance):
    count, step = len(problem.samples), problem.step
    times = step * np.arange(count)
    history = np.empty(count)
    forcing, last = problem.forcing, len(problem.forcing) - 2
    line = problem.elastic_line
    state, start, done = [0.0, 0.0], 0.0, 0
    for _ in range(RESTARTS):
        rate = line_rate(problem, line, forcing, last)
        events = line_events(problem, line)
        solution = solve_ivp(
            rate,
            (start, times[-1]),
            state,
            method,
            times[done:],
            events=events,
            rtol=max(tolerance, 3e-14),
            atol=tolerance * problem.u_ins,
        )
        if solution.status < 0:
            raise RuntimeError(solution.message)
        found = len(solution.t)
        if found:
            history[done : done + found] = solution.y[0]
            done += found
        if solution.status == 0:
            return history
        for side, (at, states) in enumerate(zip(solution.t_events, solution.y_events)):
            if len(at):
                start, state = at[-1], states[-1]
                # -1 through the lower corner, +1 through the upper one, in the order of the events
                line += events[side].direction_of_line
                break
    raise RuntimeError(f"gave up after {RESTARTS} corners")


def line_rate(problem, line, forcing, last):
    anchor, force, slope = problem.lines[line]
    step, twice_xi, elastic = problem.step, 2 * problem.xi, problem.elastic_damping
    constant = problem.constant or line == problem.elastic_line

    def rate(t, y):
        u, v = y
        position = t / step
        index = min(int(position), last)
        p = forcing[index] + (forcing[index + 1] - forcing[index]) * (position - index)
        restoring = force + slope * (u - anchor)
        c = elastic if constant else twice_xi * max(restoring / u, 0.0) ** 0.5
        return (v, p - c * v - restoring)

    return rate


def line_events(problem, line):
    events = []
    for index, change in ((line - 1, -1), (line, 1)):
        if 0 <= index < len(problem.corners):
            corner = problem.corners[index]

            def event(t, y, corner=corner):
                return y[0] - corner

            event.terminal = True
            event.direction = change
            event.direction_of_line = change
            events.append(event)
    return events
