"""Tests a wall on a floor and a building in other masters; `wall building` makes both."""

import json
import os
import platform
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssd
from lxml import etree

from masters import MASTERS, Building

ROOT = Path(__file__).parents[2]
STEP, STEPS = 0.001, 1000
X86_64 = ("x86_64", "AMD64")
SCENES = ROOT / "scenes/building"
WATCHED = {
    "building": ["floor_1.displacement", "floor_2.displacement", "strip.u", "parapet.u"],
    "wall_on_floor": ["storey.displacement", "wall.u"],
}
WALL_ON_FLOOR = """
stop_time = 2.0
step = 0.001
[[floor]]
name = "storey"
mass = 2000.0
stiffness = 4.0e6
damping_ratio = 0.0
velocity_start = 0.3
[[wall]]
name = "wall"
scene = "parapet.toml"
bottom = "storey"
"""


def program():
    path = Path(os.environ.get("ROCKING_WALL_BIN", ROOT / "target/release/wall"))
    assert path.is_file(), f"{path} is missing: run `cargo build --release --bin wall`"
    return path


def fmus():
    places = [("ROCKING_WALL_FMU", "wall.fmu"), ("ROCKING_FLOOR_FMU", "floor.fmu")]
    paths = [Path(os.environ.get(key, ROOT / "fmu_out" / name)) for key, name in places]
    assert all(path.is_file() for path in paths), "run `cargo xtask fmu`"
    return ["--wall-fmu", paths[0], "--floor-fmu", paths[1]]


def make(source, output):
    """Makes the SSP of a building file."""
    subprocess.run([program(), "building", source, "-o", output, *fmus()], check=True, capture_output=True)
    return output


@pytest.fixture(scope="module")
def buildings(tmp_path_factory):
    """Makes both systems, with a start without forces: floors move without damping, and walls move with them.

    All inputs are then 0 at the start, whatever a master does with the loop of accelerations and reactions
    before its first step. libcosim takes the step that the file states.
    """
    made = {}
    for name in WATCHED:
        folder = tmp_path_factory.mktemp(name)
        for scene in SCENES.glob("*.toml"):
            shutil.copy(scene, folder)
        text = re.sub("damping_ratio = .*", "damping_ratio = 0.0", (SCENES / "building.toml").read_text())
        text = text.replace("stop_time = 5.0", f"stop_time = 5.0\nstep = {STEP}")
        text = text if name == "building" else WALL_ON_FLOOR
        (folder / "quiet.toml").write_text(text)
        made[name] = make(folder / "quiet.toml", folder / "quiet.ssp")
    return made


def run(master, name, path, folder):
    if master in ("Ecos", "libcosim") and (sys.platform == "darwin" or platform.machine() not in X86_64):
        pytest.skip(f"not run: {master} needs packages that are not made for this platform")
    if master in ("own", "FMPy"):
        # without libraries that conflict with those of others
        return MASTERS[master](Building(path, folder), STEP, STEPS, WATCHED[name])
    output = folder / f"{master}.npy"
    command = [
        sys.executable,
        ROOT / "tests/masters/masters.py",
        master,
        path,
        str(STEP),
        str(STEPS),
        output,
        *WATCHED[name],
    ]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr[-2000:]
    return np.load(output)


@pytest.fixture(scope="module")
def expected(buildings, tmp_path_factory):
    return {name: run("own", name, path, tmp_path_factory.mktemp(name)) for name, path in buildings.items()}


@pytest.mark.parametrize("name", WATCHED)
@pytest.mark.parametrize("master", [master for master in MASTERS if master != "own"])
def test_masters_agree(buildings, expected, master, name, tmp_path):
    """The same scheme and step agree to 1e-9 of the peak; only the rounding of summed times differs."""
    found = run(master, name, buildings[name], tmp_path)
    peaks = np.abs(expected[name]).max(axis=0)
    assert np.all(peaks > 1e-3), "something moves"
    assert found.shape == expected[name].shape
    assert np.abs(found - expected[name]).max(axis=0) / peaks == pytest.approx(0.0, abs=1e-9)


