"""Checks the model description and the archive against what a good FMI 2.0 FMU has."""

import re
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


def test_the_frame(xml):
    for attribute in ("description", "author", "version", "copyright", "license", "generationTool"):
        assert xml.get(attribute), attribute
    assert xml.get("variableNamingConvention") == "structured"
    assert re.fullmatch(r"\{[0-9a-f]{32}\}", xml.get("guid"))
    experiment = xml.find("DefaultExperiment").attrib
    assert {key: float(value) for key, value in experiment.items()} == {
        "startTime": 0.0, "stopTime": 30.0, "stepSize": 0.01, "tolerance": 1e-8,
    }  # fmt: skip
    categories = {category.get("name") for category in xml.findall("LogCategories/Category")}
    assert categories == {
        "logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal", "logEvents", "logAll",
    }  # fmt: skip


def test_capabilities(xml):
    kind = xml.find("CoSimulation")
    assert kind.get("modelIdentifier") == "wall"
    for name in (
        "canHandleVariableCommunicationStepSize", "canGetAndSetFMUstate", "canSerializeFMUstate",
        "canInterpolateInputs", "providesDirectionalDerivative", "canNotUseMemoryManagementFunctions",
    ):  # fmt: skip
        assert kind.get(name) == "true", name
    for name in ("canRunAsynchronuously", "canBeInstantiatedOnlyOncePerProcess", "needsExecutionTool"):
        assert kind.get(name, "false") == "false", name
    assert int(kind.get("maxOutputDerivativeOrder")) >= 1
    exchange = xml.find("ModelExchange")
    assert exchange.get("modelIdentifier") == "wall"
    for name in (
        "canGetAndSetFMUstate", "canSerializeFMUstate",
        "providesDirectionalDerivative", "canNotUseMemoryManagementFunctions",
    ):  # fmt: skip
        assert exchange.get(name) == "true", name
    for name in (
        "completedIntegratorStepNotNeeded",
        "canBeInstantiatedOnlyOncePerProcess",
        "needsExecutionTool",
    ):
        assert exchange.get(name, "false") == "false", name
    assert int(xml.get("numberOfEventIndicators")) == 3


def test_units_and_types(xml, variables):
    units = {unit.get("name"): unit for unit in xml.findall("UnitDefinitions/Unit")}
    assert all(unit.find("BaseUnit") is not None for unit in units.values())
    shown = {display.get("name") for display in xml.iter("DisplayUnit")}
    assert {"mm", "g", "%", "kN"} <= shown  # there is no angle among the variables
    g = next(display for display in xml.iter("DisplayUnit") if display.get("name") == "g")
    # displayed = factor * value: 1 m/s2 is 1/9.80665 g
    assert float(g.get("factor")) == pytest.approx(1 / 9.80665, rel=1e-15)
    types = {kind.get("name"): kind for kind in xml.findall("TypeDefinitions/SimpleType")}
    for kind in types.values():
        inner = kind[0]
        if inner.tag == "Real":
            assert inner.get("quantity") and inner.get("unit") in units, kind.get("name")
        else:
            assert inner.tag == "Enumeration"
            items = inner.findall("Item")
            assert [int(item.get("value")) for item in items] == list(range(1, len(items) + 1))
            assert all(item.get("description") for item in items), kind.get("name")
    for variable in variables:
        kind = type_of(variable)
        assert variable.get("description"), variable.get("name")
        if kind.tag == "Real":
            assert kind.get("declaredType") in types
            assert kind.get("nominal") or types[kind.get("declaredType")][0].get("nominal"), variable.get(
                "name"
            )


def test_references_are_unique(variables):
    references = [variable.get("valueReference") for variable in variables]
    assert len(set(references)) == len(references)
    names = [variable.get("name") for variable in variables]
    assert len(set(names)) == len(names)


def test_starts_stand_where_they_belong(variables):
    for variable in variables:
        started = type_of(variable).get("start") is not None
        needs = variable.get("causality") in ("parameter", "input") or variable.get("initial") in (
            "exact",
            "approx",
        )
        assert started == needs, variable.get("name")
        if variable.get("causality") == "parameter":
            assert variable.get("variability") == "fixed", variable.get("name")


def test_starts_are_the_binarys_own(unit, variables):
    unit.start()
    for variable in variables:
        kind = type_of(variable)
        if kind.get("start") is not None:
            found = unit.get(variable.get("name"))
            assert found == (float if kind.tag == "Real" else int)(kind.get("start")), variable.get("name")


def test_structure(xml, variables):
    names = [variable.get("name") for variable in variables]
    outputs = [variable.get("name") for variable in variables if variable.get("causality") == "output"]
    structure = xml.find("ModelStructure")

    def unknowns(part):
        return [(names[int(u.get("index")) - 1], u) for u in structure.findall(f"{part}/Unknown")]

    assert [name for name, _ in unknowns("Outputs")] == outputs
    assert [name for name, _ in unknowns("Derivatives")] == ["u_dot", "u_ddot"]
    # local variables are no unknowns, in both versions of FMI
    free = [v for v in variables if v.get("initial") == "calculated" and v.get("causality") != "local"]
    assert {name for name, _ in unknowns("InitialUnknowns")} == {v.get("name") for v in free}
    for part in ("Outputs", "Derivatives", "InitialUnknowns"):
        for name, unknown in unknowns(part):
            dependencies, kinds = unknown.get("dependencies"), unknown.get("dependenciesKind")
            assert dependencies is not None, (
                f"{part} {name}: a missing list means that it depends on everything"
            )
            assert len(dependencies.split()) == len((kinds or "").split()), f"{part} {name}"


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


def test_archive(fmu):
    with zipfile.ZipFile(fmu) as archive:
        items = archive.infolist()
    names = [item.filename for item in items]
    assert names == sorted(names)
    assert {item.date_time for item in items} == {(1980, 1, 1, 0, 0, 0)}
    assert {item.compress_type for item in items} <= {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
    for name in ("modelDescription.xml", "model.png", "binaries/linux64/wall.so", "documentation/index.html"):
        assert name in names
    folders = {
        name.split("/")[1] for name in names if name.startswith("documentation/") and name.count("/") > 1
    }
    assert folders == {"licenses"}
    assert "documentation/licenses/license.txt" in names


def test_library_exports_the_interface_alone(fmu, tmp_path):
    with zipfile.ZipFile(fmu) as archive:
        library = archive.extract("binaries/linux64/wall.so", tmp_path)
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
