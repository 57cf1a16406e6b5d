"""Tests the building of OpenSees, where it is installed: `pip install openseespy`, with BLAS and LAPACK."""

import json
import subprocess
import sys

import pytest

from conftest import ROOT


def has_opensees():
    # its import fails with more than ImportError, and ends the process in some versions
    command = [sys.executable, "-c", "import openseespy.opensees"]
    return subprocess.run(command, capture_output=True).returncode == 0


@pytest.mark.skipif(not has_opensees(), reason="not run: openseespy is not installed")
def test_linear_storeys_are_those_of_wall_building(wall, fmu, tmp_path):
    motion = tmp_path / "motion.csv"
    pga = ["--synthetic", "--pga", "2.2"]
    subprocess.run([wall, "record", *pga, "--samples", motion], check=True, capture_output=True)
    example = ROOT / "examples/coupling/opensees_building.py"
    printed = subprocess.run(
        [sys.executable, example, motion, "linear"], check=True, capture_output=True, text=True
    ).stdout
    found = [float(line.split()[-2]) for line in printed.splitlines() if line.startswith("floor")]
    building = ROOT / "scenes/building/three_storeys.toml"
    tolerance = ["--tolerance", "1e-4"]
    output = subprocess.run(
        [wall, "building", building, *pga, *tolerance, "--json"], check=True, capture_output=True
    ).stdout
    expected = [abs(floor["acceleration"]["value"]) for floor in json.loads(output)["floors"]]
    assert found == pytest.approx(expected, rel=1e-3)
