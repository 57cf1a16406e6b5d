"""Tests the WebAssembly component of the FMI 3.0 units in wasmtime: it computes what the library computes."""

import contextlib
import json
import math
import random
import subprocess
import tomllib
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree
from wasmtime import WasmtimeError
from wasmtime import component as wit

import test_cases
from component import Host, HostedExchange, HostedUnit, Loaded, Slave
from conftest import ROOT, of_fmi3
from exchange import Exchange
from test_fmi3 import until_overturning
from unit import Unit

MANIFEST = Path(fmpy.__file__).parent / "schema/fmi3/fmi3LayeredStandardManifest.xsd"
MISSING = "not run: `cargo xtask portable` runs these tests, after `rustup target add wasm32-wasip2`"
# steps of a reference case: enough for its motion, few enough for calls from Python
STEPS = 400
CALLS = 30_000


@pytest.fixture(scope="module", autouse=True)
def built(unpacked3):
    if not (Path(unpacked3.folder) / "binaries/wasm32-wasip2").is_dir():
        pytest.skip(MISSING)


def state(unit):
    """The state of an instance as bytes, every number of it to the last bit."""
    slave = unit.slave
    if isinstance(unit, (HostedUnit, HostedExchange)):
        return slave.getFmuState()
    held = slave.getFMUstate()
    try:
        return slave.serializeFMUstate(held)
    finally:
        slave.freeFMUstate(held)


def restore(unit, saved):
    slave = unit.slave
    if isinstance(unit, (HostedUnit, HostedExchange)):
        return slave.setFmuState(saved)
    held = slave.deSerializeFMUstate(saved)
    slave.setFMUstate(held)
    slave.freeFMUstate(held)
    return None


@pytest.mark.parametrize("name", ["wall", "floor"])
def test_the_archive_has_a_component_of_less_than_1_2_mb(name, fmu, floor_fmu):
    with zipfile.ZipFile(of_fmi3({"wall": fmu, "floor": floor_fmu}[name])) as archive:
        assert archive.getinfo(f"binaries/wasm32-wasip2/{name}.wasm").compress_size < 1.2e6
        schema = etree.XMLSchema(etree.parse(str(MANIFEST)))
        for file in ("manifest.xml", "fmi-ls-manifest.xml"):
            schema.assertValid(etree.fromstring(archive.read(f"extra/org.modelica.fmi-ls-wasm/{file}")))
    with zipfile.ZipFile({"wall": fmu, "floor": floor_fmu}[name]) as archive:
        assert not any("wasm" in entry for entry in archive.namelist()), "FMI 2.0 has no component"


def test_a_host_needs_to_provide_the_log_and_wasi_alone(unpacked3):
    imports, exports = Loaded.of(unpacked3).names()
    own = [name for name in imports if not name.startswith("wasi:")]
    assert own == ["fmi:fmi3/types@3.0.0", "fmi:fmi3/callbacks@3.0.0"]
    kinds = ("common", "co-simulation", "model-exchange")
    assert exports == [f"fmi:fmi3/{name}@3.0.0" for name in kinds]


def test_reference_cases_have_the_bits_of_the_library(unpacked2, unpacked3):
    """Where the C library's exp, sin or cos round another way than those of the component, a case differs, by
    no more than it differs from its reference by rounding."""
    different = {}
    for name in test_cases.NAMES:
        with Unit(unpacked2) as library, HostedUnit(unpacked3) as component:
            error = max(differences(name, library, component))
            if error > 0 or state(library) != state(component):
                different[name] = error
    print(f"cases that differ, with the share of what rounding explains: {different}")
    assert max(different.values(), default=0.0) <= 1.0
    assert len(different) <= 3, f"of {len(test_cases.NAMES)}"


