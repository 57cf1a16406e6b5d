//! A wall pushed slowly, against the force laws.

use files::tables;
use rocking_wall::variables::{DampingModel, ForceLaw, Mechanism, Softening};
use rocking_wall::wall::{Parameters, Wall};

use super::Difference;
use crate::EvidenceError;

/// Step of the search for a₃ \[-\].
const A3_STEP: f64 = 0.001;

tables! {
    /// A push at the mid-height of a parapet or at the hinge of a strip.
    #[derive(Clone, Debug)]
    pub struct Push {
        /// a₁ of the trilinear laws \[-\].
        pub a1: f64,
        /// d₁ of the trilinear laws \[-\].
        pub d1: f64,
        /// Displacement over thickness from which on a₃ is fitted, and differences count \[-\].
        pub fit_from: f64,
        /// Displacement over thickness, and force over weight \[-\], from a file of their own.
        #[serde(skip)]
        pub points: Vec<[f64; 2]>,
    }
}

/// A push beside the model.
#[derive(Clone, Debug)]
pub struct PushComparison {
    /// Force at u = 0 of the rigid wall, over the weight \[-\].
    pub strength: f64,
    /// `u_ins` over the thickness \[-\].
    pub instability: f64,
    /// The rigid law, which is not fitted, and the trilinear law with each softening.
    pub laws: Vec<PushedLaw>,
}

/// A force law beside the points.
#[derive(Clone, Debug)]
pub struct PushedLaw {
    /// Name of the law or of its softening.
    pub name: &'static str,
    /// a₃, fitted for all but the rigid law \[-\].
    pub a3: f64,
    /// Force over weight at each point \[-\].
    pub forces: Vec<f64>,
    /// Corners of the law: displacement over thickness, force over weight \[-\].
    pub corners: Vec<(f64, f64)>,
    /// Differences of the points that count, over the strength.
    pub difference: Difference,
}

impl Push {
    /// Compares the points with the rigid law and with trilinear laws, whose a₃ is that of least squares to
    /// 0.001.
    ///
    /// # Errors
    /// [`EvidenceError::Parameters`] if the wall or no trilinear law is valid.
    ///
    /// # Panics
    /// If no point lies from `fit_from` on.
    pub fn compare(&self, parameters: &Parameters) -> Result<PushComparison, EvidenceError> {
        // damping does not act in a slow push
        let still = Parameters { damping_model: DampingModel::None, ..parameters.clone() };
        let rigid = Parameters { force_law: ForceLaw::RigidLinear, a3: 1.0, ..still.clone() };
        let wall = Wall::new(&rigid)?;
        let mut laws = vec![self.law("rigid", &rigid, &wall)];
        for &softening in Softening::ALL {
            let trilinear = |a3| Parameters {
                force_law: ForceLaw::Trilinear,
                a1: self.a1,
                d1: self.d1,
                a3,
                softening,
                ..still.clone()
            };
            let candidates = (1..=1000).map(|step| trilinear(A3_STEP * f64::from(step)));
            let valid =
                candidates.filter_map(|law| Some(self.law(softening.name(), &law, &Wall::new(&law).ok()?)));
            match valid.min_by(|a, b| a.difference.rms.total_cmp(&b.difference.rms)) {
                Some(best) => laws.push(best),
                None => drop(Wall::new(&trilinear(1.0))?),
            }
        }
        let instability = wall.body().instability.positive / parameters.thickness;
        Ok(PushComparison { strength: shown_force(&wall, wall.body().strength.positive), instability, laws })
    }

    fn law(&self, name: &'static str, parameters: &Parameters, wall: &Wall) -> PushedLaw {
        let (body, thickness) = (wall.body(), parameters.thickness);
        let over_instability = thickness / body.instability.positive;
        let force = |[displacement, _]: &[f64; 2]| {
            shown_force(wall, wall.capacity_at(1.0, displacement * over_instability).force)
        };
        let forces: Vec<f64> = self.points.iter().map(force).collect();
        let strength = shown_force(wall, body.strength.positive);
        let counted = self.points.iter().zip(&forces).filter(|([x, _], _)| *x >= self.fit_from);
        let difference = Difference::of(counted.map(|([_, measured], force)| (force - measured) / strength));
        let corners = wall.capacity_corners(1.0);
        let corner = |force: f64, u: f64| (u / thickness, shown_force(wall, force));
        let corners = corners.iter().map(|point| corner(point.force, point.displacement)).collect();
        PushedLaw { name, a3: parameters.a3, forces, corners, difference }
    }
}

/// Turns F of Eq. (12) into the force of a push over the weight. That of a strip is twice the line force at
/// its hinge.
fn shown_force(wall: &Wall, force: f64) -> f64 {
    let body = wall.body();
    let factor = match body.mechanism {
        Mechanism::Parapet | Mechanism::RigidBody => 1.0,
        Mechanism::VerticalSpanning => 0.5,
    };
    factor * force / body.weight
}
