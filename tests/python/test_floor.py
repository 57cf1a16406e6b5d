"""Tests how the floor answers importers, and that the same floor from another exporter answers alike."""

import math
import random
import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu
from lxml import etree
from scipy.integrate import solve_ivp

from conftest import ROOT
from exchange import Exchange, integrate, parapet_on_floor
from monolith import Monolith, Wall
from unit import Unit

BILINEAR = {"hysteresis": "bilinear", "yield_force": 6e4, "hardening_ratio": 0.1}
WALLS = 8
INPUTS = ["a_g", *(f"reaction_{i + 1}" for i in range(WALLS)), *(f"impulse_{i + 1}" for i in range(WALLS))]


def reals(unit, causality=None):
    """Returns the names of the Real variables."""
    return [
        variable.name
        for variable in unit.description.modelVariables
        if variable.type == "Real" and causality in (None, variable.causality)
    ]


def everything(unit):
    return [unit.get(variable.name) for variable in unit.description.modelVariables]


# --- the description and the archive


def test_fmpy_finds_nothing(floor_fmu):
    assert validate_fmu(str(floor_fmu)) == []


def test_dependencies_are_true(unpacked_floor, floor_fmu):
    """A dependency that is not listed is always zero; a listed one is non-zero in some state."""
    with zipfile.ZipFile(floor_fmu) as archive:
        xml = etree.fromstring(archive.read("modelDescription.xml"))
    names = [variable.get("name") for variable in xml.findall("ModelVariables/ScalarVariable")]
    listed = {
        names[int(unknown.get("index")) - 1]: {
            names[int(index) - 1] for index in unknown.get("dependencies").split()
        }
        for unknown in xml.findall("ModelStructure/Outputs/Unknown")
    }
    reacts = {name: set() for name in listed}
    states = ["displacement", "velocity", "base_displacement", "base_velocity", "energy_damping"]
    for settings in ({}, {"coupling": "impulses"}, {**BILINEAR, "displacement_start": 0.01}):
        with Unit(unpacked_floor) as unit:
            unit.start(velocity_start=0.1, **settings).step(0.001)
            for name in set(listed) & set(reals(unit)):
                for known in [*states, *INPUTS]:
                    reference = [unit.reference(known)]
                    if (
                        unit.slave.getDirectionalDerivative([unit.reference(name)], reference, [1.0])[0]
                        != 0.0
                    ):
                        reacts[name].add(known)
    for name in set(listed) - {"yielding"}:
        assert reacts[name] == listed[name], name
    assert listed["yielding"] == set()


# --- Model Exchange

KICKED = {"velocity_start": 0.4, "damping_ratio": 0.02, "mass": 2e4, "stiffness": 2e7}


def compare(exchange, steps, tolerance):
    """Compares the outputs, relative to accelerations of 10 m/s² at 30 rad/s and a mass of 20 t."""
    scales = {"m": 0.01, "m/s": 0.3, "m/s2": 10.0, "N": 2e5, "N.s": 2e4, "J": 2e3}
    for name in set(reals(steps, "output")) - {"impulse_bottom"}:
        bound = tolerance * scales[steps.variables[name].unit]
        assert exchange.get(name) == pytest.approx(steps.get(name), abs=bound), (name, steps.time)
    assert exchange.get("yielding") == steps.get("yielding")


@pytest.mark.parametrize("settings", [{}, BILINEAR, {**BILINEAR, "hardening_ratio": 0.0}])
def test_model_exchange_agrees_with_co_simulation(unpacked_floor, settings):
    def inputs(time):
        return {"a_g": 6.0 * math.sin(40 * math.floor(time * 20) / 20), "reaction_3": 2e4 - 3e4 * time}

    with Unit(unpacked_floor) as steps, Exchange(unpacked_floor) as exchange:
        steps.start(**KICKED, **settings)
        exchange.run(**KICKED, **settings)
        events = 0
        for index in range(40):
            held = inputs(index / 20 + 0.01)["a_g"]
            steps.set(a_g=held, reaction_3=inputs(index / 20)["reaction_3"])
            steps.rates(reaction_3=-3e4)
            steps.step(0.05)
            events += exchange.integrate(
                (index + 1) / 20, 1e-12, lambda t: {"a_g": held, "reaction_3": inputs(t)["reaction_3"]}
            )
            # DOP853 at 1e-12, some 10⁴ evaluations
            compare(exchange, steps, 1e-8)
        assert (steps.get("energy_hysteretic") > 1e3) == (events > 50) == bool(settings)


