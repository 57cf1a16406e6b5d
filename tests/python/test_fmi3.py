"""Tests what FMI 3.0 adds to FMI 2.0, and that both versions give the same results."""

import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu
from lxml import etree

from conftest import ROOT, of_fmi3
from unit import Unit

SCHEMA = Path(fmpy.__file__).parent / "schema/fmi3/fmi3TerminalsAndIcons.xsd"
OVERTURNING = {"u_start": 0.15, "u_dot_start": 1.0}


@pytest.fixture(params=["wall", "floor"])
def units(request, fmu, floor_fmu):
    """The FMI 2.0 and the FMI 3.0 unit of each model."""
    path = fmu if request.param == "wall" else floor_fmu
    return path, of_fmi3(path)


def terminals(path):
    with zipfile.ZipFile(path) as archive:
        return etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))


def test_fmpy_finds_nothing(units):
    assert validate_fmu(str(units[1])) == []


def test_terminals_are_valid_and_join_variables_that_fit(fmu, floor_fmu):
    schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
    found = {}
    for path in (of_fmi3(fmu), of_fmi3(floor_fmu)):
        xml = terminals(path)
        schema.assertValid(xml)
        description = read_model_description(str(path))
        variables = {variable.name: variable for variable in description.modelVariables}
        for terminal in xml.iter("Terminal"):
            found[description.modelName, terminal.get("name")] = {
                member.get("memberName"): variables[member.get("variableName")] for member in terminal
            }
    # a wall's support, and the floor's own, fit each wall_i of a floor: inputs to outputs, of the same unit
    plugs = [members for (_, name), members in found.items() if not name.startswith("wall_")]
    sockets = [members for (_, name), members in found.items() if name.startswith("wall_")]
    assert (len(plugs), len(sockets)) == (3, 8)
    for plug in plugs:
        for socket in sockets:
            assert set(plug) == set(socket) == {"acceleration", "reaction", "impulse"}
            for name, variable in plug.items():
                assert {variable.causality, socket[name].causality} == {"input", "output"}
                assert variable.declaredType.unit == socket[name].declaredType.unit


def test_the_archive_is_complete(units):
    with zipfile.ZipFile(units[1]) as archive, zipfile.ZipFile(units[0]) as old:
        names = archive.namelist()
        assert names == sorted(names)
        folder = Path(units[0]).stem
        libraries = [
            archive.read(f"binaries/x86_64-linux/{folder}.so"),
            old.read(f"binaries/linux64/{folder}.so"),
        ]
        assert libraries[0] == libraries[1], "one library serves both versions"
    assert {"documentation/index.html", "terminalsAndIcons/icon.png"} <= set(names)


def test_capabilities(units):
    with zipfile.ZipFile(units[1]) as archive:
        xml = etree.fromstring(archive.read("modelDescription.xml"))
    steps, exchange = xml.find("CoSimulation"), xml.find("ModelExchange")
    for name in (
        "canGetAndSetFMUState", "canSerializeFMUState", "providesDirectionalDerivatives",
        "providesAdjointDerivatives",
    ):  # fmt: skip
        assert steps.get(name) == exchange.get(name) == "true", name
    for name in ("hasEventMode", "providesIntermediateUpdate", "canHandleVariableCommunicationStepSize"):
        assert steps.get(name) == "true", name
    is_wall = units[1].stem == "wall"
    assert steps.get("mightReturnEarlyFromDoStep", "false") == ("true" if is_wall else "false")
    assert exchange.get("needsCompletedIntegratorStep") == "true"
    assert xml.find("ScheduledExecution") is None


STARTS = {"wall": {}, "floor": {"displacement_start": 0.02, "hysteresis": 2}}


@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_both_versions_give_the_same_history(units, kind):
    name = units[0].stem
    output = ["u", "u_max", "reaction_bottom"] if name == "wall" else ["displacement", "energy_hysteretic"]
    old, new = (
        simulate_fmu(
            str(path), fmi_type=kind, stop_time=5.0, output_interval=0.01, start_values=STARTS[name],
            output=output, relative_tolerance=1e-8, record_events=False,
        )
        for path in units
    )  # fmt: skip
    assert len(old) == len(new) == 501
    for variable in output:
        assert np.array_equal(old[variable], new[variable]), variable
    assert np.abs(new[output[0]]).max() > 0.01, "it moves"


def until_overturning(unpacked, settings, step, early, kind=Unit):
    """Steps until the wall has overturned: whether the step ended early, its end, and variables there."""
    with kind(unpacked, earlyReturnAllowed=early, eventModeUsed=early) as unit:
        unit.start(**OVERTURNING | settings)
        if early:
            unit.slave.updateDiscreteStates()
            unit.slave.enterStepMode()
        for _ in range(1000):
            event, terminate, returned, time = unit.slave.doStep(unit.time, step)
            unit.time = time
            assert not terminate and event == returned
            if unit.get("overturned"):
                return (returned, time, *unit.get("overturn_time", "u", "u_ins", "time"))
        raise AssertionError("it does not overturn")


@pytest.mark.parametrize("step", [0.01, 0.3])
def test_newmark_ends_early_where_its_own_steps_allow(unpacked3, step):
    """A step that ends elsewhere has other steps of Newmark inside, so that overturning moves: by less than
    Newmark is wrong anyway. Where the wall does not overturn in them, the step goes on to its end."""
    newmark = {"solver": "newmark"}
    _, _, reference, *_ = until_overturning(unpacked3, {}, step, False)
    _, _, expected, *_ = until_overturning(unpacked3, newmark, step, False)
    returned, time, located, *_, now = until_overturning(unpacked3, newmark, step, True)
    assert now == time
    assert abs(located - expected) <= abs(expected - reference)
    assert time == pytest.approx(located, abs=1e-7) if returned else located == expected


