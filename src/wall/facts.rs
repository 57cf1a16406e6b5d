//! The numbers that follow from the parameters of a wall.

use std::f64::consts::TAU;

use super::equation::Wall;
use super::equivalence;
use super::tie::Tie;

/// A number that follows from the parameters of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fact {
    /// Its name, that of the variable of the model description where there is one.
    pub name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit; `-` for none.
    pub unit: &'static str,
}

impl Wall {
    /// Lists the numbers that follow from the parameters: masses, strength, stability, periods, damping.
    pub fn facts(&self) -> Vec<Fact> {
        let body = self.body();
        let omega1 = self.omega1();
        let period = if omega1 > 0.0 { TAU / omega1 } else { 0.0 };
        let e = self.restitution();
        [
            ("mass", "m", body.mass, "kg"),
            ("effective_mass", "m_eff", body.effective_mass, "kg"),
            ("participation", "lambda", body.participation, "-"),
            ("weight", "W", body.weight, "N"),
            ("slenderness", "alpha", body.slenderness, "rad"),
            ("F0", "F0+", body.strength.positive, "N"),
            ("F0_negative", "F0-", body.strength.negative, "N"),
            ("u_ins", "u_ins+", body.instability.positive, "m"),
            ("u_ins_negative", "u_ins-", body.instability.negative, "m"),
            ("geometric_stiffness", "k0", body.geometric_stiffness, "N/m"),
            ("force_end", "u3+", self.force_end().positive, "m"),
            ("rocking_onset", "a_g", self.rocking_onset(), "m/s2"),
            ("omega1", "omega1", omega1, "rad/s"),
            ("elastic_period", "T1", period, "s"),
            ("restitution_used", "e", e, "-"),
            ("xi_used", "xi", self.damping_ratio(), "-"),
            ("elastic_damping", "C", self.elastic_damping(), "N s/m"),
            ("xi_makris", "Eq. 14", equivalence::makris_konstantinidis(e), "-"),
            ("xi_giannini", "Eq. 17", equivalence::giannini_masiani(e), "-"),
        ]
        .map(|(name, symbol, value, unit)| Fact { name, symbol, value, unit })
        .into_iter()
        .chain(self.tie_facts())
        .collect()
    }

    /// Lists the numbers of a tie, and the |u| at which it first pulls, yields and breaks.
    fn tie_facts(&self) -> impl Iterator<Item = Fact> + use<> {
        let tie = self.tie();
        let [positive, negative] = [1.0, -1.0].map(|sign| self.yielding_equilibrium(sign));
        let facts = [
            ("tie_stiffness", "K", tie.map(|tie| tie.stiffness), "N/m"),
            ("tie_strength", "N_y", tie.and_then(|tie| tie.strength), "N"),
            ("tie_ultimate", "p_u", tie.and_then(|tie| tie.ultimate), "m"),
            ("tie_engages", "u_e", tie.map(Tie::onset), "m"),
            ("tie_yields", "u_y", tie.and_then(Tie::strength_displacement), "m"),
            ("tie_breaks", "u_f", tie.and_then(Tie::fracture_displacement), "m"),
            ("tie_equilibrium", "u*+", positive, "m"),
            ("tie_equilibrium_negative", "u*-", negative, "m"),
        ];
        let given = |(name, symbol, value, unit): (_, _, Option<f64>, _)| {
            value.map(|value| Fact { name, symbol, value, unit })
        };
        facts.map(given).into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::{DampingModel, ForceLaw, Impact};
    use crate::wall::Parameters;

    /// A rigid wall does not vibrate: its ω₁ and T₁ are 0.
    #[test]
    fn the_elastic_period_is_that_of_omega1() {
        let rigid = Parameters {
            force_law: ForceLaw::RigidLinear,
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            ..Parameters::default()
        };
        for (parameters, vibrates) in [(Parameters::default(), true), (rigid, false)] {
            let facts = Wall::new(&parameters).unwrap().facts();
            let value = |name| facts.iter().find(|fact| fact.name == name).unwrap().value;
            let (omega1, period) = (value("omega1"), value("elastic_period"));
            if vibrates {
                // three roundings
                assert!((omega1 * period / TAU - 1.0).abs() <= 1.5 * f64::EPSILON);
            } else {
                assert_eq!([omega1, period], [0.0, 0.0]);
            }
        }
    }
}
