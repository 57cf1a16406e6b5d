"""The parameters of a wall.

Written by `cargo xtask generate python` from the model description.
"""

from collections.abc import Sequence
from typing import Literal, TypedDict


class Parameters(TypedDict, total=False):
    """The parameters of a wall, by the names of the FMU's variables; in SI units."""

    mechanism: Literal["parapet", "vertical_spanning"]
    """Rocking mechanism; default parapet."""

    height: float
    """Height of the wall [m], at least 0.001, at most 1000; default 4.0."""

    thickness: float
    """Thickness of the wall [m], at least 0.0001, at most 100; default 0.4."""

    width: float
    """Length along the wall; mass and self-weight are proportional to it [m], at least 0.001, at most 1000;
    default 1.0."""

    density: float
    """Density of the masonry [kg/m3], at least 1, at most 100000; default 1800.0."""

    gravity: float
    """Acceleration of gravity [m/s2], at least 0.001, at most 1000; default 9.81."""

    hinge_ratio: float
    """Height of the intermediate hinge as a fraction of height, at least 0.01, at most 0.99; where mechanism
    = vertical_spanning; default 0.5."""

    overburden: float
    """Vertical force on the top section, without mass, for the whole width [N], at least 0, at most 1e+12;
    default 0.0."""

    overburden_eccentricity: float
    """Distance of the overburden from the centre of the top section, positive towards +u [m], at least -100,
    at most 100; where overburden is not 0; default 0.0."""

    eccentricity_mode: Literal["fixed_to_wall", "follows_pivot"]
    """Whether the eccentricity changes sides with the wall; where overburden_eccentricity is not 0 and
    overburden is not 0; default fixed_to_wall."""

    force_law: Literal["rigid_linear", "bilinear", "trilinear", "multilinear"]
    """Shape of the restoring force; default bilinear."""

    a1: float
    """End of the elastic branch as a fraction of u_ins, at least 1e-09, at most 1; where force_law = bilinear
    or trilinear; default 0.03."""

    a3: float
    """End of the softening branch as a fraction of u_ins, at least 1e-09, at most 1; default 1.0."""

    d1: float
    """Plateau force as a fraction of F0, at least 1e-09, at most 1; where force_law = trilinear; default
    0.85."""

    softening: Literal["parallel", "rotated", "chord"]
    """What the softening branch keeps to end at a3; where a3 is not 1; default parallel."""

    damping_model: Literal[
        "none", "constant_coefficient", "free_standing_block", "constant_ratio", "stiffness_proportional"
    ]
    """Continuous damping; default constant_ratio."""

    xi: float
    """Damping ratio on the elastic branch; -1: computed from a1 and restitution (Eqs. 20 to 22), at least -1,
    at most 10; where damping_model = constant_coefficient, constant_ratio or stiffness_proportional; default
    -1.0."""

    c_bar: float
    """Damping constant of a free-standing block; -1: computed from restitution (Eq. 23), at least -1, at most
    100; where damping_model = free_standing_block; default -1.0."""

    impact: Literal["none", "restitution"]
    """What happens when the wall passes through zero displacement; default none."""

    restitution_source: Literal["analytic", "calibrated", "momentum"]
    """How the coefficient of restitution is computed from the geometry; where restitution = -1 and impact =
    restitution, or restitution = -1 and xi = -1 and damping_model = constant_coefficient, constant_ratio or
    stiffness_proportional, or restitution = -1 and c_bar = -1 and damping_model = free_standing_block;
    default calibrated."""

    restitution: float
    """Coefficient of restitution at impacts and behind damping; -1: as restitution_source says, at least -1,
    at most 1; where impact = restitution, or xi = -1 and damping_model = constant_coefficient, constant_ratio
    or stiffness_proportional, or c_bar = -1 and damping_model = free_standing_block; default -1.0."""

    rocking: Literal["two_sided", "one_sided_positive", "one_sided_negative"]
    """Sides to which the wall can rock; one-sided rocking needs impact = restitution; default two_sided."""

    u_start: float
    """Displacement at the start; zero for a coupled or shaken wall [m], at least -1000, at most 1000; default
    0.18."""

    u_dot_start: float
    """Velocity at the start [m/s], at least -10000, at most 10000; default 0.0."""

    solver: Literal["automatic", "exact", "adaptive", "newmark"]
    """Integration method; default automatic."""

    tolerance: float
    """Relative tolerance of the adaptive solver; the tighter of this and the importer's applies, at least
    1e-15, at most 0.01; where solver = adaptive, or solver = automatic and damping_model = constant_ratio or
    stiffness_proportional; default 1e-08."""

    newmark_step: float
    """Integration step of the newmark solver [s], at least 1e-09, at most 1; where solver = newmark; default
    0.001."""

    tie_height: float
    """Height of the tie above the base, at most height [m], at least 0, at most 1000; where tie_stiffness is
    not 0; default 0.0."""

    tie_stiffness: float
    """Stiffness of the tie between a parapet and its support; 0 for none [N/m], at least 0, at most 1e+15;
    default 0.0."""

    tie_slack: float
    """Displacement of the wall at the tie before it pulls [m], at least 0, at most 1000; where tie_stiffness
    is not 0; default 0.0."""

    tie_strength: float
    """Force at which the tie yields, or a limit state of an elastic one; 0 where none is given [N], at least
    0, at most 1e+12; where tie_stiffness is not 0; default 0.0."""

    tie_side: Literal["positive", "negative", "both"]
    """Side on which the tie holds the wall; where tie_stiffness is not 0; default positive."""

    tie_ultimate: float
    """Plastic elongation at which the tie breaks; it yields at tie_strength; -1: elastic [m], at least -1, at
    most 1000; where tie_strength is not 0 and tie_stiffness is not 0; default -1.0."""

    kinematics: Literal["linear", "trigonometric"]
    """Small rotations, or full ones (rigid-linear walls with restitution)."""
    points: Sequence[Sequence[float]]
    """Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"."""
    bar_diameter: float
    """Diameter of the bar of the tie [m]; a bar stands for tie_stiffness, tie_strength and tie_ultimate."""
    bar_length: float
    """Free length of the bar between its anchors [m]."""
    bar_young_modulus: float
    """Young's modulus of the bar [Pa]; default 210e9."""
    bar_yield_stress: float
    """Stress at which the bar yields [Pa]."""
    bar_ultimate_strain: float
    """Strain at which the bar tears; where none is given, the tie stays elastic."""
    bar_anchor_capacity: float
    """Force at which an anchor fails, without warning [N]; by default it is stronger than the bar."""
    bar_spacing: float
    """Distance between bars along the wall [m]; by default one bar holds its width."""
