//! Restoring forces: multilinear laws built on the rigid-linear one.

use crate::choices::{ForceLaw, Softening};

use super::error::ParameterError;
use super::mechanism::Body;
use super::parameters::Parameters;
use super::sides::Sides;

/// Largest difference of two slopes k₁ over one of them that is rounding \[-\].
const SAME_SLOPE: f64 = 1e-12;

/// A straight line of the restoring force, F = `force` + `slope` (u − `anchor`), or of F over `m_eff`.
///
/// The anchor of the last line is its zero u₃, so that the force keeps its relative accuracy towards it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Displacement of the anchor \[m\].
    pub anchor: f64,
    /// Force at the anchor \[N\].
    pub force: f64,
    /// Slope \[N/m\].
    pub slope: f64,
}

impl Line {
    /// Returns the force at a displacement \[N\].
    pub fn at(&self, displacement: f64) -> f64 {
        self.force + self.slope * (displacement - self.anchor)
    }

    /// Returns whether the line is an elastic one: of a law's lines it alone has its anchor at the origin.
    pub fn is_elastic(&self) -> bool {
        self.anchor == 0.0
    }

    /// Returns the same line seen from the other side, F(u) → −F(−u).
    fn mirrored(self) -> Self {
        Self { anchor: -self.anchor, force: -self.force, slope: self.slope }
    }
}

/// One side of a force law, in |u|: lines and the corners between them, from the origin outwards.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Side {
    /// `corners[i]` lies between `lines[i]` and `lines[i + 1]`.
    pub(super) corners: Vec<f64>,
    pub(super) lines: Vec<Line>,
    /// Where the force falls to zero, u₃ \[m\].
    pub(super) end: f64,
}

/// A restoring force on both sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RestoringForce {
    pub(super) positive: Side,
    pub(super) negative: Side,
    /// Slope of the elastic branch through the origin, k₁ \[N/m\]; `None` for the rigid-linear law.
    pub(super) elastic_stiffness: Option<f64>,
    /// End of the elastic branch as a fraction of `u_ins`, a₁ \[-\].
    pub(super) elastic_fraction: f64,
}

impl RestoringForce {
    /// # Errors
    /// A relation between `a1`, `a3`, `d1`, or the points of a multilinear law, that does not hold.
    pub(super) fn new(parameters: &Parameters, body: &Body) -> Result<Self, ParameterError> {
        let k0 = body.geometric_stiffness;
        let a3 = parameters.a3_of_sides.unwrap_or(Sides { positive: parameters.a3, negative: parameters.a3 });
        let side = |sign: f64| {
            let [f0, u_ins] = [body.strength.of(sign), body.instability.of(sign)];
            match &parameters.multilinear {
                Some(points) => Side::multilinear(&points_of_side(points, sign), f0, u_ins),
                None => Side::from_parameters(parameters, a3.of(sign), [f0, u_ins, k0]),
            }
        };
        check(parameters, a3.positive)?;
        check(parameters, a3.negative)?;
        let (positive, mut negative) = (side(1.0), side(-1.0));
        let rigid = parameters.multilinear.is_none() && parameters.force_law == ForceLaw::RigidLinear;
        let elastic_stiffness = (!rigid).then(|| positive.lines[0].slope);
        if let Some(k1) = elastic_stiffness.filter(|_| a3.positive == a3.negative)
            && (negative.lines[0].slope - k1).abs() <= SAME_SLOPE * k1
        {
            // k₁ is the same on both sides: the same number keeps the branch through the origin one line.
            negative.lines[0].slope = k1;
        }
        for line in &mut negative.lines {
            *line = line.mirrored();
        }
        let elastic_fraction = match &parameters.multilinear {
            Some(points) => points_of_side(points, 1.0)[0][0],
            None if rigid => 0.0,
            None => parameters.a1,
        };
        Ok(Self { positive, negative, elastic_stiffness, elastic_fraction })
    }

