//! The numbers that follow from the parameters of a wall.

use std::borrow::Cow;
use std::f64::consts::TAU;

use crate::choices::RestitutionSource;

use super::equation::Wall;
use super::equivalence;
use super::given::COMPUTED;
use super::impact::of_rectangle;
use super::sides::Sides;

/// A number that follows from the parameters of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its name, that of the variable of the model description where there is one.
    pub name: Cow<'static, str>,
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
        let [positive, negative] = [1.0, -1.0].map(|sign| self.stated(sign));
        let omega1 = self.omega1();
        let period = if omega1 > 0.0 { TAU / omega1 } else { 0.0 };
        [
            ("mass", "m", body.mass, "kg"),
            ("effective_mass", "m_eff", body.effective_mass, "kg"),
            ("participation", "lambda", body.participation, "-"),
            ("weight", "W", body.weight, "N"),
            ("slenderness", "alpha", body.slenderness.positive, "rad"),
            ("F0", "F0+", positive[0], "N"),
            ("F0_negative", "F0-", negative[0], "N"),
            ("u_ins", "u_ins+", positive[1], "m"),
            ("u_ins_negative", "u_ins-", negative[1], "m"),
            ("geometric_stiffness", "k0", body.geometric_stiffness, "N/m"),
            ("force_end", "u3+", self.force_end().positive, "m"),
            ("rocking_onset", "a_g", self.rocking_onset(), "m/s2"),
            ("omega1", "omega1", omega1, "rad/s"),
            ("elastic_period", "T1", period, "s"),
        ]
        .map(|(name, symbol, value, unit)| Fact { name: name.into(), symbol, value, unit })
        .into_iter()
        .chain(self.impact_facts())
        .chain(self.body_facts())
        .chain(self.tie_facts())
        .collect()
    }

    /// Lists the coefficient of restitution in use, those of all sources, and the damping.
    fn impact_facts(&self) -> impl Iterator<Item = Fact> + use<> {
        let (body, e) = (self.body(), self.restitution());
        let is_known = e != Sides::both(COMPUTED);
        let known = |e: f64| is_known.then_some(e);
        let differs = |e: Sides| ((e.negative - e.positive).abs() > 1e-12).then_some(e.negative);
        let equivalent = |f: fn(f64) -> f64| known(e.least()).map(f);
        let [analytic, calibrated] = [RestitutionSource::Analytic, RestitutionSource::Calibrated]
            .map(|source| body.is_rectangle.then(|| of_rectangle(source, body).positive));
        given([
            ("restitution_used", "e", known(e.positive), "-"),
            ("restitution_used_negative", "e-", differs(e), "-"),
            ("restitution_analytic", "e_an", analytic, "-"),
            ("restitution_calibrated", "e_cal", calibrated, "-"),
            ("restitution_impulses", "e_imp", body.impulses.map(|e| e.positive), "-"),
            ("restitution_impulses_negative", "e_imp-", body.impulses.and_then(differs), "-"),
            ("xi_used", "xi", Some(self.damping_ratio()), "-"),
            ("elastic_damping", "C", Some(self.elastic_damping()), "N s/m"),
            ("xi_makris", "Eq. 14", equivalent(equivalence::makris_konstantinidis), "-"),
            ("xi_giannini", "Eq. 17", equivalent(equivalence::giannini_masiani), "-"),
        ])
    }

    /// Lists what only a body that is no rectangle has.
    fn body_facts(&self) -> impl Iterator<Item = Fact> + use<> {
        let body = self.body();
        let is_other = !body.is_rectangle;
        let of_one = |value: f64| (is_other && !body.is_strip()).then_some(value);
        let of_strip = |value: f64| (is_other && body.is_strip()).then_some(value);
        let multiplier = |force: f64| {
            is_other.then(|| force * body.mass / (body.participation * body.effective_mass * body.weight))
        };
        let [w_b, w_t] = body.support_weights;
        given([
            ("centroid_height", "z_G", of_one(body.centroid_height), "m"),
            ("slenderness_negative", "alpha-", is_other.then_some(body.slenderness.negative), "rad"),
            ("static_multiplier", "alpha_0+", multiplier(self.stated(1.0)[0]), "-"),
            ("static_multiplier_negative", "alpha_0-", multiplier(self.stated(-1.0)[0]), "-"),
            ("thrust", "H", is_other.then_some(body.contact.thrust), "N"),
            ("hinge_height", "h1", of_strip(body.hinge_height), "m"),
            ("support_weight_bottom", "w_b", of_strip(w_b), "-"),
            ("support_weight_top", "w_t", of_strip(w_t), "-"),
            ("drift_stiffness", "F_d/d", of_strip(body.drift_weight / body.height), "N/m"),
        ])
    }

    /// Lists the numbers of each tie, and the |u| at which it first pulls, yields and breaks. Names of
    /// several ties are numbered.
    fn tie_facts(&self) -> impl Iterator<Item = Fact> {
        let are_several = self.ties().len() > 1;
        let of_each = self.ties().iter().zip(1..).flat_map(move |(tie, number)| {
            let facts = given([
                ("tie_height", "y", are_several.then_some(tie.height), "m"),
                ("tie_stiffness", "K", Some(tie.stiffness), "N/m"),
                ("tie_strength", "N_y", tie.strength, "N"),
                ("tie_ultimate", "p_u", tie.ultimate, "m"),
                ("tie_engages", "u_e", Some(tie.onset()), "m"),
                ("tie_yields", "u_y", tie.strength_displacement(), "m"),
                ("tie_breaks", "u_f", tie.fracture_displacement(), "m"),
            ]);
            let numbered = move |fact: Fact| match fact.name.strip_prefix("tie_") {
                Some(name) if are_several => Fact { name: format!("tie_{number}_{name}").into(), ..fact },
                _ => fact,
            };
            facts.map(numbered)
        });
        let [positive, negative] = [1.0, -1.0].map(|sign| self.yielding_equilibrium(sign));
        of_each.chain(given([
            ("tie_equilibrium", "u*+", positive, "m"),
            ("tie_equilibrium_negative", "u*-", negative, "m"),
        ]))
    }
}

/// Returns the facts whose value there is.
fn given<const N: usize>(
    facts: [(&'static str, &'static str, Option<f64>, &'static str); N],
) -> impl Iterator<Item = Fact> {
    let given = |(name, symbol, value, unit): (&'static str, _, Option<f64>, _)| {
        value.map(|value| Fact { name: name.into(), symbol, value, unit })
    };
    facts.into_iter().filter_map(given)
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
