"""Attributes that the part in Rust has, and the parameters of a wall as such."""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any, Generic, NoReturn, TypeVar, overload

from . import _native


Value = TypeVar("Value")


class Attribute(Generic[Value]):
    """An attribute of the part in Rust, of a parameter of a wall a number or the name of a choice."""

    def __init__(self, doc: str | None = None) -> None:
        self.__doc__ = doc or self.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Attribute[Value]: ...
    @overload
    def __get__(self, instance: object, owner: type) -> Value: ...
    def __get__(self, instance: Any, owner: type) -> Any:
        return self if instance is None else getattr(instance._native, self.name)

    def __set__(self, instance: object, value: Any) -> NoReturn:
        raise AttributeError(f"{self.name} cannot be set")


class Given:
    """The parameters of a wall and what follows from them by their names, in SI units.

    A parameter to be computed is -1.
    """

    def __getattr__(self, name: str) -> NoReturn:
        close = get_close_matches(name, dir(type(self)), 1)
        meant = f"; did you mean {close[0]!r}?" if close else ""
        raise AttributeError(f"a wall has no {name!r}{meant}", name=name, obj=None)

    _native: _native.Wall

    mechanism = Attribute[str]()
    height = Attribute[float]()
    thickness = Attribute[float]()
    width = Attribute[float]()
    density = Attribute[float]()
    gravity = Attribute[float]()
    hinge_ratio = Attribute[float]()
    overburden = Attribute[float]()
    overburden_eccentricity = Attribute[float]()
    eccentricity_mode = Attribute[str]()
    body_mass = Attribute[float]()
    centroid_height = Attribute[float]()
    inertia = Attribute[float]()
    arm = Attribute[float]()
    arm_inner = Attribute[float]()
    load_force = Attribute[float]()
    load_height = Attribute[float]()
    load_arm = Attribute[float]()
    load_mass = Attribute[float]()
    load_mass_height = Attribute[float]()
    load_inertia = Attribute[float]()
    thrust = Attribute[float]()
    thrust_height = Attribute[float]()
    force_law = Attribute[str]()
    a1 = Attribute[float]()
    a3 = Attribute[float]()
    d1 = Attribute[float]()
    softening = Attribute[str]()
    damping_model = Attribute[str]()
    xi = Attribute[float]()
    c_bar = Attribute[float]()
    impact = Attribute[str]()
    restitution_source = Attribute[str]()
    restitution = Attribute[float]()
    rocking = Attribute[str]()
    u_start = Attribute[float]()
    u_dot_start = Attribute[float]()
    solver = Attribute[str]()
    tolerance = Attribute[float]()
    newmark_step = Attribute[float]()
    tie_height = Attribute[float]()
    tie_stiffness = Attribute[float]()
    tie_slack = Attribute[float]()
    tie_strength = Attribute[float]()
    tie_side = Attribute[str]()
    tie_ultimate = Attribute[float]()
    kinematics = Attribute[str]()
    mass = Attribute[float]("Mass of the wall, overburden not included [kg].")
    effective_mass = Attribute[float]("Effective mass of the equation of motion [kg].")
    participation = Attribute[float]("Participation factor of the support acceleration.")
    F0 = Attribute[float]("Rigid restoring force at zero displacement, side u > 0 [N].")
    F0_negative = Attribute[float](
        "Rigid restoring force at zero displacement, side u < 0, as an absolute value [N]; where "
        "overburden_eccentricity is not 0 and overburden is not 0, or mechanism = rigid_body."
    )
    u_ins = Attribute[float]("Static instability displacement, side u > 0 [m].")
    u_ins_negative = Attribute[float](
        "Static instability displacement, side u < 0, as an absolute value [m]; where "
        "overburden_eccentricity is not 0 and overburden is not 0, or mechanism = rigid_body."
    )
    omega1 = Attribute[float](
        "Angular frequency of the elastic branch; zero for rigid_linear [rad/s]; where force_law = bilinear"
        " or trilinear."
    )
    xi_used = Attribute[float](
        "Damping ratio in use on the elastic branch: given, computed or from c_bar; 0 without one; where "
        "damping_model is not none."
    )
    restitution_used = Attribute[float](
        "Coefficient of restitution in use, for impacts and for computed damping; where impact = "
        "restitution, or xi = -1 and damping_model = constant_coefficient, constant_ratio or "
        "stiffness_proportional, or c_bar = -1 and damping_model = free_standing_block."
    )
    points = Attribute[list[list[float]] | None](
        'Corners [[u/u_ins, F/F0], ...] of the force law "multilinear"; None for another law.'
    )
