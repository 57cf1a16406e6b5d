"""Checks that no ordinary run divides by zero, overflows or computes what is invalid.

Some hosts trap these floating-point exceptions (feenableexcept), and would die of them.
"""

import ctypes
import ctypes.util
import itertools
import math

import pytest

from conftest import items
from unit import Unit

LIBM = ctypes.CDLL(ctypes.util.find_library("m"))
# FE_INVALID, FE_DIVBYZERO and FE_OVERFLOW of x86-64
TRAPPED = {1: "invalid", 4: "division by zero", 8: "overflow"}

MECHANISMS = {
    "parapet": {},
    "vertical_spanning": {"mechanism": "vertical_spanning", "thickness": 0.1, "overburden": 3000.0},
}
LAWS, DAMPING = items("ForceLaw"), items("DampingModel")
WALLS = list(itertools.product(MECHANISMS, LAWS, DAMPING, ("none", "restitution"), ("automatic", "newmark")))
FLOORS = [
    {"hysteresis": "none", "stiffness": 0.0},
    {"hysteresis": "none", "stiffness": 1e7},
    {"hysteresis": "bilinear", "stiffness": 1e7},
]


def quiet(call, *arguments, **settings):
    """Calls the unit, and expects no exception flag to be raised."""
    LIBM.feclearexcept(sum(TRAPPED))
    answer = call(*arguments, **settings)
    raised = LIBM.fetestexcept(sum(TRAPPED))
    assert raised == 0, [name for bit, name in TRAPPED.items() if raised & bit]
    return answer


def run(unit, inputs):
    """Shakes the unit for 4 s, leaves it alone for 100 s, and reads everything on the way."""
    reals = [v.valueReference for v in unit.variables.values() if v.type == "Real"]
    for index in range(400):
        for phase, name in enumerate(inputs):
            quiet(unit.set, **{name: 5.0 * math.sin(0.03 * index * (1.0 + phase)) * (index < 300)})
        quiet(unit.step, 0.01)
        quiet(unit.slave.getReal, reals)
    quiet(unit.step, 100.0)
    quiet(unit.slave.getReal, reals)


@pytest.mark.parametrize(("mechanism", "law", "damping", "impact", "solver"), WALLS)
def test_no_run_of_a_wall_raises_an_exception(unpacked, mechanism, law, damping, impact, solver):
    if law == "rigid_linear" and damping not in ("none", "free_standing_block"):
        return  # refused: they need an elastic branch
    with Unit(unpacked) as unit:
        settings = {"force_law": law, "damping_model": damping, "impact": impact, "solver": solver}
        quiet(unit.start, u_start=0.0, **MECHANISMS[mechanism], **settings)
        run(unit, ("a_bottom", "a_top"))


@pytest.mark.parametrize("settings", FLOORS)
def test_no_run_of_a_floor_raises_an_exception(unpacked_floor, settings):
    with Unit(unpacked_floor) as unit:
        quiet(unit.start, yield_force=2e4, displacement_start=0.01, **settings)
        run(unit, ("a_g", "reaction_1"))
