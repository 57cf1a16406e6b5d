"""An importer for Model Exchange: SciPy's DOP853 integrates the states and locates events on its dense
output.

Unlike FMPy's importer, it sets the inputs at every evaluation of the derivatives.
"""

from ctypes import c_double

import numpy as np
from fmpy.fmi2 import FMU2Model
from scipy.integrate import solve_ivp

from unit import Unit

MOST_EVENTS = 10_000


class Exchange(Unit):
    """One instance for Model Exchange, in Event Mode once it is started."""

    KIND = FMU2Model
    next_event = None

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.state_count = self.description.numberOfContinuousStates
        self.indicator_count = self.description.numberOfEventIndicators

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
        return self._numbers(self.slave.getContinuousStates, self.state_count)

    def derivatives(self):
        return self._numbers(self.slave.getDerivatives, self.state_count)

    def indicators(self):
        return self._numbers(self.slave.getEventIndicators, self.indicator_count)

    def nominals(self):
        return self._numbers(self.slave.getNominalsOfContinuousStates, self.state_count)

    def at(self, time, states, inputs=None):
        """Sets time, states and inputs."""
        self.slave.setTime(float(time))
        self.slave.setContinuousStates((c_double * self.state_count)(*states), self.state_count)
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
        return integrate([self], end, tolerance, lambda time: self.set(**inputs(time)) if inputs else None)


def parapet_on_floor(wall, floor):
    """Returns the function that connects a parapet and a floor for `integrate`."""
    a_bottom, reaction = wall.reference("a_bottom"), floor.reference("reaction_1")
    reaction_bottom = wall.reference("reaction_bottom")
    acceleration = floor.reference("acceleration_absolute")

    def connect(_time):
        # the loop is linear: one step of Newton closes it
        (by_wall,) = wall.slave.getDirectionalDerivative([reaction_bottom], [a_bottom], [1.0])
        (by_floor,) = floor.slave.getDirectionalDerivative([acceleration], [reaction], [1.0])
        floor.set(reaction_1=wall.get("reaction_bottom"))
        gap = floor.get("acceleration_absolute") - wall.get("a_bottom")
        wall.set(a_bottom=wall.get("a_bottom") + gap / (1 - by_wall * by_floor))
        floor.set(reaction_1=wall.get("reaction_bottom"))

    return connect


def integrate(units, end, tolerance, connect):
    """Integrates units together to `end` through all events; returns the number of events.

    `connect` sets their inputs at a time, for the states that have been set.
    """
    splits = np.cumsum([unit.state_count for unit in units])[:-1]

    def place(time, states):
        for unit, own in zip(units, np.split(states, splits), strict=True):
            unit.at(time, own)
        connect(time)

    def rates(time, states):
        place(time, states)
        return np.concatenate([unit.derivatives() for unit in units])

    def crossing(unit, index):
        def event(time, states):
            place(time, states)
            return unit.indicators()[index]

        event.terminal = True
        return event

    crossings = [crossing(unit, index) for unit in units for index in range(unit.indicator_count)]
    for count in range(MOST_EVENTS):
        now = units[0].time
        if now >= end:
            return count
        stop = min([end, *(unit.next_event for unit in units if unit.next_event)])
        # the largest step is limited, so that a step cannot pass a corner and come back
        piece = solve_ivp(
            rates, (now, stop), np.concatenate([unit.states() for unit in units]),
            method="DOP853", rtol=tolerance, events=crossings, max_step=0.02,
            atol=tolerance * np.concatenate([unit.nominals() for unit in units]),
        )  # fmt: skip
        assert piece.status >= 0, piece.message
        place(piece.t[-1], piece.y[:, -1])
        asked = [unit.slave.completedIntegratorStep()[0] for unit in units]
        timed = any(unit.next_event == stop for unit in units)
        for unit in units:
            unit.time = piece.t[-1]
            if any(asked) or piece.status == 1 or timed:
                unit.event()
    raise AssertionError(f"more than {MOST_EVENTS} events")
