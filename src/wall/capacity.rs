//! The capacity curve of a wall, and its secant periods.

use std::f64::consts::TAU;

use super::equation::Wall;
use super::statics::ROUNDING;
use super::tie::Tie;

/// A point of the capacity curve of one side, with the displacement and the force as positive numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapacityPoint {
    /// |u| \[m\].
    pub displacement: f64,
    /// |F| with that of ties, negative beyond u₃ \[N\].
    pub force: f64,
    /// |u|/`u_ins` \[-\].
    pub displacement_ratio: f64,
    /// F/F₀ \[-\].
    pub force_ratio: f64,
    /// d* = |u|/λ in the oscillator form of Eq. (12), d̈* + a*(d*) = −`a_g`; the curve a*(d*) can be drawn
    /// over a response spectrum \[m\].
    pub spectral_displacement: f64,
    /// a* = F/(λ `m_eff`) \[m/s²\].
    pub spectral_acceleration: f64,
    /// Secant stiffness F/u \[N/m\]; `None` at u = 0.
    pub secant_stiffness: Option<f64>,
    /// Secant period T = 2π √(`m_eff` u/F) = 2π √(d*/a*) \[s\]; `None` at u = 0 and where the force is not
    /// positive.
    pub secant_period: Option<f64>,
}

impl Wall {
    /// Returns the point of the capacity curve of the side of `sign` at a fraction of its `u_ins`. Ties
    /// have the force of a displacement that is reached for the first time.
    pub fn capacity_at(&self, sign: f64, fraction: f64) -> CapacityPoint {
        let u = fraction * self.body().instability.of(sign);
        let point = self.capacity_point(sign, u, self.ties().pull(sign, u));
        // keep the fraction itself: the quotient u/u_ins may differ from it in the last digit
        CapacityPoint { displacement_ratio: fraction, ..point }
    }

    /// Returns the corners of the capacity curve of the side of `sign`, from u = 0 to `u_ins`. Where a tie
    /// breaks there are two, before and after the fracture.
    pub fn capacity_corners(&self, sign: f64) -> Vec<CapacityPoint> {
        let u_ins = self.body().instability.of(sign);
        let side = self.statics().force.side(sign);
        let mut corners = vec![0.0];
        for tie in self.ties().of_side(sign) {
            corners.push(tie.onset());
            if let Some(breaks) = tie.fracture_displacement() {
                corners.extend(tie.strength_displacement().into_iter().chain([breaks]));
            }
        }
        corners.extend(side.corners.iter().chain([&side.end, &u_ins]));
        corners.retain(|corner| *corner <= u_ins);
        corners.sort_by(f64::total_cmp);
        corners.dedup_by(|a, b| *a - *b <= ROUNDING * u_ins);
        let points = |u: f64| {
            let after = self.capacity_point(sign, u, self.ties().pull(sign, u));
            let breaks = |tie: &&Tie| {
                tie.fracture_displacement().is_some_and(|breaks| (u - breaks).abs() <= ROUNDING * u_ins)
            };
            let lost: f64 = self
                .ties()
                .of_side(sign)
                .filter(breaks)
                .map(|tie| tie.pull * tie.strength.unwrap_or_default())
                .sum();
            let before = (lost > 0.0).then(|| self.capacity_point(sign, u, self.ties().pull(sign, u) + lost));
            before.into_iter().chain(std::iter::once(after))
        };
        corners.into_iter().flat_map(points).collect()
    }

    /// Returns the acceleration of the supports at which rocking starts, by the static curve without a tie:
    /// the largest a* of the force law, on the weaker of the sides to which the wall can rock \[m/s²\].
    pub fn rocking_onset(&self) -> f64 {
        let body = self.body();
        let largest =
            |sign: f64| self.statics().largest_own_force(sign) / (body.participation * body.effective_mass);
        self.sides().map(largest).fold(f64::INFINITY, f64::min)
    }

    /// Returns the |u| of the unstable equilibrium that yielding ties move outwards on the side of `sign`, of
    /// one tie u₃ + `N_y`/k₀ dF/dN with parallel softening, the nearest of several \[m\]; `None` where no tie
    /// yields there.
    pub fn yielding_equilibrium(&self, sign: f64) -> Option<f64> {
        let yielding = self.branches().iter().filter(|branch| branch.yielding_side() == Some(sign));
        let falling = yielding.filter(|branch| branch.stiffness < 0.0);
        let zeros = falling.map(|branch| (branch.anchor - branch.force / branch.stiffness, branch));
        let within = zeros.filter(|(u, branch)| (branch.lower..branch.upper).contains(u));
        within.map(|(u, _)| u.abs()).reduce(f64::min)
    }

    /// Returns a point of the curve on which the ties take the part `pull` of |F| \[N\].
    fn capacity_point(&self, sign: f64, u: f64, pull: f64) -> CapacityPoint {
        let body = self.body();
        let (m, participation) = (body.effective_mass, body.participation);
        let (u_ins, strength) = (body.instability.of(sign), body.strength.of(sign));
        let force = self.statics().own_force(sign, u) + pull;
        CapacityPoint {
            displacement: u,
            force,
            displacement_ratio: u / u_ins,
            force_ratio: force / strength,
            spectral_displacement: u / participation,
            spectral_acceleration: force / (participation * m),
            secant_stiffness: (u > 0.0).then(|| force / u),
            secant_period: (u > 0.0 && force > 0.0).then(|| TAU * (m * u / force).sqrt()),
        }
    }
}
