"""diffrax: adaptive methods, compiled before they are timed.

Their steps end at each sample. Corners of the force are left to the step control.
"""

import functools

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
from measuring import in_short, measure
from tools.jax import arguments, rate

METHODS = {"tsit5": diffrax.Tsit5(), "dopri8": diffrax.Dopri8()}
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
MOST_STEPS = 20_000_000


def forced_rate(t, y, given):
    forcing, step, law = given
    position = t / step
    index = jnp.clip(position.astype(int), 0, len(forcing) - 2)
    return rate(forcing[index] + (forcing[index + 1] - forcing[index]) * (position - index), y, law)


@functools.partial(jax.jit, static_argnums=0)
def solve(method, given, relative, absolute):
    forcing, step, _ = given
    times = step * jnp.arange(len(forcing))
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(forced_rate),
        METHODS[method],
        times[0],
        times[-1],
        step,
        jnp.zeros(2),
        given,
        saveat=diffrax.SaveAt(ts=times, fn=lambda t, y, given: y[0]),
        stepsize_controller=diffrax.ClipStepSizeController(
            diffrax.PIDController(relative, absolute), step_ts=times
        ),
        adjoint=diffrax.ForwardMode(),
        max_steps=MOST_STEPS,
    )
    return solution.ys


def run(writer, problem):
    given = arguments(problem)

    def history(method, tolerance):
        return np.asarray(solve(method, given, tolerance, tolerance * problem.u_ins))

    for method in METHODS:
        history(method, TOLERANCES[0])
        for tolerance in TOLERANCES:
            setting = f"{method} {in_short(tolerance, 0)} by sample"
            measure(writer, problem, "diffrax", setting, functools.partial(history, method, tolerance))
