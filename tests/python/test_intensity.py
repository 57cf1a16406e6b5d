"""Compares PGA, Sa and AvgSA of `wall record` with those of eqsig and pyrotd."""

import json
import os
import subprocess
from pathlib import Path

import eqsig.sdof
import numpy as np
import pyrotd
import pytest

FOLDER = Path(os.environ.get("ROCKING_WALL_RECORDS", "no records"))
# One near the fault, one far away, one with a coarse step, the largest of the folder, one with a long period.
RECORDS = [
    "RSN125_FRIULI.A_A-TMZ000.AT2",
    "RSN503_SMART1.40_40C00NS.AT2",
    "RIO270.AT2",
    "RSN77_SFERN_PUL164.AT2",
    "RSN879_LANDERS_LCN345.AT2",
]
AVERAGE = np.arange(0.2, 1.41, 0.2)
PERIODS = np.array([0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0])
DAMPING = 0.05
# The index of the records gives AvgSA for motions refined to this step (s).
LARGEST_STEP = 0.005


def motion(wall, folder, *source):
    """Returns a motion as `wall record --samples` writes it: the step in s and the samples in g."""
    path = folder / "motion.csv"
    subprocess.run([wall, "record", *source, "--samples", path], check=True, capture_output=True)
    times, samples = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    return (times[-1] - times[0]) / (len(times) - 1), samples / 9.80665


def refined(step, samples):
    """Returns the same motion, linear between samples, at a step of at most LARGEST_STEP."""
    parts = int(np.ceil(step / LARGEST_STEP - 1e-9))
    count = (len(samples) - 1) * parts + 1
    return step / parts, np.interp(np.arange(count) / parts, np.arange(len(samples)), samples)


def intensity(wall, folder, step, samples, *options):
    """Runs `wall record` on these samples."""
    path = folder / "samples.csv"
    path.write_text("\n".join(repr(float(sample)) for sample in samples) + "\n")
    periods = ",".join(map(str, PERIODS))
    command = [
        wall,
        "record",
        path,
        "--unit",
        "g",
        "--record-step",
        repr(float(step)),
        "--periods",
        periods,
        "--json",
        *options,
    ]
    output = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    assert output["damping"] == DAMPING
    assert output["average_periods_s"] == pytest.approx(AVERAGE)
    [record] = output["records"]
    assert record["points"] == len(samples)
    return record


def by_eqsig(step, samples, periods):
    return eqsig.sdof.pseudo_response_spectra(samples, step, np.asarray(periods), DAMPING)[2]


def by_pyrotd(step, samples, periods):
    # An FFT makes the motion periodic: after ten of the longest periods without motion the oscillator is at
    # rest.
    padded = np.concatenate([samples, np.zeros(int(10 * max(periods) / step))])
    spectrum = pyrotd.calc_spec_accels(step, padded, 1 / np.asarray(periods), DAMPING, max_freq_ratio=50)
    return np.asarray(spectrum.spec_accel)


def geometric_mean(values):
    return float(np.exp(np.mean(np.log(values))))


def sources():
    yield pytest.param("synthetic", id="synthetic")
    for name in RECORDS:
        yield pytest.param(name, id=name)


@pytest.fixture(scope="module", params=sources())
def sample(request, wall, tmp_path_factory):
    folder = tmp_path_factory.mktemp("motion")
    if request.param == "synthetic":
        source = ["--synthetic"]
    else:
        if not (FOLDER / request.param).is_file():
            pytest.skip("not run: no real accelerograms; name their folder in ROCKING_WALL_RECORDS")
        source = [FOLDER / request.param]
    return folder, *refined(*motion(wall, folder, *source))


def test_agrees_with_eqsig_at_equal_refinement(wall, sample):
    folder, step, samples = sample
    record = intensity(wall, folder, step, samples, "--at-samples")
    assert record["pga_g"] == pytest.approx(np.abs(samples).max(), rel=1e-12)
    # Both are exact between samples. eqsig has 2π to 1e-9 and loses digits as 1e-16 (ω step)⁻³: 1e-10 at 3 s
    # and 5 ms.
    expected = by_eqsig(step, samples, PERIODS)
    print(f"Sa: largest deviation from eqsig {np.abs(record['sa_g'] / expected - 1).max():.1e}")
    assert record["sa_g"] == pytest.approx(expected, rel=1e-6)
    assert record["average_sa_g"] == pytest.approx(geometric_mean(by_eqsig(step, samples, AVERAGE)), rel=1e-6)


def test_agrees_with_pyrotd(wall, sample):
    folder, step, samples = sample
    record = intensity(wall, folder, step, samples)
    # pyrotd interpolates by Fourier series instead of straight lines.
    average = geometric_mean(by_pyrotd(step, samples, AVERAGE))
    print(
        f"AvgSA {record['average_sa_g']:.6f} g, pyrotd {average:.6f} g, "
        f"{record['average_sa_g'] / average - 1:+.1e}"
    )
    assert record["average_sa_g"] == pytest.approx(average, rel=1e-3)
