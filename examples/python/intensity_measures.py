"""Which intensity measure fits these walls? Its efficiency, practicality and sufficiency, from one study.

    python examples/python/intensity_measures.py
"""

import rocking_wall as rw

study = rw.Study(
    walls={"low": rw.Wall(1.5, 0.25), "high": rw.Wall(4, 0.4)},
    records=[rw.synthetic_record(seed, duration=12, dt=0.01) for seed in range(1, 16)],
    models=["CR"],
    levels={"method": "step", "step": 0.02, "top": 3},
    intensity={"measure": "PGA", "compare": ["PGA", "PGV", "Sa(0.5)", "AvgSA", "Housner"]},
)
results = study.run(progress=False)

# %% A measure is efficient where theta and the demand D scatter little in it, and sufficient where the
# p-value of the duration is not small.
print("measure    sigma ln theta  sigma ln D  slope b  p of duration")
for row in results.measures.rows():
    if row["wall"] == "all walls":
        scatter = f"{row['sigma_ln_theta']:14.3f}  {row['sigma_ln_d']:10.3f}"
        print(f"{row['measure']:9}  {scatter}  {row['b']:7.2f}  {row['p_theta_duration']:13.2f}")
