"""A study of records that a selector chose, with their scale factors and weights.

    python examples/python/selected_records.py
"""

import tempfile
from pathlib import Path

import rocking_wall as rw

STUDY = """
title = "A parapet under selected records"
models = ["CR"]
levels = { method = "cloud" }
intensity = { measure = "PGA" }
records = { selection = "selection.csv", format = "numbers", step = 0.01, unit = "m/s2" }
walls = [{ name = "parapet", geometry = { height = 3, thickness = 0.3 } }]
"""

# %% A list of records, as selectors write it, and here records to go with it.
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    rows = ["file,scale_factor,weight"]
    for seed in range(1, 13):
        samples = rw.synthetic_record(seed=seed, duration=12, dt=0.01).a
        (folder / f"{seed}.txt").write_text("\n".join(map(str, samples)), encoding="utf-8")
        rows.append(f"{seed}.txt,{0.3 + 0.05 * seed:.2f},{2 if seed < 4 else 1}")
    (folder / "selection.csv").write_text("\n".join(rows), encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    study = rw.Study.from_toml(folder / "study.toml")

# %% Factors are in the samples; a record with twice the weight counts as two.
results = study.run(progress=False)
for row in results.records.rows():
    print(row["record"], f"factor {row['factor']:.2f}, weight {row['weight']:.2f}: {row['intensity_g']:.3f}g")
curve = list(results.fragilities.rows())[-1]
print(f"theta {curve['theta_g']:.3f} g, beta {curve['beta']:.3f}")
