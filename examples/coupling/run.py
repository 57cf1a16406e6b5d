"""Shakes a wall on a floor, or a building, with each scheme in turn.

    python examples/coupling/run.py [wall | building] [step]

Needs FMPy and NumPy, and fmu_out/wall.fmu and floor.fmu (`cargo xtask fmu`). The last column compares with
iteration at a tenth of the step.
"""

import math
import sys
import time
from pathlib import Path

from master import SCHEMES, Archive
from wiring import building, wall_on_floor

OUT = Path(__file__).parents[2] / "fmu_out"
DURATION = 3.0
SHAPES = {"wall": (wall_on_floor, "wall.u"), "building": (building, "parapet.u")}


def pulse(t):
    """Returns the ground acceleration [m/s²]: two periods of 0.5 s that grow and decay."""
    return 3.0 * math.sin(math.pi * t) ** 2 * math.sin(4 * math.pi * t) if t < 1.0 else 0.0


def shake(make, archives, scheme, step, watched):
    """Returns the history of a variable at multiples of 10 ms, and the overturning times of walls."""
    system = make(*archives, motion=pulse)
    system.initialize()
    steps, often = round(DURATION / step), round(0.01 / step)
    history = []
    for index in range(1, steps + 1):
        SCHEMES[scheme](system, step)
        if index % often == 0:
            history.append(system.get(watched))
    fallen = {
        name: unit.get("overturn_time")
        for name, unit in system.units.items()
        if "overturned" in unit.variables and unit.get("overturned")
    }
    return history, fallen


def main():
    make, watched = SHAPES[sys.argv[1] if len(sys.argv) > 1 else "wall"]
    step = float(sys.argv[2]) if len(sys.argv) > 2 else 0.002
    with Archive(OUT / "wall.fmu") as wall, Archive(OUT / "floor.fmu") as floor:
        best, _ = shake(make, (wall, floor), "iterated, linear", step / 10, watched)
        peak = max(map(abs, best))
        print(
            f"{watched}: peak {peak * 1e3:.2f} mm; step {step} s\n"
            f"{'scheme':<30}{'run time [s]':>14}{'error/peak':>14}"
        )
        for scheme in SCHEMES:
            start = time.perf_counter()
            history, fallen = shake(make, (wall, floor), scheme, step, watched)
            error = max(abs(a - b) for a, b in zip(history, best)) / peak
            falls = "".join(f"  {name} overturned at t = {moment:.3f} s" for name, moment in fallen.items())
            print(f"{scheme:<30}{time.perf_counter() - start:>14.2f}{error:>14.1e}{falls}")


if __name__ == "__main__":
    main()
