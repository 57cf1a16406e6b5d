"""Tests bodies: a packaged façade, and the general FMU as a chimney, against the program."""

import csv
import json
import subprocess

import pytest
from fmpy import read_model_description, simulate_fmu

from conftest import ROOT

BODIES = ROOT / "scenes/bodies"
INTERVAL = 0.01


def history(wall, scene, folder, *options):
    """Returns t, u and R_b of a run by the program."""
    path = folder / "history.csv"
    command = [wall, "simulate", scene, "--csv", path, *options]
    subprocess.run(command, check=True, capture_output=True)
    with path.open() as file:
        rows = list(csv.DictReader(file))
    return [[float(row[name]) for row in rows] for name in ("time_s", "u_m", "reaction_bottom_n")]


@pytest.mark.parametrize("base", ["fmu", "fmu3"])
def test_a_packaged_facade_moves_as_in_the_program(request, base, wall, tmp_path):
    scene, path = BODIES / "facade.toml", tmp_path / "facade.fmu"
    command = [wall, "package", scene, "-o", path, "--base", request.getfixturevalue(base)]
    subprocess.run(command, check=True, capture_output=True)
    times, u, reaction = history(wall, scene, tmp_path)
    step = times[1] - times[0]
    output = ["u", "reaction_bottom", "F0", "F0_negative"]
    result = simulate_fmu(str(path), output_interval=step, output=output)
    count = min(len(times), len(result))
    assert result["F0"][0] == pytest.approx(6856.88, rel=1e-12)
    assert result["F0_negative"][0] == pytest.approx(9856.88, rel=1e-12)
    # the times of the importer are sums of steps
    assert result["u"][:count] == pytest.approx(u[:count], rel=1e-9, abs=1e-11)
    assert result["reaction_bottom"][:count] == pytest.approx(reaction[:count], rel=1e-7, abs=1e-2)


TIES = """
[[tie]]
tie_height = 6.4
tie_stiffness = 5e6
tie_strength = 2e3
tie_ultimate = 0.005

[[tie]]
tie_height = 9.6
tie_stiffness = 2e6
tie_side = "both"
"""


@pytest.mark.parametrize("base", ["fmu", "fmu3"])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_facade_with_two_ties_moves_as_in_the_program(request, base, kind, wall, tmp_path):
    """The unit has the sum of the forces, and no parameters of one tie."""
    scene, path = tmp_path / "tied.toml", tmp_path / "tied.fmu"
    text = (BODIES / "facade.toml").read_text().split("[motion]")[0]
    scene.write_text(text + "[start]\nu_start = 0.05\n" + TIES)
    command = [wall, "package", scene, "-o", path, "--base", request.getfixturevalue(base)]
    subprocess.run(command, check=True, capture_output=True)
    names = {variable.name for variable in read_model_description(str(path)).modelVariables}
    assert {"tie_force", "tie_elongation", "tie_broken"} <= names
    assert not {"tie_height", "tie_stiffness", "tie_strength"} & names
    csv_path = tmp_path / "tied.csv"
    command = [wall, "simulate", scene, "--csv", csv_path, "--json"]
    demands = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["demands"]
    lower, upper = demands["ties"]
    assert lower["tie_break_time"] is not None and upper["tie_force"]["value"] > 0
    with csv_path.open() as file:
        rows = list(csv.DictReader(file))
    result = simulate_fmu(
        str(path),
        fmi_type=kind,
        relative_tolerance=1e-10,
        output_interval=float(rows[1]["time_s"]),
        stop_time=5.0,
        record_events=False,
        output=["u", "tie_force", "tie_break_time"],
    )
    # the importer's solver of Model Exchange has a tolerance of its own
    allowed = 1e-9 if kind == "CoSimulation" else 1e-5
    rows = rows[: len(result)]
    u, force = ([float(row[name]) for row in rows] for name in ("u_m", "tie_force_n"))
    assert result["u"] == pytest.approx(u, abs=allowed)
    assert result["tie_break_time"][-1] == pytest.approx(lower["tie_break_time"], abs=100 * allowed)
    if kind == "CoSimulation":
        assert result["tie_force"] == pytest.approx(force, abs=2e7 * allowed)