def test_a_run_with_early_return_goes_on(fmu3):
    result = simulate_fmu(
        str(fmu3), stop_time=3.0, output_interval=0.01, start_values=OVERTURNING, early_return_allowed=True,
        use_event_mode=True, output=["u", "overturned", "overturn_time"],
    )  # fmt: skip
    at = result["overturn_time"][-1]
    assert 0 < at < 1
    assert np.abs(result["time"] - at).min() < 1e-9, "overturning is one of the samples"
    assert result["time"][-1] == pytest.approx(3.0) and result["u"][-1] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("u_start", "by_u"), [(0.03, 0.0), (0.06, 2 * 3.0 / 4.0 * 3e5), (0.12, 0.0), (0.19, 0.0)]
)
def test_derivatives_of_a_tie_are_those_of_its_branch(unpacked3, u_start, by_u):
    """Slack, pulling, yielding, broken: by the directional and the adjoint derivative."""
    # it pulls from 0.05 m on, yields from 0.1 m on and breaks at 0.18 m of u
    tie = {"tie_height": 3.0, "tie_stiffness": 3e5, "tie_slack": 0.075, "tie_strength": 2.25e4}
    with Unit(unpacked3) as unit:
        unit.start(**tie, tie_ultimate=0.12, u_start=u_start, u_dot_start=0.1)
        knowns = [unit.reference(name) for name in ("u", "u_dot")]
        rows = [unit.reference(name) for name in ("tie_force", "tie_elongation", "tie_elongation_negative")]
        wanted = [by_u, 1.5 if u_start == 0.12 else 0.0, 0.0]
        for row, by_displacement in zip(rows, wanted):
            found = [unit.slave.getDirectionalDerivative([row], [known], [1.0])[0] for known in knowns]
            assert found == pytest.approx([by_displacement, 0.0], rel=1e-12)
            assert unit.slave.getAdjointDerivative([row], knowns, [1.0], 2) == found
        # output derivatives are those along the motion
        derivatives = unit.slave.getOutputDerivatives(rows, [1] * 3)
        assert list(derivatives) == pytest.approx([0.1 * value for value in wanted], rel=1e-12)
        assert unit.get("tie_broken") is (u_start == 0.19)


@pytest.mark.parametrize("event_mode", [False, True])
def test_a_step_ends_early_where_a_tie_breaks(unpacked3, event_mode):
    """`earlyReturn` just after the fracture, and once more at overturning; none where it is not allowed."""
    tie = {"tie_height": 3.0, "tie_stiffness": 3e5, "tie_slack": 0.075, "tie_strength": 2.25e4}
    start = {**tie, "tie_ultimate": 0.12, "u_start": 0.12, "u_dot_start": 2.0}
    with Unit(unpacked3, eventModeUsed=event_mode, earlyReturnAllowed=False) as unit:
        unit.start(**start)
        if event_mode:
            unit.slave.enterStepMode()
        _, _, early, time = unit.slave.doStep(0.0, 0.1)
        assert (early, time) == (False, 0.1)
        wanted = unit.get("tie_break_time", "overturn_time")
        assert 0.0 < wanted[0] < wanted[1] < 0.1
    with Unit(unpacked3, eventModeUsed=event_mode, earlyReturnAllowed=True) as unit:
        unit.start(**start)
        time = 0.0
        for event, broken, overturned in zip(wanted, (True, True), (False, True)):
            if event_mode:
                unit.slave.enterStepMode()
            needs_event, terminate, early, time = unit.slave.doStep(time, 0.1 - time)
            assert (early, needs_event, terminate) == (True, event_mode, False)
            # the unit ends it 1e-10 s after the event, and times agree to the rounding of split steps
            assert 0.0 < time - event < 2e-10
            assert unit.get("tie_broken", "overturned") == [broken, overturned]
            if event_mode:
                unit.slave.enterEventMode()
                unit.slave.updateDiscreteStates()
        assert unit.get("tie_break_time", "overturn_time") == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize("scene", ["plain_parapet", "shaken_parapet", "strip_between_floors"])
def test_a_scene_has_the_variables_of_fmi_2(fmu, fmu3, wall, tmp_path, scene):
    made = []
    for base in (fmu, fmu3):
        made.append(tmp_path / f"{len(made)}.fmu")
        command = [wall, "package", ROOT / f"scenes/{scene}.toml", "-o", made[-1], "--base", base]
        subprocess.run(command, check=True, capture_output=True)
    old, new = made
    assert validate_fmu(str(new)) == []
    names = [[v.name for v in read_model_description(str(path)).modelVariables] for path in made]
    added = {"time", "event_indicator_1", "event_indicator_2", "event_indicator_3"}
    assert set(names[1]) - set(names[0]) == added and set(names[0]) <= set(names[1])
    for member in terminals(new).iter("TerminalMemberVariable"):
        assert member.get("variableName") in names[1]
    results = [simulate_fmu(str(path), output=["u", "u_max"]) for path in (old, new)]
    assert np.array_equal(results[0]["u"], results[1]["u"])
    # it is no general FMU any more
    command = [wall, "package", ROOT / f"scenes/{scene}.toml", "-o", tmp_path / "x.fmu", "--base", new]
    refused = subprocess.run(command, capture_output=True, text=True)
    assert refused.returncode == 2 and "itself an FMU of a scene" in refused.stderr