def test_storeys_carry_their_values_inside(buildings):
    """Masters that ignore an SSP's parameters move the same system: the values are in the FMUs."""
    with zipfile.ZipFile(buildings["wall_on_floor"]) as archive:
        assert b"ParameterBinding" not in archive.read("SystemStructure.ssd")
        with archive.open("resources/storey.fmu") as file, zipfile.ZipFile(file) as storey:
            lines = storey.read("resources/floor.toml").decode().splitlines()
            values = dict(line.split(" = ") for line in lines)
            description = etree.fromstring(storey.read("modelDescription.xml"))
    assert {name: float(value) for name, value in values.items()} == {
        "mass": 2000.0, "stiffness": 4.0e6, "damping_ratio": 0.0, "velocity_start": 0.3
    }  # fmt: skip
    starts = {
        variable.get("name"): float(variable[0].get("start"))
        for variable in description.iter("ScalarVariable")
        if variable.get("name") in values
    }
    assert starts == {name: float(value) for name, value in values.items()}


def test_the_step_that_a_building_needs_is_printed(tmp_path):
    """Held inputs at the printed step are within 1 % of every peak, at the next longer one they are not.

    The error at a step h is found from a run at a shorter step: of order 1, that has its part of the error.
    """
    for scene in SCENES.glob("*.toml"):
        text = scene.read_text().replace("stop_time = 5.0", "stop_time = 0.6\nstep = 0.001")
        (tmp_path / scene.name).write_text(text)
    path = tmp_path / "b.ssp"
    command = [program(), "building", tmp_path / "building.toml", "-o", path, *fmus()]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    held, linear = (
        float(re.search(f"{kind} inputs +([0-9.]+) ms", printed)[1]) for kind in ("held", "linear")
    )
    assert held < linear and "the SSP states 1 ms, which is too long for held inputs" in printed
    # the steps tried are 10, 5, 2, 1, 0.5 ms and so on
    longer = held * (2.5 if f"{held:e}".startswith("2") else 2.0)
    watched = [*WATCHED["building"], "floor_1.acceleration_absolute", "floor_2.acceleration_absolute"]
    building = Building(path, tmp_path / "unpacked")

    def run(milliseconds):
        often = round(10.0 / milliseconds)
        return MASTERS["own"](building, milliseconds / 1000.0, 60 * often, watched)[often - 1 :: often]

    shorter = held / 2.5
    fine = run(shorter)
    peaks = np.abs(fine).max(axis=0)
    errors = [np.max(np.abs(run(step) - fine) / peaks) / (1 - shorter / step) for step in (held, longer)]
    assert errors[0] <= 0.01 < errors[1]


def stated(path):
    """Stop times and steps that an SSP states: of the system, for each tool, and of each unit."""
    with zipfile.ZipFile(path) as archive:
        system = etree.fromstring(archive.read("SystemStructure.ssd"))
        units = [name for name in archive.namelist() if name.endswith(".fmu")]
        experiments = []
        for name in units:
            with archive.open(name) as file, zipfile.ZipFile(file) as unit:
                description = etree.fromstring(unit.read("modelDescription.xml"))
                experiments.append(description.find("DefaultExperiment"))
    found = {etree.QName(element).localname: element for element in system.iter(etree.Element)}
    stops = [experiment.get("stopTime") for experiment in [found["DefaultExperiment"], *experiments]]
    steps = [found["FixedStepMaster"].get("stepSize"), found["FixedStepAlgorithm"].get("baseStepSize")]
    steps += [experiment.get("stepSize") for experiment in experiments]
    return {float(stop) for stop in stops}, {float(step) for step in steps}


def test_held_inputs_at_the_stated_step_hold_the_peaks(tmp_path):
    """To 1 % of the run in process, whether a master closes the loop at communication points or not."""
    path = make(SCENES / "building.toml", tmp_path / "b.ssp")
    (stop,), (step,) = stated(path)
    assert stop == 5.0
    # every peak is before it
    end = 0.3
    rows = "".join(f"{0.01 * index:.2f},0.0\n" for index in range(round(end / 0.01) + 1))
    (tmp_path / "rest.csv").write_text(f"time [s],a_g [m/s2]\n{rows}")
    command = [program(), "building", SCENES / "building.toml", "--record", tmp_path / "rest.csv"]
    command += ["--unit", "m/s2", "--tail", "4", "--tolerance", "1e-4", "--json"]
    run = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    expected = {}
    for floor in run["floors"]:
        assert floor["drift"]["time"] < end and floor["acceleration"]["time"] < end
        expected[f"{floor['name']}.displacement"] = abs(floor["drift"]["value"])
        expected[f"{floor['name']}.acceleration_absolute"] = abs(floor["acceleration"]["value"])
    for wall in run["walls"]:
        assert wall["u_ratio"]["time"] < end
        expected[f"{wall['name']}.u"] = wall["u_max"]
    building = Building(path, tmp_path / "unpacked")
    for loop in (False, True):
        history = MASTERS["own"](building, step, round(end / step), list(expected), loop=loop)
        peaks = dict(zip(expected, np.abs(history).max(axis=0), strict=True))
        assert peaks == pytest.approx(expected, rel=0.01), loop


