"""How stiff should a tie be? Its force and the displacement of the wall over its stiffness.

    python examples/python/tie.py
"""

import numpy as np

import rocking_wall as rw

wall = rw.Wall(height=3, thickness=0.25, tie_height=2.5)
records = [rw.synthetic_record(seed, duration=15) for seed in (1, 2, 3)]

# %% Each motion with both signs, because the tie holds one side. In a notebook the study draws itself.
study = wall.tie(records, stiffness=[0, 1e3, 1e4, 1e5, 1e6], both_polarities=True)
print(study)
for stiffness, force, falls in zip(study.values, study.force, study.falls):
    median = np.median(force) / 1000
    print(f"{stiffness:9.0f} N/m: median force {median:6.2f} kN, {falls.sum()} of {falls.size} fall")
