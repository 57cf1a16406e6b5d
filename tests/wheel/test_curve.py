"""Tests force laws that are made of a capacity curve, given as arrays."""

import pickle

import numpy as np
import pytest

import rocking_wall as rw

BILINEAR = rw.Wall(4, 0.4, damping_model="constant_coefficient", xi=0.05)


def of_curve(u, force, **parameters):
    law = {"curve": np.column_stack([u, force]), "damping_model": "constant_coefficient", "xi": 0.05}
    return rw.Wall(**law | parameters)


def sampled():
    u = BILINEAR.u_ins * np.concatenate([np.linspace(0, 0.03, 30), np.linspace(0.03, 1, 300)[1:]])
    return u, BILINEAR.F0 * np.where(u < 0.0301 * BILINEAR.u_ins, 0.97 / 0.03, 0) * u / BILINEAR.u_ins


def test_a_sampled_law_is_the_law():
    u, force = sampled()
    force = np.where(force > 0, force, BILINEAR.F0 * (1 - u / BILINEAR.u_ins)) * (u > 0)
    record = rw.synthetic_record(1, duration=10)
    expected = BILINEAR.simulate(record).u
    for wall in (
        of_curve(u, force, height=4, thickness=0.4),
        of_curve(2 * u, force, height=4, thickness=0.4, at_height=4.0),
        BILINEAR.replace(curve=np.column_stack([u, force])),
    ):
        assert wall.force_law == "multilinear" and len(wall.points) == 2
        np.testing.assert_allclose(wall.simulate(record).u, expected, rtol=0, atol=1e-12)
        assert pickle.loads(pickle.dumps(wall)) == wall


def test_an_oscillator_needs_no_geometry():
    curve = {"u": [-0.2, -0.05, 0.02, 0.1, 0.3], "force": [0.0, -900.0, 1000.0, 800.0, 0.0]}
    wall = of_curve(**curve, oscillator={"effective_mass": 700.0, "participation": 1.4})
    assert wall.effective_mass == pytest.approx(700.0, rel=1e-14)
    assert wall.participation == pytest.approx(1.4, rel=1e-14)
    assert [wall.u_ins, wall.u_ins_negative] == pytest.approx([0.3, 0.2], rel=1e-14)
    assert len(wall.points) == 5
    for each in (wall, pickle.loads(pickle.dumps(wall))):
        with pytest.raises(ValueError, match="height is that of a wall, and no oscillator has it"):
            each.replace(height=3)


def test_a_curve_in_other_units_is_told():
    oscillator = {"effective_mass": 700.0, "participation": 1.4}
    wall = of_curve([20.0, 200.0], [1000.0, 0.0], oscillator=oscillator)
    told = r"F is 0 at \|u\| = 200 m, not 0.001 to 5 m: check the unit"
    assert any("check the unit" in warning for warning in wall.describe()["warnings"])
    with pytest.warns(UserWarning, match=told):
        wall.simulate(rw.sine_cycle(1.0, 1.0))
    levels = {"method": "grid", "values": [0.1]}
    with pytest.warns(UserWarning, match=told):
        rw.Study(walls=wall, records=[rw.sine_cycle(1.0, 1.0)], models=["CDC"], levels=levels)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"curve": [[0.1, 1.0], [0.05, 0.5], [0.2, 0.0]]}, r"\[0.05, 0.5\] .*must rise from zero; sort"),
        ({"curve": [[0.1, 1.0], [0.2, 2.0]]}, "the last line must fall"),
        ({"curve": [[0.1, 1.0]]}, "at least two points"),
        ({"curve": "pushover.csv"}, r"curve must be pairs \[\[u, F\], ...\] in m and N"),
        ({"curve": [0.1, 0.2]}, "an array or a DataFrame of two columns"),
        ({"curve": [[0.1, np.nan], [0.2, 0.0]]}, "must be finite"),
        ({"curve": [[0.1, -1.0], [0.2, 0.0]]}, "the force must be positive"),
        ({"curve": [[0.0, 1.0], [0.2, 0.0]]}, "a curve begins at the origin"),
        ({"curve": [[0.1, 1.0, 2.0], [0.2, 0.0, 1.0]]}, "curve"),
        ({"at_height": 2.0}, "one of file"),
        ({"curve": [[0.1, 1.0], [0.2, 0.0]], "at_height": 9.0}, "at_height is not on the wall"),
        ({"curve": [[0.1, 1.0], [0.2, 0.0]], "a1": 0.1}, "a1 is not of the capacity curve"),
        ({"curve": [[0.1, 1.0], [0.2, 0.0]], "points": [[0.1, 1], [1, 0]]}, "points"),
        ({"curve": [[0.1, 1.0], [0.2, 0.0]], "oscillator": {"effective_mass": 9.0}}, "participation"),
        (
            {
                "curve": [[0.1, 1.0], [0.2, 0.0]],
                "oscillator": {"effective_mass": 9.0, "participation": 1.0},
                "height": 3.0,
            },
            "height is not of the capacity curve or oscillator",
        ),
    ],
)
def test_what_is_no_curve_is_refused(parameters, words):
    with pytest.raises(ValueError, match=words):
        rw.Wall(**parameters)


def test_the_pulse_of_a_record_is_that_of_its_wall():
    pulses = rw.Wall().record_pulses(rw.sine_cycle(1.0, 1.0))
    assert list(pulses["pulse"]) == ["sine_cycle", "ricker", "cosine_cycle"]
    assert pulses["amplitude_m_s2"][0] == pytest.approx(1.0, abs=1e-3)
    assert pulses["misfit"][0] < 1e-5 < pulses["misfit"][1]
    with pytest.raises(ValueError, match="stays at rest under the record"):
        rw.Wall().record_pulses(rw.Record(0.01, [0.0] * 50))
    with pytest.raises(TypeError):
        rw.Wall().record_pulses([0.1, 0.2])
