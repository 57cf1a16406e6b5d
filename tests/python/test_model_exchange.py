"""Tests Model Exchange: other solvers agree with co-simulation, and corners do not slow them down."""

import contextlib
import math
import random
import subprocess

import casadi
import numpy as np
import pytest
from fmpy import instantiate_fmu, simulate_fmu
from fmpy.fmi2 import FMU2Model
from fmpy.sundials import CVodeSolver
from fmpy.validation import validate_fmu

from conftest import ROOT
from exchange import Exchange
from unit import Unit

TOLERANCE = 1e-8
OUTPUTS = ["u", "u_dot", "u_max", "overturned", "overturn_time"]
RIGID = {"force_law": "rigid_linear", "damping_model": "none", "impact": "restitution"}
TIE = {"tie_height": 2.0, "tie_stiffness": 3e5, "tie_slack": 0.01, "tie_strength": 3e3}
YIELDING = {**TIE, "tie_ultimate": 0.05, "tie_side": "both", "u_start": 0.0}
STRIP = {"mechanism": "vertical_spanning", "thickness": 0.1, "u_start": 0.08}
# A relative change of gravity; it shows how a relative error of the equation changes the history.
NUDGE = 1e-7
# A solver admits an error of its tolerance at each evaluation. The sum is at most the number of evaluations
# times the response to a lasting error of the same size. Errors at the worst place count up to four times as
# much.
WORST_PLACE = 4.0


class Counted:
    """Runs FMPy's CVODE on an FMU and counts the calls."""

    def __init__(self, folder, description, settings, stop, tolerance=TOLERANCE, **options):
        self.evaluations = self.events = 0
        model = instantiate_fmu(folder, description, "ModelExchange")
        self._count(model, "getDerivatives", "evaluations")
        self._count(model, "newDiscreteStates", "events")
        try:
            self.history = simulate_fmu(
                folder, model_description=description, fmu_instance=model, fmi_type="ModelExchange",
                stop_time=stop, relative_tolerance=tolerance, start_values=numbers(description, settings),
                output=OUTPUTS, output_interval=0.01, record_events=False, **options,
            )  # fmt: skip
        finally:
            model.freeInstance()

    def _count(self, model, method, counter):
        original = getattr(model, method)

        def counted(*arguments):
            setattr(self, counter, getattr(self, counter) + 1)
            return original(*arguments)

        setattr(model, method, counted)


def numbers(description, settings):
    items = {
        kind.name: {item.name: int(item.value) for item in kind.items}
        for kind in description.typeDefinitions
        if kind.items
    }
    kinds = {
        variable.name: variable.declaredType.name
        for variable in description.modelVariables
        if variable.declaredType
    }
    return {
        name: items[kinds[name]][value] if isinstance(value, str) else value
        for name, value in settings.items()
    }


def co_simulation(folder, description, settings, stop, **options):
    return simulate_fmu(
        folder, model_description=description, fmi_type="CoSimulation", stop_time=stop, output=OUTPUTS,
        start_values=numbers(description, settings), output_interval=0.01, **options,
    )  # fmt: skip


def distance(first, second):
    assert np.allclose(first["time"], second["time"], rtol=0, atol=1e-9)
    return float(np.abs(first["u"] - second["u"]).max())


def agree(folder, description, settings, stop, **options):
    """Compares Model Exchange with co-simulation; returns the history of CVODE's run and the counters."""
    steps = co_simulation(folder, description, settings, stop, **options)
    nudged = co_simulation(folder, description, {**settings, "gravity": 9.81 * (1 + NUDGE)}, stop, **options)
    sensitivity = distance(steps, nudged) / NUDGE
    run = Counted(folder, description, settings, stop, **options)
    error, bound = distance(run.history, steps), WORST_PLACE * TOLERANCE * run.evaluations * sensitivity
    print(f"error {error:.1e} m of {bound:.1e} m, {run.evaluations} evaluations, {run.events} events")
    assert error < bound
    last, expected = run.history[-1], steps[-1]
    assert last["u_max"] == pytest.approx(expected["u_max"], abs=bound)
    assert last["overturned"] == expected["overturned"]
    return run, steps


