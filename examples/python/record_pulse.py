"""Which pulse of a record moves a wall? Its period, and the amplitude with which the wall has the same peak.

    python examples/python/record_pulse.py [RECORD.AT2 [UNIT]]
"""

import sys

import rocking_wall as rw

record = rw.read_record(*sys.argv[1:]) if sys.argv[1:] else rw.synthetic_record(3, duration=12)
for height in (1.5, 3.0, 6.0):
    wall = rw.Wall(height=height, thickness=height / 10)
    pulses = wall.record_pulses(record)
    print(f"h = {height} m, largest |u|/u_ins {wall.simulate(record).u_ratio_max:.3f}")
    columns = ("pulse", "period_s", "misfit", "fitted_m_s2", "amplitude_m_s2")
    for pulse, period, misfit, fitted, amplitude in zip(*(pulses[name] for name in columns), strict=True):
        print(f"  {pulse:12} T = {period:.2f} s, misfit {misfit:.2f}, {fitted:.2f} and {amplitude:.2f} m/s2")
