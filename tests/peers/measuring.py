"""The problems that rocking-wall-peers wrote, and the time and errors of a run."""

import json
import time

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
