"""Compares reactions and the energy through the supports with an independent two-body model. Impulses are
compared with integrals of reactions in `tests/it/couple.rs`."""

import math

import numpy as np
import pytest

import two_body
from unit import Unit

PARAPET = {"height": 3.0, "thickness": 0.4, "overburden": 8000.0, "overburden_eccentricity": 0.05}
STRIP = {"mechanism": "vertical_spanning", "height": 2.75, "thickness": 0.12, "hinge_ratio": 0.6,
         "overburden": 6000.0, "overburden_eccentricity": 0.02}  # fmt: skip
LAWS = {
    "rocking": {"a1": 0.05, "damping_model": "constant_ratio", "xi": 0.03,
                "u_start": 0.03},
    "trilinear": {"force_law": "trilinear", "d1": 0.7, "a1": 0.05, "damping_model": "stiffness_proportional",
                  "xi": 0.05, "u_start": 0.03},
    "impacts": {"a1": 0.03, "damping_model": "none", "impact": "restitution",
                "restitution": 0.8, "u_start": 0.05},
    "rigid": {"force_law": "rigid_linear", "damping_model": "none", "impact": "restitution",
              "restitution": 0.85, "u_start": 0.0},
}  # fmt: skip
# Motions that make the walls rock, rest and impact without overturning, which would end the contact.
FACTORS = {"parapet": 1.0, "strip": 0.3, "strip rigid": 1.7}
# Sums of a dozen products, each of the size of the result: 64 roundings are enough.
ROUNDING = 64 * 2.2e-16


def factor_of(shape, law):
    return FACTORS.get(f"{shape.split()[0]} {law}", FACTORS[shape.split()[0]])


class Supports:
    """Accelerations of the supports, linear within each step; velocities and displacements follow exactly."""

    def __init__(self, step, drift, factor=1.0):
        self.step = step
        self.factor = factor
        self.drift = drift
        self.velocity = np.zeros(2)
        self.displacement = np.zeros(2)
        self.acceleration = self.at(0.0)
        self.time = 0.0

    def at(self, time):
        bottom = 1.6 * math.sin(9.0 * time) + 0.9 * math.sin(17.0 * time + 0.4)
        top = bottom + (0.8 * math.sin(11.0 * time) if self.drift else 0.0)
        return self.factor * np.array([bottom, top])

    def advance(self):
        """Sets the rates of this step and moves to its end."""
        end = self.at(self.time + self.step)
        rate = (end - self.acceleration) / self.step
        h, a, v = self.step, self.acceleration, self.velocity
        self.displacement = self.displacement + v * h + a * h**2 / 2 + rate * h**3 / 6
        self.velocity = v + a * h + rate * h**2 / 2
        self.acceleration = end
        self.time += h
        return rate

    @property
    def relative(self):
        return self.displacement[1] - self.displacement[0]


def drive(unit, supports, parapet):
    """Advances unit and supports by one step; the drift is linear within a step."""
    before = supports.acceleration.copy(), supports.relative
    rate = supports.advance()
    inputs, rates = {"a_bottom": before[0][0]}, {"a_bottom": rate[0]}
    if not parapet:
        inputs |= {"a_top": before[0][1]}
        rates |= {"a_top": rate[1]}
        if supports.drift:
            inputs |= {"drift": before[1]}
            rates |= {"drift": (supports.relative - before[1]) / supports.step}
    unit.set(**inputs)
    unit.rates(**rates)
    unit.step(supports.step)


def facts(unit):
    names = ["mass", "height", "thickness", "hinge_ratio", "gravity", "overburden", "effective_mass",
             "overburden_eccentricity", "F0", "F0_negative", "u_ins", "u_ins_negative"]  # fmt: skip
    return dict(zip(names, unit.get(*names)))


def couple_of(wall, u, force, drift):
    """Returns G, the moment of all weights about the toe over h, for the wall's own force F.

    The load moves with the wall. Where the law spreads the jump of the force, the toe is s = (F + k0 u)/F0 of
    its way from the middle to the edge.
    """
    weight, load = wall["mass"] * wall["gravity"], wall["overburden"]
    side = "_negative" if (u or force) < 0 else ""
    f0 = wall[f"F0{side}"]
    share = (force + f0 / wall[f"u_ins{side}"] * u) / f0
    moment = share * (weight + load) * wall["thickness"] / 2 - load * wall["overburden_eccentricity"]
    return (moment - weight * u / 2 - (weight / 2 + load) * drift) / wall["height"]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("shape", ["parapet", "strip", "strip with drift"])