    /// Returns whether both sides are the same: F(−u) = −F(u).
    pub(super) fn is_odd(&self) -> bool {
        let Side { corners, lines, end } = &self.negative;
        let is_mirrored = |(own, other): (&Line, &Line)| *own == other.mirrored();
        corners == &self.positive.corners
            && end == &self.positive.end
            && self.positive.lines.iter().zip(lines).all(is_mirrored)
    }

    /// Returns whether both sides have the same elastic branch: one line through the origin.
    pub(super) fn is_straight(&self) -> bool {
        self.elastic_stiffness.is_some_and(|k1| self.negative.lines[0].slope == k1)
    }

    /// The side of `sign`; the negative one is in signed displacements and forces.
    pub(super) fn side(&self, sign: f64) -> &Side {
        if sign < 0.0 { &self.negative } else { &self.positive }
    }

    /// Elastic circular frequency ω₁ = √(k₁/`m_eff`) \[rad/s\]; 0 for the rigid-linear law.
    pub(super) fn omega1(&self, effective_mass: f64) -> f64 {
        self.elastic_stiffness.map_or(0.0, |k1| (k1 / effective_mass).sqrt())
    }
}

impl Side {
    fn from_parameters(parameters: &Parameters, a3: f64, [f0, u_ins, k0]: [f64; 3]) -> Self {
        let Parameters { a1, d1, .. } = *parameters;
        let rigid = parameters.force_law == ForceLaw::RigidLinear;
        let (u1, u3) = (if rigid { 0.0 } else { a1 * u_ins }, a3 * u_ins);
        let slope = match parameters.softening {
            // F = k₀ (u₃ − u)
            Softening::Parallel => -k0,
            // F = F₀ (1 − u/u₃)
            Softening::Rotated => -f0 / u3,
            // F = F₀ (1 − a₁)(u₃ − u)/(u₃ − u₁)
            Softening::Chord => -f0 * (1.0 - u1 / u_ins) / (u3 - u1),
        };
        let softening = Line { anchor: u3, force: 0.0, slope };
        let elastic = |force: f64| Line { anchor: 0.0, force: 0.0, slope: force / u1 };
        match parameters.force_law {
            ForceLaw::RigidLinear => Self { corners: vec![], lines: vec![softening], end: u3 },
            ForceLaw::Bilinear => {
                Self { corners: vec![u1], lines: vec![elastic(softening.at(u1)), softening], end: u3 }
            }
            ForceLaw::Trilinear => {
                let yield_force = d1 * f0;
                // u₂: where the softening line meets F_y
                let u2 = u3 + yield_force / slope;
                let plateau = Line { anchor: u1, force: yield_force, slope: 0.0 };
                Self { corners: vec![u1, u2], lines: vec![elastic(yield_force), plateau, softening], end: u3 }
            }
        }
    }

    fn multilinear(points: &[[f64; 2]], f0: f64, u_ins: f64) -> Self {
        let mut corners = Vec::with_capacity(points.len());
        let mut lines = Vec::with_capacity(points.len());
        let mut from = [0.0, 0.0];
        let mut end = f64::INFINITY;
        for point in points {
            let to = [point[0] * u_ins, point[1] * f0];
            let slope = (to[1] - from[1]) / (to[0] - from[0]);
            let mut line = Line { anchor: from[0], force: from[1], slope };
            if slope < 0.0 {
                let zero = to[0] - to[1] / slope;
                line = Line { anchor: zero, force: 0.0, slope };
                end = zero;
            }
            lines.push(line);
            corners.push(to[0]);
            from = to;
        }
        // the force continues along the last line
        corners.pop();
        Self { corners, lines, end }
    }
}

