"""Fragilities and annual rates of `wall study ida` beside SciPy, from the tables of the study alone."""

import csv
import subprocess
from collections import defaultdict

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize
from scipy.stats import norm

STUDY = """
models = ["CR", "CDC"]
intensity = { measure = "PGA" }
levels = LEVELS
records = { synthetic = { count = 12, duration = 12, step = 0.01 } }
report = { fractions = [0.4, 1.0], resamples = 100 }

[hazard]
points = [[0.05, 0.033], [0.1, 0.01], [0.2, 0.002], [0.8, 5e-5], [3.0, 1e-7]]

[[walls]]
name = "low"
geometry = { height = 2, thickness = 0.3 }

[[walls]]
name = "high"
geometry = { height = 3, thickness = 0.3 }

[[classes]]
name = "both"
weights = [2, 1]
"""
HUNT = '{ method = "hunt", first = 0.1, increase = 0.1, top = 1.2, gap = 0.3, resolution = 0.1 }'
GRID = '{ method = "grid", values = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0] }'
HAZARD = [(0.05, 0.033), (0.1, 0.01), (0.2, 0.002), (0.8, 5e-5), (3.0, 1e-7)]


def rows(path):
    """Reads a table."""
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def likeliest(log_likelihood):
    """Returns θ and β of the largest likelihood, over their logarithms."""
    best = minimize(
        lambda x: -log_likelihood(*np.exp(x)),
        np.log([0.4, 0.4]),
        method="Nelder-Mead",
        options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000},
    )
    assert best.success
    return np.exp(best.x)


def first_exceedances(levels, fraction):
    """Returns for each record the ends between which it first exceeds; one that overturns there exceeds
    somewhere between the levels, another where a line between its demands does."""
    runs = defaultdict(list)
    for row in levels:
        run = float(row["intensity_g"]), float(row["u_max_over_u_ins"]), row["overturned"] == "true"
        runs[row["record"]].append(run)
    found = []
    for curve in runs.values():
        low, below = 0.0, 0.0
        for level, demand, overturned in sorted(curve):
            if demand >= fraction:
                at = low + (fraction - below) / (demand - below) * (level - low)
                found.append((low, level) if overturned else (at, at))
                break
            low, below = level, demand
        else:
            found.append((low, np.inf))
    return np.array(found)


def of_records(levels, fraction):
    """The likelihood of records that count once: Φ at the upper end less that at the lower, or density."""
    low, high = first_exceedances(levels, fraction).T
    at, between = low[low == high], low < high

    def log_likelihood(theta, beta):
        with np.errstate(divide="ignore"):
            below, above = (norm.cdf(np.log(end[between] / theta) / beta) for end in (low, high))
        density = norm.logpdf(np.log(at / theta) / beta) - np.log(at * beta)
        return np.log(above - below).sum() + density.sum()

    return likeliest(log_likelihood)


def of_stripes(levels, fraction):
    """The likelihood of multiple stripes: how many of the records exceed at each level (Baker 2015)."""
    counts = defaultdict(lambda: [0, 0])
    for row in levels:
        count = counts[float(row["intensity_g"])]
        count[0] += float(row["u_max_over_u_ins"]) >= fraction
        count[1] += 1

    def log_likelihood(theta, beta):
        at = {level: np.log(level / theta) / beta for level in counts}
        terms = (k * norm.logcdf(at[x]) + (n - k) * norm.logsf(at[x]) for x, (k, n) in counts.items())
        return sum(terms)

    return likeliest(log_likelihood)


def of_cloud(levels):
    """a, b and σ of ln D = a + b ln IM + σ ε; of a wall that overturned only D ≥ 1 is known."""
    x, y = (np.log([float(row[name]) for row in levels]) for name in ("intensity_g", "u_max_over_u_ins"))
    fell = np.array([row["overturned"] == "true" for row in levels])
    assert 3 <= fell.sum() <= len(fell) - 3

    def opposite(at):
        a, b, log_sigma = at
        z = (np.where(fell, 0, y) - a - b * x) / np.exp(log_sigma)
        return -(norm.logpdf(z[~fell]) - log_sigma).sum() - norm.logsf(z[fell]).sum()

    start = minimize(opposite, [-1, 1, 0], method="Nelder-Mead", options={"maxiter": 4000}).x
    options = {"xatol": 1e-10, "fatol": 1e-13, "maxiter": 4000}
    best = minimize(opposite, start, method="Nelder-Mead", options=options)
    assert best.success
    return best.x[0], best.x[1], np.exp(best.x[2])


