"""The damping with which a wall rocks as it does with restitution.

    python examples/python/calibration.py
"""

import rocking_wall as rw

# %% Each fit is a free vibration; a few values of e and a1 take a second.
wall = rw.Wall(height=3, thickness=0.25)
calibration = wall.calibrate(["constant_ratio"], restitution=[0.85, 0.9], a1=[0.02, 0.03, 0.05])
print(calibration)

# %% xi = -x ln e, beside what the paper prints.
for row in calibration.coefficients.rows():
    print(f"a1 = {row['a1']:.2f}: x = {row['x']:.4f}, paper {row['x_paper']:.4f}")
[law] = calibration.laws.rows()
print(f"x = {law['q']:.3f} a1^{law['r']:.3f}")
