"""Tests walls on floors.

Coupled runs are compared with the same system integrated as one. Further tests cover the limits of explicit
masters, impulses and overturning.
"""

import math
import sys

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from conftest import ROOT
from exchange import Exchange, integrate, parapet_on_floor
from monolith import Monolith, Wall
from two_body import rod_energy

sys.path[:0] = [str(ROOT / "examples/coupling"), str(ROOT / "tests/coupling")]
import compiled  # noqa: E402
from master import CLOSED, SCHEMES, Archive, System, Unit  # noqa: E402
from run import pulse  # noqa: E402
from wiring import (  # noqa: E402
    BUILDING,
    FLOOR,
    STOREYS,
    WALL,
    WALL_ON_FLOOR,
    WALLS,
    building,
    by_impulses,
    wall_on_floor,
)

GRID = 0.01
LINEAR = [name for name in SCHEMES if name.endswith("linear")]


@pytest.fixture(scope="module")
def archives(fmu, floor_fmu):
    with Archive(fmu) as wall, Archive(floor_fmu) as floor:
        yield wall, floor


def grid(duration):
    return GRID * np.arange(1, round(duration / GRID) + 1)


def run(system, scheme, step, duration, watched):
    """Returns the watched variables at multiples of GRID, one row per time."""
    system.initialize()
    often, history = round(GRID / step), []
    for index in range(1, round(duration / step) + 1):
        SCHEMES[scheme](system, step)
        if index % often == 0:
            history.append([system.get(name) for name in watched])
    return np.array(history)


def slope(steps, errors):
    """Returns the observed order, by regression of log error on log step."""
    return np.polyfit(np.log(steps), np.log(errors), 1)[0]


def test_model_exchange_is_what_small_steps_approach(archives, unpacked, unpacked_floor):
    """A wall on a floor that yields, integrated together: coupled runs approach it.

    Corners of the hysteresis inside a step reduce their order from 2 to about 1.5.
    """
    changes = {"hysteresis": "bilinear", "yield_force": 4e4, "hardening_ratio": 0.1, "velocity_start": 0.4}
    with Exchange(unpacked) as wall, Exchange(unpacked_floor, "floor") as floor:
        wall.run(**WALL)
        floor.run(**FLOOR | changes)
        truth = []
        for time in grid(1.0):
            integrate([wall, floor], time, 1e-10, parapet_on_floor(wall, floor))
            truth.append([floor.get("displacement"), wall.get("u")])
        assert floor.get("energy_hysteretic") > 100 and wall.get("u_max") > 2 * 0.05 * wall.get("u_ins")
    peaks, errors, steps = np.abs(truth).max(axis=0), [], [0.005, 0.00125, 0.0003125]
    for step in steps:
        system = wall_on_floor(*archives, changes={"floor": changes})
        found = run(system, "Jacobi, loop closed, linear", step, 1.0, ["floor.displacement", "wall.u"])
        errors.append((np.abs(found - truth) / peaks).max())
    assert errors[0] > 4 * errors[1] > 16 * errors[2], errors
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("ultimate", [10.0, 0.02], ids=["yields", "breaks"])
def test_a_tied_wall_and_its_floor_keep_their_energy(unpacked, unpacked_floor, ultimate):
    """Without damping and impacts, what the floor gives the wall stretches the tie: to 1e-10 of the whole."""
    tie = {"tie_height": 1.2, "tie_stiffness": 2e5, "tie_strength": 800.0, "tie_ultimate": ultimate}
    rigid = {"force_law": "rigid_linear", "damping_model": "none", "height": 1.2, "thickness": 0.3}
    floor_starts = {"mass": 5e3, "stiffness": 5e5, "damping_ratio": 0.0, "velocity_start": 0.5}
    with Exchange(unpacked) as wall, Exchange(unpacked_floor, "floor") as floor:
        wall.run(**rigid, **tie, u_start=0.0)
        floor.run(**floor_starts)
        mass, f0, u_ins = wall.get("mass", "F0", "u_ins")

        def energy():
            (x, v), (u, u_dot) = floor.states()[:2], wall.states()
            force, p = wall.get("tie_force", "tie_elongation")
            stored = (force**2 + (800.0**2 if wall.get("tie_broken") else 0.0)) / 2e5 / 2
            potential = f0 * abs(u) * (1 - abs(u) / u_ins / 2) + 5e5 * x * x / 2
            # the foot of the wall moves with the floor
            return 5e3 * v * v / 2 + rod_energy(mass, v, v + 2 * u_dot) + potential + stored + 800.0 * p

        first = energy()
        for time in grid(1.0):
            integrate([wall, floor], time, 1e-12, parapet_on_floor(wall, floor))
            assert energy() == pytest.approx(first, rel=1e-10), time
        assert wall.get("tie_elongation") > 1e-3 and wall.get("tie_broken") == (ultimate < 1.0)


