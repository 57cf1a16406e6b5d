"""Times Python peers on the problems that rocking-wall-peers wrote, and appends their rows to its table.

Usage: peers.py FOLDER TOOL...   with the tools opensees, scipy, numba

Each tool solves u'' = -participation a_g - c(u) u' - F(u)/m with a_g linear between samples, from rest, and
returns u at the samples. Times are the least of several runs after a warm-up, without setting up the model. A
tool that is not installed has one row per scene that says so.
"""

import csv
import ctypes
import functools
import importlib.util
import json
import sys
import time
from pathlib import Path

RUNS = 15
FEWEST_RUNS = 3
SHORTEST = 0.1  # least time of repeated runs [s]; disturbances of the machine last milliseconds
PATIENCE = 0.8  # most time of repeated runs [s]; a longer first run is not repeated and needs no warm-up


class Problem:
    """A scene, its samples and its reference."""

    def __init__(self, path):
        document = json.loads(path.read_text())
        self.__dict__.update(document)
        self.samples = numbers(path.parent / self.samples_file)
        self.reference = numbers(path.parent / self.reference_file)
        self.constant = self.damping_model == "CDC"
        self.elastic_damping = 2 * self.xi * self.omega1
        self.forcing = [-self.participation * a for a in self.samples]
        points = self.force_points
        self.corners = [u for u, _ in points[1:-1]]
        self.lines = [(u, f, (g - f) / (v - u)) for (u, f), (v, g) in zip(points, points[1:])]
        # the line through the origin has constant damping in every model
        self.elastic_line = sum(corner < 0 for corner in self.corners)


def numbers(path):
    return [float(line) for line in path.read_text().split()]


def errors(history, problem):
    """Returns the largest error, the rms error and the error of the peak, over u_ins."""
    u_ins = problem.u_ins
    differences = [abs(u - r) / u_ins for u, r in zip(history, problem.reference)]
    largest = float("inf") if any(d != d for d in differences) else max(differences)
    rms = (sum(d * d for d in differences) / len(differences)) ** 0.5
    peak = max(map(abs, history))
    peak_error = abs(peak - max(map(abs, problem.reference))) / u_ins
    return largest, rms, peak_error


def measure(writer, problem, tool, setting, run, prepare=None, timed=None):
    """Adds a row. `run` returns the history; `timed`, if given, is timed in its place, after `prepare`."""
    prepare = prepare or (lambda: None)
    try:
        prepare()
        start = time.perf_counter()
        history = list(run())
        first = time.perf_counter() - start
        if len(history) != len(problem.reference):
            raise RuntimeError(f"{len(history)} of {len(problem.reference)} samples")
    except (RuntimeError, ArithmeticError, ValueError) as error:
        writer.writerow([problem.scene, tool, f"{setting}: failed: {one_line(error)}", "", "", "", "", ""])
        return
    if timed is None and first > PATIENCE:
        least = first
    else:
        least = repeat(prepare, timed or run)
    figures = [f"{value:.4e}" for value in (least, *errors(history, problem))]
    overturned = max(map(abs, history)) > problem.u_ins
    writer.writerow([problem.scene, tool, setting, *figures, str(bool(overturned)).lower()])


def repeat(prepare, timed):
    """Returns the least time of several runs."""
    least, spent, count = float("inf"), 0.0, 0
    while count < FEWEST_RUNS or (spent < PATIENCE and (count < RUNS or spent < SHORTEST)):
        prepare()
        start = time.perf_counter()
        timed()
        elapsed = time.perf_counter() - start
        least, spent, count = min(least, elapsed), spent + elapsed, count + 1
    return least


def in_short(value, digits):
    """Formats a number as Rust does: 5.000e-3."""
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def one_line(error):
    return str(error).replace(",", ";").replace("\n", " ")


# OpenSeesPy: ElasticMultiLinear and Viscous in parallel on a zero-length element, Newmark's average
# acceleration.

OPENSEES_SUBSTEPS = (1, 2, 4, 16, 64)


def import_opensees():
    """Loads OpenSeesPy's libraries in order, which its extension does not find by itself, then imports it."""
    spec = importlib.util.find_spec("openseespylinux") if sys.platform.startswith("linux") else None
    if spec is not None:
        folder = Path(spec.origin).parent / "lib"
        for name in (
            "libquadmath.so.0",
            "libgfortran.so.4",
            "libblas.so.3",
            "liblapack.so.3",
            "libgomp.so.1",
        ):
            if (folder / name).is_file():
                ctypes.CDLL(str(folder / name), mode=ctypes.RTLD_GLOBAL)
    import openseespy.opensees

    return openseespy.opensees


