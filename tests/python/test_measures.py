"""PGV, PGD, Arias intensity, CAV and Housner's intensity of studies beside SciPy, and their levels."""

import csv
import json
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.interpolate import PPoly
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.signal import lsim

G = 9.80665
STEP = 0.01
# Each number sums some thousand roundings of 1e-16; turning points of Sa are located to 1e-9 of the velocity,
# which is 1e-18 of the displacement.
TOLERANCE = 1e-9

STUDY = """
models = ["CDC"]
intensity = {{ measure = "{measure}" }}
levels = {{ method = "grid", values = {levels}, unit = "{unit}" }}
records = {{ files = ["motion.txt"], unit = "m/s2", step = 0.01 }}
report = {{ fractions = [1e-3], resamples = 100 }}
walls = [{{ name = "parapet", geometry = {{ height = 2, thickness = 0.3 }} }}]
"""


@pytest.fixture
def samples(tmp_path):
    """Noise under an envelope that ends at rest, with a drift, written beside the study."""
    rng = np.random.default_rng(7)
    time = np.arange(0, 6, STEP)
    smooth = np.convolve(rng.normal(size=len(time)), np.hanning(15) / 7, "same")
    samples = 3 * np.sin(np.pi * time / 6) ** 2 * smooth + 0.02 * np.sin(np.pi * time / 6)
    samples[-1] = 0.0
    (tmp_path / "motion.txt").write_text("\n".join(repr(float(sample)) for sample in samples) + "\n")
    return samples


def study(wall, folder, measure, levels, unit):
    """Runs a study by a measure; returns its description, its runs and its NRML, if there is one."""
    (folder / "study.toml").write_text(STUDY.format(measure=measure, levels=list(levels), unit=unit))
    out = folder / measure
    command = [wall, "study", "ida", folder / "study.toml", "--output", out]
    subprocess.run(command, check=True, capture_output=True)
    with (out / "levels.csv").open(encoding="utf-8") as file:
        runs = list(csv.DictReader(file))
    nrml = out / "fragilities.xml"
    return json.loads((out / "study.json").read_text()), runs, nrml if nrml.exists() else None


def ground(samples):
    """The acceleration between the samples, as a piecewise polynomial."""
    times = STEP * np.arange(len(samples))
    return PPoly(np.array([np.diff(samples) / STEP, samples[:-1]]), times)


def largest(function):
    """The largest absolute value of a piecewise polynomial, at its ends and where its derivative is zero."""
    zeros = function.derivative().roots(discontinuity=False, extrapolate=False)
    at = np.concatenate([function.x, zeros[np.isfinite(zeros)]])
    return np.abs(function(at)).max()


def pseudo_velocity(samples, period):
    """Largest ω |u| of an oscillator with 5 % damping, from rest."""
    omega = 2 * np.pi / period
    padded = np.concatenate([samples, np.zeros(int(np.ceil(period / STEP)))])
    matrix = np.array([[0, 1], [-(omega**2), -0.1 * omega]])
    system = (matrix, np.array([[0], [-1]]), np.eye(2), np.zeros((2, 1)))
    # exact at the samples, because the motion is linear between them
    _, states, _ = lsim(system, padded, STEP * np.arange(len(padded)))
    # u, u̇, a and its slope
    whole = np.zeros((4, 4))
    whole[:2, :2], whole[1, 2], whole[2, 3] = matrix, -1, 1
    best = np.abs(states[:, 0]).max()
    turns = np.flatnonzero(states[:-1, 1] * states[1:, 1] < 0)
    # from its peak to the nearer end of its piece |u| falls by h²/8 |ü|, where |ü| is ω² |u| + |a| at most;
    # twice that has room for the change of ü
    fall = STEP**2 / 4 * (omega**2 * best + np.abs(samples).max())
    ends = np.maximum(np.abs(states[turns, 0]), np.abs(states[turns + 1, 0]))
    for turn in turns[ends > best - fall]:
        start = [*states[turn], padded[turn], (padded[turn + 1] - padded[turn]) / STEP]
        at = brentq(lambda t, s=start: (expm(whole * t) @ s)[1], 0, STEP, xtol=1e-15)
        best = max(best, abs((expm(whole * at) @ start)[0]))
    return omega * best


