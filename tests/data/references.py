"""Computes the references of `wall verify formulas` from the mechanics, in decimal arithmetic of 40 digits.

    python tests/data/references.py          # writes crates/evidence/src/verification/references.csv

Scenes are those of formulas.toml beside that file. Forces follow from the potential energy of the bodies and
masses from integrals over the height, so that this shares nothing with the library but the equations.
References of the scenes named c*, t* and o* are rows of tests/data/cases.
"""

import csv
import json
import tomllib
from decimal import Decimal, getcontext
from pathlib import Path

getcontext().prec = 40
ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "crates/evidence/src/verification"
CASES = ROOT / "tests/data/cases"
# 45 units of rounding in double precision, 2.2e-16
ROUNDING = Decimal("1e-14")
START = {
    "mechanism": "parapet", "height": 4.0, "thickness": 0.4, "width": 1.0, "density": 1800.0, "gravity": 9.81,
    "hinge_ratio": 0.5, "overburden": 0.0, "overburden_eccentricity": 0.0,
    "eccentricity_mode": "fixed_to_wall", "force_law": "bilinear", "a1": 0.03, "a3": 1.0, "d1": 0.85,
    "softening": "parallel",
    "restitution_source": "calibrated", "tie_stiffness": 0.0, "u_dot_start": 0.0,
}  # fmt: skip
STATIC = {
    "parapet_loaded": "mass effective_mass participation F0 F0_negative u_ins u_ins_negative",
    "parapet_pivot": "F0 F0_negative u_ins_negative",
    "strip_loaded": "effective_mass participation F0 F0_negative u_ins u_ins_negative",
    "parapet_shaken": "u_ddot reaction_bottom",
    "strip_supports": "u_ddot reaction_bottom reaction_top",
    "strip_drift": "restoring_force u_ddot reaction_bottom reaction_top",
    "law_rigid": "restoring_force",
    "law_elastic": "restoring_force omega1",
    "law_plateau": "restoring_force omega1",
    "tie_pulls": "tie_force restoring_force",
    "tie_slack": "tie_force restoring_force",
    "law_multilinear": "restoring_force",
} | {f"law_{name}": "restoring_force omega1" for name in ["parallel", "rotated", "chord", "beyond_u3"]}


def exp(x):
    return x.exp()


def cos_sin(x):
    """Series of e^(ix)."""
    sums, term, k = [Decimal(1), Decimal(0)], Decimal(1), 0
    while abs(term) > Decimal("1e-45"):
        k += 1
        term *= x / k
        sums[k % 2] += term if k % 4 < 2 else -term
    return sums


def acosh(x):
    return (x + (x * x - 1).sqrt()).ln()


def cosh(x):
    return (exp(x) + exp(-x)) / 2


def sinh(x):
    return (exp(x) - exp(-x)) / 2