def opensees(writer, problem):
    ops = import_opensees()
    if not problem.constant:
        name = "not offered: no damping ratio on the secant frequency"
        writer.writerow([problem.scene, "OpenSeesPy", name, "", "", "", "", ""])
        return
    intervals = len(problem.samples) - 1
    for count in OPENSEES_SUBSTEPS:
        step = problem.step / count

        def analyze(steps):
            if ops.analyze(steps, step) != 0:
                raise RuntimeError(f"no convergence at {ops.getTime()} s")

        def history():
            found = [0.0]
            for _ in range(intervals):
                analyze(count)
                found.append(ops.nodeDisp(2, 1))
            return found

        def step_loop():
            """Runs the steps and records nothing."""
            call = ops.analyze
            for _ in range(intervals * count):
                if call(1, step) != 0:
                    raise RuntimeError(f"no convergence at {ops.getTime()} s")

        setting = f"newmark {in_short(step, 3)} s"
        measure(
            writer, problem, "OpenSeesPy", setting, history, lambda: opensees_model(ops, problem), step_loop
        )
    ops.wipe()


def opensees_model(ops, problem):
    mass = problem.effective_mass
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, mass)
    displacements = [u for u, _ in problem.force_points]
    forces = [f * mass for _, f in problem.force_points]
    ops.uniaxialMaterial("ElasticMultiLinear", 1, "-strain", *displacements, "-stress", *forces)
    ops.uniaxialMaterial("Viscous", 2, problem.elastic_damping * mass, 1.0)
    ops.uniaxialMaterial("Parallel", 3, 1, 2)
    ops.element("zeroLength", 1, 1, 2, "-mat", 3, "-dir", 1)
    ops.timeSeries(
        "Path", 1, "-dt", problem.step, "-values", *problem.samples, "-factor", problem.participation
    )
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    # the cheapest of its solvers and tests here: a step on one branch takes one iteration
    ops.system("ProfileSPD")
    ops.test("NormUnbalance", 1e-10 * max(forces[1:-1]), 100)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


# SciPy: solve_ivp, restarted at each corner on the next branch.

SCIPY_TOLERANCES = {
    "RK45": (1e-4, 1e-6, 1e-8, 1e-10),
    "DOP853": (1e-4, 1e-6, 1e-8),
    "LSODA": (1e-4, 1e-6, 1e-8, 1e-10),
    "Radau": (1e-4, 1e-6),
}
SCIPY_SETTINGS = [(method, value) for method, values in SCIPY_TOLERANCES.items() for value in values]
SCIPY_RESTARTS = 100_000


def scipy(writer, problem):
    from scipy.integrate import solve_ivp

    for method, tolerance in SCIPY_SETTINGS:
        setting = f"{method} {in_short(tolerance, 0)} events"
        measure(writer, problem, "SciPy", setting, lambda: scipy_run(solve_ivp, problem, method, tolerance))


def scipy_run(solve_ivp, problem, method, tolerance):
    import numpy as np

    count, step = len(problem.samples), problem.step
    times = step * np.arange(count)
    history = np.empty(count)
    forcing, last = problem.forcing, len(problem.forcing) - 2
    line = problem.elastic_line
    state, start, done = [0.0, 0.0], 0.0, 0
    for _ in range(SCIPY_RESTARTS):
        rate = scipy_rate(problem, line, forcing, last)
        events = scipy_events(problem, line)
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
    raise RuntimeError(f"gave up after {SCIPY_RESTARTS} corners")


def scipy_rate(problem, line, forcing, last):
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


def scipy_events(problem, line):
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


# numba: plain loops, compiled before they are timed.

RK4_SUBSTEPS = (1, 4, 16, 64, 256)
NEWMARK_SUBSTEPS = (1, 4, 16, 64)