DURATION = 1.0
SHAPES = {
    "wall on floor": (
        wall_on_floor,
        ["floor.displacement", "wall.u"],
        lambda: Monolith([FLOOR], [Wall(WALL, 0)], pulse),
    ),
    "building": (
        building,
        ["floor_1.displacement", "floor_2.displacement", "strip.u", "parapet.u"],
        lambda: Monolith(
            STOREYS.values(), [Wall(WALLS["strip"], 0, 1, drift=True), Wall(WALLS["parapet"], 1)], pulse
        ),
    ),
}


@pytest.fixture(scope="module")
def truths():
    found = {}
    for shape, (_, watched, monolith) in SHAPES.items():
        model = monolith()
        found[shape] = model.solve(grid(DURATION))[:, : len(watched)]
        for wall, column in zip(model.walls, range(model.n, len(watched))):
            # all walls rock beyond the corner of their law: the schemes must cope with it
            assert wall.u1 < np.abs(found[shape][:, column]).max() < 0.7 * wall.u_ins
    return found


@pytest.mark.parametrize("shape", SHAPES)
def test_errors_fall_at_the_schemes_order(archives, truths, shape):
    """Held inputs have order 1, linear inputs order 2, compared with the system integrated as one."""
    make, watched, _ = SHAPES[shape]
    truth = truths[shape]
    peaks = np.abs(truth).max(axis=0)
    steps = [0.01, 0.005, 0.0025, 0.00125][0 if shape == "wall on floor" else 1 :]
    orders = {}
    # the wall on a floor shows held inputs, the building what more floors and walls add
    for scheme in SCHEMES if shape == "wall on floor" else LINEAR:
        errors = []
        for step in steps:
            found = run(make(*archives, motion=pulse), scheme, step, DURATION, watched)
            errors.append((np.abs(found - truth) / peaks).max())
        orders[scheme] = slope(steps, errors)
        # the corners of the law fall anywhere within a step, which scatters the errors by some ten per cent
        assert abs(orders[scheme] - (2 if scheme in LINEAR else 1)) < 0.25, (scheme, errors)
        assert errors[-1] < (3e-3 if scheme in LINEAR else 2e-1), scheme
    assert abs(orders["iterated, linear"] - 2) < 0.1
    for linear in LINEAR if shape == "wall on floor" else []:
        gained = orders[linear] - orders[linear.replace("linear", "held")]
        assert 0.7 < gained < 1.3, (linear, gained)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("newton", [True, False])
def test_iteration_closes_the_interface(archives, shape, newton):
    """At the end of every step, inputs equal the connected outputs to 1e-8 of the nominal value."""
    system = SHAPES[shape][0](*archives, motion=pulse)
    system.initialize()
    sweeps = []
    for _ in range(500):
        system.iterated(0.002, newton=newton)
        assert np.all(np.abs(system.outputs() - system.values) <= CLOSED * system.scale)
        sweeps.append(system.sweeps)
    # each plain sweep reduces the error by the gain of the loop, below 0.1 here
    assert max(sweeps) <= (5 if newton else 12)


