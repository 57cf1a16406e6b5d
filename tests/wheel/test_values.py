"""Walls and records are values: they do not change, can be copied, sent and compared."""

import concurrent.futures
import copy
import pickle
from types import SimpleNamespace

import numpy as np
import pytest

import rocking_wall as rw
from rocking_wall import _native

SAMPLES = np.array([0.0, 0.5, -1.25, 3.0, -0.75, 0.25])
WALLS = {
    "default": rw.Wall(),
    "named start": rw.Wall(height=3, thickness=0.25, u_start=0.01),
    "law of points": rw.Wall(a1=0.05, force_law="multilinear", points=[[0.02, 0.8], [0.1, 0.9], [1.0, 0.0]]),
    "full rotations": rw.Wall(
        kinematics="trigonometric", force_law="rigid_linear", damping_model="none", impact="restitution"
    ),
    "motion": rw.Wall.from_toml("scenes/shaken_parapet.toml"),
    "floor": rw.Wall.from_toml("scenes/parapet_on_a_roof.toml"),
    "floors": rw.Wall.from_toml("scenes/strip_between_floors.toml"),
    "period alone": rw.Wall(height=3, thickness=0.25).on_storeys([rw.Storey(period=0.3)]),
}
WAYS = [copy.copy, copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value))]


@pytest.mark.filterwarnings("ignore:a1 is set and has no effect")
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", WALLS)
def test_a_wall_is_copied_and_sent(name, way, record):
    wall = WALLS[name]
    other = way(wall)
    assert other == wall and hash(other) == hash(wall) and other.parameters == wall.parameters
    assert other._native.sent()[0] == wall._native.sent()[0]
    assert other.describe()["warnings"] == wall.describe()["warnings"]
    np.testing.assert_array_equal(other.simulate(record).u, wall.simulate(record).u)
    if name in ("motion", "floor", "floors"):
        np.testing.assert_array_equal(other.simulate().u, wall.simulate().u)


def test_walls_are_compared_by_value():
    assert len({*WALLS.values(), *map(copy.deepcopy, WALLS.values())}) == len(WALLS)
    wall = rw.Wall(height=3, thickness=0.25)
    assert wall == wall.replace(height=4).replace(height=3)
    assert wall != wall.replace(u_start=0.01) and wall != "wall"


def peak(wall, record):
    """Runs in another process."""
    return wall.simulate(record).u_max


def test_walls_in_a_pool_of_processes(record):
    walls = [rw.Wall(height=height, thickness=0.25) for height in (2.0, 3.0)]
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        assert list(pool.map(peak, walls, [record] * 2)) == [peak(wall, record) for wall in walls]


def test_a_wall_never_changes():
    wall = rw.Wall(height=3, thickness=0.25)
    with pytest.raises(AttributeError, match=r"never changes: wall.replace\(height=4\)"):
        wall.height = 4
    with pytest.raises(AttributeError, match="never changes"):
        wall.u_ins = 1.0
    with pytest.raises(AttributeError, match="never changes"):
        del wall._native
    assert wall.u_ins == 0.125


def test_what_follows_from_the_parameters_can_be_read():
    names = [name for name, _, _ in _native.calculated()]
    assert {"mass", "F0", "u_ins", "omega1", "xi_used", "restitution_used"} < set(names)
    wall = rw.Wall(height=3, thickness=0.25)
    described = wall.describe()
    for name in names:
        assert getattr(wall, name) == described[name], name
        assert getattr(rw.Wall, name).__doc__, name
    # ρ b h, W b/(2 h_half) with h_half = h/2
    assert wall.mass == pytest.approx(1800 * 3 * 0.25) and wall.F0 == pytest.approx(wall.mass * 9.81 / 12)


