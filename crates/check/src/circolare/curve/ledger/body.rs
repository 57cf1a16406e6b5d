//! What is said of a body of parts and loads: its sums, by the moments about its toe.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{COMPUTED, Load, Parameters};

use super::{OfSide, gives, strip};
use crate::circolare::curve::set_back::{Contact, standing};
use crate::circolare::curve::{Curve, level};
use crate::circolare::statement::resultants::Resultants;
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::{say, shown};

/// A load as the sums have it: forces in kN, places in m.
struct Term {
    force: f64,
    /// Distance from the toe.
    arm: f64,
    height: f64,
    /// The weight that moves along.
    moving: f64,
    /// The thrust, positive where it takes from the side.
    thrust: f64,
}

/// How formulas name the inertial force for α = 1, dF/dN of a tie, u over its elongation and its slope over
/// K.
#[derive(Clone, Copy)]
pub(in crate::circolare) struct Names {
    pub(in crate::circolare) pushed: &'static str,
    pub(in crate::circolare) lever: &'static str,
    pub(in crate::circolare) per_elongation: &'static str,
    pub(in crate::circolare) slope: &'static str,
}

impl Curve {
    /// Whether the formulas of a rectangle give its numbers.
    pub(in crate::circolare) fn is_plain(&self) -> bool {
        self.body().is_rectangle && self.e_star == 1.0
    }

    /// The names of its terms in formulas.
    pub(in crate::circolare) fn names(&self) -> Names {
        let [lever, per_elongation, slope] = match (self.body().is_strip(), self.is_plain()) {
            (true, _) => ["2 φ_y", "1/φ_y", "2 φ_y²"],
            (false, true) => ["2 y/h", "h/(2 y)", "(2 y/h)²"],
            (false, false) => ["y/z_G", "z_G/y", "(y/z_G)²"],
        };
        let pushed = if self.is_plain() { "(W + 2 r O)" } else { "F_E" };
        Names { pushed, lever, per_elongation, slope }
    }

    /// Adds the sums of a body and its numbers, from the weights to d/u.
    pub(super) fn add_sums(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let unit = Unit::KILONEWTONS;
        let words = say!("Weight of the masonry", "Peso della muratura");
        ledger.add(Quantity::new("weight", "W", unit, self.body().weight, words));
        if self.body().is_strip() {
            self.add_strip(of, ledger);
        } else {
            self.add_moments(of, ledger);
        }
        let (parameters, pushed) = (of.parameters, &self.pushed);
        let all = 1e-3 * pushed.weight;
        let words = say!("Weights that are pushed", "Pesi soggetti all'azione sismica");
        let weights = Quantity::new("pushed_weight", "P_Q = W + Σ (P + Q)", unit, pushed.weight, words);
        let is_own = gives(all, 1e-3 * self.body().weight);
        ledger.add(weights.with_numbers(if is_own { String::new() } else { self.put_weights(of) }));
        let is_edge = gives(self.acting_force, self.body().strength.of(of.side.sign()));
        let is_moment = is_edge && !self.body().is_strip();
        let multiplier = if is_moment { "α0 = (M_W − M_H)/M_E" } else { "α0 = F_act/F_E" };
        let words = say!("Multiplier of activation, without FC", "Moltiplicatore di attivazione, senza FC");
        ledger.add(Quantity::new("alpha0", multiplier, Unit::NONE, self.alpha0, words).at("[C8.7.1.1]"));
        self.add_resultants(of, ledger);
        let words = say!("Participating mass", "Massa partecipante");
        ledger.add(Quantity::new("M_star", "M* = e* P_Q/g", Unit::TONNES, self.mass, words));
        let words = say!("Acceleration of activation, without FC", "Accelerazione di attivazione, senza FC");
        ledger.add(Quantity::new("a0", "a_0 = α0 g/e*", Unit::ACCELERATION, self.a0, words));
        let words = say! {
            "Displacement of the code over that of the model",
            "Rapporto tra spostamento spettrale e spostamento u"
        };
        let is_strip = parameters.mechanism == Mechanism::VerticalSpanning;
        let ratio = if is_strip { "d/u = F_E/(2 P_Q e*)" } else { "d/u = F_E/(P_Q e*)" };
        ledger.add(Quantity::new("d_per_u", ratio, Unit::NONE, self.d_per_u, words).at("[C8.7.1.4]"));
    }

