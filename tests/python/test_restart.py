"""States that outlive their process: `examples/python/restart.py`, and what refuses a foreign state."""

import struct
import subprocess
import sys

import pytest
from fmpy.fmi1 import FMICallException

from conftest import ROOT
from unit import Unit

EXAMPLE = ROOT / "examples/python/restart.py"
# of the example
STEP, BREAK, END = 0.01, 200, 500


def mended(body):
    """The bytes of a state with their checksum, FNV-1a with 64 bits."""
    checksum = 0xCBF29CE484222325
    for byte in body:
        checksum = (checksum ^ byte) * 0x100000001B3 % 2**64
    return body + struct.pack("<Q", checksum)


def restart(*arguments):
    """Runs the example in a process of its own and returns what it prints."""
    command = [sys.executable, EXAMPLE, *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def test_a_run_goes_on_in_another_process(unpacked, fmu):
    """With the bits of a run without a break, in both versions of FMI and from one to the other."""
    with Unit(unpacked) as unit:
        unit.start()
        for index in range(END):
            unit.slave.doStep(currentCommunicationPoint=index * STEP, communicationStepSize=STEP)
        expected = unit.get("u")
    told = restart(fmu.parent).splitlines()
    assert len(told) == 4 and all(line.endswith(f": u = {expected} m") for line in told), told


def refusal(unit, state):
    """Returns why the unit refuses a state; it stays usable."""
    with pytest.raises(FMICallException):
        unit.slave.deserializeFMUState(state)
    unit.step(0.01)
    return unit.messages.pop()[2]


def test_a_state_of_another_version_is_refused_with_that_word(either):
    with Unit(either) as unit:
        state = unit.start().slave.serializeFMUState(unit.slave.getFMUState())
        guid = 24
        behind_guid = guid + len(either.description.guid)
        for message, at, new in (
            ("version 2 of the format, this library reads version 3", 8, struct.pack("<Q", 2)),
            ("the state is of another version of this unit", guid, b"{another"),
            ("version 9 of the model's state, this library reads", behind_guid, struct.pack("<Q", 9)),
            ("version 1 of the model's state, this library reads", behind_guid, struct.pack("<Q", 1)),
        ):
            body = state[:at] + new + state[at + len(new) : -8]
            assert message in refusal(unit, mended(body))


@pytest.mark.parametrize(
    ("archive", "model", "length"), [("unpacked", 4, 670), ("unpacked_floor", 1, 501)]
)
def test_a_change_of_the_state_raises_its_version(request, archive, model, length):
    """The values of a state are a list of `transfer_state`; another length is another version of it."""
    unpacked = request.getfixturevalue(archive)
    with Unit(unpacked) as unit:
        state = unit.start().slave.serializeFMUState(unit.slave.getFMUState())
    behind_guid = 24 + len(unpacked.description.guid)
    version, payload = struct.unpack_from("<QQ", state, behind_guid)
    assert (version, payload) == (model, length), "raise STATE_VERSION of the model, then change this test"
