"""Drives an FMU with a recorded input in FMPy, as `fmpy simulate --input-file` does.

Usage: shake.py FMU INPUT STOP HISTORY
"""

import sys

from fmpy import simulate_fmu
from fmpy.util import read_csv, write_csv


def main(unit, record, stop, history):
    result = simulate_fmu(unit, input=read_csv(record), stop_time=float(stop), start_values={"u_start": 0.0})
    write_csv(history, result)
    print(result["u_max"][-1])


if __name__ == "__main__":
    main(*sys.argv[1:])