@functools.cache
def numba_loops():
    """Returns the two loops, which are compiled at their first call."""
    import numba as compiler
    import numpy as np

    @compiler.njit(inline="always")
    def lines(u, corners):
        line = 0
        while line < len(corners) and u > corners[line]:
            line += 1
        return line

    @compiler.njit(inline="always")
    def coefficients(u, corners, table, damping):
        """Returns F/m, its slope and c."""
        line = lines(u, corners)
        restoring = table[line, 1] + table[line, 2] * (u - table[line, 0])
        twice_xi, elastic, constant, elastic_line = damping
        if constant or line == elastic_line:
            return restoring, table[line, 2], elastic
        return restoring, table[line, 2], twice_xi * np.sqrt(max(restoring / u, 0.0))

    @compiler.njit
    def rk4(forcing, step, count, corners, table, damping):
        history = np.zeros(len(forcing))
        u, v, h = 0.0, 0.0, step / count
        for sample in range(len(forcing) - 1):
            rise = (forcing[sample + 1] - forcing[sample]) / count
            for part in range(count):
                p0 = forcing[sample] + rise * part
                pm, p1 = p0 + 0.5 * rise, p0 + rise
                f, _, c = coefficients(u, corners, table, damping)
                k1u, k1v = v, p0 - c * v - f
                ut, vt = u + 0.5 * h * k1u, v + 0.5 * h * k1v
                f, _, c = coefficients(ut, corners, table, damping)
                k2u, k2v = vt, pm - c * vt - f
                ut, vt = u + 0.5 * h * k2u, v + 0.5 * h * k2v
                f, _, c = coefficients(ut, corners, table, damping)
                k3u, k3v = vt, pm - c * vt - f
                ut, vt = u + h * k3u, v + h * k3v
                f, _, c = coefficients(ut, corners, table, damping)
                k4u, k4v = vt, p1 - c * vt - f
                u += h / 6 * (k1u + 2 * k2u + 2 * k3u + k4u)
                v += h / 6 * (k1v + 2 * k2v + 2 * k3v + k4v)
            history[sample + 1] = u
        return history

    @compiler.njit
    def newmark(forcing, step, count, corners, table, damping, tolerance):
        """Runs Newmark's average acceleration; Newton's method on u neglects the slope of c."""
        history = np.zeros(len(forcing))
        h = step / count
        f, k, c = coefficients(0.0, corners, table, damping)
        u, v, a = 0.0, 0.0, forcing[0] - f
        for sample in range(len(forcing) - 1):
            rise = (forcing[sample + 1] - forcing[sample]) / count
            for part in range(count):
                p = forcing[sample] + rise * (part + 1)
                un = u
                for _ in range(100):
                    vn = 2 / h * (un - u) - v
                    an = 4 / (h * h) * (un - u) - 4 / h * v - a
                    f, k, c = coefficients(un, corners, table, damping)
                    change = (p - an - c * vn - f) / (4 / (h * h) + 2 / h * c + k)
                    un += change
                    if abs(change) < tolerance:
                        break
                vn = 2 / h * (un - u) - v
                an = 4 / (h * h) * (un - u) - 4 / h * v - a
                u, v, a = un, vn, an
            history[sample + 1] = u
        return history

    return rk4, newmark


def numba(writer, problem):
    import numpy as np

    rk4, newmark = numba_loops()
    forcing = np.array(problem.forcing)
    corners, table = np.array(problem.corners), np.array(problem.lines)
    damping = (2 * problem.xi, problem.elastic_damping, problem.constant, problem.elastic_line)

    def rk4_run(count):
        return rk4(forcing, problem.step, count, corners, table, damping)

    def newmark_run(count):
        return newmark(forcing, problem.step, count, corners, table, damping, 1e-12 * problem.u_ins)

    for name, loop, substeps in (("rk4", rk4_run, RK4_SUBSTEPS), ("newmark", newmark_run, NEWMARK_SUBSTEPS)):
        loop(1)
        for count in substeps:
            run = functools.partial(loop, count)
            measure(writer, problem, "numba", f"{name} {in_short(problem.step / count, 3)} s", run)


TOOLS = {"opensees": ("OpenSeesPy", opensees), "scipy": ("SciPy", scipy), "numba": ("numba", numba)}


def main():
    folder, names = Path(sys.argv[1]), sys.argv[2:]
    problems = [Problem(path) for path in sorted(folder.glob("wall_*.json"))]
    with (folder / "rows.csv").open("a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        for name in names:
            tool, run = TOOLS[name]
            for problem in problems:
                print(f"{problem.scene}: {tool}", flush=True)
                try:
                    run(writer, problem)
                except (ImportError, OSError, RuntimeError) as error:
                    writer.writerow([problem.scene, tool, f"missing: {one_line(error)}", "", "", "", "", ""])


main()