@pytest.mark.parametrize("base", ["fmu", "fmu3"])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_the_general_unit_is_a_chimney(request, base, kind, wall, tmp_path):
    """A chimney is given by seven parameters, without packaging."""
    scene = tmp_path / "chimney.toml"
    text = (BODIES / "chimney.toml").read_text().split("[force_law]")[0]
    damping = "[damping]\ndamping_model = 'constant_coefficient'\nxi = 0.05\n"
    scene.write_text(text + "[start]\nu_start = 0.1\n" + damping)
    shown = subprocess.run([wall, "describe", scene, "--json"], check=True, capture_output=True).stdout
    facts = json.loads(shown)
    z, weight = facts["centroid_height"], facts["weight"]
    start = {
        "mechanism": 3,
        "height": 1.6,
        "body_mass": facts["mass"],
        "centroid_height": z,
        "inertia": facts["effective_mass"] * z * z,
        "arm": facts["F0"] * z / weight,
        "damping_model": 2,
        "xi": 0.05,
        "u_start": 0.1,
    }
    times, u, _ = history(wall, scene, tmp_path, "--stop-time", "2", "--output-step", str(INTERVAL))
    result = simulate_fmu(
        str(request.getfixturevalue(base)),
        fmi_type=kind,
        start_values=start,
        stop_time=2.0,
        output_interval=INTERVAL,
        relative_tolerance=1e-10,
        record_events=False,
        output=["u", "participation"],
    )
    count = min(len(times), len(result))
    assert result["participation"][0] == pytest.approx(facts["participation"], rel=1e-12)
    # Model Exchange: CVODE to its tolerance
    tolerance = 1e-11 if kind == "CoSimulation" else 1e-5
    assert result["u"][:count] == pytest.approx(u[:count], abs=tolerance)


@pytest.mark.parametrize("base", ["fmu", "fmu3"])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_a_packaged_gable_moves_in_full_rotations(request, base, kind, wall, tmp_path):
    scene, path = tmp_path / "gable.toml", tmp_path / "gable.fmu"
    scene.write_text("""stop_time = 1.5
[geometry]
kinematics = "trigonometric"
[[geometry.part]]
height = 2.4
thickness = 0.5
width = [6.0, 0.0]
[[geometry.load]]
force = 8e3
height = 1.2
inside = 0.3
moving_mass = 1.0
thrust = 300
[force_law]
force_law = "rigid_linear"
[damping]
damping_model = "none"
[impact]
impact = "restitution"
restitution = 0.9
[start]
u_start = 0.1
""")
    command = [wall, "package", scene, "-o", path, "--base", request.getfixturevalue(base)]
    subprocess.run(command, check=True, capture_output=True)
    times, u, reaction = history(wall, scene, tmp_path, "--output-step", str(INTERVAL))
    result = simulate_fmu(
        str(path),
        fmi_type=kind,
        stop_time=1.5,
        output_interval=INTERVAL,
        relative_tolerance=1e-10,
        record_events=False,
        output=["u", "reaction_bottom"],
    )
    count = min(len(times), len(result))
    assert min(result["u"]) < -0.01
    # Model Exchange: CVODE to its tolerance, and samples beside an impact
    tolerance = 1e-9 if kind == "CoSimulation" else 1e-5
    assert result["u"][:count] == pytest.approx(u[:count], abs=tolerance)
    if kind == "CoSimulation":
        assert result["reaction_bottom"][:count] == pytest.approx(reaction[:count], rel=1e-7, abs=1e-2)


def test_a_body_that_tips_over_by_itself_is_refused(fmu, tmp_path):
    start = {"mechanism": 3, "thrust": 5e3, "thrust_height": 4.0, "xi": 0.05}
    with pytest.raises(Exception, match="fmi2ExitInitializationMode|initiali"):
        simulate_fmu(str(fmu), start_values=start, stop_time=0.1)