/// Relations within the force law: 0 < a₁ < a₃ ≤ 1, u₁ < u₂, rising points.
fn check(parameters: &Parameters, a3: f64) -> Result<(), ParameterError> {
    let Parameters { a1, d1, softening, .. } = *parameters;
    if let Some(points) = &parameters.multilinear {
        return check_points(points);
    }
    if parameters.force_law == ForceLaw::RigidLinear {
        return Ok(());
    }
    if a1 >= a3 {
        return Err(ParameterError::ElasticBranchTooLong { a1, a3 });
    }
    if parameters.force_law == ForceLaw::Trilinear {
        let (limit, formula) = match softening {
            Softening::Parallel => (a3 - a1, "a3 - a1"),
            Softening::Rotated => (1.0 - a1 / a3, "1 - a1/a3"),
            Softening::Chord => (1.0 - a1, "1 - a1"),
        };
        if d1 >= limit {
            return Err(ParameterError::PlateauTooHigh { d1, limit, formula, softening: softening.name() });
        }
    }
    Ok(())
}

/// Returns the points `[|u|/u_ins, |F|/F0]` of a multilinear law on the side of `sign`, from the origin
/// outwards. Without points at u < 0 both sides have those of u > 0.
fn points_of_side(points: &[[f64; 2]], sign: f64) -> Vec<[f64; 2]> {
    let (negative, positive) = points.split_at(points.partition_point(|point| point[0] < 0.0));
    if sign > 0.0 || negative.is_empty() {
        return positive.to_vec();
    }
    negative.iter().rev().map(|point| point.map(|number| -number)).collect()
}

/// What is wrong with a point of a multilinear law.
const RISE: &str = "the displacements must rise from zero; sort the points, and give loops by their envelope";
const SIGN: &str =
    "the force must be positive, and negative at u < 0 (the last one may be zero); cut the rest";

/// Checks that points `[u, F]`, in any units, make a multilinear law, on each of its sides.
///
/// # Errors
/// [`ParameterError::Points`] of the first that does not.
pub fn check_points(points: &[[f64; 2]]) -> Result<(), ParameterError> {
    let refuse = |index: usize, reason: &'static str| {
        let [displacement, force] = points.get(index).copied().unwrap_or([f64::NAN; 2]);
        Err(ParameterError::Points { number: index + 1, displacement, force, reason })
    };
    let first = points.partition_point(|point| point[0] < 0.0);
    let last = points.len().saturating_sub(1);
    for (index, &[displacement, force]) in points.iter().enumerate() {
        if !displacement.is_finite() || !force.is_finite() {
            return refuse(index, "both numbers must be finite");
        }
        if displacement == 0.0 || index > 0 && displacement <= points[index - 1][0] {
            return refuse(index, RISE);
        }
        if force * displacement < 0.0 || force == 0.0 && index != last && (index > 0 || first == 0) {
            return refuse(index, SIGN);
        }
    }
    if let Some(end) = (points.len() - first < 2).then_some(last).or((first == 1).then_some(0)) {
        return refuse(end, "a multilinear law needs at least two points after the origin");
    }
    let ends = [Some((last - 1, last)), (first > 0).then_some((1, 0))];
    for (before, end) in ends.into_iter().flatten() {
        if points[end][1].abs() >= points[before][1].abs() {
            return refuse(end, "the last line must fall: the force goes on along it");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::Wall;

    /// A plateau needs u₁ < u₂: d₁ stays below the value at which u₂ = u₁.
    #[test]
    fn the_plateau_ends_beyond_the_elastic_branch() {
        let (a1, a3) = (0.1, 0.8);
        for softening in Softening::ALL.iter().copied() {
            let width = |d1: f64| {
                let force_law = ForceLaw::Trilinear;
                let wall =
                    Wall::new(&Parameters { force_law, a1, a3, d1, softening, ..Parameters::default() })?;
                let [from, to] = wall.statics().force.positive.corners[..] else { panic!("not two corners") };
                Ok((to - from) / wall.body().instability.positive)
            };
            let Err(ParameterError::PlateauTooHigh { limit, .. }) = width(0.99) else {
                panic!("no plateau is that high")
            };
            assert!(width(limit).is_err());
            // softening lines fall by F₀ over u_ins, or faster
            let width = width(limit - 1e-6).unwrap();
            assert!(width > 0.0 && width < 1e-6 + 1e-15, "{softening:?}: {width}");
        }
    }
}
