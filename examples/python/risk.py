"""From a table of walls to the annual rate at which they fall.

    python examples/python/risk.py [COUNT]

A class of parapets, of one height and thickness each, under synthetic records on a site with a hazard curve.
"""

import sys

import numpy as np

import rocking_wall as rw

# %% The walls: a DataFrame with these columns does as well.
count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
rng = np.random.default_rng(1)
walls = {
    "name": [f"wall {number}" for number in range(1, count + 1)],
    "height": rng.uniform(1.0, 3.0, count),
    "thickness": rng.normal(0.30, 0.02, count),
}

# %% The hazard: intensities (g) and annual rates at which they are exceeded.
study = rw.Study(
    walls=walls,
    records=[rw.synthetic_record(seed) for seed in range(1, 11)],
    models=["CDC"],
    intensity={"measure": "AvgSA"},
    levels={"method": "hunt", "first": 0.05, "increase": 0.05, "top": 10, "gap": 0.1},
    report={"fractions": [0.4, 1.0], "resamples": 200},
    classes=[{"name": "parapets"}],
    hazard={"points": [[0.05, 1 / 30], [0.1, 1 / 101], [0.2, 1 / 475], [0.4, 4e-4], [0.8, 1e-4], [2, 2e-6]]},
)
results = study.run()  # a folder keeps the runs: study.run("risk_results")

# %% The class: its curve, and the annual rate of each limit state with the interval of the records.
for curve, rate in zip(results.curves.rows()[-2:], results.rates.rows()[-2:]):
    print(
        f"{rate['u_max_over_u_ins']} u_ins: theta {curve['theta']:.3f} g, beta {curve['beta']:.3f}, "
        f"{rate['annual_rate']:.2e} a year ({rate['annual_rate_low']:.2e} to {rate['annual_rate_high']:.2e})"
    )
