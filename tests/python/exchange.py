"""An importer for Model Exchange: SciPy's DOP853 integrates the states and locates events on its dense
output.

Unlike FMPy's importer, it sets the inputs at every evaluation of the derivatives.
"""

from ctypes import c_double

import numpy as np
from fmpy.fmi2 import FMU2Model
from scipy.integrate import solve_ivp

from unit import Unit

STATES = 2
INDICATORS = 3
MOST_EVENTS = 10_000


class Exchange(Unit):
    """One instance for Model Exchange, in Event Mode once it is started."""

    KIND = FMU2Model
    next_event = None

    def run(self, **values):
        """Starts and enters Continuous-Time Mode."""
        self.start(**values)
        self.update()
        self.slave.enterContinuousTimeMode()
        return self

    def update(self):
        """Iterates the event; returns whether states have jumped."""
        jumped = False
        for _ in range(10):
            again, end, nominals, changed, timed, time = self.slave.newDiscreteStates()
            assert not end
            assert not nominals
            jumped |= changed
            self.next_event = time if timed else None
            if not again:
                return jumped
        raise AssertionError("the event iteration does not end")

    def _numbers(self, getter, count):
        values = (c_double * count)()
        getter(values, count)
        return list(values)

    def states(self):
        return self._numbers(self.slave.getContinuousStates, STATES)

    def derivatives(self):
        return self._numbers(self.slave.getDerivatives, STATES)

    def indicators(self):
        return self._numbers(self.slave.getEventIndicators, INDICATORS)

    def nominals(self):
        return self._numbers(self.slave.getNominalsOfContinuousStates, STATES)

    def at(self, time, states, inputs=None):
        """Sets time, states and inputs."""
        self.slave.setTime(float(time))
        self.slave.setContinuousStates((c_double * STATES)(*states), STATES)
        if inputs:
            self.set(**inputs(time))
        return self

    def event(self):
        self.slave.enterEventMode()
        jumped = self.update()
        self.slave.enterContinuousTimeMode()
        return jumped

    def integrate(self, end, tolerance, inputs=None):
        """Integrates to `end` through all events; returns their number."""
        for count in range(MOST_EVENTS):
            if self.time >= end:
                return count
            stop = min(end, self.next_event or end)
            crossings = [self._crossing(index, inputs) for index in range(INDICATORS)]
            # the largest step is limited, so that a step cannot pass a corner and come back
            piece = solve_ivp(
                lambda t, x: self.at(t, x, inputs).derivatives(), (self.time, stop), self.states(),
                method="DOP853", rtol=tolerance, atol=tolerance * np.array(self.nominals()),
                events=crossings, max_step=0.02,
            )  # fmt: skip
            assert piece.status >= 0, piece.message
            self.time = piece.t[-1]
            asked, _ = self.at(self.time, piece.y[:, -1], inputs).slave.completedIntegratorStep()
            if asked or piece.status == 1 or stop == self.next_event:
                self.event()
        raise AssertionError(f"more than {MOST_EVENTS} events")

    def _crossing(self, index, inputs):
        def crossing(t, x):
            return self.at(t, x, inputs).indicators()[index]

        crossing.terminal = True
        return crossing
