"""The example of the export layer, a bouncing ball, in FMPy: both versions, both kinds."""

import math
import os
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

from conftest import of_fmi3

GRAVITY = 9.81
# Both kinds amplify an error in a speed by 1/(1 - e) = 5 over the bounces. Rounding: 500 steps of 4.4 m/s.
# Model Exchange: the solver's tolerance of 1e-8, of 4.4 m/s over 5 s.
BOUNDS = {"CoSimulation": 5 * 500 * 2**-52 * 4.4, "ModelExchange": 5 * 5 * 1e-8 * 4.4}


@pytest.fixture(scope="module")
def ball():
    if "ROCKING_WALL_BALL" not in os.environ:
        pytest.skip("ROCKING_WALL_BALL is not set; `cargo xtask test` sets it")
    return Path(os.environ["ROCKING_WALL_BALL"])


def height(time, start, restitution):
    """Height of the ball in closed form, and the number of bounces before."""
    speed, left, bounces = math.sqrt(2 * GRAVITY * start), time, 0
    duration = speed / GRAVITY
    if left <= duration:
        return start - GRAVITY * left**2 / 2, 0
    while True:
        left -= duration
        speed, bounces = restitution * speed, bounces + 1
        duration = 2 * speed / GRAVITY
        if speed < 0.01:
            return 0.0, bounces
        if left <= duration:
            return speed * left - GRAVITY * left**2 / 2, bounces


@pytest.mark.parametrize("kind", BOUNDS)
@pytest.mark.parametrize("version", [2, 3])
def test_the_ball_bounces_as_in_closed_form(ball, version, kind):
    path = ball if version == 2 else of_fmi3(ball)
    assert validate_fmu(path) == []
    settings = {"fmi_type": kind, "stop_time": 5, "output_interval": 0.01, "relative_tolerance": 1e-8}
    result = simulate_fmu(path, start_values={"e": 0.8}, **settings)
    expected = [height(time, 1.0, 0.8) for time in result["time"]]
    assert expected[-1] == (0.0, 28)
    assert max(abs(h - e) for h, (e, _) in zip(result["h"], expected)) < BOUNDS[kind]


def test_a_dead_ball_rests(ball):
    result = simulate_fmu(ball, fmi_type="ModelExchange", stop_time=1, start_values={"e": 0.0})
    assert result["v"][-1] == 0.0 and 0.0 <= result["h"][-1] < 1e-9


@pytest.mark.parametrize("kind", BOUNDS)
@pytest.mark.parametrize("version", [2, 3])
def test_gravity_is_an_input(ball, version, kind):
    path = ball if version == 2 else of_fmi3(ball)
    # a lift that lets the ball weigh half from 0.2 s on
    points = [(0.0, GRAVITY), (0.2, GRAVITY), (0.2, GRAVITY / 2), (0.4, GRAVITY / 2)]
    gravity = np.array(points, [("time", float), ("g", float)])
    settings = {"fmi_type": kind, "stop_time": 0.4, "output_interval": 0.01, "relative_tolerance": 1e-8}
    result = simulate_fmu(path, input=gravity, **settings)
    height, speed = 1.0 - GRAVITY * 0.2**2 / 2, -GRAVITY * 0.2
    expected = height + speed * 0.2 - GRAVITY / 2 * 0.2**2 / 2
    assert abs(result["h"][-1] - expected) < BOUNDS[kind]
