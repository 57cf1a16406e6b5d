"""Tests FMUs of one scene: only used variables, the motion inside, and no instance without the scene."""

import json
import math
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from conftest import ROOT
from unit import Unit

SCENES = sorted((ROOT / "scenes").glob("*.toml")) + sorted((ROOT / "scenes/bodies").glob("*.toml"))
PATHS = {scene.stem: scene for scene in SCENES}


@pytest.fixture(scope="module")
def packages(fmu, wall, tmp_path_factory):
    folder = tmp_path_factory.mktemp("packages")
    made = {}
    for scene in SCENES:
        made[scene.stem] = folder / f"{scene.stem}.fmu"
        command = [wall, "package", scene, "-o", made[scene.stem], "--base", fmu]
        subprocess.run(command, check=True, capture_output=True)
    return made


@pytest.mark.parametrize("scene", [scene.stem for scene in SCENES])
def test_package_is_valid_and_runs_as_the_scene(packages, wall, scene):
    path = packages[scene]
    assert validate_fmu(str(path)) == []
    summary = json.loads(
        subprocess.run(
            [wall, "simulate", PATHS[scene], "--json"], check=True, capture_output=True
        ).stdout
    )
    experiment = read_model_description(str(path)).defaultExperiment
    assert float(experiment.stopTime) == summary["end_time"]
    # The motion is inside: the importer's step matters only through rounding and the sensitivity of the
    # scene.
    for step in (None, 0.0137, 0.5):
        result = simulate_fmu(str(path), output_interval=step)
        # FMPy ends after a whole number of steps; the peak of these scenes is well before
        assert result["u_max"][-1] == pytest.approx(summary["u_max"], rel=1e-9, abs=1e-12), step


def test_a_plain_parapet_lists_what_it_needs(packages):
    names = {
        variable.name for variable in read_model_description(str(packages["plain_parapet"])).modelVariables
    }
    assert names == {
        # outputs of a parapet
        "u", "u_dot", "overturned", "u_ddot", "u_ratio", "restoring_force", "damping_force",
        "reaction_bottom", "impulse_bottom", "overturn_time", "u_max",
        # its parameters
        "height", "thickness", "width", "density", "gravity", "a1", "a3", "xi", "u_start", "u_dot_start",
        # calculated parameters
        "mass", "effective_mass", "participation", "F0", "u_ins", "omega1", "xi_used",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("scene", "there", "absent"),
    [
        (
            "shaken_parapet",
            {"u"},
            {"a_g", "a_bottom", "a_top", "drift", "overburden", "hinge_ratio", "d1", "mechanism"},
        ),
        (
            "strip_between_floors",
            {"a_bottom", "a_top", "drift", "hinge_ratio", "overburden", "d1", "xi", "restitution"},
            {"a_g", "c_bar", "tie_height"},
        ),
        (
            "rigid_block",
            {"restitution_used"},
            {"a1", "d1", "xi", "c_bar", "damping_force", "omega1", "tolerance"},
        ),
        ("quadrilinear_strip", {"hinge_ratio", "xi"}, {"a1", "a3", "d1", "force_law", "restitution"}),
        ("facade", {"F0_negative", "u_ins_negative", "gravity"}, {"height", "density", "body_mass"}),
        ("stepped_strip", {"hinge_ratio", "overburden", "reaction_top"}, {"height", "width", "density"}),
    ],
)
def test_what_plays_no_part_is_not_there(packages, scene, there, absent):
    names = {variable.name for variable in read_model_description(str(packages[scene])).modelVariables}
    assert there <= names
    assert not absent & names


@pytest.mark.parametrize("base", ["fmu", "fmu3"])
def test_a_tied_scene_lists_what_its_tie_does(request, base, wall, tmp_path):
    text = (ROOT / "scenes/plain_parapet.toml").read_text()
    tie = "[tie]\ntie_height = 1.2\ntie_stiffness = 2e5\ntie_strength = 2e3\ntie_side = 'negative'\n"
    names = {}
    for ultimate in (-1.0, 0.005):
        scene, path = tmp_path / f"{ultimate}.toml", tmp_path / f"{ultimate}.fmu"
        scene.write_text(f"{text}\n{tie}tie_ultimate = {ultimate}\n")
        command = [wall, "package", scene, "-o", path, "--base", request.getfixturevalue(base)]
        subprocess.run(command, check=True, capture_output=True)
        assert validate_fmu(str(path)) == []
        names[ultimate] = {variable.name for variable in read_model_description(str(path)).modelVariables}
    added = {"tie_ultimate", "tie_elongation_negative", "tie_broken", "tie_break_time"}
    assert names[0.005] - names[-1.0] == added and "tie_elongation" not in names[0.005]
    result = simulate_fmu(str(path), output=["tie_broken", "tie_break_time"])
    shown = subprocess.run([wall, "simulate", scene, "--json"], check=True, capture_output=True).stdout
    assert result["tie_broken"][-1] and not result["tie_broken"][0]
    expected = json.loads(shown)["demands"]["tie_break_time_negative"]
    assert result["tie_break_time"][-1] == pytest.approx(expected)


