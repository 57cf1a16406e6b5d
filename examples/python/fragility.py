"""An incremental dynamic analysis and its fragilities.

    python examples/python/fragility.py [STUDY.toml]
"""

import sys
import tempfile
from pathlib import Path

import rocking_wall as rw

STUDY = """
title = "Two parapets"
models = ["CR", "CDC"]
levels = { method = "hunt", first = 0.1, increase = 0.1, top = 6, resolution = 0.05, gap = 0.5 }
records = { synthetic = { count = 8, duration = 15 } }

[[walls]]
name = "low"
geometry = { height = 1.5, thickness = 0.25 }

[[walls]]
name = "high"
geometry = { height = 3, thickness = 0.25 }
"""

# %% A study file, as for `wall study ida`: here one that is written on the spot.
if len(sys.argv) > 1:
    study = rw.Study.from_toml(sys.argv[1])
else:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.toml"
        path.write_text(STUDY, encoding="utf-8")
        study = rw.Study.from_toml(path)
print(study)

# %% It runs on all cores; Ctrl-C stops it.
results = study.run()
print(results)

# %% The fragilities: a row for each wall, damping model and limit state.
for row in results.fragilities.rows():
    if row["u_max_over_u_ins"] == 1.0:
        print(f"{row['wall']:<5} {row['model']:<5} theta {row['theta_g']:.3f} g, beta {row['beta']:.3f}")
try:
    print(results.to_pandas())
except ImportError as error:
    print(f"skipped: {error}")