def expected(samples, measure):
    """The measure in SI units, by SciPy."""
    acceleration = ground(samples)
    velocity = acceleration.antiderivative()
    if measure == "PGV":
        return largest(velocity)
    if measure == "PGD":
        return largest(velocity.antiderivative())
    if measure == "Arias":
        # Simpson's rule is exact for the square of a line
        middle = (samples[:-1] + samples[1:]) / 2
        squares = samples[:-1] ** 2 + 4 * middle**2 + samples[1:] ** 2
        return np.pi / (2 * G) * STEP / 6 * squares.sum()
    if measure == "CAV":
        zeros = acceleration.roots(discontinuity=False, extrapolate=False)
        ends = np.unique(np.concatenate([acceleration.x, zeros[np.isfinite(zeros)]]))
        return np.abs(np.diff(velocity(ends))).sum()
    periods = np.arange(10, 251) / 100
    return np.trapezoid([pseudo_velocity(samples, period) for period in periods], periods)


MEASURES = {
    # the column, its unit in SI units, the unit of levels, the name in NRML
    "PGV": ("intensity_cm_s", 0.01, "m/s", "PGV"),
    "PGD": ("intensity_cm", 0.01, "m", "PGD"),
    "Arias": ("intensity_m_s", 1.0, "m/s", "IA"),
    "CAV": ("intensity_g_s", G, "m/s", "CAV"),
    "Housner": ("intensity_cm", 0.01, "m", None),
}


@pytest.mark.parametrize("measure", MEASURES)
def test_measures_are_those_of_scipy(wall, tmp_path, samples, measure):
    """A level is reached by the scale that it takes: its root for Arias intensity."""
    column, size, unit, imt = MEASURES[measure]
    own = expected(samples, measure)
    factors = np.array([0.3, 0.6, 0.9])
    levels = own * (factors**2 if measure == "Arias" else factors)
    described, runs, nrml = study(wall, tmp_path, measure, map(float, levels), unit)
    [record] = described["contents"]["records"]
    assert record["intensity"] == pytest.approx(own, rel=TOLERANCE, abs=0)
    np.testing.assert_allclose([float(run[column]) * size for run in runs], levels, rtol=1e-14)
    # the same runs by the peak acceleration; a demand follows its scale to a few hundred times
    peaks = factors * np.abs(samples).max()
    _, by_peak, _ = study(wall, tmp_path, "PGA", map(float, peaks), "m/s2")
    demands = [[float(run["u_max_over_u_ins"]) for run in table] for table in (runs, by_peak)]
    assert max(demands[0]) > 1e-4
    np.testing.assert_allclose(demands[0], demands[1], rtol=1e3 * TOLERANCE)
    assert (nrml is None) == (imt is None)
    if nrml is not None:
        text = nrml.read_text(encoding="utf-8")
        assert f"intensities in {described['contents']['unit']}" in text
        imls = ElementTree.fromstring(text).iter("{http://openquake.org/xmlns/nrml/0.5}imls")
        # one record has no curve
        assert not list(imls)


def test_a_level_in_another_unit_is_refused(wall, tmp_path, samples):
    (tmp_path / "study.toml").write_text(STUDY.format(measure="PGV", levels=[0.1], unit="g"))
    command = [wall, "study", "ida", tmp_path / "study.toml", "--output", tmp_path / "out"]
    told = subprocess.run(command, check=False, capture_output=True, text=True)
    assert told.returncode != 0
    assert 'unit "g" of PGV: expected cm/s, m/s, mm/s' in told.stderr
