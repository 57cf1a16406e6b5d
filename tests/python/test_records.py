"""Drives the FMU in FMPy with recorded accelerograms; the result equals that of the command line."""

import json
import os
import subprocess
from pathlib import Path

import pytest
from fmpy import simulate_fmu
from fmpy.util import read_csv

FOLDER = Path(os.environ.get("ROCKING_WALL_RECORDS", "no records"))
# A small stiff wall, a slender wall and a large wall of Table 5 of the paper.
WALLS = {"2": (1.5, 0.3, 0.0012), "3": (3.0, 0.3, 0.009), "6": (6.0, 0.6, 0.018)}


@pytest.fixture(scope="module")
def record():
    path = FOLDER / "RSN125_FRIULI.A_A-TMZ000.AT2"
    if not path.is_file():
        pytest.skip("not run: no real accelerograms; name their folder in ROCKING_WALL_RECORDS")
    return path


@pytest.mark.parametrize("number", WALLS)
def test_a_real_record_drives_the_unit(record, fmu, wall, tmp_path, number):
    height, thickness, a1 = WALLS[number]
    settings = {"height": height, "thickness": thickness, "a1": a1, "u_start": 0.0}
    motion = tmp_path / "motion.csv"
    subprocess.run(
        [wall, "record", record, "--scale", "0.8", "--samples", motion],
        check=True,
        capture_output=True,
    )
    signal = read_csv(motion)
    stop = float(signal["time (a_g in m/s2)"][-1])
    result = simulate_fmu(str(fmu), input=signal, stop_time=stop, start_values=settings)
    command = [wall, "simulate", "--record", record, "--scale", "0.8", "--stop-time", str(stop), "--json"]
    command += [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]

    def on_the_command_line(*extra):
        return json.loads(subprocess.run([*command, *extra], check=True, capture_output=True).stdout)

    held, linear = on_the_command_line("--hold"), on_the_command_line()
    u_ins = thickness / 2
    # the samples are the same; times are sums of rounded steps, and walls near overturning amplify rounding
    # by up to 1e5
    assert result["u_max"][-1] / u_ins == pytest.approx(held["u_max"] / u_ins, abs=1e-9)
    assert bool(result["overturned"][-1]) == held["overturned"]
    print(f"wall {number}: u_max/u_ins {held['u_ratio_max']:.6f} held, {linear['u_ratio_max']:.6f} linear")