@pytest.mark.parametrize(
    ("settings", "stop"),
    [
        ({}, 30.0),
        (STRIP, 10.0),
        ({"damping_model": "stiffness_proportional"}, 30.0),
        ({"force_law": "trilinear", "damping_model": "constant_coefficient"}, 20.0),
        ({"impact": "restitution", "damping_model": "none"}, 20.0),
        (RIGID, 30.0),
        ({"u_start": 0.19, "u_dot_start": 0.3}, 3.0),
        ({"u_start": 0.19, "u_dot_start": 0.3, "a3": 0.9, "damping_model": "stiffness_proportional"}, 3.0),
        ({**STRIP, "overburden": 3000.0, "overburden_eccentricity": 0.02, "u_start": -0.05}, 6.0),
        ({**TIE, "tie_ultimate": 10.0, "tie_side": "both", "u_start": -0.1}, 10.0),
        ({**TIE, "tie_ultimate": 0.02, "u_start": -0.1}, 10.0),
    ],
    ids=[
        "default",
        "CDR strip",
        "SDR",
        "trilinear",
        "elastic impacts",
        "rigid",
        "overturning",
        "overturning SDR",
        "two sides",
        "ties that yield",
        "a tie that breaks",
    ],
)
def test_agrees_with_co_simulation(unpacked, settings, stop):
    run, steps = agree(unpacked.folder, unpacked.description, settings, stop)
    if steps["overturned"][-1]:
        # an error of u changes the time of overturning by u over the velocity there, 0.3 m/s or more
        assert run.history["overturn_time"][-1] == pytest.approx(steps["overturn_time"][-1], abs=1e-6)
        assert run.history["u_dot"][-1] == 0.0


@pytest.mark.parametrize(
    "settings", [{}, STRIP, {"force_law": "trilinear", "damping_model": "constant_coefficient"}, RIGID]
)
def test_agrees_where_only_reported_changes_restart_the_solver(unpacked, settings, restarts_if_reported):
    agree(unpacked.folder, unpacked.description, settings, 10.0)


@pytest.fixture
def restarts_if_reported(monkeypatch):
    """Lets FMPy restart CVODE only after events that report changed states, as some importers do."""
    reported = []
    original = FMU2Model.newDiscreteStates, CVodeSolver.reset

    def update(model):
        information = original[0](model)
        reported.append(information[3])
        return information

    def reset(solver, time):
        if any(reported):
            original[1](solver, time)
        reported.clear()

    monkeypatch.setattr(FMU2Model, "newDiscreteStates", update)
    monkeypatch.setattr(CVodeSolver, "reset", reset)


def test_explicit_steps_of_the_default_length_do_not_overturn_the_wall(unpacked):
    experiment = unpacked.description.defaultExperiment
    step, stop = float(experiment.stepSize), float(experiment.stopTime)
    assert (1 / step).is_integer(), "it divides the stop times that people write"
    history = simulate_fmu(
        unpacked.folder, model_description=unpacked.description, fmi_type="ModelExchange", solver="Euler",
        step_size=step, output_interval=step, stop_time=stop, output=OUTPUTS,
    )  # fmt: skip
    assert not history["overturned"][-1] and abs(history["u"][-1]) < 0.25 * history["u"][0]


def test_the_log_names_no_solver(unpacked):
    with Exchange(unpacked, logging=True) as exchange:
        exchange.run()
        assert exchange.messages and not any("solver" in text for _, _, text in exchange.messages)


def test_corners_do_not_slow_the_solver(unpacked):
    """An event costs CVODE a restart, however sharp the corner: 100 to 180 evaluations at 1e-8."""
    for a1 in (0.1, 1e-2, 1e-3, 1e-4):
        settings = {"a1": a1, "xi": 0.05}
        run = Counted(unpacked.folder, unpacked.description, settings, 10.0)
        print(f"a1 = {a1}: {run.evaluations} evaluations, {run.events} events")
        assert run.events > 10
        assert run.evaluations < 200 * run.events


@pytest.mark.parametrize(
    "settings", [{}, {"overburden": 5000.0, "overburden_eccentricity": 0.05}], ids=["alike", "two sides"]
)
def test_bounces_found_exactly_end_in_rest(unpacked, settings):
    """With impacts located to rounding, no solver error ends the bounces: energy falls by e² at each."""
    with Exchange(unpacked) as exchange:
        exchange.run(**RIGID, **settings, u_start=0.02)
        e, scale = exchange.get("restitution_used", "u_ins_negative")
        count = exchange.integrate(10.0, 1e-8)
        assert exchange.states() == exchange.derivatives() == [0.0, 0.0]
        # a bounce of the height h is followed by one of the height e² h, down to 4e-12 u_ins
        assert count < math.log(4e-12 * scale / 0.02) / math.log(e**2) + 10