def test_reactions(unpacked, law, shape):
    parapet, drift = shape == "parapet", shape.endswith("drift")
    with Unit(unpacked) as unit:
        unit.start(**(PARAPET if parapet else STRIP), **LAWS[law])
        wall, supports, kinds = facts(unit), Supports(0.002, drift, factor_of(shape, law)), set()
        for _ in range(1500):
            drive(unit, supports, parapet)
            names = [
                "u",
                "u_dot",
                "u_ddot",
                "restoring_force",
                "damping_force",
                "reaction_bottom",
                "reaction_top",
            ]
            u, speed, acceleration, restoring, damping, bottom, top = unit.get(*names)
            kinds.add("rest" if u == speed == acceleration == 0.0 else "motion")
            # force of the wall against u, as one rod or as half of Eq. (12)
            force, scale = restoring + damping, wall["mass"] * (10.0 + abs(acceleration)) + abs(restoring)
            if parapet:
                expected, couple = two_body.parapet(
                    wall["mass"], wall["height"], supports.acceleration[0], acceleration
                )
                assert bottom == pytest.approx(expected, abs=ROUNDING * scale)
                assert top == 0.0
                # moment about the base: -(F + C u') h/2
                assert -couple * 2 / wall["height"] == pytest.approx(force, abs=ROUNDING * scale)
                continue
            given = supports.relative if drift else 0.0
            own = restoring + wall["mass"] * wall["gravity"] * given / wall["height"]
            couple = couple_of(wall, u, own, given)
            expected = two_body.strip(
                wall["mass"],
                wall["height"],
                wall["hinge_ratio"] * wall["height"],
                supports.acceleration,
                acceleration,
                couple,
            )
            assert bottom == pytest.approx(expected[0], abs=ROUNDING * scale)
            assert top == pytest.approx(expected[1], abs=ROUNDING * scale)
            # the equation of motion is twice Lagrange's
            assert 2 * expected[3] == pytest.approx(force, abs=ROUNDING * scale)
        assert "motion" in kinds
        assert "rest" in kinds or law != "rigid"
        assert unit.get("overturned") is False


def stored(wall, law, u, u_ins, f0):
    """Returns ∫F du [J] from 0, for a bilinear law with softening parallel to the rigid law."""
    u1, k0 = law["a1"] * u_ins, f0 / u_ins
    top = k0 * (u_ins - u1)
    if abs(u) <= u1:
        return 0.5 * top / u1 * u * u
    return 0.5 * top * u1 + k0 * (u_ins * (abs(u) - u1) - (u * u - u1 * u1) / 2)


@pytest.mark.parametrize("shape", ["parapet", "strip", "strip with drift"])
def test_power_through_the_supports(unpacked, shape):
    """∫(R_b v_b + R_t v_t) dt is the change of energy plus the dissipation, to 2.5e-7 of what is exchanged.

    The work of the couple of the contacts on a drift, ∫ G ḋ dt, is not in the equation of motion; it is
    taken out.

    Simpson's rule over 1.2e-4 s has an error at each corner of the force: about (ω₁ h)²/30 of the energy that
    passes within the step, which is 2.5e-7 of it. The drift is linear within the unit's steps; its error is
    h² a/8, 3e-9 m.
    """
    parapet, drift = shape == "parapet", shape.endswith("drift")
    law = LAWS["rocking"] | {"damping_model": "constant_coefficient", "overburden_eccentricity": 0.0}
    with Unit(unpacked) as unit:
        unit.start(**(PARAPET if parapet else STRIP) | law)
        wall, supports = facts(unit), Supports(6e-5, drift, factor_of(shape, "rocking"))
        u_ins, f0, xi, omega = unit.get("u_ins", "F0", "xi", "omega1")
        h, h1 = wall["height"], wall["hinge_ratio"] * wall["height"]
        part = 1.0 if parapet else 0.5
        damper = part * 2 * wall["effective_mass"] * omega * xi

        def energy(u, speed):
            bottom, top = supports.velocity
            potential = part * stored(wall, law, u, u_ins, f0)
            if parapet:
                return two_body.rod_energy(wall["mass"], bottom, bottom + 2 * speed) + potential
            middle = bottom * (1 - h1 / h) + top * h1 / h + speed
            rods = two_body.rod_energy(wall["mass"] * h1 / h, bottom, middle)
            rods += two_body.rod_energy(wall["mass"] * (1 - h1 / h), middle, top)
            if drift:
                weight, d = wall["mass"] * wall["gravity"], supports.relative
                potential -= weight * u * d / (2 * h) + (weight / 2 + wall["overburden"]) * d * d / (2 * h)
            return rods + potential

        def rates():
            names = ["u", "u_dot", "reaction_bottom", "reaction_top", "restoring_force"]
            u, speed, bottom, top, restoring = unit.get(*names)
            power = bottom * supports.velocity[0] + top * supports.velocity[1]
            if drift:
                weight = wall["mass"] * wall["gravity"]
                own = restoring + weight * supports.relative / h
                contacts = couple_of(wall, u, own, 0.0) + weight * u / (2 * h)
                power -= contacts * (supports.velocity[1] - supports.velocity[0])
            return u, power, damper * speed**2

        u, power, loss = rates()
        start, work, dissipated, exchanged = energy(u, unit.get("u_dot")), 0.0, 0.0, 0.0
        corners = 0
        for _ in range(6_000):
            powers, losses, places = [power], [loss], [u]
            for _ in range(2):
                drive(unit, supports, parapet)
                u, power, loss = rates()
                powers.append(power)
                losses.append(loss)
                places.append(u)
            weights = np.array([1, 4, 1]) * supports.step / 3
            work += weights @ powers
            dissipated += weights @ losses
            exchanged += weights @ np.abs(powers)
            corners += (abs(places[0]) - law["a1"] * u_ins) * (abs(places[2]) - law["a1"] * u_ins) < 0
        change = energy(u, unit.get("u_dot")) - start
        assert corners >= 2 and dissipated > 0.0
        assert work == pytest.approx(change + dissipated, abs=2.5e-7 * (exchanged + dissipated))
