"""numba: plain loops, compiled before they are timed."""

import functools

import numba
import numpy as np
from measuring import in_short, measure

RK4_SUBSTEPS = (1, 4, 16, 64)
NEWMARK_SUBSTEPS = (1, 4, 16, 64)


@numba.njit(inline="always")
def lines(u, corners):
    line = 0
    while line < len(corners) and u > corners[line]:
        line += 1
    return line


@numba.njit(inline="always")
def coefficients(u, corners, table, damping):
    """Returns F/m, its slope and c."""
    line = lines(u, corners)
    restoring = table[line, 1] + table[line, 2] * (u - table[line, 0])
    twice_xi, elastic, constant, elastic_line = damping
    if constant or line == elastic_line:
        return restoring, table[line, 2], elastic
    return restoring, table[line, 2], twice_xi * np.sqrt(max(restoring / u, 0.0))


@numba.njit
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


@numba.njit
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


def run(writer, problem):
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
            setting = f"{name} {in_short(problem.step / count, 3)} s"
            measure(writer, problem, "numba", setting, functools.partial(loop, count))