@pytest.mark.parametrize("settings", [{}, BILINEAR])
def test_fmpy_integrates_the_floor(unpacked_floor, settings):
    values = {**KICKED, **settings, **({"hysteresis": 2} if settings else {})}
    names = ["displacement", "velocity", "energy_damping", "energy_hysteretic"]
    steps, exchange = (
        simulate_fmu(
            unpacked_floor.folder, model_description=unpacked_floor.description, fmi_type=kind,
            start_values=values, stop_time=2.0, output_interval=0.01, relative_tolerance=1e-8, output=names,
            record_events=False,
        )
        for kind in ("CoSimulation", "ModelExchange")
    )  # fmt: skip
    # CVODE admits an error of its tolerance at each of some 10³ steps
    for name in names:
        assert np.abs(steps[name] - exchange[name]).max() < 1e-5 * np.abs(steps[name]).max() + 1e-12, name


def test_a_state_of_model_exchange_resumes_bit_for_bit(unpacked_floor):
    with Exchange(unpacked_floor) as first, Exchange(unpacked_floor) as second:
        first.run(**KICKED, **BILINEAR)
        first.integrate(0.02, 1e-8)
        assert first.get("yielding") and first.get("energy_hysteretic") > 0
        state = first.slave.getFMUState()
        second.slave.setFMUState(second.slave.deserializeFMUState(first.slave.serializeFMUState(state)))
        second.time = first.time
        for instance in (first, second):
            instance.integrate(1.0, 1e-8)
        assert everything(first) == everything(second)


def test_what_model_exchange_refuses(unpacked_floor):
    with Exchange(unpacked_floor) as exchange:
        with pytest.raises(Exception, match="fmi2ExitInitializationMode"):
            exchange.start(coupling="impulses")
        assert any("coupling" in text and "reactions" in text for _, _, text in exchange.messages)


def test_a_wall_and_a_floor_are_integrated_together(unpacked, unpacked_floor):
    """Agrees with the same system integrated as one, corners of the law included."""
    parapet = {"height": 1.5, "thickness": 0.3, "a1": 0.05, "xi": 0.03, "u_start": 0.12}
    storey = {"mass": 2e3, "stiffness": 8e5, "damping_ratio": 0.02, "displacement_start": 0.01}
    with Exchange(unpacked) as wall, Exchange(unpacked_floor, "floor") as floor:
        wall.run(**parapet, damping_model="constant_coefficient")
        floor.run(**storey)
        times = 0.05 * np.arange(1, 41)
        truth = Monolith([storey], [Wall(parapet, 0)]).solve(times)
        found, events = [], 0
        for time in times:
            events += integrate([wall, floor], time, 1e-10, parapet_on_floor(wall, floor))
            found.append([floor.get("displacement"), wall.get("u")])
    assert events > 20, "it rocks"
    # DOP853 at 1e-10 through the corners
    print(f"error {np.abs(found - truth[:, :2]).max():.1e} m, {events} events")
    assert np.abs(found - truth[:, :2]).max() < 1e-7


# --- states, errors


def shaken(unit, steps, seed):
    source = random.Random(seed)
    for _ in range(steps):
        unit.set(a_g=source.uniform(-8, 8), reaction_4=source.uniform(-1e5, 1e5))
        unit.rates(a_g=source.uniform(-100, 100))
        unit.step(source.choice([1e-3, 0.01, 0.0371]))
    return unit


def test_the_log(unpacked_floor):
    with Unit(unpacked_floor, logging=False) as unit:
        shaken(unit.start(**BILINEAR), 20, 5)
        assert unit.messages == []
    with Unit(unpacked_floor, logging=True) as unit:
        unit.start(stiffness=0.0, impulse_1=1.0).step(0.1)
        warnings = [text for _, category, text in unit.messages if category == "logStatusWarning"]
        assert len(warnings) == 2 and "damping_coefficient" in warnings[0] and "coupling" in warnings[1]
    with Unit(unpacked_floor, logging=True) as unit:
        unit.start(velocity_start=1.0, **BILINEAR).step(1.0)
        assert any(category == "logEvents" and "corners" in text for _, category, text in unit.messages)


# --- with walls, other floors and another exporter


TIE = {"tie_height": 3.0, "tie_stiffness": 2e5, "tie_strength": 500.0, "tie_side": "negative"}