@pytest.mark.parametrize("ratio", [1.0, 10.0])
def test_heavy_walls_on_stiff_floors(archives, ratio):
    """On a 50 Hz floor, walls of 1 and 10 floor masses are stable and of order 2 with both schemes."""
    mass = Wall(WALL, 0).mass / ratio
    floor = {"mass": mass, "stiffness": mass * (2 * math.pi * 50) ** 2, "damping_ratio": 0.05}
    truth = Monolith([floor], [Wall(WALL, 0)], pulse).solve(grid(1.0))[:, 1:2]
    for scheme in ("Jacobi, loop closed, linear", "iterated, linear"):
        steps, errors = [0.005, 0.0025, 0.00125], []
        for step in steps:
            found = run(wall_on_floor(*archives, {"floor": floor}, pulse), scheme, step, 1.0, ["wall.u"])
            errors.append(np.abs(found - truth).max() / np.abs(truth).max())
        assert errors[0] < 0.01 and 1.6 < slope(steps, errors) < 2.4, (scheme, errors)
    # an explicit master has a gain of ratio/4; above 1 its values grow until an input refuses them
    system = wall_on_floor(*archives, {"floor": floor}, pulse)
    if ratio > 4:
        with pytest.raises(FMICallException):
            run(system, "Jacobi, linear", 0.00125, 1.0, ["wall.u"])
    else:
        found = run(system, "Jacobi, linear", 0.00125, 1.0, ["wall.u"])
        assert np.abs(found).max() <= 3 * np.abs(truth).max()


# --- the limits of explicit masters

RIGID = {"force_law": "rigid_linear", "damping_model": "none"}
STRIP = {"mechanism": "vertical_spanning", "hinge_ratio": 0.5}
# reaction of a wall for a unit acceleration of its floor, over its mass
ANSWERS = {
    "rocking parapet": ({}, 1 / 4),
    "rigid parapet at rest": (RIGID, 1.0),
    "rocking strip": (STRIP, 7 / 48),
    # at rest the toe moves with the force: m/3, and b/2 of F/F0 over h
    "rigid strip at rest": (STRIP | RIGID, 1 / 3 + 1 / 16),
}


def echo(archives, kind, gain, scheme, steps):
    """Pushes a free floor; returns the error of its acceleration over that of the push, step by step.

    The push reaches the wall, whose reaction returns multiplied by `gain`. 200 steps are 20 us; springs of 60
    rad/s add (60 * 2e-5)^2 = 1e-6 in this time. At 1e-3 m/s2 the rigid walls stay at rest.
    """
    wall, answer = ANSWERS[kind]
    mass, push = 3.0 * 0.3 * 1800 * answer / gain, 1e-3
    free = {"mass": mass, "stiffness": 0.0, "damping_ratio": 0.0}
    system = wall_on_floor(*archives, {"floor": free, "wall": {"xi": 0.0} | wall})
    system.initialize()
    system.units["floor"].set("reaction_2", -push * mass)
    found = []
    for _ in range(steps):
        SCHEMES[scheme](system, 1e-7)
        found.append(system.get("floor.acceleration_absolute") / push - 1 / (1 + gain))
    return np.abs(found)


@pytest.mark.parametrize("kind", ANSWERS)
def test_the_gain_of_an_explicit_master(archives, kind):
    """An error returns multiplied by the gain, after two steps of Jacobi or one of Gauss-Seidel."""
    for gain in (0.98, 1.02):
        for scheme, round_trip in [("Jacobi, held", 2), ("Gauss-Seidel, held", 1)]:
            found = echo(archives, kind, gain, scheme, 200)[::round_trip]
            assert found[2:] == pytest.approx(gain * found[1:-1], rel=1e-4, abs=1e-5)
            assert (found[-1] > found[0]) == (gain > 1)
        # output derivatives follow the same loop, so that the error also grows with the number of rounds
        found = echo(archives, kind, gain, "Jacobi, linear", 400)
        assert (found[-4:].max() > found[196:200].max()) == (gain > 1)
        for scheme in SCHEMES:
            if "closed" in scheme or "iterated" in scheme:
                # CLOSED is relative to a nominal force of 1 kN; the push is 0.2 N and more
                assert echo(archives, kind, gain, scheme, 50)[1:].max() < 5e-5, scheme
    # Gauss-Seidel extrapolates extrapolated values: z^2 + 2 g z - g = 0 leaves the unit circle at g = 1/3
    for gain in (0.98 / 3, 1.02 / 3):
        found = echo(archives, kind, gain, "Gauss-Seidel, linear", 400)
        assert (found[-1] > found[200]) == (gain > 1 / 3)


