"""A study of walls from a table and records in memory, without a file.

    python examples/python/many_walls.py
"""

import rocking_wall as rw

# %% Walls: a DataFrame, or any table with a column for each parameter.
walls = {
    "name": ["low", "high", "thick"],
    "height": [1.5, 3.0, 3.0],
    "thickness": [0.25, 0.25, 0.38],
}
try:
    import pandas
except ImportError as error:
    print(f"skipped: {error}")
else:
    walls = pandas.DataFrame(walls)

# %% Records: of the program, from files (rw.read_record) or from arrays (rw.Record).
study = rw.Study(
    walls=walls,
    records=[rw.synthetic_record(seed, duration=15) for seed in range(1, 7)],
    models=["CR", "CDC"],
    levels={"method": "hunt", "first": 0.1, "increase": 0.1, "top": 6, "resolution": 0.05, "gap": 0.5},
    report={"fractions": [1.0], "resamples": 200},
)
print(study)
for row in study.run(progress=False).fragilities.rows():
    print(f"{row['wall']:<5} {row['model']:<5} theta {row['theta_g']:.3f} g, beta {row['beta']:.3f}")