class Wall:
    """A wall from the energies of its bodies, for u on the side of `sign`."""

    def __init__(self, scene, motion):
        tables = [table for table in scene.values() if isinstance(table, dict)]
        given = START | {name: value for table in tables for name, value in table.items()}
        self.given = {k: Decimal(v) if isinstance(v, float) else v for k, v in given.items()}
        p = self.given
        self.support = [Decimal(motion.get(k, motion.get("bottom", [0.0]))[0]) for k in ["bottom", "top"]]
        self.drift = Decimal(motion.get("drift", [0.0])[0])
        self.h, self.b, self.parapet = p["height"], p["thickness"], p["mechanism"] == "parapet"
        self.mass = p["density"] * self.h * self.b * p["width"]
        self.weight = self.mass * p["gravity"]
        self.h1 = self.h if self.parapet else p["hinge_ratio"] * self.h
        self.sign = -1 if p["u_start"] < 0 else 1
        self.u, self.v = p["u_start"], p["u_dot_start"]
        # ∫φ² and ∫φ of the mass over the height: φ falls from its top at h₁ to 0 at the supports
        top, scale = (2, 1) if self.parapet else (1, 2)
        self.m_eff = scale * top * top * self.mass / 3
        self.participation = scale * top * self.mass / 2 / self.m_eff

    def strength(self, sign):
        """F₀ and k₀ of V = Σ w (x θ − y θ²/2): a weight w at (x, y) from the point it turns about."""
        p, b = self.given, self.b
        flip = -1 if p["eccentricity_mode"] == "fixed_to_wall" and sign < 0 else 1
        c, load = flip * p["overburden_eccentricity"], p["overburden"]
        if self.parapet:
            rate = 2 / self.h
            parts = [(self.weight, b / 2, self.h / 2, rate), (load, b / 2 - c, self.h, rate)]
        else:
            h1, h2 = self.h1, self.h - self.h1
            lower, upper = self.weight * h1 / self.h, self.weight * h2 / self.h
            parts = [(2 * lower, b / 2, h1 / 2, 1 / h1)]
            for weight, x, y in [(upper, b / 2, h2 / 2), (load, b / 2 + c, h2)]:
                parts += [(2 * weight, b, h1, 1 / h1), (2 * weight, x, y, 1 / h2)]
        return sum(w * x * r for w, x, y, r in parts), sum(w * y * r * r for w, x, y, r in parts)

    def law(self):
        """Corners (u, F) of the law, straight lines between."""
        p = self.given
        f0, k0 = self.strength(self.sign)
        u_ins = f0 / k0
        if p["force_law"] == "multilinear":
            points = [[0.0, 0.0], *p["points"]]
            return [(Decimal(x) * u_ins, Decimal(y) * f0) for x, y in points]
        u1, u3 = p["a1"] * u_ins, p["a3"] * u_ins
        lines = {
            "parallel": lambda u: k0 * (u3 - u),
            "rotated": lambda u: f0 * (1 - u / u3),
            "chord": lambda u: f0 * (1 - p["a1"]) * (u3 - u) / (u3 - u1),
        }
        line = lines[p["softening"]]
        if p["force_law"] == "rigid_linear":
            return [(Decimal(0), line(Decimal(0))), (2 * u3, line(2 * u3))]
        if p["force_law"] == "bilinear":
            return [(Decimal(0), Decimal(0)), (u1, line(u1)), (2 * u3, line(2 * u3))]
        slope = (line(u3) - line(u1)) / (u3 - u1)
        end = u3 + p["d1"] * f0 / slope
        return [(Decimal(0), Decimal(0)), (u1, p["d1"] * f0), (end, p["d1"] * f0), (2 * u3, line(2 * u3))]

    def force(self):
        u, corners = abs(self.u), self.law()
        for (u0, f0), (u1, f1) in zip(corners, corners[1:]):
            if u <= u1:
                return self.sign * (f0 + (f1 - f0) * (u - u0) / (u1 - u0))

    def toe_moment(self):
        """Σ P (x - x_A) of all weights at their places about the toe, x_A growing against u.

        Where the law spreads the jump of the force, the toe is the share s = (F + k₀|u|)/F₀ of the way from
        the middle of the two toes, each with its place of the load, to that of this side.
        """
        p = self.given
        weights = [self.weight * self.h1 / self.h, self.weight * (1 - self.h1 / self.h), p["overburden"]]
        hinge = self.u + self.drift * self.h1 / self.h
        places = [hinge / 2, (hinge + self.drift) / 2, self.drift]

        def about(sign):
            flips = p["eccentricity_mode"] == "follows_pivot" and sign < 0
            load = -p["overburden_eccentricity"] if flips else p["overburden_eccentricity"]
            arms = [sign * self.b / 2 - x for x in places]
            return sum(w * x for w, x in zip(weights, arms)) - weights[2] * load

        f0, k0 = self.strength(self.sign)
        share = (abs(self.force()) + k0 * abs(self.u)) / f0
        middle = (about(1) + about(-1)) / 2
        return middle + share * (about(self.sign) - middle)

    def omega1(self):
        _, (u1, f1), *_ = self.law()
        return (f1 / u1 / self.m_eff).sqrt()

    def damping(self):
        """C."""
        p, m, omega1 = self.given, self.m_eff, self.omega1()
        squared = self.force() / (self.u * m)
        return {
            "none": lambda: Decimal(0),
            "constant_coefficient": lambda: 2 * m * omega1 * p["xi"],
            "free_standing_block": lambda: m * (2 * p["gravity"] / self.h).sqrt() * p["c_bar"],
            "constant_ratio": lambda: 2 * m * squared.sqrt() * p["xi"],
            "stiffness_proportional": lambda: 2 * m * squared / omega1 * p["xi"],
        }[p.get("damping_model", "none")]()

    def ratio(self):
        """ξ that e predicts, Eqs. (20) to (23)."""
        p = self.given
        a1, loss = p["a1"], -p["restitution"].ln()
        power = lambda q, r: Decimal(q) * a1 ** Decimal(r) * loss
        return {
            "constant_coefficient": lambda: power("0.667", "0.450"),
            "constant_ratio": lambda: power("0.350", "0.074"),
            "stiffness_proportional": lambda: power("0.218", "-0.195"),
            "free_standing_block": lambda: (
                Decimal("1.55") * loss * (2 * p["gravity"] / self.h).sqrt() / (2 * self.omega1())
            ),
        }[p["damping_model"]]()

    def restitution(self):
        p, h, h1, b = self.given, self.h, self.h1, self.b
        sine = b * b / (h1 * h1 + b * b)
        analytic = 1 - Decimal("1.5") * sine if self.parapet else 1 - 2 * sine
        if p.get("rocking", "two_sided") != "two_sided":
            return -analytic**2 * (1 - Decimal("1.5") * (1 - sine))
        return {
            "analytic": analytic,
            "calibrated": analytic * Decimal("0.95" if self.parapet else "0.90"),
            "momentum": (h * h1 + h1 * h1 - 3 * b * b) / (h * h1 + h1 * h1 + 3 * b * b),
        }[p["restitution_source"]]

    def values(self):
        """Every quantity at the start, with the scale of its error."""
        p, m, h = self.given, self.m_eff, self.h
        (f0, k0), (negative, k0_negative) = self.strength(1), self.strength(-1)
        bottom, top = self.support
        # ∫ a φ of a straight line of accelerations: φ is a triangle, its centroid known
        centroid = 2 * h / 3 if self.parapet else (h + self.h1) / 3
        effective = bottom if self.parapet else bottom + (top - bottom) * centroid / h
        tie = Decimal(0)
        if p["tie_stiffness"]:
            arm = 2 * p["tie_height"] / h
            tie = p["tie_stiffness"] * max(Decimal(0), self.u * arm - p["tie_slack"])
        pull = self.weight * self.drift / h
        force = self.force() + (2 * p["tie_height"] / h * tie if tie else 0) - pull
        damping = self.damping() * self.v if self.v else Decimal(0)
        acceleration = -(damping + force) / m - self.participation * effective
        terms = max(abs(damping / m), abs(force / m), abs(self.participation * effective))
        # moments of the inertia forces, a straight line and a triangle, about each end over h; of the weights
        # about the toe
        straight = self.mass * (2 * bottom + top) / 6
        triangle = self.mass * (1 - centroid / h) / 2
        couple = Decimal(0)
        if self.parapet:
            reactions = [self.mass * (bottom + acceleration), Decimal(0)]
        else:
            couple = self.toe_moment() / h
            other = self.mass * (bottom + 2 * top) / 6 + self.mass * centroid / h / 2 * acceleration
            reactions = [straight + triangle * acceleration - couple, other + couple]
        inertia = self.mass * max(terms, abs(bottom), abs(top))
        values = {
            "mass": self.mass, "effective_mass": m, "participation": self.participation, "F0": f0,
            "F0_negative": negative, "u_ins": f0 / k0, "u_ins_negative": negative / k0_negative,
        }  # fmt: skip
        values = {name: (value, abs(value)) for name, value in values.items()}
        return values | {
            "restoring_force": (force, max(f0, abs(force))),
            "tie_force": (tie, max(tie, p["tie_stiffness"] * p.get("tie_slack", 0), Decimal(1))),
            "u_ddot": (acceleration, terms),
            "damping_force": (damping, abs(damping)),
            "reaction_bottom": (reactions[0], inertia),
            "reaction_top": (reactions[1], inertia),
        }