# --- impulses


@pytest.mark.parametrize("fraction", [1e-4, 0.25, 0.9])
@pytest.mark.parametrize("ratio", [0.2, 1.0])
def test_restitution_on_a_floor_that_reacts(archives, fraction, ratio):
    """Iteration on impulses gives the plastic exchange within the step of the impact: e = 0.9 becomes 0.84 at
    m = M.

    The velocity jump D of the floor acts as a mean acceleration over the step. Its part before the impact, at
    a fraction f of the step, is therefore reflected too: u'+ = e u'- - lambda D (1 - f (1 - e)). Conservation
    of momentum gives (M + m) D = -m (u'+ - u'-). With b = 3m/(4(M + m)),

        u'+/u'- = (e - b k)/(1 - b k),   k = 1 - f (1 - e)

    For f = 0 this is the plastic exchange. The acceleration also delays the impact. Weight changes u' by 2e-6
    of it.
    """
    e, step, speed = 0.9, 1e-6, 0.5
    mass = 3.0 * 0.3 * 1800
    floor = {"mass": mass / ratio, "stiffness": 0.0, "damping_ratio": 0.0, "coupling": "impulses"}
    wall = RIGID | {"impact": "restitution", "restitution": e}
    wall |= {"u_start": (1 + fraction) * speed * step, "u_dot_start": -speed}
    found = {}
    for scheme in ("iterated, held", "Jacobi, held"):
        system = wall_on_floor(
            *archives, {"floor": floor, "wall": wall}, connections=by_impulses(WALL_ON_FLOOR)
        )
        system.initialize(loop=False)
        speeds = []
        for _ in range(40):
            SCHEMES[scheme](system, step)
            speeds.append(system.get("wall.u_dot") / -speed)
        found[scheme] = speeds
    share = 3 * ratio / (4 * (1 + ratio))

    def exchange(f):
        k = 1 - f * (1 - e)
        return (e - share * k) / (1 - share * k)

    at = fraction
    for _ in range(50):
        # u = 0 where fraction = f - lambda |D|/u' f^2/2
        slowed = share * (1 - exchange(at))
        at = (1 - math.sqrt(1 - 2 * slowed * fraction)) / slowed
    assert ratio != 1.0 or exchange(0.0) == pytest.approx(0.84)
    # the first step ends before the impact
    assert found["iterated, held"][1] == pytest.approx(exchange(at), abs=1e-5)
    # an explicit master gives e first; the floor reacts over the next steps and reaches the same velocity
    assert found["Jacobi, held"][1] == pytest.approx(e, abs=1e-5)
    assert found["Jacobi, held"][-1] == pytest.approx(exchange(0.0), abs=1e-4)
    # reactions at communication points do not contain an impact between them
    floor["coupling"] = "reactions"
    blind = wall_on_floor(*archives, {"floor": floor, "wall": wall})
    blind.initialize()
    for _ in range(40):
        blind.jacobi(step)
    assert blind.get("wall.u_dot") / -speed == pytest.approx(e, abs=1e-4)


