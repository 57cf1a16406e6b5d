"""The measures that a study compares beside SciPy: regressions of the runs in its tables, on intensities that
NumPy computes from the records."""

import csv
import subprocess

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid, simpson
from scipy.optimize import brentq
from scipy.stats import linregress

G = 9.80665
STEP = 0.01
COUNT = 9
STUDY = """
models = ["CR"]
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 1.2, gap = 0.3 }
intensity = { measure = "PGA", compare = ["PGA", "PGV", "Arias"], records_table = "events.csv" }
records = { files = ["motions"], unit = "m/s2", step = 0.01 }
report = { fractions = [1.0], resamples = 100 }
walls = [
  { name = "low", geometry = { height = 2, thickness = 0.3 } },
  { name = "high", geometry = { height = 3, thickness = 0.3 } },
]
"""


def rows(path):
    """Reads a table."""
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def motions():
    """Noise under an envelope, of several durations, at rest at the end."""
    rng = np.random.default_rng(11)
    for number in range(COUNT):
        time = np.arange(0, 6 + number, STEP)
        window = np.hanning(15 + 4 * number) / 7
        noise = np.convolve(rng.normal(size=len(time)), window, "same")
        envelope = np.sin(np.pi * time / time[-1]) ** (1 + number % 3)
        yield f"{number}.txt", 3 * envelope * (noise - np.average(noise, weights=envelope))


def energy(samples, time):
    """Returns the integral of a² up to a time, with lines between samples; Simpson's rule is exact."""
    whole = int(time / STEP)
    end = np.interp(time, STEP * np.arange(len(samples)), samples)
    start = samples[whole]
    squares = (time - STEP * whole) * (start * start + start * end + end * end) / 3
    before = samples[: whole + 1]
    middle = (before[:-1] + before[1:]) / 2
    points = np.empty(2 * whole + 1)
    points[::2], points[1::2] = before, middle
    return squares + (simpson(points**2, dx=STEP / 2) if whole else 0.0)


def duration(samples):
    """Returns the time from 5 % to 95 % of the integral of a²."""
    last = STEP * (len(samples) - 1)
    all_of_it = energy(samples, last - 1e-12)
    at = [
        brentq(lambda t, part=part: energy(samples, t) - part * all_of_it, 0, last - 1e-9, xtol=1e-12)
        for part in (0.05, 0.95)
    ]
    return at[1] - at[0]


def pgv(samples):
    """Returns the largest |v|, also between samples."""
    v = cumulative_trapezoid(samples, dx=STEP, initial=0)
    a, b = samples[:-1], samples[1:]
    turns = a * b < 0
    between = v[:-1][turns] + STEP * a[turns] ** 2 / (a[turns] - b[turns]) / 2
    return max(np.abs(v).max(), np.abs(between).max())


def residuals(x, y, group):
    """Returns the slope that groups share and the residuals, each group with a line of its own height."""
    indicators = (np.unique(group)[:, None] == group).T.astype(float)
    matrix = indicators if x is None else np.c_[indicators, x]
    solution = np.linalg.lstsq(matrix, y, rcond=None)[0]
    rest = y - matrix @ solution
    return solution[-1], rest, np.sqrt(rest @ rest / (len(y) - matrix.shape[1]))


def test_regressions_are_those_of_scipy(wall, tmp_path):
    (tmp_path / "motions").mkdir()
    samples = dict(motions())
    rng = np.random.default_rng(5)
    table, features = "record,magnitude,distance_km\n", {}
    for name, motion in samples.items():
        (tmp_path / "motions" / name).write_text("\n".join(map(repr, map(float, motion))) + "\n")
        magnitude, distance = 5 + 2 * rng.random(), 60 * rng.random()
        features[name] = {"duration": duration(motion), "magnitude": magnitude, "distance": distance}
        table += f"{name},{magnitude!r},{distance!r}\n"
    (tmp_path / "events.csv").write_text(table)
    (tmp_path / "study.toml").write_text(STUDY)
    subprocess.run(
        [wall, "study", "ida", "study.toml", "-o", "out"], check=True, capture_output=True, cwd=tmp_path
    )
    pga = {name: np.abs(motion).max() / G for name, motion in samples.items()}
    whole = {name: energy(motion, STEP * (len(motion) - 1) - 1e-12) for name, motion in samples.items()}
    of_level = {
        "PGA": lambda name, level: level,
        "PGV": lambda name, level: 100 * pgv(samples[name]) * level / pga[name],
        "Arias": lambda name, level: np.pi / (2 * G) * whole[name] * (level / pga[name]) ** 2,
    }
    levels, collapses = rows(tmp_path / "out/levels.csv"), rows(tmp_path / "out/collapses.csv")
    found = rows(tmp_path / "out/measures.csv")
    assert len(found) == 3 * 3
    for row in found:
        intensity = of_level[row["measure"]]
        own = [row["wall"]] if row["walls"] == "1" else ["low", "high"]
        stood = [one for one in levels if one["wall"] in own and one["overturned"] == "false"]
        fell = [one for one in collapses if one["wall"] in own and one["collapse_g"]]
        x = np.log([intensity(one["record"], float(one["intensity_g"])) for one in stood])
        y = np.log([float(one["u_max_over_u_ins"]) for one in stood])
        slope, rest, sigma = residuals(x, y, np.array([one["wall"] for one in stood]))
        between = [np.sqrt(float(one["collapse_g"]) * float(one["standing_below_g"])) for one in fell]
        theta = np.log([intensity(one["record"], level) for one, level in zip(fell, between)])
        _, apart, spread = residuals(None, theta, np.array([one["wall"] for one in fell]))
        expected = {"b": slope, "sigma_ln_d": sigma, "sigma_ln_theta": spread}
        for name in ("duration", "magnitude", "distance"):
            of_runs = [features[one["record"]][name] for one in stood]
            expected[f"p_d_{name}"] = linregress(of_runs, rest).pvalue
            of_records = [features[one["record"]][name] for one in fell]
            expected[f"p_theta_{name}"] = linregress(of_records, apart).pvalue
        assert int(row["censored"]) == COUNT * len(own) - len(fell)
        assert int(row["runs"]) == len(stood)
        for name, value in expected.items():
            assert float(row[name]) == pytest.approx(value, rel=1e-6), (name, row)