def elastic(wall, t):
    """u of the damped oscillator."""
    omega, xi = wall.omega1(), wall.given["xi"]
    s = xi * omega
    if xi == 1:
        even, odd = Decimal(1), t
    elif xi < 1:
        damped = omega * (1 - xi * xi).sqrt()
        even, odd = cos_sin(damped * t)
        odd /= damped
    else:
        damped = omega * (xi * xi - 1).sqrt()
        even, odd = cosh(damped * t), sinh(damped * t) / damped
    return exp(-s * t) * (wall.u * even + (wall.v + s * wall.u) * odd)


def rocking(wall, t):
    """u of a rigid wall from impact to impact: from a peak over a zero to the next peak."""
    f0, k0 = wall.strength(1)
    p, u_ins, e = (k0 / wall.m_eff).sqrt(), f0 / k0, wall.given["restitution"]
    peak, side, since = wall.u / u_ins, 1, Decimal(0)
    for _ in range(1000):
        quarter = acosh(1 / (1 - peak)) / p
        if t <= since + quarter:
            return side * u_ins * (1 - (1 - peak) * cosh(p * (t - since)))
        since += quarter
        peak = 1 - (1 - e * e * (1 - (1 - peak) ** 2)).sqrt()
        side = side if "rocking" in wall.given else -side
        since += acosh(1 / (1 - peak)) / p
    # e^1000 is left: the wall has come to rest
    return Decimal(0)


