//! What is said of the numbers of a curve.

mod body;
mod strip;

use std::f64::consts::TAU;

use rocking_wall::variables::{EccentricityMode, Mechanism};
use rocking_wall::wall::Parameters;

use super::case::has_plateau;
use super::{Curve, factor_of_beam};
use crate::circolare::statement::Statement;
use crate::circolare::statement::table::Activation;
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::names::Side;
use crate::words::{at_most, say};

pub(in crate::circolare) use body::Names;

/// Share by which a formula may differ from the number that it explains: rounding only \[-\].
const ROUNDING: f64 = 1e-9;

/// Returns whether a formula gives a number.
pub(in crate::circolare) fn gives(formula: f64, number: f64) -> bool {
    (formula - number).abs() <= ROUNDING * number.abs()
}

/// A side of a wall whose numbers are shown.
#[derive(Clone, Copy)]
pub(in crate::circolare) struct OfSide<'a> {
    pub(in crate::circolare) statement: &'a Statement,
    pub(in crate::circolare) parameters: &'a Parameters,
    pub(in crate::circolare) side: Side,
}

impl OfSide<'_> {
    /// The eccentricity of the overburden, positive towards the side that it loads least \[m\].
    pub(in crate::circolare) fn eccentricity(&self) -> f64 {
        let Parameters { eccentricity_mode, overburden_eccentricity, .. } = *self.parameters;
        let follows = eccentricity_mode == EccentricityMode::FollowsPivot;
        if follows { overburden_eccentricity } else { self.side.sign() * overburden_eccentricity + 0.0 }
    }

    /// A ledger that knows the wall, and the numbers of the side with its hinge: forces in kN, displacements
    /// in mm.
    pub(in crate::circolare) fn ledger(&self, curve: &Curve) -> Ledger {
        let (parameters, body) = (self.parameters, curve.body());
        let (w, o, h1) = (1e-3 * body.weight, 1e-3 * body.overburden, body.hinge_height);
        let pushed = 1e-3 * curve.pushed_weight;
        let above = w * (1.0 - h1 / body.height) + o;
        let with_e_star = pushed * curve.e_star;
        let mut ledger = Ledger::default();
        ledger.know(&[
            ("ρ", parameters.density),
            ("g", parameters.gravity),
            ("h", body.height),
            ("b", parameters.thickness),
            ("l", parameters.width),
            ("h_1", h1),
            ("h_2", body.height - h1),
            ("r", self.statement.table.overburden_mass.unwrap_or(0.0)),
            ("c", self.eccentricity()),
            ("W", w),
            ("O", o),
            ("(W + O)", w + o),
            ("(W_2 + O)", above),
            ("(W + 2 r O)", pushed),
            ("((W + 2 r O) e*)", with_e_star),
            ("[(W + 2 r O) e*]", with_e_star),
            ("(W + 2 r O) e*", with_e_star),
            ("(d/u)", curve.d_per_u),
            ("u_0", 1e3 * curve.d0 / curve.d_per_u),
            ("k_0", 1e-3 * curve.acting_force * curve.d_per_u / curve.d0),
            ("h_1/h", curve.hinge.unwrap_or(f64::NAN)),
            ("t_b", 1e3 * curve.set_back.base),
            ("t_m", 1e3 * curve.set_back.middle),
            ("t_t", 1e3 * curve.set_back.top),
            ("FC", self.statement.confidence_factor),
            ("q", self.statement.behaviour_factor),
            ("K", 1e-3 * parameters.tie_stiffness),
            ("N_y", 1e-3 * parameters.tie_strength),
            ("g_0", 1e3 * parameters.tie_slack),
            ("e_p", 1e3 * parameters.tie_ultimate),
            ("y", parameters.tie_height),
        ]);
        curve.know_contact(*self, &mut ledger);
        ledger
    }
}

