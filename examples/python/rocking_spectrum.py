"""Rocking spectra: walls of many sizes under a record, one wall under many pulses.

    python examples/python/rocking_spectrum.py
"""

import numpy as np

import rocking_wall as rw

wall = rw.Wall(damping_model="none", impact="restitution", force_law="rigid_linear")

# %% Which walls does a record overturn? In a notebook the spectrum draws itself.
record = rw.synthetic_record(pga=3.0)
spectrum = wall.rocking_spectrum(record, heights=np.linspace(1, 6, 11), ratios=np.linspace(6, 16, 6))
print(spectrum)
for ratio, overturned in zip(spectrum.rows, spectrum.overturned):
    print(f"h/b = {ratio:4.1f}  " + " ".join("x" if each else "." for each in overturned))

# %% Which pulses overturn a wall? The axes are dimensionless: walls of any size have this spectrum.
pulses = wall.pulse_spectrum("sine_cycle", frequency_ratios=range(1, 10), amplitude_ratios=range(1, 7))
print(pulses)
try:
    print(pulses.to_pandas().groupby("amplitude_ratio")["overturned"].sum())
except ImportError as error:
    print(f"skipped: {error}")
