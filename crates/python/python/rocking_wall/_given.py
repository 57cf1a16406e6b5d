"""The parameters of a wall as attributes."""

from __future__ import annotations

from typing import Generic, TypeVar, overload

from . import _native


Value = TypeVar("Value")


class Parameter(Generic[Value]):
    """A parameter of a wall, or what follows from the parameters: a number, or the name of a choice."""

    def __init__(self, doc: str | None = None) -> None:
        self.__doc__ = doc or self.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, wall: None, owner: type) -> Parameter[Value]: ...
    @overload
    def __get__(self, wall: Given, owner: type) -> Value: ...
    def __get__(self, wall: Given | None, owner: type) -> Parameter[Value] | Value:
        if wall is None:
            return self
        value: Value = wall._native.value(self.name)
        return value


class Given:
    """The parameters of a wall and what follows from them by their names, in SI units.

    A parameter to be computed is -1.
    """

    _native: _native.Wall

    mechanism = Parameter[str]()
    height = Parameter[float]()
    thickness = Parameter[float]()
    width = Parameter[float]()
    density = Parameter[float]()
    gravity = Parameter[float]()
    hinge_ratio = Parameter[float]()
    overburden = Parameter[float]()
    overburden_eccentricity = Parameter[float]()
    eccentricity_mode = Parameter[str]()
    force_law = Parameter[str]()
    a1 = Parameter[float]()
    a3 = Parameter[float]()
    d1 = Parameter[float]()
    softening = Parameter[str]()
    damping_model = Parameter[str]()
    xi = Parameter[float]()
    c_bar = Parameter[float]()
    impact = Parameter[str]()
    restitution_source = Parameter[str]()
    restitution = Parameter[float]()
    rocking = Parameter[str]()
    u_start = Parameter[float]()
    u_dot_start = Parameter[float]()
    solver = Parameter[str]()
    tolerance = Parameter[float]()
    newmark_step = Parameter[float]()
    tie_height = Parameter[float]()
    tie_stiffness = Parameter[float]()
    tie_slack = Parameter[float]()
    tie_strength = Parameter[float]()
    tie_side = Parameter[str]()
    kinematics = Parameter[str]()
    mass = Parameter[float]("Mass of the wall, overburden not included [kg].")
    effective_mass = Parameter[float]("Effective mass of the equation of motion [kg].")
    participation = Parameter[float]("Participation factor of the support acceleration.")
    F0 = Parameter[float]("Rigid restoring force at zero displacement, side u > 0 [N].")
    F0_negative = Parameter[float](
        "Rigid restoring force at zero displacement, side u < 0, as an absolute value [N]; where "
        "overburden_eccentricity is not 0 and overburden is not 0."
    )
    u_ins = Parameter[float]("Static instability displacement, side u > 0 [m].")
    u_ins_negative = Parameter[float](
        "Static instability displacement, side u < 0, as an absolute value [m]; where "
        "overburden_eccentricity is not 0 and overburden is not 0."
    )
    omega1 = Parameter[float](
        "Angular frequency of the elastic branch; zero for rigid_linear [rad/s]; where force_law = bilinear"
        " or trilinear."
    )
    xi_used = Parameter[float](
        "Damping ratio in use on the elastic branch: given, computed or from c_bar; 0 without one; where "
        "damping_model is not none."
    )
    restitution_used = Parameter[float](
        "Coefficient of restitution in use, for impacts and for computed damping; where impact = "
        "restitution, or xi = -1 and damping_model = constant_coefficient, constant_ratio or "
        "stiffness_proportional, or c_bar = -1 and damping_model = free_standing_block."
    )
    points = Parameter[list[list[float]] | None](
        'Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law.'
    )