def test_the_system_is_complete_and_its_bytes_repeat(tmp_path):
    first, second = (make(SCENES / "building.toml", tmp_path / name) for name in ("a.ssp", "b.ssp"))
    assert first.read_bytes() == second.read_bytes()
    # validate with the schema of SSP 1.0
    system = read_ssd(str(first), validate=True).system
    assert [element.name for element in system.elements] == ["floor_1", "floor_2", "strip", "parapet"]
    with zipfile.ZipFile(first) as archive:
        names = archive.namelist()
        description = etree.fromstring(archive.read("SystemStructure.ssd"))
    assert names == sorted(names)
    assert {element.source for element in system.elements} == set(names) - {"SystemStructure.ssd"}
    prefix = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
    connectors = list(description.iter(f"{prefix}Connector"))
    types = {etree.QName(kind).localname for connector in connectors for kind in connector}
    assert all(len(connector) == 1 for connector in connectors) and types == {"Real", "Boolean"}
    connections = [dict(connection.attrib) for connection in description.iter(f"{prefix}Connection")]
    assert {
        "startElement": "floor_2", "startConnector": "displacement",
        "endElement": "strip", "endConnector": "drift"
    } in connections  # fmt: skip
    assert len(connections) == 9


def test_a_system_may_have_the_grounds_motion_as_its_input(tmp_path):
    for scene in SCENES.glob("*.toml"):
        text = scene.read_text().replace("expose_ground = false", "expose_ground = true")
        (tmp_path / scene.name).write_text(text)
    system = read_ssd(str(make(tmp_path / "building.toml", tmp_path / "open.ssp"))).system
    assert [(connector.name, connector.kind) for connector in system.connectors] == [("a_g", "input")]
    assert (None, "a_g", "floor_1", "a_g") in [
        (c.startElement, c.startConnector, c.endElement, c.endConnector) for c in system.connections
    ]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("mass = 2.0e4", "mass = -1"), ["line 10", "mass", "-1"]),
        (('on = "floor_1"', 'on = "floor_3"'), ["floor_3", "ground, floor_1"]),
        (('name = "parapet"', 'name = "strip"'), ["line 29", 'name = "strip"', "is taken"]),
        (('name = "parapet"', 'name = "a wall"'), ["a wall", "letters"]),
        (('scene = "parapet.toml"', 'scene = "none.toml"'), ["none.toml"]),
        (('scene = "parapet.toml"', 'scene = "strip.toml"'), ["parapet", "top"]),
        (("velocity_start", "speed"), ["speed", "velocity_start"]),
        (("stop_time = 5.0", "stop_time = 0"), ["stop_time = 0"]),
        (("stop_time = 5.0", "stop_time = 5.0\nstep = 0"), ["line 5", "step = 0", "above 0", "by default"]),
        (("stop_time = 5.0", "stop_time = 5.0\nstep = 6"), ["step = 6", "stop_time = 5"]),
    ],
)
def test_bad_buildings_are_named(tmp_path, change, words):
    for scene in SCENES.glob("*.toml"):
        shutil.copy(scene, tmp_path)
    text = (tmp_path / "building.toml").read_text()
    assert change[0] in text
    (tmp_path / "bad.toml").write_text(text.replace(*change))
    command = [program(), "building", tmp_path / "bad.toml", "-o", tmp_path / "bad.ssp", *fmus()]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 2 and not (tmp_path / "bad.ssp").exists()
    assert all(word in result.stderr for word in words), result.stderr
