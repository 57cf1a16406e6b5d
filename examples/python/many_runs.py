"""Many runs of one wall: at which factor does a record overturn it?

    python examples/python/many_runs.py
"""

import numpy as np

import rocking_wall as rw

wall = rw.Wall(height=3, thickness=0.25, damping_model="none", impact="restitution")
record = rw.synthetic_record()

# %% A thousand runs, eight side by side.
factors = np.linspace(0.1, 5.0, 1000)
peaks = wall.peaks(record, factors)
print(peaks)
print("first overturned at the factor", peaks.factor[peaks.overturned][0].round(4))
print("standing above it:", int((~peaks.overturned[peaks.overturned.argmax() :]).sum()), "runs")

# %% A run in a batch is that run by itself.
one = wall.simulate(record, scale=factors[100])
print(f"{peaks.u_max[100]:.9f} m in the batch, {one.u_max:.9f} m by itself")

# %% Records by the numbers of their seeds: the median factor of overturning.
collapse = []
for seed in range(1, 21):
    peaks = wall.peaks(rw.synthetic_record(seed), factors)
    collapse.append(peaks.factor[peaks.overturned.argmax()] if peaks.overturned.any() else np.inf)
print("median factor of overturning of 20 records:", np.median(collapse).round(3))
