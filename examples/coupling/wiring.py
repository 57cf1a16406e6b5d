"""Connections of a wall on a floor, and of a building: two floors, a strip wall between them, a parapet on
the roof.

`reaction_*` of a wall are forces of the floor on the wall. The floor negates them, so they are connected as
they are. An upper storey acts on the storey below like a wall: its base moves with that storey, and its
`reaction_bottom` loads it.
"""

from master import System, Unit

WALL_ON_FLOOR = [
    ("floor.acceleration_absolute", "wall.a_bottom"),
    ("wall.reaction_bottom", "floor.reaction_1"),
]

BUILDING = [
    ("floor_1.acceleration_absolute", "floor_2.a_g"),
    ("floor_2.reaction_bottom", "floor_1.reaction_1"),
    ("floor_1.acceleration_absolute", "strip.a_bottom"),
    ("floor_2.acceleration_absolute", "strip.a_top"),
    # relative to floor 1, its base
    ("floor_2.displacement", "strip.drift"),
    ("strip.reaction_bottom", "floor_1.reaction_2"),
    ("strip.reaction_top", "floor_2.reaction_1"),
    ("floor_2.acceleration_absolute", "parapet.a_bottom"),
    ("parapet.reaction_bottom", "floor_2.reaction_2"),
]


def by_impulses(connections):
    """Replaces reactions by impulses; the floors then need `coupling = impulses`."""
    return [tuple(end.replace("reaction", "impulse") for end in connection) for connection in connections]


# Parameters of the examples: a parapet that weighs 15 % of its floor, whose frequency is 5 Hz.
WALL = {"height": 3.0, "thickness": 0.3, "a1": 0.05, "u_start": 0.0, "damping_model": "constant_coefficient",
        "xi": 0.05}  # fmt: skip
FLOOR = {"mass": 1.08e4, "stiffness": 1.08e4 * 31.4**2, "damping_ratio": 0.05}

STOREYS = {
    "floor_1": {"mass": 2.0e4, "stiffness": 4.0e7, "damping_ratio": 0.03},
    "floor_2": {"mass": 1.5e4, "stiffness": 2.5e7, "damping_ratio": 0.03},
}
WALLS = {
    "strip": {"mechanism": "vertical_spanning", "height": 3.0, "thickness": 0.2, "hinge_ratio": 0.6,
              "overburden": 5000.0, "a1": 0.05, "u_start": 0.0,
              "damping_model": "constant_coefficient", "xi": 0.05},
    "parapet": {"height": 1.2, "thickness": 0.3, "a1": 0.05, "u_start": 0.0,
                "damping_model": "constant_coefficient", "xi": 0.05},
}  # fmt: skip


def wall_on_floor(wall, floor, changes=None, motion=None, connections=WALL_ON_FLOOR):
    """Makes the system from both archives.

    `changes` has parameters by unit, `motion` is the ground acceleration as a function of time.
    """
    return _system((floor, {"floor": FLOOR}), (wall, {"wall": WALL}), changes, motion, connections)


def building(wall, floor, changes=None, motion=None, connections=BUILDING):
    """Makes the building; arguments as for `wall_on_floor`."""
    return _system((floor, STOREYS), (wall, WALLS), changes, motion, connections)


def _system(floors, walls, changes, motion, connections):
    changes = changes or {}
    units = [
        Unit(archive, name, **(parameters | changes.get(name, {})))
        for archive, members in (floors, walls)
        for name, parameters in members.items()
    ]
    return System(units, connections, {f"{units[0].name}.a_g": motion} if motion else None)
