"""Measures coupling error against communication step and run time, for each scheme, held and linear inputs.

    python measure.py WALL.fmu FLOOR.fmu OUTPUT_FOLDER

Writes a CSV file and a table. The reference is the system integrated as one
(tests/python/monolith.py). The master is that of examples/coupling. Run times are those of this master in
Python; they show how many steps and sweeps each scheme takes.
"""

import csv
import math
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "examples/coupling"), str(ROOT / "tests/python")]
import compiled  # noqa: E402
from master import SCHEMES, Archive  # noqa: E402
from monolith import Monolith, Wall  # noqa: E402
from run import pulse  # noqa: E402
from wiring import FLOOR, STOREYS, WALL, WALLS, building, wall_on_floor  # noqa: E402

DURATION = 2.0
GRID = 0.01
STEPS = [0.01, 0.005, 0.0025, 0.00125, 0.000625]
# Number of runs; the fastest counts.
REPEATS = 2
# A run whose error over the peak exceeds this is lost.
LOST = 1.0


def storey(ratio, frequency):
    """Returns a floor whose mass is that of the example wall divided by `ratio`."""
    mass = Wall(WALL, 0).mass / ratio
    return {"mass": mass, "stiffness": mass * (2 * math.pi * frequency) ** 2, "damping_ratio": 0.05}


def single(floor):
    def make(wall, unit):
        return wall_on_floor(wall, unit, {"floor": floor}, pulse)

    return make, ["floor.displacement", "wall.u"], Monolith([floor], [Wall(WALL, 0)], pulse)


def problems():
    walls = [Wall(WALLS["strip"], 0, 1, drift=True), Wall(WALLS["parapet"], 1)]
    return {
        "A wall of 0.15 M on a floor of 5 Hz": single(FLOOR),
        "A wall as heavy as its floor, 50 Hz": single(storey(1.0, 50.0)),
        "A wall ten times as heavy as its floor, 50 Hz": single(storey(10.0, 50.0)),
        "The building: two storeys, a strip wall, a parapet": (
            lambda wall, unit: building(wall, unit, motion=pulse),
            ["floor_1.displacement", "floor_2.displacement", "strip.u", "parapet.u"],
            Monolith(STOREYS.values(), walls, pulse),
        ),
    }


def run(make, archives, scheme, step, watched):
    """Returns histories at multiples of GRID, and the processor time in s."""
    system = make(*archives)
    system.initialize()
    often, history = round(GRID / step), []
    start = time.process_time()
    try:
        for index in range(1, round(DURATION / step) + 1):
            SCHEMES[scheme](system, step)
            if index % often == 0:
                history.append([system.get(name) for name in watched])
    except Exception as error:  # a lost run exceeds a unit's limits, or its loop does not close
        return None, str(error)
    return np.array(history), time.process_time() - start


def measure(archives):
    """Returns rows of problem, scheme, step, error over the peak (NaN where lost), seconds."""
    rows = []
    times = GRID * np.arange(1, round(DURATION / GRID) + 1)
    for name, (make, watched, monolith) in problems().items():
        truth = monolith.solve(times)[:, : len(watched)]
        peaks = np.abs(truth).max(axis=0)
        for scheme in SCHEMES:
            for step in STEPS:
                seconds = math.inf
                for _ in range(REPEATS):
                    history, taken = run(make, archives, scheme, step, watched)
                    if history is None:
                        break
                    seconds = min(seconds, taken)
                error = math.nan if history is None else float((np.abs(history - truth) / peaks).max())
                rows.append((name, scheme, step, error if error < LOST else math.nan, seconds))
        print(f"measured: {name}", flush=True)
    return rows


def table(rows):
    """Returns Markdown: errors at two steps, observed order, run time of a simulated second at 2.5 ms."""
    lines = [
        "| system | scheme | error/peak at 5 ms | at 1.25 ms | order | run time at 2.5 ms [ms] |",
        "|---|---|---|---|---|---|",
    ]
    for name in dict.fromkeys(row[0] for row in rows):
        title = name
        for scheme in SCHEMES:
            found = {
                step: (error, seconds) for n, s, step, error, seconds in rows if (n, s) == (name, scheme)
            }
            good = [
                (step, error) for step, (error, _) in found.items() if step <= 0.005 and math.isfinite(error)
            ]
            order = f"{np.polyfit(*np.log(np.array(good).T), 1)[0]:.2f}" if len(good) >= 3 else "—"
            shown = [f"{found[s][0]:.0e}" if math.isfinite(found[s][0]) else "lost" for s in (0.005, 0.00125)]
            cost = f"{found[0.0025][1] / DURATION * 1e3:.0f}" if math.isfinite(found[0.0025][0]) else "—"
            lines.append(f"| {title} | {scheme} | {shown[0]} | {shown[1]} | {order} | {cost} |")
            title = ""
    return "\n".join(lines) + "\n"


def main():
    wall, floor, output = sys.argv[1:]
    output = Path(output)
    with Archive(wall) as wall_archive, Archive(floor) as floor_archive:
        archives = wall_archive, floor_archive
        rows = measure(archives)
    with open(output / "coupling.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["system", "scheme", "step_s", "error_over_peak", "seconds"])
        writer.writerows(rows)
    hundred = compiled.run(wall, floor, 100, 10.0, 0.001)
    # the allocator takes whole pages, so only many walls show how much one needs
    each = compiled.run(wall, floor, 2000, 0.001, 0.001)["bytes_per_wall"]
    (output / "coupling.md").write_text(
        table(rows)
        + "\nThe compiled master (one thread) runs 100 walls on two storeys for 10 s at steps of 1 ms in "
        f"{hundred['run_time_s']:.2f} s.\nEach wall takes {each / 1024:.1f} kB of memory.\n"
    )


if __name__ == "__main__":
    main()