def straight(u, v, force, slope, t):
    """u and u̇ at t under ü = force + slope u, which is not 0."""
    centre, rate = -force / slope, abs(slope).sqrt()
    even, odd = cos_sin(rate * t) if slope < 0 else (cosh(rate * t), sinh(rate * t))
    bent = rate * odd if slope > 0 else -rate * odd
    return centre + (u - centre) * even + v / rate * odd, (u - centre) * bent + v * even


class Yielding:
    """A rigid wall that moves outwards from u = 0, with a tie that yields: pieces from event to event, up to
    the first impact and the piece after it."""

    def __init__(self, wall):
        p = wall.given
        f0, k0 = wall.strength(1)
        arm, stiffness, strength = 2 * p["tie_height"] / wall.h, p["tie_stiffness"], p["tie_strength"]
        engages = p["tie_slack"] / arm
        yields = (p["tie_slack"] + strength / stiffness) / arm
        breaks = yields + p["tie_ultimate"] / arm
        # ü = force + slope u of a wall whose tie is slack or broken, pulls from a place on, or yields
        free = -f0 / wall.m_eff, k0 / wall.m_eff
        added = arm * arm * stiffness / wall.m_eff
        pulling = lambda place: (free[0] + added * place, free[1] - added)
        yielding = free[0] - arm * strength / wall.m_eff, free[1]
        # start, u, u̇, and the law until u_ins, u = 0 or what else ends it
        self.pieces, self.break_time = [], Decimal(-1)
        now = self.add((Decimal(0), wall.u, wall.v), free, engages)
        now = self.add(now, pulling(engages), yields)
        if yields < breaks:
            now = self.add(now, yielding, breaks)
        t, u, v = now
        if v > 0:
            self.break_time = t
        else:
            slack = u - strength / stiffness / arm
            now = self.add(now, pulling(slack), slack)
        self.elongation = arm * (u - yields)
        self.overturn_time, u, v = self.add(now, free, f0 / k0, Decimal(0))
        if u == 0:
            e = p["restitution"]
            # on the other side F changes its sign, and there is no tie
            self.pieces.append((self.overturn_time, u, e * v, (-free[0], free[1])))

    def add(self, start, law, *places):
        """Moves from a start to the first of the places, or to where u̇ = 0 if none of them is inwards."""
        t, u, v = start
        self.pieces.append((t, u, v, law))

        def is_before(time):
            now, speed = straight(u, v, *law, time)
            inside = all(now < place if u < place else now > place for place in places)
            return inside and (speed > 0 or v <= 0 or Decimal(0) in places)

        step = Decimal("1e-3")
        low = Decimal(0)
        while is_before(low + step):
            low += step
        for _ in range(125):
            step /= 2
            low += step if is_before(low + step) else 0
        now, speed = straight(u, v, *law, low)
        reached = [place for place in places if abs(now - place) < Decimal("1e-25")]
        return t + low, reached[0] if reached else now, speed if reached else Decimal(0)

    def at(self, t):
        start, u, v, law = next(piece for piece in reversed(self.pieces) if piece[0] <= t)
        return straight(u, v, *law, t - start)


