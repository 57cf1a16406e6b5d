"""One wall and one record: what the wall is, how it responds, what the record asks of it.

    pip install rocking-wall
    python examples/python/one_wall.py [RECORD.AT2 [UNIT]]
"""

import sys

import rocking_wall as rw

# %% A record: a file in one of the usual formats, an array, or the synthetic motion.
if len(sys.argv) > 1:
    record = rw.read_record(sys.argv[1], unit=sys.argv[2] if len(sys.argv) > 2 else None)
else:
    record = rw.synthetic_record(pga=1.5)
print(record)
print("Sa(0.2, 0.5, 1 s) =", record.spectrum([0.2, 0.5, 1.0]).round(3), "m/s²")
print("AvgSA             =", round(record.average_sa(), 3), "m/s²")

# %% A parapet of 3 m. help(rw.Wall) lists the parameters with their units and defaults.
wall = rw.Wall(height=3, thickness=0.25)
print(wall.describe())

# %% Its response. In a notebook `response` alone on a line draws itself.
response = wall.simulate(record)
print(response)
highest = response.demands["u"]["highest"]
print(f"largest u: {1000 * highest['value']:.2f} mm at {highest['time']:.3f} s")

# %% The same wall with restitution instead of viscous damping.
rocking = wall.replace(damping_model="none", impact="restitution", force_law="rigid_linear")
print(rocking.simulate(record))

# %% Tables and plots, where pandas and matplotlib are installed.
try:
    print(response.to_pandas().describe())
    response.plot().figure.savefig("one_wall.png")
except ImportError as error:
    print(f"skipped: {error}")