impl Curve {
    /// Adds the numbers of one side, from the force to the curve.
    pub(in crate::circolare) fn add_to(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        ledger.begin("", "curve");
        if let Some(tie) = self.tie() {
            // of several, those of this side
            ledger.know(&[
                ("K", 1e-3 * tie.stiffness),
                ("N_y", 1e-3 * tie.strength.unwrap_or(0.0)),
                ("g_0", 1e3 * tie.slack),
                ("e_p", 1e3 * tie.ultimate.unwrap_or(-1e-3)),
                ("y", tie.height),
                ("φ_y", tie.lever),
            ]);
        }
        if let Some(at) = self.hinge {
            let words = say!("Place of the hinge", "Posizione della cerniera");
            ledger.add(Quantity::new("hinge_ratio", "h_1/h", Unit::NONE, at, words).unlisted());
        }
        if let (Some(angle), Some(range)) = (self.crack, of.statement.table.crack_angles) {
            let [from, to] = range.map(|angle| at_most(angle, 4));
            let words = say! {
                "Crack from the vertical, at the least α0 from {from}° to {to}°",
                "Lesione rispetto alla verticale, di minimo α0 tra {from}° e {to}°", from, to
            };
            let crack = Quantity::new("crack_angle", "β", Unit::DEGREES, angle, words);
            ledger.add(crack.at("C8.7.1.2.1.1"));
        }
        if self.is_plain() {
            self.add_rectangle(of, ledger);
        } else {
            self.add_sums(of, ledger);
        }
        self.add_zero(ledger);
        let words = if self.tie().is_some() {
            say!("Zero of the curve of the wall without a tie", "Annullamento della curva senza catena")
        } else {
            say!("Zero of the curve", "Annullamento della curva")
        };
        let zero = Quantity::new("d0", "d_0 = (d/u) u_0", Unit::MILLIMETRES, self.d0, words);
        ledger.add(zero.at("C8.7.1.2.1.6"));
        self.add_elastic_branch(of, ledger);
    }

