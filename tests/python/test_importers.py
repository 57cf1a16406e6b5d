"""Tests what importers do beside the standard, in both versions of FMI: it must not stop them."""

import subprocess

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException

from conftest import ROOT, of_fmi3
from unit import Unit

STEP, END = 0.005, 6.0
UNKNOWN = 4242


@pytest.fixture(scope="module")
def scene(fmu, wall, tmp_path_factory):
    """The FMU of a scene, in each version."""
    made = {}
    for version, base in (("2.0", fmu), ("3.0", of_fmi3(fmu))):
        made[version] = tmp_path_factory.mktemp("scene") / "strip.fmu"
        command = [wall, "package", ROOT / "scenes/strip_between_floors.toml", "-o", made[version]]
        subprocess.run([*command, "--base", base], check=True, capture_output=True)
    return made


@pytest.fixture(params=["2.0", "3.0"])
def version(request):
    return request.param


@pytest.fixture(params=["wall", "floor", "scene"])
def running(request, version, fmu, floor_fmu, scene):
    """A unit that logs, in step mode, with the name of its Boolean output."""
    paths = {"2.0": lambda path: path, "3.0": of_fmi3}[version]
    path = {"wall": lambda: paths(fmu), "floor": lambda: paths(floor_fmu), "scene": lambda: scene[version]}
    values = {"wall": {"u_start": 0.15, "u_dot_start": 1.0}, "floor": {"displacement_start": 0.02}}
    with Unit.unpack(path[request.param]()) as unpacked, Unit(unpacked, logging=True) as unit:
        unit.start(**values.get(request.param, {}))
        yield unit, "yielding" if request.param == "floor" else "overturned"


def warnings(unit):
    return [text for status, category, text in unit.messages if category == "logStatusWarning"]


def test_event_mode_takes_a_record(fmu3):
    """FMPy sets a discrete input to the value that it has before each step that is no event."""
    time = np.arange(round(END / STEP) + 1) * STEP
    # a new value every 10 or 15 ms or so: most steps begin with the value of the step before
    acceleration = np.round(2.5 * np.sin(2.0 * np.pi * time) * np.exp(-0.3 * time), 1)
    record = np.array(list(zip(time, acceleration, strict=True)), dtype=[("time", "f8"), ("a_g", "f8")])
    plain, events = (
        simulate_fmu(
            str(fmu3), stop_time=END, output_interval=STEP, input=record, output=["u", "u_max"],
            start_values={"u_start": 0.0}, use_event_mode=use_event_mode,
        )
        for use_event_mode in (False, True)
    )  # fmt: skip
    assert len(plain) == len(time) < len(events), "events are sampled twice"
    _, first = np.unique(events["time"], return_index=True)
    assert np.array_equal(events["time"][first], plain["time"])
    for name in ("u", "u_max"):
        assert np.array_equal(events[name][first], plain[name]), name
    assert 0.1 < plain["u_max"][-1] < 0.2, "it rocks"


def test_a_boolean_is_read_as_a_number(running):
    unit, name = running
    before = warnings(unit)
    found = set()
    for _ in range(200):
        unit.step(0.01)
        (value,) = unit.slave.getReal([unit.reference(name)])
        assert value == float(unit.get(name))
        found.add(value)
    # the bare wall overturns
    assert found == ({0.0, 1.0} if unit.description.modelName == "rocking-wall" else {0.0})
    (warning,) = warnings(unit)[len(before) :]
    assert f"{name} is a Boolean, read as 0 or 1" in warning


def test_a_getter_that_fails_does_not_end_the_run(running):
    unit, name = running
    for getter in (unit.slave.getReal, unit.slave.getInteger, unit.slave.getBoolean):
        with pytest.raises(FMICallException):
            getter([UNKNOWN])
        assert f"no variable of this type has the value reference {UNKNOWN}" in unit.messages[-1][-1]
        unit.step(0.01)


def test_a_step_of_length_0_changes_nothing(running, version):
    unit, _ = running
    unit.step(0.1)
    outputs = [v.name for v in unit.description.modelVariables if v.causality == "output"]
    before, state = unit.get(*outputs), unit.slave.getFMUState()
    bytes_before = unit.slave.serializeFMUState(state)
    answer = unit.slave.doStep(unit.time, 0.0)
    if version == "3.0":
        assert answer == (False, False, False, unit.time)
    assert unit.get(*outputs) == before
    assert unit.slave.serializeFMUState(unit.slave.getFMUState()) == bytes_before
    unit.step(0.1)
    with pytest.raises(FMICallException):
        unit.slave.doStep(unit.time, -1e-9)