def yielding(name, wall):
    """Rows of a wall with a tie that yields, at times on each of its pieces."""
    motion = Yielding(wall)
    scale, speed = wall.strength(1)[0] / wall.strength(1)[1], abs(wall.v)
    tight = Decimal("1e-12")
    times = {"tie_breaks": [0.03, 0.1, 1.0, 1.4], "tie_turns": [0.1, 0.3, 0.6], "tie_brittle": [0.2]}[name]
    for time in times:
        u, v = motion.at(Decimal(time))
        yield "u", time, u, scale, tight
        yield "u_dot", time, v, speed, tight
        if u > 0:
            energy = wall.m_eff / 2 * wall.v * wall.v
            yield "energy", time, energy, energy, tight
    time = times[-1]
    yield "tie_elongation", time, motion.elongation, Decimal(wall.given["tie_slack"]), tight
    yield "tie_break_time", time, motion.break_time, Decimal(1), tight
    if name == "tie_brittle":
        yield "overturn_time", 0.5, motion.overturn_time, Decimal(1), tight


def full_strip(wall):
    """ü of a strip wall in full rotations: d/dt (M u̇) − M′u̇²/2 + V′ = −(m/2) a_g, for u > 0."""
    m, b, g = wall.mass, wall.b, wall.given["gravity"]
    heights = [wall.h1, wall.h - wall.h1]
    masses = [m * height / wall.h for height in heights]

    def inertia_and_slopes(u):
        s = u - b
        rises = [(height * height + b * b - s * s).sqrt() for height in heights]
        # of the centres, whose horizontal position is s/2; θ̇ = ṡ/c, and m D²/12 about a centre
        slopes = [-s / rises[0] / 2, -s / rises[0] - s / rises[1] / 2]
        parts = zip(masses, slopes, heights, rises)
        inertia = sum(
            mass * (Decimal("0.25") + slope**2 + (height**2 + b * b) / 12 / rise**2)
            for mass, slope, height, rise in parts
        )
        return inertia, slopes

    inertia, slopes = inertia_and_slopes(wall.u)
    small = Decimal("1e-12")
    growth = (inertia_and_slopes(wall.u + small)[0] - inertia_and_slopes(wall.u - small)[0]) / (2 * small)
    weight = g * sum(mass * slope for mass, slope in zip(masses, slopes))
    return -(growth * wall.v**2 / 2 + weight + m / 2 * wall.support[0]) / inertia


def motions(name, wall):
    """Rows (variable, time, reference, scale, bound) of a motion in closed form."""
    f0, k0 = wall.strength(1)
    p, u_ins = (k0 / wall.m_eff).sqrt(), f0 / k0
    tight = Decimal("1e-12")
    if name.startswith("elastic"):
        return [("u", t, elastic(wall, Decimal(t)), wall.u, tight) for t in [0.37, 5.0]]
    if name.startswith("rocking"):
        times = [0.4, 5.0, 10.0, 20.0] if name == "rocking_rigid" else [2.0, 2.9, 6.0]
        return [("u", t, rocking(wall, Decimal(t)), u_ins, tight * 10) for t in times]
    if name == "uplift_ramp":
        # the forcing is −λ a_g; the ramp ends at 1 s
        rate, lift = wall.participation * Decimal(1.5), f0 / wall.m_eff
        after = p * (1 - lift / rate)
        return [("u", 1.0, rate / p**3 * (sinh(after) - after), u_ins, tight)]
    if name == "overturning_constant":
        excess = wall.participation * -wall.support[0] - f0 / wall.m_eff
        time = acosh(1 + p * p * u_ins / excess) / p
        # later it lies still at h/2, without reactions
        return [
            ("overturn_time", 2.0, time, time, tight),
            ("u", 10.0, wall.h / 2, wall.h / 2, tight),
            ("reaction_bottom", 10.0, Decimal(0), wall.weight, tight),
        ]
    if name == "full_strip":
        return [("u_ddot", 0.0, full_strip(wall), wall.given["gravity"], ROUNDING)]
    assert name == "full_parapet", name
    b, h, g = wall.b, wall.h, wall.given["gravity"]
    diagonal = (h * h + b * b).sqrt()
    sine = (2 * wall.u - b) / diagonal
    cosine = (1 - sine * sine).sqrt()
    rate = 2 * wall.v / (diagonal * cosine)
    # θ̈ = −p² [sin(α − θ) + (a_g/g) cos(α − θ)], and u = (b + D sin(θ − α))/2 twice differentiated
    angular = 3 * g / (2 * diagonal) * (sine - wall.support[0] / g * cosine)
    return [("u_ddot", 0.0, diagonal / 2 * (cosine * angular - sine * rate * rate), g, ROUNDING)]