    /// Adds the numbers of a rectangle, from its weight to d/u.
    fn add_rectangle(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (body, parameters) = (self.body(), of.parameters);
        let (unit, value) = (Unit::SPECIFIC_WEIGHT, parameters.density * parameters.gravity);
        let words = say!("Specific weight", "Peso specifico");
        ledger.add(Quantity::new("", "γ = ρ g {10⁻³}", unit, value, words));
        let words = say!("Weight", "Peso");
        ledger.add(Quantity::new("", "W = γ h b l", Unit::KILONEWTONS, body.weight, words));
        self.add_force(of, ledger);
        let (multiplier, mass, ratio) = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody if body.overburden > 0.0 => {
                ("α0 = F_act/(W + 2 r O)", "M* = e* (W + r O)/g", "d/u = (W + 2 r O)/(W + r O)")
            }
            Mechanism::Parapet | Mechanism::RigidBody => ("α0 = F_act/W", "M* = e* W/g", "d/u"),
            Mechanism::VerticalSpanning => ("α0 = F_act/W", "M* = e* W/g", "d/u = 1/2 · W/W"),
        };
        let words = say!("Multiplier of activation, without FC", "Moltiplicatore di attivazione, senza FC");
        ledger.add(Quantity::new("alpha0", multiplier, Unit::NONE, self.alpha0, words).at("[C8.7.1.1]"));
        let words = say!("One resultant on each body", "Una risultante per ogni corpo");
        ledger.add(Quantity::new("e_star", "e*", Unit::NONE, self.e_star, words).at("[C8.7.1.5]"));
        let words = say!("Participating mass", "Massa partecipante");
        ledger.add(Quantity::new("M_star", mass, Unit::TONNES, self.mass, words));
        let words = say!("Acceleration of activation, without FC", "Accelerazione di attivazione, senza FC");
        ledger.add(Quantity::new("a0", "a_0 = α0 g/e*", Unit::ACCELERATION, self.a0, words));
        let words = say! {
            "Displacement of the code over that of the model",
            "Rapporto tra spostamento spettrale e spostamento u"
        };
        ledger.add(Quantity::new("d_per_u", ratio, Unit::NONE, self.d_per_u, words).at("[C8.7.1.4]"));
    }

    /// Adds F0 of Eq. (1) with the hinges at the edges, where the side has them, and `F_act`.
    fn add_force(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (body, unit) = (self.body(), Unit::KILONEWTONS);
        if has_plateau(of.parameters) {
            let words = say!("Largest force of the law", "Forza massima della legge");
            ledger.add(Quantity::new("", "F_act", unit, self.acting_force, words));
            return;
        }
        let formula = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody if body.overburden == 0.0 => "W b/h",
            Mechanism::Parapet | Mechanism::RigidBody => "[(W + O) b − 2 O c]/h",
            Mechanism::VerticalSpanning => {
                let words = say!("Height of the hinge", "Quota della cerniera");
                ledger.add(Quantity::new("", "h_1", Unit::METRES, body.hinge_height, words));
                "(2/h_1) (W + O) b + O (b + 2 c)/h_2"
            }
        };
        let words = say! {
            "Force at u = 0 of the line that falls to its zero", "Forza a u = 0 della retta decrescente"
        };
        let strength = body.strength.of(of.side.sign());
        if gives(self.acting_force, strength) {
            ledger.add(Quantity::new("", format!("F_act = F0 = {formula}"), unit, self.acting_force, words));
            return;
        }
        let of_edges =
            say!("Force at u = 0 with the hinges at the edges", "Forza a u = 0 con le cerniere agli spigoli");
        ledger.add(Quantity::new("", format!("F0 = {formula}"), unit, strength, of_edges));
        // the overburden passes no nearer to the edge than the set-back of the top
        let is_cut = of.eccentricity() > 0.5 * of.parameters.thickness - self.set_back.top;
        let formula = match (of.statement.masonry, body.mechanism) {
            (None, _) => "F_act",
            (Some(_), Mechanism::Parapet | Mechanism::RigidBody) => "F_act = F0 − (2/h) (W + O) t_b {10⁻³}",
            (Some(_), Mechanism::VerticalSpanning) if is_cut => {
                "F_act = F0 − (2/h_1) (W + O) t_b {10⁻³} − 2 (W_2 + O) t_m {10⁻³} h/(h_1 h_2) − (2/h_2) O [c \
                 − (b/2 − t_t {10⁻³})]"
            }
            (Some(_), Mechanism::VerticalSpanning) => {
                "F_act = F0 − (2/h_1) (W + O) t_b {10⁻³} − 2 (W_2 + O) t_m {10⁻³} h/(h_1 h_2)"
            }
        };
        ledger.add(Quantity::new("", formula, unit, self.acting_force, words));
    }

    /// Adds `k_0` and `u_0` of the line that falls to its zero, unless a law of another form has them.
    fn add_zero(&self, ledger: &mut Ledger) {
        let body = self.body();
        let (w, o) = (body.weight, body.overburden);
        let (k, formula) = if !self.is_plain() {
            let formula = match (body.is_strip(), ledger.number("K_1")) {
                (false, _) => "k_0 = K_θ/z_G²",
                (true, Some(_)) => "k_0 = 2 (K_1/h_1² + K_2/h_2²)",
                (true, None) => "k_0",
            };
            (body.geometric_stiffness, formula)
        } else if body.mechanism == Mechanism::Parapet {
            (2.0 * (w + 2.0 * o) / body.height, "k_0 = 2 (W + 2 O)/h")
        } else {
            let [h1, h2] = [body.hinge_height, body.height - body.hinge_height];
            (2.0 * (w + o) / h1 + 2.0 * o / h2, "k_0 = 2 (W + O)/h_1 + 2 O/h_2")
        };
        if gives(self.acting_force / k, self.zero) {
            let words = say!("Slope of the line that falls to its zero", "Pendenza della retta decrescente");
            ledger.add(Quantity::new("", formula, Unit::KILONEWTONS_PER_METRE, k, words));
            let words = say!("Zero of the line", "Annullamento della retta");
            ledger.add(Quantity::new("", "u_0 = F_act/k_0 {10³}", Unit::MILLIMETRES, self.zero, words));
        }
    }

    /// Adds T0, `d_y` and `a_y`.
    fn add_elastic_branch(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (parameters, &Self { t0, dy, ay, a0, d0, d_per_u, .. }) = (of.parameters, self);
        let (seconds, mm, acceleration) = (Unit::SECONDS, Unit::MILLIMETRES, Unit::ACCELERATION);
        let end = say!("End of the elastic branch", "Fine del ramo elastico");
        let largest = say!("Largest acceleration, without FC", "Accelerazione massima, senza FC");
        match of.statement.table.before_activation {
            None | Some(Activation::Rigid) => {
                let words = say!("Period before activation: rigid", "Periodo prima dell'attivazione: rigida");
                ledger.add(Quantity::new("T0", "T0", seconds, t0, words).at("C8.7.1.2.1.3"));
                ledger.add(Quantity::new("dy", "d_y", mm, dy, end).unlisted());
                ledger.add(Quantity::new("ay", "a_y", acceleration, ay, largest).unlisted());
            }
            Some(Activation::Law) => {
                let (a1, at_end) = (parameters.a1, dy * (TAU / t0).powi(2));
                ledger.know(&[("a_1", a1), ("u_ins", 1e3 * dy / (a1 * d_per_u)), ("a(d_y)", at_end)]);
                let formula = if parameters.multilinear.is_none() { "d_y = (d/u) a_1 u_ins" } else { "d_y" };
                ledger.add(Quantity::new("dy", formula, mm, dy, end));
                let on_line = gives(a0 * (1.0 - dy / d0), ay);
                let formula = if on_line { "a_y = a_0 (1 − d_y/d_0)" } else { "a_y" };
                ledger.add(Quantity::new("ay", formula, acceleration, ay, largest));
                let is_largest = gives(at_end, ay);
                let formula = if is_largest {
                    "T0 = 2π √(d_y {10⁻³}/a_y)"
                } else {
                    "T0 = 2π √[d_y {10⁻³}/a(d_y)]"
                };
                let words = say!("Period of the elastic branch", "Periodo del ramo elastico");
                ledger.add(Quantity::new("T0", formula, seconds, t0, words).at("[C8.7.1.6]"));
            }
            Some(Activation::Beam) => {
                let Parameters { height, thickness, density, gravity, mechanism, .. } = *parameters;
                ledger.know(&[
                    ("κ", factor_of_beam(mechanism)),
                    ("λ", height / thickness),
                    ("L", height),
                    ("W_s", 1e-3 * density * gravity),
                    ("E", 1e-6 * of.statement.table.young_modulus.unwrap_or(f64::NAN)),
                    ("4π²/T0²", (TAU / t0).powi(2)),
                    ("(4π²/T0²)", (TAU / t0).powi(2)),
                ]);
                let words = say!("Period of a uniform beam", "Periodo di una trave uniforme");
                let period = Quantity::new("T0", "T0 = κ λ L √(W_s/(E {10³} g))", seconds, t0, words);
                ledger.add(period.at("[C8.7.1.7]"));
                let formula = "d_y = a_0/(4π²/T0² + a_0/{(}d_0 {10⁻³)}) {10³}";
                ledger.add(Quantity::new("dy", formula, mm, dy, end).at("[C8.7.1.6]"));
                let words = say!("Acceleration there, without FC", "Accelerazione corrispondente, senza FC");
                let formula = "a_y = (4π²/T0²) d_y {10⁻³}";
                ledger.add(Quantity::new("ay", formula, acceleration, ay, words));
            }
        }
    }
}
