"""Static capacity against demand, on the ground and on a floor.

    python examples/python/check.py
"""

import rocking_wall as rw

wall = rw.Wall(height=1.5, thickness=0.3)
records = [rw.synthetic_record(seed, pga=1.5) for seed in (1, 2, 3)]

# %% The demand is the median spectrum of the records. In a notebook the check draws itself.
check = wall.check(records)
side = check.governing
print(check)
print(f"onset {side.onset_acceleration:.3f} m/s², Sa(0) {side.peak_acceleration:.3f} m/s²")
print(f"capacity {1000 * side.displacement_capacity:.0f} mm, demand {1000 * side.displacement_demand:.0f} mm")

# %% On a storey of 0.3 s the demand is that of the floor.
on_floor = wall.on_storeys([rw.Storey(period=0.3, damping_ratio=0.05)])
print(on_floor.check(records))
print(on_floor.simulate(records[0]))

# %% A spectrum of a code: periods and Sa.
print(wall.check(spectrum=([0.0, 0.1, 0.5, 1.0, 2.0, 4.0], [2.0, 5.0, 5.0, 2.5, 1.25, 0.3])))