    /// Adds e*, and that of the other resultants.
    fn add_resultants(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let [one, each] = self.pushed.e_stars;
        let (words, other, symbol, told) = match of.statement.table.resultants {
            Resultants::Body => (
                say!("One resultant on each body", "Una risultante per ogni corpo"),
                each,
                "e*_w",
                say! {
                    "The same with a resultant of each weight: every ζ_E is then `e*/e*_w` times as large",
                    "Lo stesso con una risultante per ogni peso: ogni ζ_E va moltiplicato per `e*/e*_w`"
                },
            ),
            Resultants::Each => (
                say!("A resultant of each weight", "Una risultante per ogni peso"),
                one,
                "e*_1",
                say! {
                    "The same with one resultant on each body: every ζ_E is then `e*/e*_1` times as large",
                    "Lo stesso con una risultante per ogni corpo: ogni ζ_E va moltiplicato per `e*/e*_1`"
                },
            ),
        };
        let put = if self.e_star == 1.0 { String::new() } else { e_star(&self.resultants(of)) };
        let formula = if put.is_empty() { "e*" } else { "e* = (Σ P δ)²/(Σ P Σ P δ²)" };
        let own = Quantity::new("e_star", formula, Unit::NONE, self.e_star, words).at("[C8.7.1.5]");
        ledger.add(own.with_numbers(put));
        let other = (other != self.e_star).then_some(other);
        ledger.add(Quantity::new("other_e_star", symbol, Unit::NONE, other, told).at("[C8.7.1.5]"));
    }

    /// The resultants with their δ where there are several; none beside an overburden of a strip.
    fn resultants(&self, of: OfSide<'_>) -> Vec<[f64; 2]> {
        let is_each = of.statement.table.resultants == Resultants::Each;
        if !self.body().is_strip() {
            let at_height = |own: Term| [own.moving, own.height / self.body().centroid_height];
            let loads = self.terms(of).into_iter().map(at_height);
            return [[1e-3 * self.body().weight, 1.0]].into_iter().chain(loads).collect();
        }
        let terms = strip::terms(self.body(), of);
        if is_each {
            return terms.iter().map(|own| [own.moving, own.phi]).collect();
        }
        let of_body = |is_lower: bool| {
            let own = terms.iter().filter(|own| own.is_lower == is_lower);
            let weight: f64 = own.clone().map(|own| own.moving).sum();
            [weight, own.map(|own| own.moving * own.phi).sum::<f64>() / weight]
        };
        if terms.is_empty() { Vec::new() } else { [true, false].map(of_body).to_vec() }
    }

    /// Adds the moments of one body about its toe, and what they are at the height of u.
    fn add_moments(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (body, sign, moments) = (self.body(), of.side.sign(), Unit::KILONEWTON_METRES);
        let z = body.centroid_height;
        let words =
            say!("Height of its centroid, where u is measured", "Quota del baricentro, dove si misura u");
        ledger.add(Quantity::new("z_G", "z_G", Unit::METRES, z, words));
        let words = say!("Its distance from the toe", "Distanza del baricentro dal polo");
        ledger.add(Quantity::new("x_G", "x_G", Unit::METRES, arm(of.parameters, sign), words));
        let terms = self.terms(of);
        let (x, w) = (arm(of.parameters, sign), 1e-3 * body.weight);
        // no sum is −0
        let sum = |number: &dyn Fn(&Term) -> f64| terms.iter().map(number).sum::<f64>() + 0.0;
        let put = |first: Option<[f64; 2]>, number: &dyn Fn(&Term) -> [f64; 2]| {
            products(first.into_iter().chain(terms.iter().map(number)))
        };
        let mut add = |key, [bare, loaded]: [&str; 2], value: f64, put: String, words| {
            let is_bare = !put.contains(" + ") && !put.contains(" − ");
            let quantity =
                Quantity::new(key, if is_bare { bare } else { loaded }, moments, 1e3 * value, words);
            ledger.add(if is_bare && bare == "M_H" {
                quantity.with_numbers("")
            } else {
                quantity.with_numbers(put)
            });
        };
        let words = say!("Stabilizing moment of the weights", "Momento stabilizzante dei pesi");
        let value = w * x + sum(&|term| term.force * term.arm);
        let text = put(Some([w, x]), &|term| [term.force, term.arm]);
        add("M_W", ["M_W = W x_G", "M_W = W x_G + Σ P d"], value, text, words);
        let words = say! {
            "Moment of the thrusts, positive where they overturn",
            "Momento delle spinte, positivo se ribaltante"
        };
        let value = sum(&|term| term.thrust * term.height);
        let text = put(None, &|term| [term.thrust, term.height]);
        let name = if text.is_empty() { "M_H" } else { "M_H = Σ H z" };
        add("M_H", [name, "M_H = Σ H z"], value, text, words);
        let words =
            say!("Moment of the inertial forces for α = 1", "Momento delle forze d'inerzia per α = 1");
        let value = w * z + sum(&|term| term.moving * term.height);
        let text = put(Some([w, z]), &|term| [term.moving, term.height]);
        add("M_E", ["M_E = W z_G", "M_E = W z_G + Σ (P + Q) z"], value, text, words);
        let words = say! {
            "What the weights lose of their moment per unit of rotation",
            "Riduzione del momento dei pesi per unità di rotazione"
        };
        let value = w * z + sum(&|term| term.force * term.height);
        let text = put(Some([w, z]), &|term| [term.force, term.height]);
        add("K_theta", ["K_θ = W z_G", "K_θ = W z_G + Σ P z"], value, text, words);
        let words = say!("Inertial force for α = 1, at z_G", "Forza d'inerzia per α = 1, a z_G");
        ledger.add(Quantity::new("", "F_E = M_E/z_G", Unit::KILONEWTONS, self.pushed_weight, words));
        self.add_acting_force(of, "(M_W − M_H)/z_G", ledger);
    }