def differences(name, library, component):
    """Yields by how much u differs at the rows of a case, as a share of 100 eps times the sensitivity."""
    scene = tomllib.loads((test_cases.CASES / f"{name}.toml").read_text())
    times, accelerations = test_cases.nodes(scene)
    tables = [table for key, table in scene.items() if isinstance(table, dict) and key != "motion"]
    parameters = {name: value for table in tables for name, value in table.items()}
    supports = ["a_bottom"] + (["a_top"] if parameters["mechanism"] == "vertical_spanning" else [])
    rows = test_cases.rows(name)
    end = json.loads((test_cases.CASES / f"{name}.json").read_text())["horizon"]
    rows = [row for row in rows if row["t"] <= end and not math.isnan(row["u"])]
    units = library, component
    for unit in units:
        unit.start(**parameters, **dict.fromkeys(supports, accelerations[0]))
    for row in rows[:: max(1, len(rows) // STEPS)]:
        step = row["t"] - library.time
        now, then = np.interp([library.time, row["t"]], times, accelerations, right=0.0)
        for unit in units:
            unit.set(**dict.fromkeys(supports, now))
            unit.rates(**dict.fromkeys(supports, (then - now) / step if step else 0.0))
            unit.step(step)
            unit.time = row["t"]
        first, second = (unit.get("u") for unit in units)
        yield abs(first - second) / (100 * test_cases.EPSILON * row["sensitivity"] * library.get("u_ins"))


def test_the_floor_has_the_bits_of_the_library(unpacked_floor, floor_fmu):
    with Unit.unpack(of_fmi3(floor_fmu)) as unpacked:
        with Unit(unpacked_floor) as library, HostedUnit(unpacked) as component:
            for unit in (library, component):
                unit.start(hysteresis="bilinear", yield_force=6e4, hardening_ratio=0.1)
                for index in range(500):
                    unit.set(a_g=3.0 * (-1) ** (index // 20)).step(0.01)
            assert state(library) == state(component)
            assert component.get("energy_hysteretic") > 0


def test_model_exchange_locates_the_events(unpacked2, unpacked3):
    """Free rocking, from one second to the next, by DOP853 with the event indicators of the component."""
    with HostedUnit(unpacked3) as steps, HostedExchange(unpacked3) as component:
        steps.start()
        component.run()
        events = 0
        for second in range(1, 11):
            steps.step(1.0)
            events += component.integrate(float(second), 1e-11)
            assert component.get("u") == pytest.approx(steps.get("u"), abs=1e-6 * steps.get("u_ins"))
        assert events > 10
        assert component.slave.getNumberOfEventIndicators() == component.indicator_count
        assert component.slave.getNumberOfContinuousStates() == component.state_count
    with Exchange(unpacked2) as library, HostedExchange(unpacked3) as component:
        for unit in (library, component):
            assert unit.run().integrate(3.0, 1e-9) > 1
        assert state(library) == state(component), "the same calls give the same bits"


def test_derivatives_are_those_of_the_library(unpacked2, unpacked3):
    unknowns, knowns = ["u_ddot", "restoring_force", "reaction_bottom"], ["u", "u_dot", "a_g", "a_bottom"]
    with Exchange(unpacked2) as library, HostedExchange(unpacked3) as component:
        for unit in (library, component):
            unit.run(u_start=0.12, u_dot_start=0.1)
        rows, columns = ([library.reference(name) for name in names] for names in (unknowns, knowns))
        seed = [0.5, -1.0, 2.0, 0.25]
        found = component.slave.getDirectionalDerivative(rows, columns, seed)
        assert found == library.slave.getDirectionalDerivative(rows, columns, seed)
        adjoint = [component.slave.getAdjointDerivative([row], columns, [1.0], 4) for row in rows]
        assert np.array(adjoint) @ seed == pytest.approx(found, rel=1e-14)
    with Unit(unpacked2) as library, HostedUnit(unpacked3) as component:
        for unit in (library, component):
            unit.start()
            unit.step(0.1)
        reference = [library.reference("u")]
        derivatives = library.slave.getRealOutputDerivatives(reference, [1])
        assert component.slave.getOutputDerivatives([(reference[0], 1)]) == list(derivatives)


# both ties of the second wall yield, one of them from the start on
TIE = {"tie_height": 2.0, "tie_stiffness": 3e5, "tie_strength": 3e3, "tie_ultimate": 10.0}
SHAPES = [{"u_start": 0.15}, {**TIE, "tie_side": "both", "u_start": -0.15}]


@pytest.mark.parametrize("settings", SHAPES, ids=["free", "tied"])
@pytest.mark.parametrize("there", ["to the component", "to the library"])
@pytest.mark.parametrize("kind", ["Co-Simulation", "Model Exchange"])
def test_a_state_goes_there_and_back(kind, there, settings, unpacked2, unpacked3):
    native, hosted = (Unit, HostedUnit) if kind == "Co-Simulation" else (Exchange, HostedExchange)

    def start(unit):
        if kind == "Co-Simulation":
            unit.start(**settings)
        else:
            unit.run(**settings)

    def go_on(unit, until):
        if kind == "Model Exchange":
            unit.integrate(until, 1e-8)
            return
        while unit.time < until - 1e-9:
            unit.step(0.01)

    with native(unpacked2) as library, hosted(unpacked3) as component:
        first, second = (library, component) if there == "to the component" else (component, library)
        start(first)
        go_on(first, 1.0)
        restore(second, state(first))
        second.time = first.time
        assert state(second) == state(first)
        go_on(first, 2.0)
        go_on(second, 2.0)
        assert state(second) == state(first)
        restore(first, state(second))
        go_on(first, 2.5)
        go_on(second, 2.5)
        assert state(second) == state(first)


def test_a_step_ends_early_where_the_wall_overturns(unpacked3):
    found = [until_overturning(unpacked3, {}, 0.3, True, kind) for kind in (Unit, HostedUnit)]
    assert found[0] == found[1]
    assert found[0][0], "it ends early"


def test_a_scene_finds_its_resources(fmu, fmu3, wall, tmp_path):
    made = []
    for base in (fmu, fmu3):
        made.append(tmp_path / f"{len(made)}.fmu")
        command = [wall, "package", ROOT / "scenes/shaken_parapet.toml", "-o", made[-1], "--base", base]
        subprocess.run(command, check=True, capture_output=True)
    with Unit.unpack(made[0]) as old, Unit.unpack(made[1]) as new:
        with Unit(old) as library, HostedUnit(new) as component:
            for unit in (library, component):
                unit.start()
                for _ in range(500):
                    unit.step(0.02)
            assert library.get("u_max") > 0
            assert state(library) == state(component)


def test_instances_of_one_component_share_nothing(unpacked2, unpacked3):
    token, reference = unpacked3.description.guid, {v.name: v for v in unpacked3.description.modelVariables}
    host = Host(Loaded.of(unpacked3), lambda *_: None)
    starts = (0.05, 0.1, 0.15)
    with contextlib.ExitStack() as stack:
        libraries = [stack.enter_context(Unit(unpacked2)) for _ in starts]
        slaves = [
            Slave(host, "co-simulation", name, token, "", False, False, False, False, []) for name in "aab"
        ]
        for start, library, slave in zip(starts, libraries, slaves, strict=True):
            library.start(u_start=start)
            slave.setReal([reference["u_start"].valueReference], [start])
            slave.enterInitializationMode()
            slave.exitInitializationMode()
        for _ in range(100):
            for library, slave in zip(libraries, slaves, strict=True):
                slave.doStep(library.time, 0.02)
                library.step(0.02)
        slaves[0].freeInstance()
        for library, slave in list(zip(libraries, slaves, strict=True))[1:]:
            assert slave.getReal([reference["u"].valueReference]) == [library.get("u")]


def test_a_call_from_inside_the_log_does_no_harm(unpacked3):
    answers = []

    def log(store, *_message):
        try:
            answers.append(slave.function("get-float64")(store, slave.handle, [0]))
        except WasmtimeError as refused:
            # wasmtime before 50 does not enter a component that calls out
            answers.append(str(refused))

    host = Host(Loaded.of(unpacked3), log)
    token = unpacked3.description.guid
    slave = Slave(host, "co-simulation", "a", token, "", False, True, False, False, [])
    slave.function("get-float64")
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    assert answers and set(answers) <= {"error", "wasm trap: cannot enter component instance"}
    slave.doStep(0.0, 0.01)
    assert slave.getReal([0]) == [0.01]


def test_refusals_say_why(unpacked3):
    with HostedUnit(unpacked3, logging=True, requiredIntermediateVariables=[1]) as unit:
        assert any("use set-input-derivatives" in text for _, _, text in unit.messages)
        unit.start()
        for call in (
            lambda: unit.slave.setClock([1], [True]),
            lambda: unit.slave.getFloat32([1]),
            lambda: unit.slave.setFmuState(b"FMI2stat"),
            lambda: unit.step(-1.0),
        ):
            unit.messages.clear()
            with pytest.raises(fmpy.fmi1.FMICallException):
                call()
            ((status, category, text),) = unit.messages
            assert (status, category) == ("error", "logStatusError") and ": " in text
    unit.messages.clear()
    token, unpacked3.description.guid = unpacked3.description.guid, "{0}"
    try:
        with pytest.raises(fmpy.fmi1.FMICallException):
            HostedUnit.__init__(unit, unpacked3)
    finally:
        unpacked3.description.guid = token
    assert unit.messages[0][2].startswith("instantiate-co-simulation: the guid \"{0}\" is not")


# Random calls


class Caller:
    """Calls random methods with random arguments of their types, mostly in an order that goes on."""

    ORDER = (
        "enter-initialization-mode", "exit-initialization-mode", "enter-step-mode",
        "enter-continuous-time-mode",
    )  # fmt: skip

    def __init__(self, unpacked, seed):
        self.random, self.unpacked = random.Random(seed), unpacked
        variables = unpacked.description.modelVariables
        self.references = [v.valueReference for v in variables] + [0, 1 << 30, 7777]
        self.inputs = [v.valueReference for v in variables if v.causality == "input"]
        self.served, self.states, self.methods, self.called = 0, [b""], {}, ["reset"]
        types = unpacked.component.component.type.exports(unpacked.component.engine)
        for kind in (HostedUnit, HostedExchange):
            names = types[f"fmi:fmi3/{kind.INTERFACE}@3.0.0"].ty.exports(unpacked.component.engine)
            self.methods[kind] = [name.split(".")[1] for name in names if name.startswith("[method]")]

    def run(self, calls):
        """Makes as many calls; a trap is an exception."""
        for number in range(calls):
            if number % 250 == 0:
                kind = self.random.choice([HostedUnit, HostedExchange])
                unit, self.failed = kind(self.unpacked, logging=self.random.random() < 0.1), False
            self.call(unit)

    def call(self, unit):
        methods = self.methods[type(unit)]
        usual = [name for name in self.called if name in methods]
        order = [name for name in self.ORDER if name in methods]
        name = self.random.choice(self.random.choice([methods, usual, usual, order]))
        if self.failed and self.random.random() < 0.3:
            name = "reset"
        elif name in ("terminate", "reset") and self.random.random() < 0.95:
            name = "get-fmu-state"
        function = unit.slave.function(name)
        self.name, self.count = name, self.random.choice([0, 1, 1, 1, 2, 5])
        arguments = [self.value(key, kind) for key, kind in function.type(None).params[1:]]
        if name == "do-step" and self.random.random() < 0.9:
            arguments[0] = unit.time
        answer = function(unit.slave.host.store, unit.slave.handle, *arguments)
        if isinstance(answer, bytes):
            self.states.append(answer)
        self.failed = answer == "error"
        if not self.failed:
            self.served += 1
            self.called += [] if name in self.called else [name]
            unit.time = vars(answer)["last-successful-time"] if name == "do-step" else unit.time

    def value(self, key, kind):
        """A random value of a type; that of a list has as many as the others, as a rule."""
        pick = self.random.choice
        if isinstance(kind, wit.ListType):
            if isinstance(kind.element, wit.U8) and key == "state":
                return self.damaged(pick(self.states[-20:]))
            count = self.count if self.random.random() < 0.95 else 3
            values = [self.value(key, kind.element) for _ in range(count)]
            return bytes(values) if isinstance(kind.element, wit.U8) else values
        if isinstance(kind, wit.TupleType):
            return tuple(self.value(key, element) for element in kind.elements)
        if isinstance(kind, wit.RecordType):
            record = wit.Record()
            for name, element in kind.fields:
                setattr(record, name, self.value(name, element))
            return record
        if isinstance(kind, wit.OptionType):
            return pick([None, self.value(key, kind.payload)])
        if isinstance(kind, wit.Bool):
            return pick([False, True])
        if isinstance(kind, wit.String):
            return pick(["", "logAll", "logEvents", "\0ü", "x" * 99])
        if isinstance(kind, (wit.F64, wit.F32)):
            usual = [0.0, 1e-3, 0.01, 0.05, 0.1, 0.3, -0.1, 1.0]
            odd = [float("nan"), float("inf"), -float("inf"), -0.0, 5e-324, 1e-30, 3.0, -7.5]
            return pick(usual if self.random.random() < 0.9 else odd)
        if isinstance(kind, wit.U32):
            usual = self.inputs if self.name.startswith("set-") and self.random.random() < 0.8 else None
            return pick(usual or self.references + [1, 2**32 - 1])
        return pick([0, 1, 2, 100])

    def damaged(self, saved):
        if self.random.random() < 0.7 or not saved:
            return saved
        at = self.random.randrange(len(saved))
        return saved[:at] + bytes([self.random.randrange(256)]) + saved[at + 1 :]


def test_random_calls_never_trap(unpacked3):
    Loaded.of(unpacked3)
    caller = Caller(unpacked3, 1)
    caller.run(CALLS)
    print(f"{caller.served} of {CALLS} calls were served, by {len(caller.called)} methods")
    assert caller.served > CALLS / 4 and len(caller.called) > 35
