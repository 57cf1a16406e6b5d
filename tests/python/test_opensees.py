"""Tests the building of OpenSees, where it is installed: `pip install openseespy`, with BLAS and LAPACK."""

import json
import subprocess
import sys
import tomllib

import pytest

import test_cases
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


# u of a bilinear parapet with constant damping and a tie: ElasticPPGap with damage, both as springs in u
FREE_VIBRATION = """
import sys
import openseespy.opensees as ops
mass, damping, u1, k1, k0, u_ins, tie, strength, gap, start, step, count, every = map(float, sys.argv[1:])
ops.wipe()
ops.model("basic", "-ndm", 1, "-ndf", 1)
ops.node(1, 0.0)
ops.node(2, 0.0)
ops.fix(1, 1)
ops.mass(2, mass)
points = [-2 * u_ins, -u1, u1, 2 * u_ins]
forces = [k0 * u_ins, -k1 * u1, k1 * u1, -k0 * u_ins]
ops.uniaxialMaterial("ElasticMultiLinear", 1, 0.0, "-strain", *points, "-stress", *forces)
ops.uniaxialMaterial("ElasticPPGap", 2, tie, strength, gap, 0.0, "damage")
ops.uniaxialMaterial("Viscous", 3, damping, 1.0)
for tag in (1, 2, 3):
    ops.element("zeroLength", tag, 1, 2, "-mat", tag, "-dir", 1)
ops.setNodeDisp(2, 1, start, "-commit")
ops.setNodeAccel(2, 1, -k0 * (u_ins - abs(start)) * (1 if start > 0 else -1) / mass, "-commit")
ops.constraints("Plain")
ops.numberer("Plain")
ops.system("FullGeneral")
ops.test("NormDispIncr", 1e-14, 50)
ops.algorithm("Newton")
ops.integrator("Newmark", 0.5, 0.25)
ops.analysis("Transient")
for _ in range(int(count)):
    assert ops.analyze(int(every), step) == 0
    print(ops.nodeDisp(2, 1))
"""


@pytest.mark.skipif(not has_opensees(), reason="not run: openseespy is not installed")
def test_elastic_pp_gap_with_damage_is_the_tie_that_yields():
    """At 0.1 ms it is within 3e-7 u_ins of the reference case for 3 s, in which the tie is stretched once."""
    scene = tomllib.loads((test_cases.CASES / "y01_free_cdc.toml").read_text())
    given = test_cases.given(scene)
    weight = given["density"] * given["gravity"] * given["height"] * given["thickness"]
    mass = weight / given["gravity"] * 4 / 3
    u_ins, k0 = given["thickness"] / 2, 2 * weight / given["height"]
    u1 = given["a1"] * u_ins
    k1 = k0 * (u_ins - u1) / u1
    damping = 2 * given["xi"] * (k1 * mass) ** 0.5
    lever = 2 * given["tie_height"] / given["height"]
    tie = [lever**2 * given["tie_stiffness"], lever * given["tie_strength"], given["tie_slack"] / lever]
    rows = test_cases.rows("y01_free_cdc")[:301]
    step = 1e-4
    every = round((rows[1]["t"] - rows[0]["t"]) / step)
    arguments = [mass, damping, u1, k1, k0, u_ins, *tie, given["u_start"], step, len(rows) - 1, every]
    command = [sys.executable, "-c", FREE_VIBRATION, *map(str, arguments)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    found = [float(line) for line in printed.split()]
    errors = [abs(u - row["u"]) / u_ins for u, row in zip(found, rows[1:], strict=True)]
    assert rows[-1]["p_positive"] > 1e-3 and max(errors) < 3e-7, f"{max(errors):.1e} u_ins"
