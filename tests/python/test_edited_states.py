"""Edits the bytes of saved states, with a checksum that suits them, and uses what is not refused."""

import math
import struct

import pytest
from fmpy.fmi1 import FMICallException

from unit import Unit

WALL = {"u_start": 0.1}
STRIP = {"mechanism": "vertical_spanning", "thickness": 0.1, "u_start": 0.02, "impact": "restitution"}
LINEAR = {"displacement_start": 0.01}
BILINEAR = {"displacement_start": 0.1, "hysteresis": "bilinear"}

EDITS = [struct.pack("<d", value) for value in (math.nan, math.inf, -1.0, 1e300, -1e-300)]
EDITS += [bytes(8), b"\xff" * 8, struct.pack("<Q", 2)]


def mended(state, start, payload):
    """The state with another payload and its checksum, FNV-1a with 64 bits."""
    body = state[:start] + payload
    checksum = 0xCBF29CE484222325
    for byte in body:
        checksum = (checksum ^ byte) * 0x100000001B3 % 2**64
    return body + struct.pack("<Q", checksum)


def finite(unit):
    """Whether all outputs are finite; one that cannot be read is not an answer."""
    names = [name for name, variable in unit.variables.items() if variable.type == "Real"]
    return all(math.isfinite(value) for value in unit.slave.getReal([unit.reference(n) for n in names]))


def used(unit, edited):
    """Loads edited bytes and goes on from there. Returns whether everything was accepted."""
    state = None
    try:
        state = unit.slave.deserializeFMUState(edited)
        unit.slave.setFMUState(state)
        assert finite(unit)
        unit.slave.doStep(0.03, 0.01)
        assert finite(unit)
        return True
    except FMICallException as error:
        assert error.status == 3, "fmi2Error"
        return False
    finally:
        if state is not None:
            unit.slave.freeFMUState(state)


@pytest.mark.parametrize(
    ("archive", "settings"),
    [
        ("unpacked", WALL),
        ("unpacked", STRIP),
        ("unpacked3", STRIP),
        ("unpacked_floor", LINEAR),
        ("unpacked_floor", BILINEAR),
    ],
)
def test_edited_states_are_refused_or_work(request, archive, settings):
    unpacked = request.getfixturevalue(archive)
    with Unit(unpacked) as unit:
        unit.start(**settings)
        for _ in range(3):
            unit.step(0.01)
        own = unit.slave.getFMUState()
        state = unit.slave.serializeFMUState(own)
        start = 16 + 8 + len(unpacked.description.guid) + 8 + 8
        payload = state[start:-8]
        assert mended(state, start, payload) == state
        assert used(unit, state)
        accepted = 0
        for at in range(len(payload) - 7):
            for edit in EDITS:
                edited = mended(state, start, payload[:at] + edit + payload[at + 8 :])
                accepted += used(unit, edited)
                assert not any("internal error" in text for _, _, text in unit.messages), unit.messages[-1]
                unit.messages.clear()
                unit.slave.setFMUState(own)
        assert accepted > 0
        assert used(unit, state), "still usable"


def test_a_parameter_beyond_its_limits_is_named(unpacked_floor):
    with Unit(unpacked_floor) as unit:
        unit.start(**BILINEAR, yield_force=54321.0)
        state = unit.slave.serializeFMUState(unit.slave.getFMUState())
        start = 16 + 8 + len(unpacked_floor.description.guid) + 8 + 8
        payload = state[start:-8].replace(struct.pack("<d", 54321.0), struct.pack("<d", -1.0))
        assert not used(unit, mended(state, start, payload))
        assert "yield_force = -1.0 N is below its minimum" in unit.messages[-1][2]
        assert unit.get("yield_force") == 54321.0
