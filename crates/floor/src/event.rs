//! A floor that an importer's solver moves: it sets the state; yielding and unloading are events.

use crate::floor::{Branch, Floor, Yielding};
use crate::motion::{FloorState, Load};

/// Event indicators: the distances to yielding towards +x and −x, or the velocity while yielding.
pub(crate) const INDICATORS: usize = 2;

/// How far beyond its corner an indicator becomes zero, as a part of its scale.
///
/// The margin is far above rounding and far below any solver's tolerance, so that no indicator is zero after
/// an event.
const MARGIN: f64 = 1e-12;

impl FloorState {
    /// Returns plastic displacement \[m\] and hysteretic energy \[J\] at a displacement that a solver has set
    /// since the last corner.
    pub(crate) fn flow(&self, floor: &Floor) -> (f64, f64) {
        let sign = self.branch.sign();
        match floor.yielding {
            Some(Yielding { displacement: limit, force }) if sign != 0.0 => {
                let plastic = self.displacement - sign * limit;
                (plastic, self.hysteretic_energy + force * sign * (plastic - self.plastic))
            }
            _ => (self.plastic, self.hysteretic_energy),
        }
    }

    /// Returns the rate of the plastic displacement \[m/s\].
    pub(crate) fn plastic_rate(&self) -> f64 {
        if self.branch == Branch::Elastic { 0.0 } else { self.velocity }
    }

    /// Returns the event indicators; each is positive while the branch holds.
    pub(crate) fn indicators(&self, floor: &Floor) -> [f64; INDICATORS] {
        let Some(Yielding { displacement: limit, .. }) = floor.yielding else { return [1.0; INDICATORS] };
        if self.branch == Branch::Elastic {
            let deformation = (self.displacement - self.plastic) / limit;
            [1.0 - deformation + MARGIN, 1.0 + deformation + MARGIN]
        } else {
            [self.branch.sign() * self.velocity / (limit * floor.omega()) + MARGIN, 1.0]
        }
    }

    /// Updates branch, plastic displacement and hysteretic energy. Returns whether the branch has changed.
    pub(crate) fn event(&mut self, floor: &Floor, load: Load) -> bool {
        let Some(Yielding { displacement: limit, .. }) = floor.yielding else { return false };
        let before = self.branch;
        if before == Branch::Elastic {
            let deformation = self.displacement - self.plastic;
            if deformation.abs() < limit {
                return false;
            }
            self.branch = if deformation > 0.0 { Branch::YieldingUp } else { Branch::YieldingDown };
        }
        (self.plastic, self.hysteretic_energy) = self.flow(floor);
        self.branch = self.branch_ahead(floor, load);
        self.branch != before
    }
}