    /// Adds the work of weights, thrusts and inertial forces of a strip, per unit of u.
    fn add_strip(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (body, unit, terms) = (self.body(), Unit::KILONEWTONS, strip::terms(self.body(), of));
        let twice = |sum: String| if sum.is_empty() { sum } else { format!("2 ({sum})") };
        let words = say!("Height of the hinge", "Quota della cerniera");
        ledger.add(Quantity::new("", "h_1", Unit::METRES, body.hinge_height, words));
        let words = say! {
            "Work of the inertial forces for α = 1, twice, per unit of u; `φ`: displacements",
            "Doppio del lavoro delle forze d'inerzia per α = 1, per unità di u; `φ`: spostamenti"
        };
        let work = Quantity::new("", "F_E = 2 Σ (P + Q) φ", unit, self.pushed_weight, words);
        ledger.add(work.with_numbers(twice(products(terms.iter().map(|own| [own.moving, own.phi])))));
        let words = say! {
            "Work of weights and thrusts, twice, per unit of u: force at u = 0; `ρ`: rises",
            "Doppio del lavoro di pesi e spinte, per unità di u: forza a u = 0; `ρ`: innalzamenti"
        };
        let force = Quantity::new("", "F_act = 2 (Σ P ρ − Σ H φ)", unit, self.acting_force, words);
        let weights = terms.iter().map(|own| [own.force, own.rho]);
        let sum = products(weights.chain(terms.iter().map(|own| [-own.thrust, own.phi])));
        let is_edge = gives(self.acting_force, body.strength.of(of.side.sign()));
        ledger.add(force.with_numbers(if is_edge { twice(sum) } else { String::new() }));
        if terms.is_empty() {
            return;
        }
        let (h1, moments) = (body.hinge_height, Unit::KILONEWTON_METRES);
        let levers = terms.iter().map(|own| [own.force, if own.is_lower { own.height } else { h1 }]);
        let upper = terms.iter().filter(|own| !own.is_lower).map(|own| [own.force, own.height - h1]);
        let value = |pairs: &mut dyn Iterator<Item = [f64; 2]>| 1e3 * pairs.map(|[a, b]| a * b).sum::<f64>();
        let words = say! {
            "What the weights lose of the moment of the lower body per unit of its rotation",
            "Riduzione del momento del corpo inferiore per unità della sua rotazione"
        };
        let lower = Quantity::new("", "K_1 = Σ P min(z; h_1)", moments, value(&mut levers.clone()), words);
        ledger.add(lower.with_numbers(products(levers)));
        let words = say!("The same of the upper body", "Lo stesso del corpo superiore");
        let of_upper = Quantity::new("", "K_2 = Σ P (z − h_1)", moments, value(&mut upper.clone()), words);
        ledger.add(of_upper.with_numbers(products(upper)));
    }

    /// Adds the force at u = 0 of one body: that of the edges, and that of hinges that are set back.
    fn add_acting_force(&self, of: OfSide<'_>, edges: &str, ledger: &mut Ledger) {
        let (body, unit) = (self.body(), Unit::KILONEWTONS);
        let strength = body.strength.of(of.side.sign());
        let words = say! {
            "Force at u = 0 of the line that falls to its zero", "Forza a u = 0 della retta decrescente"
        };
        if gives(self.acting_force, strength) {
            let force = Quantity::new("", format!("F_act = F0 = {edges}"), unit, self.acting_force, words);
            ledger.add(force);
            return;
        }
        let told =
            say!("Force at u = 0 with the hinges at the edges", "Forza a u = 0 con le cerniere agli spigoli");
        ledger.add(Quantity::new("", format!("F0 = {edges}"), unit, strength, told));
        let is_set_back = of.statement.masonry.is_some();
        let formula = if is_set_back { "F_act = F0 − N_b t_b {10⁻³}/z_G" } else { "F_act" };
        ledger.add(Quantity::new("", formula, unit, self.acting_force, words));
    }

