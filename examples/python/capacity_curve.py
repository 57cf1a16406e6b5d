"""A pushover curve as arrays: an oscillator of anything that rocks, beside the wall of that curve.

    python examples/python/capacity_curve.py
"""

import numpy as np

import rocking_wall as rw

displacement = np.array([0.0, 0.004, 0.01, 0.02, 0.05, 0.12, 0.2])
force = 1000.0 * np.array([0.0, 1.4, 2.3, 2.6, 2.2, 1.15, 0.0])
curve = np.column_stack([displacement, force])

# %% Effective mass and participation stand in place of a geometry.
frame = rw.Wall(curve=curve, oscillator={"effective_mass": 3800, "participation": 0.75}, xi=0.04)
# %% The same curve of a wall, measured at its top: u, at the centroid, is half of it.
wall = rw.Wall(height=4, thickness=0.2, curve=curve, at_height=4.0, xi=0.04)
record = rw.synthetic_record(1, duration=15)
for name, each in [("oscillator", frame), ("wall", wall)]:
    run = each.simulate(record)
    print(f"{name:10}  u_ins {1000 * each.u_ins:5.1f} mm, largest |u| {1000 * run.u_max:5.1f} mm")
