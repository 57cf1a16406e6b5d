"""Storeys and walls as one system, under a record.

    python examples/python/building.py
"""

from pathlib import Path

import rocking_wall as rw

FILE = Path(__file__).parents[2] / "scenes" / "building" / "three_storeys.toml"

# %% The file is that of `wall building`.
building = rw.Building.from_toml(FILE)
print(building)

# %% Floors and walls move in one loop. In a notebook the response draws itself.
response = building.simulate(rw.synthetic_record(duration=12), scale=0.5, tail=5.0, tolerance=0.05)
print(response)
for name, floor in response.floors.items():
    peak = floor.acceleration_peak
    print(f"{name}: {abs(peak['value']):.2f} m/s² at {peak['time']:.2f} s")
for row in response.peaks.rows():
    fate = f"exceeds u_ins at {row['overturn_time']:.2f} s" if row["overturned"] else "stands"
    print(f"{row['wall']}: {abs(row['u_ratio_peak']):.2f} u_ins, {fate}")