def record():
    noise = np.random.default_rng(3)
    time = np.arange(0, 8, 0.01)
    shape = np.convolve(noise.normal(size=time.size), np.ones(8) / 8, "same") * np.exp(-((time - 3) ** 2) / 3)
    return time, 5.0 * shape


def test_a_record_through_a_g(unpacked):
    time, motion = record()
    signal = np.array(list(zip(time, motion, strict=True)), dtype=[("time", float), ("a_g", float)])
    _, steps = agree(unpacked.folder, unpacked.description, {"u_start": 0.0, "a1": 0.1}, 8.0, input=signal)
    assert np.abs(steps["u"]).max() > 0.01, "it rocks"


@pytest.fixture(scope="module")
def scenes(fmu, wall, tmp_path_factory):
    """Makes the FMU of a scene with its record inside, and unpacks it."""
    folder = tmp_path_factory.mktemp("exchange")
    with contextlib.ExitStack() as opened:

        def package(name):
            path = folder / f"{name}.fmu"
            command = [wall, "package", ROOT / f"scenes/{name}.toml", "-o", path, "--base", fmu]
            subprocess.run(command, check=True, capture_output=True)
            assert validate_fmu(str(path)) == []
            return opened.enter_context(Unit.unpack(path))

        yield package


@pytest.mark.parametrize(
    ("name", "stop"), [("shaken_parapet", 8.0), ("rigid_block", 5.0), ("quadrilinear_strip", 2.0)]
)
def test_a_scene_plays_its_own_record(scenes, name, stop):
    scene = scenes(name)
    run, steps = agree(scene.folder, scene.description, {}, stop)
    assert np.abs(steps["u"]).max() > 0.003, "it rocks"
    # the samples, 0.01 s apart or less, are events, so that no step crosses a kink
    assert run.events > 400


def test_a_scenes_record_restarts_a_solver_that_restarts_only_if_told(scenes, restarts_if_reported):
    scene = scenes("rigid_block")
    agree(scene.folder, scene.description, {}, 5.0)


def corners(points):
    """Returns a function that is linear between points (time, value)."""
    times, values = zip(*points, strict=True)
    return lambda time: float(np.interp(time, times, values))


def test_supports_that_move(unpacked):
    """Compares a solver that sets inputs at every evaluation with co-simulation with the same slopes."""
    pieces = {
        "a_bottom": [(0, 0.0), (0.5, 1.4), (1.0, -1.75), (1.5, 0.7), (3.0, 0.0)],
        "a_top": [(0, 0.0), (0.5, 0.7), (1.0, -1.05), (1.5, -0.7), (3.0, 0.0)],
        "drift": [(0, 0.0), (0.5, 0.01), (1.0, -0.02), (1.5, 0.0), (3.0, 0.005)],
    }
    motions = {name: corners(points) for name, points in pieces.items()}

    def inputs(time):
        return {name: motion(time) for name, motion in motions.items()}

    settings = {**STRIP, "u_start": 0.0, "a1": 0.05}
    # 10⁴ evaluations at 1e-11, and a factor of 20 for the growth of errors over 3 s; on the elastic branch
    # 0.1 m of u corresponds to 0.5 m/s of u̇ and 30 m/s² of ü, and the mass is 720 kg
    bounds = {"u": 2e-7, "u_dot": 1e-6, "reaction_bottom": 2e-2, "reaction_top": 2e-2, "u_max": 2e-7}
    with Unit(unpacked) as steps, Exchange(unpacked) as exchange:
        steps.start(**settings)
        exchange.run(**settings)
        for time in np.arange(0.0, 3.0, 0.1):
            start, end = inputs(time), inputs(time + 0.1)
            steps.set(**start)
            steps.rates(**{name: (end[name] - start[name]) / 0.1 for name in motions})
            steps.step(0.1)
            exchange.integrate(time + 0.1, 1e-11, inputs)
            for (name, bound), found, expected in zip(
                bounds.items(), exchange.get(*bounds), steps.get(*bounds), strict=True
            ):
                assert found == pytest.approx(expected, abs=bound), (name, time)
        assert 0.01 < steps.get("u_max") < 0.1, "it rocks and stands"


