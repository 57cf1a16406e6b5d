"""JAX: the loop of Runge-Kutta steps of numba, compiled before it is timed."""

import functools

import jax
import jax.numpy as jnp
import numpy as np
from measuring import in_short, measure
from tools.numba import RK4_SUBSTEPS

jax.config.update("jax_enable_x64", True)


def arguments(problem):
    """Returns the forcing, its step and the law of a problem: one compilation serves all problems."""
    damping = (2 * problem.xi, problem.elastic_damping, problem.constant, problem.elastic_line)
    law = (jnp.array(problem.corners), jnp.array(problem.lines), damping)
    return jnp.array(problem.forcing), problem.step, law


def rate(p, y, law):
    u, v = y
    corners, lines, (twice_xi, elastic, constant, elastic_line) = law
    line = jnp.sum(u > corners)
    anchor, force, slope = lines[line]
    restoring = force + slope * (u - anchor)
    ratio = twice_xi * jnp.sqrt(jnp.maximum(restoring / u, 0.0))
    c = jnp.where(constant | (line == elastic_line), elastic, ratio)
    return jnp.array([v, p - c * v - restoring])


@jax.jit
def rk4(forcing, step, law, count):
    h = step / count

    def sample(y, ends):
        rise = (ends[1] - ends[0]) / count

        def part(index, y):
            p = ends[0] + rise * index
            k1 = rate(p, y, law)
            k2 = rate(p + 0.5 * rise, y + 0.5 * h * k1, law)
            k3 = rate(p + 0.5 * rise, y + 0.5 * h * k2, law)
            k4 = rate(p + rise, y + h * k3, law)
            return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

        y = jax.lax.fori_loop(0, count, part, y)
        return y, y[0]

    _, history = jax.lax.scan(sample, jnp.zeros(2), (forcing[:-1], forcing[1:]))
    return jnp.concatenate([jnp.zeros(1), history])


def run(writer, problem):
    given = arguments(problem)

    def loop(count):
        return np.asarray(rk4(*given, count))

    loop(1)
    for count in RK4_SUBSTEPS:
        setting = f"rk4 {in_short(problem.step / count, 3)} s"
        measure(writer, problem, "JAX", setting, functools.partial(loop, count))
