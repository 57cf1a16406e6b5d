"""Storeys and rocking walls as one system of equations: the reference for coupled runs.

SciPy integrates it with a tight tolerance. The unknowns at each instant are the absolute accelerations A of
the storeys and u'' of the walls:

    M_i A_i = -S_i + S_{i+1} - sum of reactions,    S_i = k_i x_i + c_i x_i',    x_i'' = A_i - A_{i-1}
    m_eff u'' + C u' + F(u) - W d/h = -lambda m_eff (w_b A_b + w_t A_t)

The reactions are those of docs/model.md. The force law is bilinear with softening parallel to the rigid law,
and C is constant. The integration restarts at each corner of the law.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp

GROUND = -1
GRAVITY = 9.81
MOST_PIECES = 10_000


class Wall:
    """Quantities of one wall from its parameters.

    `bottom` and `top` are indices of storeys, or GROUND; the top of a parapet is None.
    """

    def __init__(self, parameters, bottom, top=None, drift=False):
        p = {"width": 1.0, "density": 1800.0, "overburden": 0.0, "hinge_ratio": 0.5} | parameters
        h, b, load = p["height"], p["thickness"], p["overburden"]
        self.height, self.load, self.bottom, self.top, self.drift = h, load, bottom, top, drift
        self.mass = p["density"] * h * b * p["width"]
        self.weight = self.mass * GRAVITY
        if top is None:
            self.weights, self.participation, self.effective = (1.0, 0.0), 0.75, self.mass * 4 / 3
            f0, k0 = (self.weight + load) * b / h, 2 * (self.weight + 2 * load) / h
        else:
            h1 = p["hinge_ratio"] * h
            self.weights, self.participation = ((2 * h - h1) / (3 * h), (h + h1) / (3 * h)), 1.5
            self.effective = self.mass * 2 / 3
            f0 = 2 * (self.weight + load) * b / h1 + load * b / (h - h1)
            k0 = 2 * (self.weight + load) / h1 + 2 * load / (h - h1)
        self.u_ins, self.k0, self.f0 = f0 / k0, k0, f0
        self.edge = (self.weight + load) * b / 2
        self.u1 = p["a1"] * self.u_ins
        self.k1 = k0 * (self.u_ins - self.u1) / self.u1
        self.damping = 2 * self.effective * math.sqrt(self.k1 / self.effective) * p["xi"]
        self.start = p["u_start"]

    def force(self, u, branch):
        return self.k1 * u if branch == 0 else self.k0 * (branch * self.u_ins - u)

    def couple(self, u, d, branch):
        """Returns G: the force that weights and contacts add to the top reaction of a strip and subtract from
        the bottom one. The toe is at an edge from the end of the elastic branch on."""
        share = branch if branch else (self.k1 + self.k0) * u / self.f0
        weights = self.weight * u / 2 + (self.weight / 2 + self.load) * d
        return (share * self.edge - weights) / self.height

    def reactions(self):
        """Returns the coefficients of (A_b, A_t, u'') in the reactions at bottom and top."""
        m, (w_b, w_t) = self.mass, self.weights
        if self.top is None:
            return (m, 0.0, m), (0.0, 0.0, 0.0)
        return (m / 3, m / 6, m * w_b / 2), (m / 6, m / 3, m * w_t / 2)


class Monolith:
    """The system: `storeys` from the ground up, each on the one below, and `walls` on them."""

    def __init__(self, storeys, walls, ground=lambda t: 0.0):
        self.walls, self.ground, self.n = walls, ground, len(storeys)
        self.mass = np.array([s["mass"] for s in storeys])
        self.stiffness = np.array([s["stiffness"] for s in storeys])
        self.damping = np.array(
            [2 * s["damping_ratio"] * math.sqrt(s["mass"] * s["stiffness"]) for s in storeys]
        )
        self.start = np.concatenate([
            [s.get("displacement_start", 0.0) for s in storeys], [w.start for w in walls],
            [s.get("velocity_start", 0.0) for s in storeys], np.zeros(len(walls)),
        ])  # fmt: skip
        n, size = self.n, self.n + len(walls)
        # the last column is for the ground's acceleration
        matrix = np.zeros((size, size + 1))
        matrix[range(n), range(n)] = self.mass
        for j, wall in enumerate(walls):
            row, ends = n + j, [size if end == GROUND else end for end in (wall.bottom, wall.top)]
            matrix[row, row] += wall.effective
            for end, weight, coefficients in zip(ends, wall.weights, wall.reactions()):
                if end is None:
                    continue
                matrix[row, end] += wall.participation * wall.effective * weight
                if end < n:
                    for column, coefficient in zip((*ends, row), coefficients):
                        if column is not None:
                            matrix[end, column] += coefficient
        self.inverse = np.linalg.inv(matrix[:, :size])
        self.by_ground = matrix[:, size]

    def accelerations(self, t, y, branches):
        """Returns A of the storeys and u'' of the walls."""
        n, size = self.n, self.n + len(self.walls)
        x, v = y[:n], y[size : size + n]
        springs = self.stiffness * x + self.damping * v
        right = np.empty(size)
        right[:n] = -springs
        right[: n - 1] += springs[1:]
        ground = self.ground(t)
        for j, wall in enumerate(self.walls):
            u, speed = y[n + j], y[size + n + j]
            # a wall with a drift spans from one storey to the next
            d = x[wall.top] if wall.drift else 0.0
            right[n + j] = (
                -wall.damping * speed
                - wall.force(u, branches[j])
                + (wall.weight * d / wall.height if wall.drift else 0.0)
            )
            if wall.top is not None:
                couple = wall.couple(u, d, branches[j])
                for end, sign in [(wall.bottom, 1), (wall.top, -1)]:
                    if end != GROUND:
                        right[end] += sign * couple
        return self.inverse @ (right - self.by_ground * ground)

    def rates(self, t, y, branches):
        n, size = self.n, self.n + len(self.walls)
        found = self.accelerations(t, y, branches)
        below = np.concatenate([[self.ground(t)], found[: n - 1]])
        return np.concatenate([y[size:], found[:n] - below, found[n:]])

    def solve(self, times):
        """Returns one row per time: displacements, then velocities; storeys before walls. Times ascend."""
        n, size = self.n, self.n + len(self.walls)
        branches = [0 if abs(w.start) <= w.u1 else int(math.copysign(1, w.start)) for w in self.walls]
        events = [self._corner(j, side) for j in range(len(self.walls)) for side in (1, -1)]
        state, now, found = self.start.copy(), 0.0, []
        for _ in range(MOST_PIECES):
            for event in events:
                # events: outwards through the end of the elastic branch, or back inwards
                event.direction = event.side if branches[event.wall] == 0 else -event.side
                event.terminal = branches[event.wall] in (0, event.side)
            ahead = times[(times > now) & (times <= times[-1])]
            piece = solve_ivp(
                self.rates, (now, times[-1]), state, "DOP853", t_eval=ahead, events=events, args=(branches,),
                rtol=1e-12, atol=1e-14, max_step=0.02,
            )  # fmt: skip
            found += list(np.transpose(piece.y))
            if piece.status == 0:
                return np.array(found)
            hit = next(e for e, hits in enumerate(piece.t_events) if len(hits) and events[e].terminal)
            now, state = piece.t_events[hit][0], piece.y_events[hit][0]
            event = events[hit]
            branches[event.wall] = event.side if branches[event.wall] == 0 else 0
            assert abs(state[n + event.wall]) < self.walls[event.wall].u_ins and size
        raise AssertionError("too many corners")

    def _corner(self, j, side):
        index, corner = self.n + j, side * self.walls[j].u1

        def event(t, y, branches):
            return y[index] - corner

        event.wall, event.side = j, side
        return event
