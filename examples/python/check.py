"""Static capacity against demand, on the ground and on a floor, and the check by Circolare 7/2019.

    python examples/python/check.py
"""

import rocking_wall as rw

wall = rw.Wall(height=1.5, thickness=0.3, density=1800, a1=0.03)
records = [rw.synthetic_record(seed, pga=1.5) for seed in (1, 2, 3)]

# %% The demand is the median spectrum of the records. In a notebook the check draws itself.
check = wall.check(records, code="fractions")
print(check)
side = check.numbers["sides"][0]
print(f"onset {side['onset_acceleration']:.3f} m/s², Sa(0) {side['peak_acceleration']:.3f} m/s²")
capacity, demand = side["displacement_capacity"], side["displacement_demand"]
print(f"capacity {1000 * capacity:.0f} mm, demand {1000 * demand:.0f} mm")

# %% On a storey of 0.3 s the demand is that of the floor.
on_floor = wall.on_storeys([rw.Storey(period=0.3, damping_ratio=0.05)])
print(on_floor.check(records, code="fractions"))
print(on_floor.simulate(records[0]))

# %% A spectrum of a code: periods and Sa.
spectrum = [[0.0, 2.0], [0.1, 5.0], [0.5, 5.0], [1.0, 2.5], [2.0, 1.25], [4.0, 0.3]]
print(wall.check(code="fractions", spectrum=spectrum, unit="m/s2"))

# %% The Italian code: the site, and what the engineer states of the wall. In a notebook it draws itself.
hazard = {"ag": 0.15, "F0": 2.45, "TC": 0.32, "building_damping": 0.10}
building = {"storeys": 3, "period": 0.3, "height_ratio": 1.0}
verdict = wall.check(SLV=hazard, building=building, soil="B", before_activation="law")
print(verdict)
print(*verdict.notes, sep="\n")

# %% With records the wall is run too: none beyond d_0, and the mean of the maxima within d_SLV.
dynamic = wall.check(records, SLV=hazard, soil="B", before_activation="law", method="dynamic")
print(dynamic)
for run in dynamic.numbers["dynamic"]["SLV"]["runs"]:
    print(f"{run['record']}: times {run['factor']:.3f}, d = {1000 * max(run['d']):.0f} mm")
