"""Support forces of rocking walls from Newton and Euler, body by body: rigid rods, small rotations, moving
supports.

A rod of mass m and length h has the horizontal displacements x0 at its foot and x1 at its head. Its centre is
at their mean, and its rotation is (x1 - x0)/h. Horizontal forces act at foot and head. The vertical forces
(weight, overburden, pivots) and the dampers give a couple M that turns the head towards +x:

    m (x0'' + x1'')/2 = P0 + P1                     (Newton)
    m h²/12 (x1'' - x0'')/h = (P1 - P0) h/2 + M      (Euler)

The wall's equation of motion is not used here.
"""

import numpy as np


def parapet(mass, height, acceleration, u_acceleration):
    """Returns base force and couple [N, N m] of a rod that rocks on its base, without a force at its head."""
    foot, head = acceleration, acceleration + 2 * u_acceleration
    base = mass * (foot + head) / 2
    couple = mass * height / 12 * (head - foot) + base * height / 2
    return base, couple


def strip(mass, height, hinge, accelerations, u_acceleration, drift_couple):
    """Returns the forces at bottom, top and hinge, and the force Q against u [N].

    Two rods are joined at the height `hinge`. Their couples M1 and M2 do the virtual work
    M1 dθ1 + M2 dθ2 = -Q du - G dd, with θ1 = d/h + u/h1 and θ2 = d/h - u/h2. Hence M1/h1 - M2/h2 = -Q and
    (M1 + M2)/h = -G. `drift_couple` is G.
    """
    h1, h2 = hinge, height - hinge
    m1, m2 = mass * h1 / height, mass * h2 / height
    bottom, top = accelerations
    middle = bottom * h2 / height + top * h1 / height + u_acceleration
    # unknowns: R_b, R_t, H (of the upper rod on the lower one), M1, M2, Q
    equations = np.zeros((6, 6))
    right = np.zeros(6)
    equations[0, [0, 2]], right[0] = [1, 1], m1 * (bottom + middle) / 2
    equations[1, [0, 2, 3]], right[1] = [-h1 / 2, h1 / 2, 1], m1 * h1 / 12 * (middle - bottom)
    equations[2, [1, 2]], right[2] = [1, -1], m2 * (middle + top) / 2
    equations[3, [1, 2, 4]], right[3] = [h2 / 2, h2 / 2, 1], m2 * h2 / 12 * (top - middle)
    equations[4, [3, 4, 5]] = [1 / h1, -1 / h2, 1]
    equations[5, [3, 4]], right[5] = [1 / height, 1 / height], -drift_couple
    bottom_force, top_force, hinge_force, _, _, against = np.linalg.solve(equations, right)
    return bottom_force, top_force, hinge_force, against


def rod_energy(mass, foot, head):
    """Returns the kinetic energy [J] of a rod from the velocities of its ends."""
    return mass / 6 * (foot * foot + foot * head + head * head)