def test_a_cloud_is_the_regression_of_scipy(wall, tmp_path):
    cloud = STUDY.replace("LEVELS", '{ method = "cloud", scale = 0.7 }').replace("count = 12", "count = 30")
    (tmp_path / "study.toml").write_text(cloud.replace('"PGA"', '"AvgSA"'), encoding="utf-8")
    subprocess.run(
        [wall, "study", "ida", "study.toml", "-o", "out"], check=True, capture_output=True, cwd=tmp_path
    )
    out = tmp_path / "out"
    runs, fitted = rows(out / "levels.csv"), rows(out / "fragilities.csv")
    lines = rows(out / "cloud.csv")
    assert len(runs) == 2 * 2 * 30 and len(lines) == 2 * 2 and len(fitted) == 2 * 2 * 2
    for line in lines:
        key = line["wall"], line["model"]
        own = [run for run in runs if (run["wall"], run["model"]) == key]
        a, b, sigma = of_cloud(own)
        for name, expected in (("a", a), ("b", b), ("sigma", sigma)):
            assert abs(float(line[name]) - expected) < 1e-6, (key, name, line, expected)
        for row in fitted:
            if (row["wall"], row["model"]) != key:
                continue
            theta = np.exp((np.log(float(row["u_max_over_u_ins"])) - a) / b)
            assert abs(float(row["theta_g"]) / theta - 1) < 1e-6 and row["median_g"] == row["theta_g"]
            assert abs(float(row["beta"]) / (sigma / b) - 1) < 1e-6
            assert row["censored"] == line["collapsed"] and row["misfit"] == ""
            assert float(row["theta_low_g"]) < theta < float(row["theta_high_g"])
    assert len(rows(out / "rates.csv")) == 3 * 2 * 2


@pytest.mark.parametrize(("levels", "estimate"), [(HUNT, of_records), (GRID, of_stripes)])
def test_curves_and_rates_are_those_of_scipy(wall, tmp_path, levels, estimate):
    (tmp_path / "study.toml").write_text(STUDY.replace("LEVELS", levels), encoding="utf-8")
    subprocess.run(
        [wall, "study", "ida", "study.toml", "-o", "out"], check=True, capture_output=True, cwd=tmp_path
    )
    out = tmp_path / "out"
    runs, logs, variances = rows(out / "levels.csv"), {}, {}
    fitted = rows(out / "fragilities.csv")
    assert len(fitted) == 2 * 2 * 2
    for row in fitted:
        own = [run for run in runs if (run["wall"], run["model"]) == (row["wall"], row["model"])]
        theta, beta = estimate(own, float(row["u_max_over_u_ins"]))
        assert abs(float(row["theta_g"]) / theta - 1) < 1e-6 and abs(float(row["beta"]) / beta - 1) < 1e-6
        key = row["model"], row["u_max_over_u_ins"], row["wall"]
        logs[key], variances[key] = np.log(float(row["theta_g"])), float(row["beta"]) ** 2

    # the total variance of a class: the mean of those of its walls, and that of their ln θ
    weights = np.array([2, 1]) / 3
    classes = [row for row in rows(out / "fragility_curves.csv") if row["wall"] == "both"]
    assert len(classes) == 2 * 2
    for row in classes:
        keys = [(row["model"], row["u_max_over_u_ins"], name) for name in ("low", "high")]
        log_theta, variance = (np.array([one[key] for key in keys]) for one in (logs, variances))
        mean = weights @ log_theta
        between = weights @ (log_theta - mean) ** 2
        assert abs(float(row["theta"]) / np.exp(mean) - 1) < 1e-12
        for name, square in (
            ("beta_records", weights @ variance),
            ("beta_walls", between),
            ("beta", weights @ variance + between),
        ):
            assert abs(float(row[name]) ** 2 / square - 1) < 1e-12, name

    # each segment of the hazard curve by quadrature
    rates, shares = rows(out / "rates.csv"), rows(out / "rate_shares.csv")
    assert len(rates) == 3 * 2 * 2 and len(shares) == len(rates) * (len(HAZARD) - 1)
    for place, row in enumerate(rates):
        theta, beta = float(row["theta_g"]), float(row["beta"])
        parts = []
        for (low, rate), (high, next_rate) in zip(HAZARD, HAZARD[1:]):
            slope = np.log(rate / next_rate) / np.log(high / low)

            def density(y, low=low, rate=rate, slope=slope, theta=theta, beta=beta):
                at = (np.log(low / theta) + y) / beta
                return norm.cdf(at) * slope * rate * np.exp(-slope * y)

            parts.append(quad(density, 0, np.log(high / low), epsabs=0, epsrel=1e-12, limit=200)[0])
        found = [float(share["annual_rate"]) for share in shares[4 * place : 4 * place + 4]]
        # what is 1e-12 of the rate of the first point is nothing
        assert np.allclose(found, parts, rtol=1e-9, atol=HAZARD[0][1] * 1e-12), (row, found, parts)
        assert abs(float(row["annual_rate"]) / sum(parts) - 1) < 1e-9
        low, high = float(row["annual_rate_low"]), float(row["annual_rate_high"])
        assert low < float(row["annual_rate"]) < high
        assert abs(float(row["return_period_years"]) * float(row["annual_rate"]) - 1) < 1e-12
        assert abs(float(row["probability"]) / -np.expm1(-50 * float(row["annual_rate"])) - 1) < 1e-12


