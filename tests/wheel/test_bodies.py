"""Tests walls of parts: as dictionaries, as a scene, sent, in studies, and refused."""

import pickle

import numpy as np
import pytest

import rocking_wall as rw

FACADE = {
    "part": [{"height": 9.6, "thickness": 0.6, "density": 1800}],
    "load": [
        {"force": 12e3, "height": 3.2, "inside": 0.5, "moving_mass": 1},
        {"force": 12e3, "height": 6.4, "inside": 0.5, "moving_mass": 1, "thrust": 500},
        {"force": 8e3, "height": 9.6, "inside": 0.4, "moving_mass": 1, "thrust": 1000},
    ],
}


def facade(**parameters):
    return rw.Wall(**FACADE, a1=0.05, damping_model="constant_coefficient", xi=0.05, **parameters)


def test_a_facade_has_the_numbers_of_an_independent_program():
    wall = facade()
    assert wall.F0 == pytest.approx(6856.88, rel=1e-12)
    assert wall.F0_negative == pytest.approx(9856.88, rel=1e-12)
    assert wall.effective_mass == pytest.approx(19804.2922188, rel=1e-11)
    described = wall.describe()
    assert described["restitution_impulses"] == pytest.approx(0.995386965496, rel=1e-11)
    assert described["restitution_impulses_negative"] == pytest.approx(0.993899098848, rel=1e-11)
    assert "height" not in wall.parameters
    assert rw.Wall(a1=0.05).replace(**FACADE).F0 == wall.F0


def test_a_wall_of_parts_is_that_of_its_scene(tmp_path):
    (tmp_path / "facade.toml").write_text(
        "[force_law]\na1 = 0.05\n[damping]\ndamping_model = 'constant_coefficient'\nxi = 0.05\n"
        "[[geometry.part]]\nheight = 9.6\nthickness = 0.6\ndensity = 1800\n"
        "[[geometry.load]]\nforce = 12e3\nheight = 3.2\ninside = 0.5\nmoving_mass = 1\n"
        "[[geometry.load]]\nforce = 12e3\nheight = 6.4\ninside = 0.5\nmoving_mass = 1\nthrust = 500\n"
        "[[geometry.load]]\nforce = 8e3\nheight = 9.6\ninside = 0.4\nmoving_mass = 1\nthrust = 1000\n"
    )
    wall = rw.Wall.from_toml(tmp_path / "facade.toml")
    record = rw.synthetic_record()
    assert wall.parameters == facade().parameters
    assert np.array_equal(wall.simulate(record).u, facade().simulate(record).u)
    # other processes get the same wall, and a batch the peaks of single runs
    sent = pickle.loads(pickle.dumps(wall))
    assert sent == wall and np.array_equal(sent.simulate(record).u, wall.simulate(record).u)
    scales = [0.3, 0.6, 0.9]
    single = [wall.simulate(record, scale=scale).u_max for scale in scales]
    # the path of whole records rounds otherwise
    assert np.allclose(wall.peaks(record, scales).u_max, single, rtol=1e-7, atol=0)


def test_a_study_takes_walls_of_parts(tmp_path):
    study = rw.Study(
        walls={"facade": facade(), "block": rw.Wall(3, 0.3)},
        records=[rw.synthetic_record(seed=seed) for seed in (1, 2, 3)],
        models=["CR"],
        levels={"method": "grid", "values": [0.1, 0.3, 0.5]},
    )
    found = study.run(tmp_path / "results").to_pandas()
    assert set(found["wall"]) == {"facade", "block"}
    # the folder keeps the parts: a second run finds its results there
    assert study.run(tmp_path / "results").to_pandas().equals(found)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"part": [{"height": 3, "thickness": -0.3}]}, "part 1: thickness = -0.3 m must be from"),
        ({"part": [{"height": 3, "thicknes": 0.3}]}, 'unknown key "thicknes"'),
        ({"part": [{"height": 3, "thickness": 0.3}], "height": 4, "load": []}, None),
        ({"load": [{"force": 1e3, "height": 2, "inside": 0.1}]}, "give the wall as"),
        (
            {**FACADE, "height": 4},
            "height is that of a rectangle, and the wall has parts; change these",
        ),
    ],
)
def test_what_makes_no_wall_is_refused(given, message):
    if message is None:
        # one prism is a rectangle, whose height can be changed
        assert rw.Wall(**given) == rw.Wall(4, 0.3)
        return
    with pytest.raises(ValueError, match=message):
        rw.Wall(**given)


def test_a_facade_is_tied_at_several_heights(tmp_path):
    bar = {"diameter": 0.016, "length": 5.0, "yield_stress": 235e6, "ultimate_strain": 0.02}
    ties = [{"tie_height": 6.2, "bar": bar}, {"tie_height": 9.4, "tie_stiffness": 2e7, "tie_side": "both"}]
    wall = facade(tie=ties)
    record = rw.synthetic_record(pga=3.0)
    response = wall.simulate(record)
    lower, upper = response.tie_forces
    assert np.allclose(response.tie_force, lower + upper, rtol=1e-15, atol=0)
    assert lower.max() > 0 and upper.max() > 0
    told = response.demands["ties"]
    assert [tie["tie_height"] for tie in told] == [6.2, 9.4]
    assert "tie_elongation" in told[0] and "tie_elongation" not in told[1]
    assert list(response.history)[-2:] == ["tie_1_force", "tie_2_force"]
    assert wall.describe()["tie_2_stiffness"] == 2e7
    # sent, replaced and packaged it is the same; one tie of several cannot be set by its parameters
    sent = pickle.loads(pickle.dumps(wall))
    assert sent == wall and np.array_equal(sent.simulate(record).u, response.u)
    assert facade().replace(tie=ties) == wall
    with pytest.raises(ValueError, match="is that of one tie, and the wall has several"):
        wall.replace(tie_height=3.0)
    with pytest.raises(ValueError, match=r"tie 2 of 2 has no stiffness"):
        facade(tie=[*ties[:1], {"tie_height": 9.4}])