def test_no_indicator_stays_at_zero_after_an_event(unpacked):
    """After an event at a random point, every indicator is away from zero and time and states are as set."""
    noise = random.Random(5)
    for settings in ({}, RIGID, {**STRIP, "impact": "restitution"}, {"force_law": "trilinear"}, YIELDING):
        with Exchange(unpacked) as exchange:
            exchange.run(**settings)
            scale = exchange.get("u_ins")
            places = [0.0, 0.03 * scale, -0.03 * scale, scale, 2.0, -2.0, 1.0]
            for step in range(500):
                place = (
                    noise.choice(places)
                    + noise.choice([0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-4, -1e-4]) * scale
                )
                exchange.at(0.01 * step, [place, noise.choice([0.0, 1e-9, -1e-9, 0.1, -0.1])])
                exchange.set(a_bottom=noise.uniform(-4, 4))
                exchange.event()
                assert min(exchange.indicators()) > 4e-13, (settings, step)
                before = exchange.states()
                assert not exchange.event(), "a second event finds nothing to change"
                assert exchange.states() == before
            assert all(map(math.isfinite, exchange.states() + exchange.derivatives()))


def test_a_g_acts_at_once(unpacked):
    """FMI 2.0 forbids setting a discrete input between events, but FMPy and PyFMI do so."""
    with Exchange(unpacked) as exchange:
        exchange.run(u_start=0.0)
        exchange.set(a_g=1.0)
        assert exchange.derivatives() == [0.0, -0.75]
        assert exchange.slave.completedIntegratorStep() == (False, False)
        assert exchange.event(), "a solver that restarts only if told restarts"
        assert exchange.derivatives() == [0.0, -0.75]
        assert not exchange.event()


def test_a_g_set_at_every_evaluation(unpacked):
    """PyFMI sets all inputs so, linear between samples: the motion is that of a_bottom with slopes."""
    motion = corners([(0, 0.0), (0.5, 2.0), (1.0, -2.5), (1.5, 1.0), (2.0, 0.0)])
    settings = {"u_start": 0.0, "a1": 0.05}
    with Unit(unpacked) as steps, Exchange(unpacked) as exchange:
        steps.start(**settings)
        exchange.run(**settings)
        events = 0
        for time in np.arange(0.0, 3.0, 0.1):
            steps.set(a_bottom=motion(time))
            steps.rates(a_bottom=(motion(time + 0.1) - motion(time)) / 0.1)
            steps.step(0.1)
            events += exchange.integrate(time + 0.1, 1e-11, lambda now: {"a_g": motion(now)})
            assert exchange.states()[0] == pytest.approx(steps.get("u"), abs=2e-7), time
        assert steps.get("u_max") > 0.005, "it rocks"
        assert events < 100


def test_casadi_evaluates_the_derivative(unpacked):
    """CasADi's DaeBuilder sets the states like inputs in Event Mode and gets the derivatives there."""
    model = casadi.DaeBuilder("wall", str(unpacked.folder), {})
    assert (model.x(), model.u()) == (["u", "u_dot"], ["a_bottom", "a_top", "drift"])
    derivative = model.create("derivative", ["x", "u"], ["ode"])
    jacobian = derivative.factory("jacobian", ["x", "u"], ["jac:ode:x", "jac:ode:u"])
    for u, u_dot, a in [
        (0.18, 0.0, 0.0),
        (0.1, 0.2, 1.0),
        (0.003, 0.1, 0.5),
        (-0.05, -0.2, -1.0),
        (0.199, 0.0, 0.0),
    ]:
        with Unit(unpacked) as unit:
            unit.start(u_start=u, u_dot_start=u_dot, a_bottom=a)
            assert derivative([u, u_dot], [a, 0, 0]).full().ravel().tolist() == unit.get("u_dot", "u_ddot")
            by_state, by_input = (part.full() for part in jacobian([u, u_dot], [a, 0, 0]))
            knowns = [unit.reference(name) for name in ("u", "u_dot", "a_bottom")]
            expected = [
                unit.slave.getDirectionalDerivative([unit.reference("u_ddot")], [known], [1.0])[0]
                for known in knowns
            ]
            # CasADi scales its seeds
            assert [*by_state[1], by_input[1][0]] == pytest.approx(expected, rel=1e-14)
