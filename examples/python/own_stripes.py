"""Stripes with records of their own at each level, as studies of conditional spectra select them.

    python examples/python/own_stripes.py
"""

import tempfile
from pathlib import Path

import rocking_wall as rw

STUDY = """
title = "A parapet under stripes of their own records"
models = ["CR"]
intensity = { measure = "PGA" }
records = { format = "numbers", step = 0.01, unit = "m/s2" }
walls = [{ name = "parapet", geometry = { height = 3, thickness = 0.3 } }]
levels = { method = "stripes", unit = "g", stripe = [
    { intensity = 0.2, selection = "0.csv" }, { intensity = 0.3, selection = "1.csv" },
    { intensity = 0.4, selection = "2.csv" }, { intensity = 0.6, selection = "3.csv" },
] }
"""

# %% A list of records with factors for each level; here every level has other records.
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    for stripe, pga in enumerate([0.2, 0.3, 0.4, 0.6]):
        rows = ["file,scale_factor"]
        for seed in range(10 * stripe, 10 * stripe + 10):
            samples = rw.synthetic_record(seed=seed, duration=12, dt=0.01, pga=9.80665).a
            (folder / f"{seed}.txt").write_text("\n".join(map(str, samples)), encoding="utf-8")
            rows.append(f"{seed}.txt,{pga}")
        (folder / f"{stripe}.csv").write_text("\n".join(rows), encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    results = rw.Study.from_toml(folder / "study.toml").run(progress=False)

# %% Each record was run once; the curve is that of maximum likelihood over all levels.
print(len(results.levels["wall"]), "runs,", int(results.levels["overturned"].sum()), "overturned")
curve = list(results.fragilities.rows())[-1]
print(f"theta {curve['theta_g']:.3f} g, beta {curve['beta']:.3f}")