@pytest.mark.parametrize("tie", [{}, {**TIE, "tie_ultimate": 10.0}, {**TIE, "tie_ultimate": 0.0}])
def test_a_wall_and_a_floor_keep_their_momentum(unpacked, unpacked_floor, tie):
    """A floor on rollers loses, one step later, the momentum that a rocking parapet with impacts gained, also
    where its tie yields or breaks."""
    mass, step = 3000.0, 0.002
    with Unit(unpacked) as wall, Unit(unpacked_floor) as floor:
        rigid = {"impact": "restitution", "damping_model": "none", "force_law": "rigid_linear"}
        wall.start(u_start=0.05, **rigid, **tie)
        floor.start(mass=mass, stiffness=0.0, damping_ratio=0.0, coupling="impulses")
        given, largest = 0.0, 0.0
        for _ in range(2000):
            impulse = wall.get("impulse_bottom")
            wall.set(a_bottom=floor.get("acceleration_absolute"))
            floor.set(impulse_1=impulse)
            wall.step(step)
            floor.step(step)
            given += impulse
            momentum = mass * floor.get("velocity")
            largest = max(largest, abs(momentum))
            # 2000 additions
            assert abs(momentum + given) <= 1e-12 * max(1.0, largest)
        assert largest > 10.0
        assert wall.get("u_max") == pytest.approx(0.05)
        if tie:
            assert wall.get("tie_broken") == (tie["tie_ultimate"] == 0.0)
            assert wall.get("tie_broken") or wall.get("tie_elongation_negative") > 1e-3


def test_storeys_stack(unpacked_floor):
    """Two floors coupled by impulses approach the two-mass building for small steps."""
    mass, stiffness, stop = 2e4, 2e7, 0.3
    matrix = np.array([[2.0, -1.0], [-1.0, 1.0]]) * stiffness / mass

    def rates(_, y):
        return [*y[2:], *(-matrix @ y[:2])]

    wanted = solve_ivp(rates, (0, stop), [0.01, 0.01, 0, 0], "DOP853", rtol=1e-12, atol=1e-14).y[:2, -1]
    errors = []
    for count in (600, 1200):
        step = stop / count
        with Unit(unpacked_floor) as low, Unit(unpacked_floor) as high:
            low.start(displacement_start=0.01, damping_ratio=0.0, coupling="impulses")
            high.start(damping_ratio=0.0, coupling="impulses")
            for _ in range(count):
                low.set(impulse_1=high.get("impulse_bottom"))
                low.step(step)
                # mean acceleration of the storey below over its last step
                high.set(a_g=low.get("acceleration_absolute"))
                high.step(step)
            errors.append(abs(low.get("displacement") - wanted[0]))
    # first order, because the impulses act one step late
    assert errors[0] < 1e-3 and 1.7 < errors[0] / errors[1] < 2.3, errors


@pytest.fixture(scope="module")
def partner_fmu(tmp_path_factory):
    folder = tmp_path_factory.mktemp("partner")
    source = shutil.copy(ROOT / "tests/python/partner_floor.py", folder / "partner_floor.py")
    subprocess.run(
        [sys.executable, "-m", "pythonfmu", "build", "-f", source, "-d", folder],
        check=True,
        capture_output=True,
    )
    return folder / "PartnerFloor.fmu"


@pytest.mark.parametrize("coupling", ["reactions", "impulses"])
def test_another_exporters_floor_gives_the_same_answer(partner_fmu, unpacked_floor, coupling):
    parameters = {"displacement_start": 0.004, "velocity_start": -0.1, "damping_ratio": 0.03, "mass": 1.5e4}
    source = random.Random(11)
    push = {"reactions": ("reaction_1", 5e4), "impulses": ("impulse_1", 5e2)}[coupling]
    with Unit.unpack(partner_fmu) as unpacked, Unit(unpacked) as partner, Unit(unpacked_floor) as floor:
        floor.start(coupling=coupling, **parameters)
        partner.start(**parameters)
        largest, apart = 0.0, 0.0
        for _ in range(500):
            inputs = {"a_g": source.uniform(-5, 5), push[0]: push[1] * source.uniform(-1, 1)}
            for unit in (partner, floor):
                unit.set(**inputs).step(0.01)
            names = ("displacement", "velocity", "acceleration", "acceleration_absolute")
            ours, theirs = floor.get(*names), partner.get(*names)
            largest = max(largest, abs(ours[0]))
            apart = max(apart, abs(ours[0] - theirs[0]))
            # the error of the matrix exponential is about 1e-14 per step
            assert ours == pytest.approx(theirs, rel=1e-9, abs=1e-9)
        assert apart < 1e-12 * 500 * largest