def test_parameters_can_be_read():
    wall = rw.Wall(3, 0.25, overburden=5e3)
    assert wall == rw.Wall(height=3, thickness=0.25, overburden=5e3) and rw.Wall(3) == rw.Wall(height=3)
    assert (wall.height, wall.thickness, wall.overburden, wall.mechanism) == (3.0, 0.25, 5e3, "parapet")
    for name, value in wall.parameters.items():
        assert getattr(wall, name) == value, name
    assert (wall.xi, wall.kinematics, wall.points, wall.force_law) == (-1.0, "linear", None, "bilinear")
    law = WALLS["law of points"]
    assert (law.force_law, law.points) == ("multilinear", [[0.02, 0.8], [0.1, 0.9], [1.0, 0.0]])
    assert WALLS["full rotations"].kinematics == "trigonometric"
    with pytest.raises(AttributeError):
        wall.hight


@pytest.mark.parametrize("way", WAYS)
def test_a_record_is_copied_and_sent(way):
    record = rw.Record(0.01, SAMPLES, name="one", warnings=("odd",))
    other = way(record)
    assert other == record and (other.name, other.warnings) == ("one", ("odd",))
    assert not other.a.flags.writeable


def test_records_are_compared_by_step_and_samples():
    record = rw.Record(0.01, SAMPLES)
    assert record == rw.Record(0.01, list(SAMPLES), name="other")
    assert record != rw.Record(0.02, SAMPLES) and record != rw.Record(0.01, SAMPLES + 1.0)
    assert record != rw.Record(0.01, SAMPLES[:-1]) and record != "record"
    assert len({record, rw.Record(0.01, SAMPLES), rw.Record(0.02, SAMPLES)}) == 2
    assert hash(rw.Record(0.01, [0.0, 1.0])) == hash(rw.Record(0.01, [-0.0, 1.0]))


def test_a_record_is_a_sequence_of_samples():
    record = rw.Record(0.01, SAMPLES, name="one")
    assert len(record) == 6 and record[3] == 3.0 and record[-1] == 0.25
    assert list(record) == list(SAMPLES)
    assert record[1:4] == rw.Record(0.01, SAMPLES[1:4]) and record[1:4].name == "one"
    assert record[::2] == rw.Record(0.02, SAMPLES[::2])
    with pytest.raises(IndexError):
        record[6]
    with pytest.raises(ValueError, match="forward in time, found the stride -1"):
        record[::-1]
    with pytest.raises(ValueError, match="at least two samples, found 1"):
        record[2:3]


@pytest.mark.parametrize("factor", [2, 2.0, np.float64(2.0), np.float32(2.0), np.int64(2)])
def test_a_record_times_a_number(factor):
    record = rw.Record(0.01, SAMPLES, name="one")
    for product in (record * factor, factor * record):
        assert isinstance(product, rw.Record) and product == record.scaled(2.0) and product.name == "one"
    assert -record == record.scaled(-1.0)


def test_a_record_times_anything_else():
    record = rw.Record(0.01, SAMPLES)
    for other in (SAMPLES, [1.0, 2.0], "2", record):
        with pytest.raises(TypeError, match="use record.a"):
            record * other
        with pytest.raises(TypeError):
            other * record


def test_numpy_takes_a_record_as_its_samples():
    record = rw.Record(0.01, SAMPLES)
    assert np.asarray(record) is record.a or np.shares_memory(np.asarray(record), record.a)
    np.testing.assert_array_equal(np.asarray(record, dtype=np.float32), SAMPLES.astype(np.float32))
    copied = np.array(record)
    copied[0] = 7.0
    assert record[0] == 0.0
    np.testing.assert_array_equal(np.abs(record), np.abs(SAMPLES))


@pytest.mark.parametrize("unit, factor", [("m/s2", 1.0), ("cm/s2", 0.01), ("gal", 0.01), ("g", 9.80665)])
def test_samples_in_a_unit(unit, factor):
    np.testing.assert_allclose(rw.Record(0.01, SAMPLES, unit=unit).a, factor * SAMPLES, rtol=1e-15)


