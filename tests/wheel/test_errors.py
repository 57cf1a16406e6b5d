"""What cannot be used raises an exception with the message of the program."""

import warnings

import pytest

import rocking_wall as rw


@pytest.mark.parametrize(
    "name, value, error",
    [
        ("hight", 3, TypeError),
        ("height", -1, ValueError),
        ("height", "tall", ValueError),
        ("force_law", "straight", ValueError),
        ("kinematics", "curved", ValueError),
    ],
)
def test_messages_are_those_of_the_program(program, name, value, error):
    with pytest.raises(error) as caught:
        rw.Wall(**{name: value})
    assert str(caught.value) in program("simulate", "--set", f"{name}={value}", code=2)


def test_other_values():
    with pytest.raises(TypeError, match="height must be a number or a name, found a value of the type list"):
        rw.Wall(height=[3])
    with pytest.raises(TypeError, match="positional"):
        rw.Wall(3, 0.25, 1.0)
    with pytest.raises(TypeError, match="height is given twice, by place and by name"):
        rw.Wall(3, height=3)
    with pytest.raises(ValueError, match="thickness = 30 m is unusual.*in cm, give 0.3 m; as given, rest"):
        rw.Wall(3, 30)
    with pytest.raises(ValueError, match="exact"):
        rw.Wall(solver="exact", damping_model="constant_ratio")


def test_an_installation_without_the_general_fmu(tmp_path, monkeypatch):
    monkeypatch.setattr("rocking_wall._walls.files", lambda package: tmp_path)
    with pytest.raises(FileNotFoundError, match="run `cargo xtask fmu` and pass base='fmu_out/wall.fmu'"):
        rw.package(rw.Wall(), tmp_path / "scene.fmu")


def test_files(tmp_path):
    for read in (rw.read_record, rw.Wall.from_toml, rw.Study.from_toml):
        with pytest.raises(FileNotFoundError, match="none.toml: cannot be read"):
            read(tmp_path / "none.toml")
    path = tmp_path / "scene.toml"
    path.write_text("[geometry]\nhight = 3\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"scene.toml, line 2: unknown key \"hight\""):
        rw.Wall.from_toml(path)
    with pytest.raises(FileNotFoundError, match="cannot be read"):
        rw.package("scenes/shaken_parapet.toml", tmp_path / "a.fmu", base=tmp_path / "none.fmu")


def test_runs(record):
    wall = rw.Wall(height=3, thickness=0.25)
    for arguments, words in [
        ({"tail": -1.0}, "tail = -1 must be at least 0 and at most"),
        ({"stop_time": 0.0}, "stop_time = 0 must be above 0"),
        ({"thresholds": [2.0]}, "thresholds = 2 must be above 0 and at most 1"),
        ({"scale": float("nan")}, "scale = nan must be a finite number"),
    ]:
        with pytest.raises(ValueError, match=words):
            wall.simulate(record, **arguments)
    with pytest.raises(ValueError, match="scale needs a record"):
        wall.simulate(scale=2.0)
    with pytest.raises(ValueError, match="cannot be scaled by inf"):
        wall.peaks(record, [1.0, float("inf")])


@pytest.mark.parametrize(
    "threads, error", [(0, ValueError), (-1, ValueError), (1.5, TypeError), ("2", TypeError)]
)
def test_threads(threads, error):
    for run in (
        lambda: rw.Wall().pulse_spectrum("ricker", threads=threads),
        lambda: rw.Wall().calibrate(threads=threads),
        lambda: study({"method": "grid", "values": [0.1]}).run(threads=threads, progress=False),
    ):
        with pytest.raises(error, match="threads"):
            run()


@pytest.mark.parametrize("scale, error", [(float("inf"), ValueError), ("2", TypeError), (1e308, ValueError)])
def test_scale(scale, error, record):
    wall = rw.Wall(height=3, thickness=0.25)
    for run in (wall.simulate, wall.replace(tie_height=3).tie):
        with pytest.raises(error, match=rf"scale = {str(scale).replace('+', '.')!s}|scale = {scale!r}"):
            run(record, scale=scale)


def study(levels):
    """Makes a study with these levels."""
    records = [rw.synthetic_record(duration=12)]
    return rw.Study(walls=rw.Wall(3, 0.25), records=records, models=["CR"], levels=levels)


@pytest.mark.parametrize(
    "levels, error, words",
    [
        ([0.1, 0.2], TypeError, r"levels = \[0.1, 0.2\] must be a dictionary, such as"),
        ({"method": "gird"}, ValueError, 'levels: method = "gird" is not one of hunt, step, grid'),
        ({"method": "grid"}, ValueError, 'levels: method = "grid" needs values'),
        ({"method": "grid", "values": "0.1"}, ValueError, 'levels: values = "0.1": expected a list'),
        ({"method": "step", "step": -1, "top": 2}, ValueError, "step of the levels is .*; it must be"),
        ({"method": "step", "stap": 1}, ValueError, 'levels: unknown key "stap" .*did you mean "step"'),
    ],
)
def test_levels(levels, error, words):
    with pytest.raises(error, match=words):
        study(levels)


def test_warnings():
    with pytest.raises(ValueError, match="u_start = 0.2 m is beyond u_ins"):
        rw.Wall(height=3, thickness=0.25, u_start=0.2).simulate()
    with pytest.raises(ValueError, match="u_start = 0.2 m is beyond u_ins"):
        rw.Wall(height=3, thickness=0.25, u_start=0.2).peaks(rw.sine_cycle(1.0, 2.0), [1.0])
    with pytest.warns(UserWarning, match="d1 is set and has no effect: it counts where force_law = tri"):
        rw.Wall(height=3, thickness=0.25, d1=0.7).simulate(rw.sine_cycle(1.0, 2.0))
    with pytest.warns(UserWarning, match="a peak of 300.0 m/s² is 30.6 g"):
        rw.Wall(height=3, thickness=0.25).simulate(rw.synthetic_record(pga=3), scale=100)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rw.Wall(height=3, thickness=0.25).simulate(rw.sine_cycle(1.0, 2.0))
