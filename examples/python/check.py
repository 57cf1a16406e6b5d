"""Static capacity against demand, on the ground and on a floor, and the check by Circolare 7/2019.

    python examples/python/check.py
"""

import rocking_wall as rw

wall = rw.Wall(height=1.5, thickness=0.3)
records = [rw.synthetic_record(seed, pga=1.5) for seed in (1, 2, 3)]

# %% The demand is the median spectrum of the records. In a notebook the check draws itself.
check = wall.check(records)
print(check)
for row in check.table.rows():
    print(f"{row['side']}, {row['check']}: capacity {row['capacity']:.3f}, demand {row['demand']:.3f}")

# %% On a storey of 0.3 s the demand is that of the floor.
on_floor = wall.on_storeys([rw.Storey(period=0.3, damping_ratio=0.05)])
print(on_floor.check(records))
print(on_floor.simulate(records[0]))

# %% A spectrum of a code: periods and Sa.
print(wall.check(spectrum=([0.0, 0.1, 0.5, 1.0, 2.0, 4.0], [2.0, 5.0, 5.0, 2.5, 1.25, 0.3])))

# %% The Italian code: the site, and what the engineer states of the wall. In a notebook it draws itself.
site = {"SLV": {"ag": 0.15, "F0": 2.45, "TC": 0.32, "building_damping": 0.10}}
building = {"storeys": 3, "period": 0.3, "height_ratio": 1.0}
verdict = wall.check(site=site, building=building, soil="B", before_activation="law")
print(verdict)
side = verdict.values["sides"]["positive"]
print(f"holds up to a_g = {side['SLV']['ag']:.3f} g, reference {site['SLV']['ag']} g")

# %% With records the wall is run too: none beyond d_0, and the mean of the maxima within d_SLV.
dynamic = wall.check(records, site=site, soil="B", before_activation="law", method="dynamic")
print(dynamic)
for run in dynamic.values["dynamic"]["SLV"]["runs"]:
    print(f"{run['record']}: times {run['factor']:.3f}, d = {1000 * max(run['d']):.0f} mm")