SEQUENCES = """
models = ["CDC", "CDR"]
intensity = { measure = "PGA" }
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 1.6, gap = 0.3, resolution = 0.1 }
report = { fractions = [0.4, 1.0], resamples = 100, given = [0.1, 0.3] }
scaled_shocks = "last"

[records]
unit = "m/s2"
pause = 8
sequences = SHOCKS

[[walls]]
name = "tied"
geometry = { height = 3, thickness = 0.3 }
tie = { tie_height = 2.6, tie_stiffness = 2e6, tie_strength = 1e3, tie_ultimate = 0.01 }
"""


def test_fragilities_by_state_are_those_of_the_records_that_lead_to_it(wall, tmp_path):
    random = np.random.default_rng(7)
    for name in range(28):
        time = np.arange(0.0, 10.0, 0.01)
        noise = np.convolve(random.standard_normal(time.size), np.hanning(25), "same")
        samples = noise / np.abs(noise).max() * np.sin(np.pi * time / 10) * (0.6 + 0.07 * (name % 14))
        table = "\n".join(f"{t!r},{a!r}" for t, a in zip(time.tolist(), samples.tolist()))
        (tmp_path / f"{name}.csv").write_text(f"t,a\n{table}\n", encoding="utf-8")
    shocks = [[f"{name}.csv", f"{name + 14}.csv"] for name in range(14)]
    study, results = tmp_path / "study.toml", tmp_path / "results"
    study.write_text(SEQUENCES.replace("SHOCKS", str(shocks)), encoding="utf-8")
    subprocess.run([wall, "study", "ida", study, "-o", results], check=True, capture_output=True)
    levels, compared = rows(results / "levels.csv"), 0
    collapses = rows(results / "collapses.csv")
    for row in rows(results / "given.csv"):
        states = {"any": lambda d, broken: True, "tie broken": lambda d, broken: broken}
        states |= {"d <= 0.1": lambda d, broken: d <= 0.1 and not broken}
        states |= {f"d > {fraction}": lambda d, broken, f=fraction: d > f for fraction in (0.1, 0.3)}
        of_model = [one for one in collapses if one["model"] == row["model"]]
        chosen = {
            one["record"]
            for one in of_model
            if states[row["given"]](float(one["u_max_over_u_ins_before"]), one["tie_broken_before"] == "true")
        }
        assert int(row["records"]) == len(chosen)
        if not row["theta_g"] or len(chosen) < 3:
            continue
        runs = [one for one in levels if one["model"] == row["model"] and one["record"] in chosen]
        theta, beta = of_records(runs, float(row["u_max_over_u_ins"]))
        assert theta == pytest.approx(float(row["theta_g"]), rel=1e-6)
        assert beta == pytest.approx(float(row["beta"]), rel=1e-6)
        compared += 1
    assert compared >= 12