def test_a_wall_overturns_and_the_building_goes_on(archives):
    """The parapet falls: the log gives the time, its impulses end, and momentum still balances."""
    wall, floor = archives
    log = []
    units = [Unit(floor, name, **(storey | {"coupling": "impulses"})) for name, storey in STOREYS.items()]
    units.append(Unit(wall, "strip", **WALLS["strip"]))
    units.append(
        Unit(wall, "parapet", log=lambda *line: log.append(line), **(WALLS["parapet"] | {"u_dot_start": 0.9}))
    )
    system = System(units, by_impulses(BUILDING), {"floor_1.a_g": lambda t: 1.5 * pulse(t)})
    system.initialize(loop=False)
    step, taken, received = 0.001, {"strip": 0.0, "parapet": 0.0}, 0.0
    departed, largest = None, 0.0
    for _ in range(3000):
        SCHEMES["Jacobi, held"](system, step)
        for name in taken:
            taken[name] += system.get(f"{name}.impulse_bottom") + system.get(f"{name}.impulse_top")
        received += system.get("floor_1.impulse_bottom")
        storeys = sum(STOREYS[name]["mass"] * system.get(f"{name}.velocity_absolute") for name in STOREYS)
        largest = max(largest, abs(received), abs(storeys), *map(abs, taken.values()))
        # the impulse from the ground is in the storeys and walls, except the part that acts one step later
        late = sum(system.get(f"{name}.impulse_{end}") for name in taken for end in ("bottom", "top"))
        late += system.get("floor_2.impulse_bottom")
        # rounding of 3000 additions
        assert abs(received - storeys - sum(taken.values()) + late) <= 3000 * 1e-15 * largest
        if departed is None and abs(system.get("parapet.u")) > 0.3:
            # half of the geometric end, h/2
            departed = taken["parapet"]
    assert system.get("parapet.overturned") and not system.get("strip.overturned")
    assert departed is not None and taken["parapet"] == departed
    events = [(name, message) for name, category, message in log if category == "logEvents"]
    overturned = f"overturned at t = {system.get('parapet.overturn_time')} s"
    assert any(name == "parapet" and overturned in message for name, message in events), events
    assert any("left the supports" in message for _, message in events)
    # the strip and the storeys continue to move
    assert 0.001 < system.get("strip.u_max") < 0.2


# --- many walls


def ground(t):
    """Returns the ground acceleration of examples/coupling/master.c."""
    return (
        1.5
        * math.sin(0.1 * math.pi * t)
        * (math.sin(2 * math.pi * 1.3 * t) + 0.6 * math.sin(2 * math.pi * 3.1 * t))
    )


def test_a_compiled_master_gives_the_same(archives, fmu, floor_fmu):
    """Runs six walls for 2 s in C and in Python, and a hundred in one process, each a few kilobytes."""
    count, step, seconds = 6, 0.002, 2.0
    mass = 6e3 * count
    storey = {"mass": mass, "stiffness": mass * 4 * math.pi**2 * 16}
    wall, floor = archives
    units = [Unit(floor, name, **storey) for name in ("floor_1", "floor_2")]
    connections = [
        ("floor_1.acceleration_absolute", "floor_2.a_g"),
        ("floor_2.reaction_bottom", "floor_1.reaction_8"),
    ]
    for index in range(count):
        units.append(Unit(wall, f"wall_{index}", u_start=0.0, thickness=0.2 + 0.2 * index / count))
        below = f"floor_{index % 2 + 1}"
        connections += [
            (f"{below}.acceleration_absolute", f"wall_{index}.a_bottom"),
            (f"wall_{index}.reaction_bottom", f"{below}.reaction_{index // 2 + 1}"),
        ]
    system = System(units, connections, {"floor_1.a_g": ground})
    system.initialize(loop=False)
    largest = 0.0
    for _ in range(round(seconds / step)):
        system.jacobi(step)
        largest = max(largest, abs(system.get("wall_0.u")))
    found = compiled.run(fmu, floor_fmu, count, seconds, step)
    assert found["u_max_of_wall_1_m"] == pytest.approx(largest, rel=1e-9) and largest > 1e-3
    assert found["u_of_last_wall_m"] == pytest.approx(system.get(f"wall_{count - 1}.u"), rel=1e-9)
    many = compiled.run(fmu, floor_fmu, 100, 0.1, 0.001)
    # the allocator takes whole pages, which the first hundred walls account for
    assert many["bytes_per_wall"] < 64 * 1024