NAMED = re.compile(r"<tr><td><code>(\w+)</code></td>")


@pytest.mark.parametrize("scene", [scene.stem for scene in SCENES])
def test_a_scene_documents_what_it_has(packages, fmu, scene):
    """The page lists the variables of the unit, and a parapet without a tie says nothing of ties."""
    names = {variable.name for variable in read_model_description(str(packages[scene])).modelVariables}
    texts = []
    for path in (packages[scene], fmu):
        with zipfile.ZipFile(path) as archive:
            assert "documentation/licenses/license.txt" in archive.namelist()
            texts.append(archive.read("documentation/index.html").decode())
    page, general = texts
    assert set(NAMED.findall(page)) == names < set(NAMED.findall(general))
    for tag in ("tr", "li", "table", "div", "ul"):
        assert page.count(f"<{tag}") == page.count(f"</{tag}>") > 0, tag
    tables = page.split("<table")[1:]
    assert all("<td>" in table for table in tables)
    assert ("tie" in re.findall(r"[a-z]+", page)) == ("tie_stiffness" in names)


def test_the_step_is_at_most_that_of_the_record(packages):
    for scene, most in (("shaken_parapet", 0.005), ("plain_parapet", math.inf)):
        description = read_model_description(str(packages[scene]))
        experiment = description.defaultExperiment
        step, stop = float(experiment.stepSize), float(experiment.stopTime)
        assert step == min(most, stop / 1000), scene


def test_reference_results_stay_with_the_general_unit(fmu, packages):
    for path, expected in ((fmu, 6), (packages["plain_parapet"], 0)):
        with zipfile.ZipFile(path) as archive:
            found = [name for name in archive.namelist() if "fmi-ls-ref" in name]
        assert len(found) == expected, found


def test_starts_are_the_scenes(packages):
    with Unit.unpack(packages["strip_between_floors"]) as unpacked, Unit(unpacked) as unit:
        unit.start()
        started = [v for v in unpacked.description.modelVariables if v.start is not None and v.type == "Real"]
        assert {"hinge_ratio", "overburden", "a1"} <= {variable.name for variable in started}
        for variable in started:
            assert float(variable.start) == unit.get(variable.name), variable.name


def without(path, target, *names):
    """Copies the archive without some of its files."""
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(target, "w") as new:
        for item in old.infolist():
            if item.filename not in names:
                new.writestr(item, old.read(item))
    return target


def test_a_scene_does_not_run_without_its_resources(packages, tmp_path):
    broken = without(packages["shaken_parapet"], tmp_path / "broken.fmu", "resources/scene.bin")
    with Unit.unpack(broken) as unpacked, pytest.raises(Exception, match="instantiate"):
        Unit(unpacked)


def test_a_changed_scene_is_refused(packages, tmp_path):
    with Unit.unpack(packages["shaken_parapet"]) as unpacked:
        file = Path(unpacked.folder) / "resources/scene.bin"
        original = file.read_bytes()
        for place in (0, len(original) // 2, len(original) - 1):
            changed = bytes([original[place] ^ 1])
            file.write_bytes(original[:place] + changed + original[place + 1 :])
            with pytest.raises(Exception, match="instantiate"):
                Unit(unpacked)
        file.write_bytes(original)
        with Unit(unpacked) as unit:
            unit.start()
            assert unit.step(1.0).get("u_max") >= 0.0


def test_packages_are_the_same_bytes(packages, fmu, wall, tmp_path):
    again = tmp_path / "again.fmu"
    shutil.copy(ROOT / "scenes/shaken_parapet.toml", tmp_path / "shaken_parapet.toml")
    command = [wall, "package", tmp_path / "shaken_parapet.toml", "-o", again, "--base", fmu]
    subprocess.run(command, check=True, capture_output=True)
    assert again.read_bytes() == packages["shaken_parapet"].read_bytes()
