"""The parameters of a wall.

Written by `cargo xtask generate python` from the schema of scenes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, Required, TypedDict


class Parameters(TypedDict, total=False):
    """The parameters of a wall, by the names of the FMU's variables; in SI units.

    - mechanism: Rocking mechanism; default "parapet".
    - height: Height of the wall, or of the top of a rigid body [m], at least 0.001, at most 1000; default
      4.0.
    - thickness: Thickness of the wall [m], at least 0.0001, at most 100; where mechanism = parapet or
      vertical_spanning; default 0.4.
    - width: Length along the wall; mass and self-weight are proportional to it [m], at least 0.001, at most
      1000; where mechanism = parapet or vertical_spanning; default 1.0.
    - density: Density of the masonry [kg/m3], at least 1, at most 100000; where mechanism = parapet or
      vertical_spanning; default 1800.0.
    - gravity: Acceleration of gravity [m/s2], at least 0.001, at most 1000; default 9.81.
    - hinge_ratio: Height of the intermediate hinge as a fraction of height, at least 0.01, at most 0.99;
      where mechanism = vertical_spanning; default 0.5.
    - overburden: Vertical force on the top section, without mass, for the whole width [N], at least 0, at
      most 1e+12; default 0.0.
    - overburden_eccentricity: Distance of the overburden from the centre of the top section, positive towards
      +u [m], at least -100, at most 100; where overburden is not 0; default 0.0.
    - eccentricity_mode: Whether the eccentricity changes sides with the wall; where overburden_eccentricity
      is not 0 and overburden is not 0; default "fixed_to_wall".
    - body_mass: Mass of a rigid body, without its loads [kg], at least 1e-06, at most 1e+12; where mechanism
      = rigid_body; default 2880.0.
    - centroid_height: Height of the centroid of a rigid body above its base, where u is measured [m], at
      least 0.0005, at most 1000; where mechanism = rigid_body; default 2.0.
    - inertia: Integral of z squared over the mass of a rigid body, z from its base [kg.m2], at least 1e-09,
      at most 1e+18; where mechanism = rigid_body; default 15360.0.
    - arm: Distance of the centroid of a rigid body from the hinge of u > 0 [m], at least 0, at most 100;
      where mechanism = rigid_body; default 0.2.
    - arm_inner: Distance of the centroid of a rigid body from the hinge of u < 0; -1: as arm [m], at least
      -1, at most 100; where mechanism = rigid_body; default -1.0.
    - load_force: Sum of the loads P on a rigid body, downwards, without its weight [N], at least 0, at most
      1e+12; where mechanism = rigid_body; default 0.0.
    - load_height: Height of the loads: sum of P z over the sum of P [m], at least 0, at most 1000; where
      load_force is not 0 and mechanism = rigid_body; default 0.0.
    - load_arm: Distance of the loads from the hinge of u > 0, weighted by P [m], at least -100, at most 100;
      where load_force is not 0 and mechanism = rigid_body; default 0.0.
    - load_mass: Mass of the loads that moves along with a rigid body [kg], at least 0, at most 1e+12; where
      mechanism = rigid_body; default 0.0.
    - load_mass_height: Height of the centroid of load_mass [m], at least 0, at most 1000; where load_mass is
      not 0 and mechanism = rigid_body; default 0.0.
    - load_inertia: Sum of z squared times mass over the loads that move along [kg.m2], at least 0, at most
      1e+18; where load_mass is not 0 and mechanism = rigid_body; default 0.0.
    - thrust: Sum of the thrusts H on a rigid body, towards u > 0 [N], at least -1e+12, at most 1e+12; where
      mechanism = rigid_body; default 0.0.
    - thrust_height: Height of the thrusts: sum of H z over the sum of H [m], at least 0, at most 1000; where
      thrust is not 0 and mechanism = rigid_body; default 0.0.
    - force_law: Shape of the restoring force; default "bilinear".
    - a1: End of the elastic branch as a fraction of u_ins, at least 1e-09, at most 1; where force_law =
      bilinear or trilinear; default 0.03.
    - a3: End of the softening branch as a fraction of u_ins, at least 1e-09, at most 1; default 1.0.
    - d1: Plateau force as a fraction of F0, at least 1e-09, at most 1; where force_law = trilinear; default
      0.85.
    - softening: What the softening branch keeps to end at a3; where a3 is not 1; default "parallel".
    - damping_model: Continuous damping; default "constant_ratio".
    - xi: Damping ratio on the elastic branch; -1: computed from a1 and restitution (Eqs. 20 to 22), at least
      -1, at most 10; where damping_model = constant_coefficient, constant_ratio or stiffness_proportional;
      default -1.0.
    - c_bar: Damping constant of a free-standing block; -1: computed from restitution (Eq. 23), at least -1,
      at most 100; where damping_model = free_standing_block; default -1.0.
    - impact: What happens when the wall passes through zero displacement; default "none".
    - restitution_source: How the coefficient of restitution is computed from the geometry; where restitution
      = -1 and impact = restitution, or restitution = -1 and xi = -1 and damping_model = constant_coefficient,
      constant_ratio or stiffness_proportional, or restitution = -1 and c_bar = -1 and damping_model =
      free_standing_block; default "calibrated".
    - restitution: Coefficient of restitution at impacts and behind damping; -1: as restitution_source says,
      at least -1, at most 1; where impact = restitution, or xi = -1 and damping_model = constant_coefficient,
      constant_ratio or stiffness_proportional, or c_bar = -1 and damping_model = free_standing_block; default
      -1.0.
    - rocking: Sides to which the wall can rock; one-sided rocking needs impact = restitution; default
      "two_sided".
    - u_start: Displacement at the start; zero for a coupled or shaken wall [m], at least -1000, at most 1000;
      default 0.18.
    - u_dot_start: Velocity at the start [m/s], at least -10000, at most 10000; default 0.0.
    - solver: Integration method; default "automatic".
    - tolerance: Relative tolerance of the adaptive solver; the tighter of this and the importer's applies, at
      least 1e-15, at most 0.01; where solver = adaptive, or solver = automatic and damping_model =
      constant_ratio or stiffness_proportional; default 1e-08.
    - newmark_step: Integration step of the newmark solver [s], at least 1e-06, at most 1; where solver =
      newmark; default 0.001.
    - tie_height: Height of the tie above the base, at most height [m], at least 0, at most 1000; where
      tie_stiffness is not 0; default 0.0.
    - tie_stiffness: Stiffness of the tie between wall and support; 0 for none [N/m], at least 0, at most
      1e+15; default 0.0.
    - tie_slack: Displacement of the wall at the tie before it pulls [m], at least 0, at most 1000; where
      tie_stiffness is not 0; default 0.0.
    - tie_strength: Force at which the tie yields, or a limit state of an elastic one; 0 where none is given
      [N], at least 0, at most 1e+12; where tie_stiffness is not 0; default 0.0.
    - tie_side: Side on which the tie holds the wall; where tie_stiffness is not 0; default "positive".
    - tie_ultimate: Plastic elongation at which the tie breaks; it yields at tie_strength; -1: elastic [m], at
      least -1, at most 1000; where tie_strength is not 0 and tie_stiffness is not 0; default -1.0.
    - kinematics: Small rotations, or full ones (rigid_linear without damping); default "linear".
    - points: Corners [u/u_ins, F/F0] of a multilinear law without the origin; both sides are alike unless
      some have u < 0.
    - part: Parts of the masonry, in place of one rectangle.
    - opening: Openings and hollows in the parts.
    - load: Loads on the parts or the body.
    - tie: Several ties, in place of one by tie_height, tie_stiffness, ….
    - curve: Capacity curve in place of a file: pairs of a displacement [m] and the force F [N].
    - at_height: Height at which the displacements are measured [m]; by default they are u, and d* beside a*,
      above 0, at most 1000.
    - curve_tolerance: Largest deviation of the law from the curve, over the largest force [-]; by default
      0.001, at least 0, at most 0.1.
    - oscillator: What rocks, in place of a geometry.
    - bar_anchor_capacity: Force at which an anchor fails, without warning; by default it is stronger than the
      bar [N], above 0.
    - bar_diameter: Diameter of the bar [m], above 0.
    - bar_length: Free length between the anchors [m], above 0.
    - bar_spacing: Distance between bars along the wall; by default one bar holds its width [m], above 0.
    - bar_ultimate_strain: Strain at which the bar tears, above 0; where none is given, the tie stays elastic.
    - bar_yield_stress: Stress at which the bar yields [Pa], above 0.
    - bar_young_modulus: Young's modulus of the bar; 210e9 Pa by default [Pa], above 0.
    """

    mechanism: Literal["parapet", "vertical_spanning", "rigid_body"]
    height: float
    thickness: float
    width: float
    density: float
    gravity: float
    hinge_ratio: float
    overburden: float
    overburden_eccentricity: float
    eccentricity_mode: Literal["fixed_to_wall", "follows_pivot"]
    body_mass: float
    centroid_height: float
    inertia: float
    arm: float
    arm_inner: float
    load_force: float
    load_height: float
    load_arm: float
    load_mass: float
    load_mass_height: float
    load_inertia: float
    thrust: float
    thrust_height: float
    force_law: Literal["rigid_linear", "bilinear", "trilinear", "multilinear"]
    a1: float
    a3: float
    d1: float
    softening: Literal["parallel", "rotated", "chord"]
    damping_model: Literal[
        "none", "constant_coefficient", "free_standing_block", "constant_ratio", "stiffness_proportional"
    ]
    xi: float
    c_bar: float
    impact: Literal["none", "restitution"]
    restitution_source: Literal["analytic", "calibrated", "momentum", "impulses"]
    restitution: float
    rocking: Literal["two_sided", "one_sided_positive", "one_sided_negative"]
    u_start: float
    u_dot_start: float
    solver: Literal["automatic", "exact", "adaptive", "newmark"]
    tolerance: float
    newmark_step: float
    tie_height: float
    tie_stiffness: float
    tie_slack: float
    tie_strength: float
    tie_side: Literal["positive", "negative", "both"]
    tie_ultimate: float
    kinematics: Literal["linear", "trigonometric"]
    points: Sequence[Sequence[float]]
    part: Sequence[Part]
    opening: Sequence[Opening]
    load: Sequence[Load]
    tie: Sequence[Tie]
    curve: Sequence[Sequence[float]]
    at_height: float
    curve_tolerance: float
    oscillator: Oscillator
    bar_anchor_capacity: float
    bar_diameter: float
    bar_length: float
    bar_spacing: float
    bar_ultimate_strain: float
    bar_yield_stress: float
    bar_young_modulus: float


class Part(TypedDict, total=False):
    """A part of the masonry, from the base up.

    - base: Height of its lower edge above the base [m]; by default the top of the part before, at least 0, at
      most 1000.
    - density: Density [kg/m³], at least 1, at most 100000; default 1800.
    - height: Height of the part [m], at least 0.001, at most 1000.
    - outer: Outer face, inwards from that of the lowest part at its foot [m], or that at the bottom and at
      the top; by default 0.
    - thickness: Thickness, or that at the bottom and at the top [m].
    - width: Length along the wall, or that at the bottom and at the top [m]; by default 1 m.
    """

    base: float
    density: float
    height: Required[float]
    outer: float | Sequence[float]
    thickness: Required[float | Sequence[float]]
    width: float | Sequence[float]


class Opening(TypedDict, total=False):
    """An opening or, with a thickness, a hollow.

    - base: Height of its lower edge above the base [m], at least 0, at most 1000.
    - height: Height of the opening [m], above 0, at most 1000.
    - outer: Outer face of a hollow, inwards from that of the lowest part at its foot [m].
    - thickness: Thickness of a hollow [m]; by default the opening goes through the wall, above 0, at most
      100.
    - width: Length along the wall [m], above 0, at most 1000.
    """

    base: Required[float]
    height: Required[float]
    outer: float
    thickness: float
    width: Required[float]


class Load(TypedDict, total=False):
    """A load at a height.

    - force: Force downwards [N]; 0 for a mass that moves along without resting on the wall, at least 0, at
      most 1e+12.
    - height: Height above the base [m], above 0, at most 1000.
    - inside: Distance inwards from the outer face of the lowest part at its foot [m]. With [geometry.body]:
      from the outer hinge, at least -100, at most 100.
    - mass: Mass that moves along with the wall without resting on it [kg], with force = 0, at least 0, at
      most 1e+12; default 0.
    - moving_mass: Share of force/g that moves along with the wall [-]; a check needs it, at least 0, at most
      1; default 0.
    - thrust: Thrust, positive outwards [N], at least -1e+12, at most 1e+12; default 0.
    - thrust_lasts: Whether the thrust certainly lasts until collapse: a check counts it on the side that it
      helps; default False.
    """

    force: Required[float]
    height: Required[float]
    inside: Required[float]
    mass: float
    moving_mass: float
    thrust: float
    thrust_lasts: bool


class Tie(TypedDict, total=False):
    """A tie.

    - bar: The tie as it is built, in place of tie_stiffness, tie_strength and tie_ultimate.
    - tie_height: Height of the tie above the base, at most height [m], at least 0, at most 1000; where
      tie_stiffness is not 0; default 0.0.
    - tie_side: Side on which the tie holds the wall; where tie_stiffness is not 0; default "positive".
    - tie_slack: Displacement of the wall at the tie before it pulls [m], at least 0, at most 1000; where
      tie_stiffness is not 0; default 0.0.
    - tie_stiffness: Stiffness of the tie between wall and support; 0 for none [N/m], at least 0, at most
      1e+15; default 0.0.
    - tie_strength: Force at which the tie yields, or a limit state of an elastic one; 0 where none is given
      [N], at least 0, at most 1e+12; where tie_stiffness is not 0; default 0.0.
    - tie_ultimate: Plastic elongation at which the tie breaks; it yields at tie_strength; -1: elastic [m], at
      least -1, at most 1000; where tie_strength is not 0 and tie_stiffness is not 0; default -1.0.
    """

    bar: Bar
    tie_height: float
    tie_side: Literal["positive", "negative", "both"]
    tie_slack: float
    tie_stiffness: float
    tie_strength: float
    tie_ultimate: float


class Bar(TypedDict, total=False):
    """The tie as it is built, in place of tie_stiffness, tie_strength and tie_ultimate.

    - anchor_capacity: Force at which an anchor fails, without warning; by default it is stronger than the bar
      [N], above 0.
    - diameter: Diameter of the bar [m], above 0.
    - length: Free length between the anchors [m], above 0.
    - spacing: Distance between bars along the wall; by default one bar holds its width [m], above 0.
    - ultimate_strain: Strain at which the bar tears, above 0; where none is given, the tie stays elastic.
    - yield_stress: Stress at which the bar yields [Pa], above 0.
    - young_modulus: Young's modulus of the bar; 210e9 Pa by default [Pa], above 0.
    """

    anchor_capacity: float
    diameter: Required[float]
    length: Required[float]
    spacing: float
    ultimate_strain: float
    yield_stress: Required[float]
    young_modulus: float


class Oscillator(TypedDict, total=False):
    """The constants of an oscillator; φ is its shape, 1 where u is measured.

    - effective_mass: Effective mass m_eff = Σmφ² [kg], at least 0.001, at most 1e+09.
    - participation: Participation λ = Σmφ/Σmφ² [-], at least 0.01, at most 10.
    """

    effective_mass: Required[float]
    participation: Required[float]