    /// The loads of one body on a side, with the overburden.
    fn terms(&self, of: OfSide<'_>) -> Vec<Term> {
        let (body, sign) = (self.body(), of.side.sign());
        let own = level::on_side(of.parameters, sign);
        let [outer, inner] = toes(&own);
        let gravity = body.weight / body.mass;
        let term = |load: &Load| Term {
            force: 1e-3 * load.force,
            arm: if sign > 0.0 { load.inside - outer } else { inner - load.inside },
            height: load.height,
            moving: 1e-3 * gravity * load.moving(gravity),
            thrust: 1e-3 * sign * load.thrust,
        };
        let mut terms: Vec<_> = level::loads(&own).iter().map(term).collect();
        if terms.is_empty() && own.mechanism == Mechanism::RigidBody {
            let Parameters { load_force, load_height: height, load_arm: inside, thrust, .. } = own;
            let load = Load { thrust, ..Load::resting(load_force, height, inside) };
            terms.push(Term { moving: 1e-3 * gravity * own.load_mass, ..term(&load) });
        }
        if body.overburden > 0.0 {
            let force = 1e-3 * body.overburden;
            let of_others: f64 =
                terms.iter().map(|term| term.force * term.arm - term.thrust * term.height).sum();
            let own_moment = 1e-3 * body.weight * arm(&own, sign);
            let all = 1e-3 * body.strength.of(sign) * body.centroid_height;
            let arm = (all - own_moment - of_others) / force;
            let moving = force * of.statement.table.overburden_mass.unwrap_or(0.0);
            terms.push(Term { force, arm, height: body.height, moving, thrust: 0.0 });
        }
        terms
    }

    /// The weights that are pushed, added up.
    fn put_weights(&self, of: OfSide<'_>) -> String {
        if self.body().is_strip() {
            return String::new();
        }
        let terms = self.terms(of);
        let moving = terms.iter().map(|term| term.moving).filter(|weight| *weight != 0.0);
        let all: Vec<_> = [1e-3 * self.body().weight].into_iter().chain(moving).map(shown).collect();
        all.join(" + ")
    }

    /// Makes what formulas of set-backs take known.
    pub(super) fn know_contact(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        if let (false, Ok(contact)) = (self.is_plain(), Contact::new(of.parameters, 0.0)) {
            let [whole, above] = standing(self.body(), of.parameters).map(|force| 1e-3 * force);
            ledger.know(&[("N_b", whole), ("N_m", above), ("l", contact.width), ("b", contact.thickness)]);
        }
    }
}

/// Places of the outer and the inner toe \[m\].
fn toes(parameters: &Parameters) -> [f64; 2] {
    let Parameters { thickness, arm, arm_inner, mechanism, .. } = *parameters;
    match &parameters.profile {
        Some(profile) => profile.toes(),
        None if mechanism == Mechanism::RigidBody => {
            [0.0, arm + if arm_inner == COMPUTED { arm } else { arm_inner }]
        }
        None => [0.0, thickness],
    }
}

/// Distance of the centroid of the masonry from the toe of a side \[m\].
fn arm(parameters: &Parameters, sign: f64) -> f64 {
    let [outer, inner] = toes(parameters);
    let x = match &parameters.profile {
        Some(profile) => profile.centroid([0.0, profile.height()]).x,
        None if parameters.mechanism == Mechanism::RigidBody => parameters.arm,
        None => 0.5 * (outer + inner),
    };
    if sign > 0.0 { x - outer } else { inner - x }
}

/// e* of resultants with their δ, [C8.7.1.5]; empty of none.
fn e_star(resultants: &[[f64; 2]]) -> String {
    let all = resultants.iter().filter(|[weight, _]| *weight != 0.0);
    let squares: Vec<_> =
        all.map(|[weight, delta]| format!("{} · {}²", shown(*weight), shown(*delta))).collect();
    if squares.is_empty() {
        return String::new();
    }
    let (sum, weight) = (products(resultants.iter().copied()), resultants.iter().map(|own| own[0]).sum());
    format!("({sum})²/[{} ({})]", shown(weight), squares.join(" + "))
}

/// Products of two numbers, added up; those with a 0 are left out.
fn products(pairs: impl Iterator<Item = [f64; 2]>) -> String {
    let mut text = String::new();
    for [a, b] in pairs.filter(|[a, b]| *a != 0.0 && *b != 0.0) {
        let is_negative = a * b < 0.0;
        text += match (text.is_empty(), is_negative) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text.extend([shown(a.abs()), " · ".to_owned(), shown(b.abs())]);
    }
    text
}