def case(name):
    """Rows of a reference case: u at the middle and at the end of what can be compared."""
    about = json.loads((CASES / f"{name}.json").read_text())
    with open(CASES / f"{name}.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if float(row["t"]) <= about["horizon"]]
    least = 1e-12 if name in ["c02_free_cdc", "c05_free_cdcfs", "c06_fig5_cdc"] else 1e-9
    for row in [rows[len(rows) // 2], rows[-1]]:
        bound = max(least, 100 * 2.2e-16 * float(row["sensitivity"]), 100 * about["error_in_double"])
        yield "u", float(row["t"]), Decimal(row["u"]), Decimal(about["u_ins"]), Decimal(bound)
    if (time := about["overturn_time"]) is not None:
        # Δt = Δu/u̇: 1e-9 of 0.2 m over 0.1 m/s, and as much for the pulse
        yield "overturn_time", time + 0.1, Decimal(time), Decimal(time), Decimal("4e-9")


class Body:
    """A body of parts by exact integrals of polynomials in z, from moments about its toes.

    `points` of a stretch are the sums Σ of m, m x, m z, m x², m z², W x, W z and W of its masonry and loads.
    """

    def __init__(self, scene):
        geometry = scene["geometry"]
        self.strip = geometry.get("mechanism") == "vertical_spanning"
        self.gravity = Decimal("9.81")
        self.prisms, top = [], Decimal(0)
        for part in geometry["part"]:
            base = Decimal(repr(part["base"])) if "base" in part else top
            height = Decimal(repr(part["height"]))
            top = base + height
            lines = [self.line(part.get(key, other), base, height)
                     for key, other in [("thickness", None), ("width", 1.0), ("outer", 0.0)]]
            self.prisms.append((base, top, *lines, Decimal(repr(part["density"]))))
        masonry = list(self.prisms)
        for hole in geometry.get("opening", []):
            base, width = (Decimal(repr(hole[key])) for key in ["base", "width"])
            end = base + Decimal(repr(hole["height"]))
            for first, last, thickness, _, outer, density in masonry:
                if "thickness" in hole:
                    faces = [Decimal(repr(hole[key])) for key in ["thickness", "outer"]]
                    thickness, outer = ([face, Decimal(0)] for face in faces)
                if max(base, first) < min(end, last):
                    self.prisms.append(
                        (max(base, first), min(end, last), thickness, [width, Decimal(0)], outer, -density)
                    )
        self.height = max(prism[1] for prism in masonry)
        names = ["force", "height", "inside", "moving_mass", "thrust"]
        loads = geometry.get("load", [])
        self.loads = [[Decimal(repr(load.get(name, 0.0))) for name in names] for load in loads]
        # faces at the foot, inwards from the outer toe
        foot = masonry[0]
        self.toes = [foot[4][0], foot[4][0] + foot[2][0]]
        self.hinge = Decimal(repr(geometry.get("hinge_ratio", 0.5))) * self.height
        self.masonry = masonry

    @staticmethod
    def line(value, base, height):
        """Coefficients over z of a size with these values at the bottom and at the top."""
        bottom, top = (Decimal(repr(end)) for end in (value if isinstance(value, list) else [value, value]))
        slope = (top - bottom) / height
        return [bottom - slope * base, slope]

    def points(self, low, high, loads=True):
        sums = [Decimal(0)] * 8
        for base, top, t, w, o, density in self.prisms:
            a, b = max(base, low), min(top, high)
            if a >= b:
                continue

            def over(*factors, a=a, b=b):
                polynomial = [Decimal(1)]
                for factor in factors:
                    product = [Decimal(0)] * (len(polynomial) + len(factor) - 1)
                    for i, x in enumerate(polynomial):
                        for j, y in enumerate(factor):
                            product[i + j] += x * y
                    polynomial = product
                return density * sum(  # noqa: B023
                    c * (b ** (k + 1) - a ** (k + 1)) / (k + 1) for k, c in enumerate(polynomial)
                )

            z = [Decimal(0), Decimal(1)]
            mass, x = over(t, w), over(t, w, o) + over(t, t, w) / 2
            xx = over(t, w, o, o) + over(t, t, w, o) + over(t, t, t, w) / 3
            g = self.gravity
            own = [mass, x, over(t, w, z), xx, over(t, w, z, z), g * x, g * over(t, w, z), g * mass]
            sums = [total + one for total, one in zip(sums, own, strict=True)]
        for force, z, x, share, _ in self.loads if loads else []:
            if low < z <= high:
                m = share * force / self.gravity
                own = [m, m * x, m * z, m * x * x, m * z * z, force * x, force * z, force]
                sums = [total + one for total, one in zip(sums, own, strict=True)]
        return sums

    def values(self):
        return self.values_of_strip() if self.strip else self.values_of_one()

    def values_of_one(self):
        m, _, mz, *_ = self.points(Decimal(0), self.height, loads=False)
        z_g = mz / m
        moving, mx, mz, mxx, mzz, wx, wz, w = self.points(Decimal(0), self.height)
        thrust = sum(h * z for _, z, _, _, h in self.loads)
        outer, inner = self.toes
        force = [(wx - w * outer - thrust) / z_g, (w * inner - wx + thrust) / z_g]
        stiffness = wz / z_g**2
        # ∫(x − x_A)(x − x_B) dm and ∫(x − x_B)² dm
        both = mxx - mx * (outer + inner) + moving * outer * inner
        after = mxx - 2 * mx * inner + moving * inner**2
        return {
            "mass": m, "effective_mass": mzz / z_g**2, "participation": mz * z_g / mzz,
            "F0": force[0], "F0_negative": force[1],
            "u_ins": force[0] / stiffness, "u_ins_negative": force[1] / stiffness,
            "restitution_used": (mzz + both) / (mzz + after),
        }  # fmt: skip

    def values_of_rotation(self, u, v, ground):
        """u_ins, ü and R_b in full rotations, on the side on which u is; thrusts push it outwards."""
        side = 1 if u > 0 else -1
        m, own_x, mz, *_ = self.points(Decimal(0), self.height, loads=False)
        moving, mx, first, mxx, mzz, wx, wz, w = self.points(Decimal(0), self.height)
        toe = self.toes[0] if side > 0 else self.toes[1]
        z, x = mz / m, side * (own_x / m - toe)
        across = side * (mx - moving * toe)
        inertia = mzz + mxx - 2 * mx * toe + moving * toe * toe
        moment = side * (wx - w * toe) - side * sum(h * height for _, height, _, _, h in self.loads)
        turning = wz + side * sum(h * side * (inside - toe) for _, _, inside, _, h in self.loads)

        diagonal = (z * z + x * x).sqrt()
        sine = (side * u - x) / diagonal
        cosine = (1 - sine * sine).sqrt()
        # of θ, which is larger by α
        sin, cos = (sine * z + cosine * x) / diagonal, (cosine * z - sine * x) / diagonal
        rate = side * v / (diagonal * cosine)
        push = side * ground * (first * cos + across * sin)
        angular = (turning * sin - moment * cos - push) / inertia
        momentum = angular * (first * cos + across * sin) + rate * rate * (across * cos - first * sin)
        reaction = moving * ground + side * momentum - sum(h for *_, h in self.loads)
        size = (moment * moment + turning * turning).sqrt()
        u_ins = (z * moment + x * (size - turning)) / size
        return {
            "u_ins" if side > 0 else "u_ins_negative": (u_ins, u_ins),
            "u_ddot": (side * diagonal * (cosine * angular - sine * rate * rate), self.gravity),
            "reaction_bottom": (reaction, w),
        }

    def values_of_strip(self):
        h, h1 = self.height, self.hinge
        h2 = h - h1
        lower, upper = self.points(Decimal(0), h1), self.points(h1, h)
        faces = [[line[0] + line[1] * h1 for line in (prism[4], prism[2])]
                 for prism in self.masonry if prism[0] <= h1 <= prism[1]]
        edges = [max(outer for outer, _ in faces), min(outer + thickness for outer, thickness in faces)]

        # places rise by (x − x_A)/h₁ below, and (x_B − x_A)/h₁ + (x_B − x)/h₂ above; ρ = p + q x
        def rise(sign):
            toe, edge = (self.toes[0], edges[1]) if sign > 0 else (self.toes[1], edges[0])
            below = (-toe / h1 * sign, sign / h1)
            return below, (((edge - toe) / h1 + edge / h2) * sign, -sign / h2)

        force = [2 * sum(p * s[7] + q * s[5] for (p, q), s in zip(rise(sign), [lower, upper], strict=True))
                 for sign in [1, -1]]
        k1, k2 = lower[6] + h1 * upper[7], upper[6] - h1 * upper[7]
        stiffness = 2 * (k1 / h1**2 + k2 / h2**2)
        phi = lower[2] / h1 + (h * upper[0] - upper[2]) / h2
        phi2 = lower[4] / h1**2 + (h * h * upper[0] - 2 * h * upper[2] + upper[4]) / h2**2

        def product(one, other):
            return sum(p * r * s[0] + (p * t + q * r) * s[1] + q * t * s[3]
                       for (p, q), (r, t), s in zip(one, other, [lower, upper], strict=True))

        old, new = rise(1), rise(-1)
        return {
            "mass": self.points(Decimal(0), h, loads=False)[0],
            "effective_mass": 2 * phi2, "participation": phi / phi2,
            "F0": force[0], "F0_negative": force[1],
            "u_ins": force[0] / stiffness, "u_ins_negative": force[1] / stiffness,
            "restitution_used": (phi2 - product(old, new)) / (phi2 + product(new, new)),
        }  # fmt: skip


def rows(name, scene, motion):
    """Every reference of a scene."""
    if name.startswith("body_"):
        values = Body(tomllib.loads(scene)).values()
        # the sums of a body cancel some digits
        return [(variable, 0.0, value, value, 10 * ROUNDING) for variable, value in values.items()]
    if name == "full_facade":
        scene = tomllib.loads(scene)
        u, v = (Decimal(repr(scene["start"][key])) for key in ["u_start", "u_dot_start"])
        values = Body(scene).values_of_rotation(u, v, Decimal(repr(motion["bottom"][0])))
        return [(variable, 0.0, *value, 10 * ROUNDING) for variable, value in values.items()]
    if name[0] in "cto" and name[1:3].isdigit():
        return list(case(name))
    wall = Wall(tomllib.loads(scene), motion)
    if name in ["tie_breaks", "tie_turns", "tie_brittle"]:
        return list(yielding(name, wall))
    if name.startswith("damped"):
        wanted = ["damping_force"]
    elif name.startswith("ratio"):
        return [("xi_used", 0.0, wall.ratio(), wall.ratio(), ROUNDING)]
    elif name.startswith("e_"):
        return [("restitution_used", 0.0, wall.restitution(), wall.restitution(), ROUNDING)]
    elif name in STATIC:
        wanted = STATIC[name].split()
    else:
        return motions(name, wall)
    values = wall.values()
    if "omega1" in wanted:
        values["omega1"] = (wall.omega1(), wall.omega1())
    return [(variable, 0.0, *values[variable], ROUNDING) for variable in wanted]


def text():
    """The content of references.csv."""
    formulas = tomllib.loads((FOLDER / "formulas.toml").read_text())["formula"]
    lines = ["scene,variable,time,reference,scale,bound"]
    for formula in formulas:
        for name, scene in formula.get("scenes", {}).items():
            for variable, time, reference, scale, bound in rows(name, scene, formula.get("motion", {})):
                numbers = f"{time!r},{float(reference)!r},{float(scale):.3e},{float(bound):.1e}"
                lines.append(f"{name},{variable},{numbers}")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    (FOLDER / "references.csv").write_text(text())
