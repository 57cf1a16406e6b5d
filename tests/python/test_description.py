"""Checks the model description and the archive against what a good FMI 2.0 FMU has."""

import subprocess
import zipfile

import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from conftest import ROOT
from library import problems
from unit import Unit


@pytest.fixture(scope="module")
def xml(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return etree.fromstring(archive.read("modelDescription.xml"))


@pytest.fixture(scope="module")
def variables(xml):
    return xml.findall("ModelVariables/ScalarVariable")


def type_of(variable):
    return next(
        child for child in variable if child.tag in ("Real", "Integer", "Enumeration", "Boolean", "String")
    )


def test_fmpy_finds_nothing(fmu):
    assert validate_fmu(str(fmu)) == []


def test_starts_are_the_binarys_own(unit, variables):
    unit.start()
    for variable in variables:
        kind = type_of(variable)
        if kind.get("start") is not None:
            found = unit.get(variable.get("name"))
            assert found == (float if kind.tag == "Real" else int)(kind.get("start")), variable.get("name")


def test_dependencies_are_true(unpacked, xml, variables):
    """A dependency that is not listed is always zero; a listed one is non-zero in some state."""
    names = [variable.get("name") for variable in variables]
    listed = {
        names[int(unknown.get("index")) - 1]: {
            names[int(index) - 1] for index in unknown.get("dependencies").split()
        }
        for unknown in xml.findall("ModelStructure/Outputs/Unknown")
    }
    knowns = ["u", "u_dot", "a_g", "a_bottom", "a_top", "drift"]
    reacts = {name: set() for name in listed}
    yielding = {"tie_height": 3.0, "tie_stiffness": 1e6, "tie_strength": 1e3, "tie_ultimate": 10.0}
    states = [
        {"u_start": 0.1, "u_dot_start": 0.2},
        {"u_start": 0.1, "tie_height": 3.0, "tie_stiffness": 1e6},
        # a tie that yields on
        {"u_start": 0.1, "u_dot_start": 0.2, **yielding},
        {"u_start": -0.1, "u_dot_start": -0.2, "tie_side": "negative", **yielding},
        {
            "mechanism": "vertical_spanning",
            "thickness": 0.1,
            "u_start": 0.03,
            "u_dot_start": 0.1,
            "drift": 1e-3,
        },
        {"force_law": "rigid_linear", "damping_model": "none", "u_start": 0.0},
        {
            "force_law": "rigid_linear",
            "damping_model": "none",
            "mechanism": "vertical_spanning",
            "u_start": 0.0,
            "drift": 1e-9,
        },
    ]
    for state in states:
        with Unit(unpacked) as unit:
            unit.start(**state)
            for name in listed:
                if unit.variables[name].type != "Real":
                    continue
                for known in knowns:
                    slope = unit.slave.getDirectionalDerivative(
                        [unit.reference(name)], [unit.reference(known)], [1.0]
                    )[0]
                    if slope != 0.0:
                        reacts[name].add(known)
    for name, dependencies in listed.items():
        if any(variable.get("name") == name and type_of(variable).tag == "Real" for variable in variables):
            assert reacts[name] == dependencies, name


def test_libraries_export_the_interface_alone(fmu, floor_fmu, tmp_path):
    for path in (fmu, floor_fmu):
        with zipfile.ZipFile(path) as archive:
            library = archive.extract(f"binaries/linux64/{path.stem}.so", tmp_path)
        assert problems(library, portable=False) == []


def test_packing_is_reproducible(fmu, wall, tmp_path):
    libraries = []
    with zipfile.ZipFile(fmu) as archive:
        for name in archive.namelist():
            if name.startswith("binaries/"):
                library = archive.extract(name, tmp_path)
                libraries += ["--binary", library]
    again = tmp_path / "again.fmu"
    command = [
        wall.parent / "fmu-pack",
        "--description",
        "modelDescription/modelDescription.xml",
        "--documentation",
        "modelDescription/documentation",
    ]
    command += [*libraries, "--output", str(again)]
    subprocess.run(command, check=True, cwd=ROOT)
    assert again.read_bytes() == fmu.read_bytes()