def trace(channel="HNE", data=SAMPLES, **stats):
    """An object as ObsPy's traces are."""
    stats = SimpleNamespace(channel=channel, **stats)
    return SimpleNamespace(data=data, id=f"XX.STA..{channel}", stats=stats)


def test_a_trace_becomes_a_record():
    record = rw.Record.from_trace(trace(delta=0.01), "cm/s2")
    assert record == rw.Record(0.01, SAMPLES, unit="cm/s2")
    assert (record.name, record.warnings) == ("XX.STA..HNE", ())
    # neither an id nor a channel is needed
    plain = SimpleNamespace(data=list(SAMPLES), stats=SimpleNamespace(delta=np.float32(0.5)))
    assert rw.Record.from_trace(plain, "m/s2") == rw.Record(0.5, SAMPLES)
    with pytest.warns(UserWarning, match=r"XX.STA..HNZ: vertical: .* use a horizontal one"):
        vertical = rw.Record.from_trace(trace("HNZ", delta=0.01), unit="g")
    assert len(vertical.warnings) == 1
    gaps = np.ma.array(SAMPLES, mask=[0, 0, 1, 0, 0, 0])
    for given, unit, error, words in [
        (trace(delta=0.01), None, ValueError, "a trace states no unit of its data; give unit"),
        (trace(delta=0.01, data=gaps), "g", ValueError, "the trace has gaps"),
        (trace(), "g", TypeError, "data and stats.delta, .* stream.0."),
        ([trace(delta=0.01)], "g", TypeError, "found a value of the type list"),
        (trace(delta=0.0), "g", ValueError, "time step"),
    ]:
        with pytest.raises(error, match=words):
            rw.Record.from_trace(given, unit)
    with pytest.raises(TypeError, match=r"or rw.Record.from_trace\(trace, unit\)"):
        rw.Wall(height=3, thickness=0.25).simulate(trace(delta=0.01))


def test_a_vertical_file_is_warned_of(tmp_path):
    path = tmp_path / "a-UP.AT2"
    path.write_text("A\nB, 1/1/2001, C, UP\nUNITS OF G\nNPTS= 3, DT= .01 SEC\n0 1 0\n", encoding="utf-8")
    with pytest.warns(UserWarning, match="a-UP.AT2: vertical"):
        rw.read_record(path)


def test_wrong_arguments_say_what_is_expected(record):
    wall = rw.Wall(height=3, thickness=0.25)
    for call, words in [
        (lambda: wall.simulate("x.AT2"), r"record must be a Record, .*: read it with rw.read_record\('x"),
        (lambda: wall.simulate(SAMPLES), r"type ndarray: make one with rw.Record\(dt, samples\)"),
        (lambda: wall.simulate(record, top="x.AT2"), r"top must be a Record"),
        (lambda: wall.peaks("x.AT2", [1.0]), r"rw.read_record\('x.AT2'\)"),
        (lambda: rw.Record(SAMPLES, 0.01), r"Record\(dt, samples\): dt must be .* they are swapped"),
        (lambda: rw.Record("0.01", SAMPLES), r"dt must be the time between samples in s, .* type str$"),
    ]:
        with pytest.raises(TypeError, match=words):
            call()
    with pytest.raises(ValueError, match="unit"):
        rw.Record(0.01, SAMPLES, unit="furlong")


def test_counts_and_flags_are_integers_and_booleans(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        'models = ["CR"]\nlevels = { method = "step", step = 1.0, top = 10 }\n'
        "records = { synthetic = { count = 2, duration = 10 } }\n"
        'walls = [{ name = "1", geometry = { height = 3, thickness = 0.25 } }]\n',
        encoding="utf-8",
    )
    results = rw.Study.from_toml(path).run(progress=False)
    kinds = {
        name: table[name].dtype.kind
        for table in (results.levels, results.collapses, results.fragilities)
        for name in ("overturned", "runs", "resurrections", "records", "censored")
        if name in table
    }
    assert kinds == {"overturned": "b", "runs": "i", "resurrections": "i", "records": "i", "censored": "i"}
