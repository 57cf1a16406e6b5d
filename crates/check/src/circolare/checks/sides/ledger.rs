//! The ledger of a side.

use std::f64::consts::TAU;

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Body, Tie};
use serde_json::{Value, json};

use super::{LeastAlpha0, SideVerdict};
use crate::circolare::checks::LARGEST_LOSS;
use crate::circolare::checks::ledger::OfCheck;
use crate::circolare::checks::ties::{TieNumbers, TieVerdict};
use crate::circolare::curve::TieBreak;
use crate::circolare::curve::ledger::{Names, OfSide};
use crate::circolare::statement::table::STRESS_BLOCK;
use crate::ntc::demand::Demands;
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::names::{Deciding, LimitState};
use crate::words::{Written, say, shown};

impl SideVerdict {
    /// The numbers of the side, in the order of a terminal and a report.
    pub(in crate::circolare) fn ledger(&self, of: OfSide<'_>, demands: &Demands) -> Ledger {
        let mut ledger = of.ledger(&self.curve);
        self.least_alpha0.iter().for_each(|found| found.add_to(&mut ledger));
        self.add_set_back(of, &mut ledger);
        self.curve.add_to(of, &mut ledger);
        self.add_activation(&mut ledger);
        if self.ties.is_empty() {
            self.tie.iter().for_each(|tie| tie.add_to(self, of, &mut ledger));
        } else {
            self.ties.iter().for_each(|tie| tie.add_to(self, &mut ledger));
            ledger.begin("", "");
            ledger.fact("ties", json!(self.ties.iter().map(TieVerdict::json).collect::<Vec<_>>()));
        }
        let is_tied = self.activation.force > 0.0;
        for (given, demand) in of.statement.demanded(demands) {
            let at = |own| OfCheck { side: of, curve: &self.curve, own, given, demand, is_tied };
            let activated = match given.state {
                LimitState::Sld => self.checks.sld.map(|found| (Deciding::Sld, found)),
                LimitState::Slv => self.checks.slv_q.map(|found| (Deciding::SlvWithQ, found)),
                LimitState::Slc => None,
            };
            if let Some((check, found)) = activated {
                found.add_to(check, at(&self.curve), &mut ledger);
            }
            if let Some(found) = self.displacement(given.state) {
                found.add_to(at(self.at(found.hinge)), &mut ledger);
            }
        }
        if let Some(untied) = self.untied {
            ledger.begin("untied", "untied");
            for (state, zeta) in [(LimitState::Slv, untied.slv), (LimitState::Slc, untied.slc)] {
                let words = say!("Without the tie, {state}", "In assenza di catena, {state}", state);
                ledger.add(Quantity::new(state.key(), "ζ_E", Unit::NONE, zeta, words));
            }
        }
        ledger.begin("", "");
        if !self.sensitivity.is_empty() {
            ledger.fact("sensitivity", json!(self.sensitivity));
        }
        ledger
    }

    /// Adds the depths of stress blocks and what they take of the thickness.
    fn add_set_back(&self, of: OfSide<'_>, ledger: &mut Ledger) {
        let (given, set_back, mm) = (&of.statement.table, self.curve.set_back, Unit::MILLIMETRES);
        let is_set_back = of.statement.masonry.is_some();
        ledger.begin("", "set-back");
        if let (Some(strength), Some(bears)) = (given.masonry_strength, of.statement.masonry) {
            let (gamma, block) =
                (given.masonry_gamma.unwrap_or(1.0), given.stress_block.unwrap_or(STRESS_BLOCK));
            ledger.know(&[("f_m", 1e-6 * strength), ("γ", gamma), ("κ", block)]);
            let (words, equation) = if given.masonry_over_fc.unwrap_or(true) {
                let words = say! {
                    "Design strength of the masonry, with FC", "Resistenza di progetto della muratura, con FC"
                };
                (words, "f_d = f_m/(γ FC)")
            } else {
                let words = say! {
                    "Design strength of the masonry, without FC",
                    "Resistenza di progetto della muratura, senza FC"
                };
                (words, "f_d = f_m/γ")
            };
            let design = Quantity::new("", equation, Unit::MEGAPASCALS, bears / block, words);
            ledger.add(design.at("C8.7.1.2.1 d)"));
        }
        ledger.begin("set_back", "set-back");
        let is_strip = of.parameters.mechanism == Mechanism::VerticalSpanning;
        // kN over MPa and m are mm
        let mut add = |key, equation: &str, depth: f64, words| {
            if is_set_back && (is_strip || key == "base") {
                ledger.add(Quantity::new(key, equation, mm, depth, words).at("NTC 7.8.2.2.3"));
            } else {
                ledger.fact(key, depth);
            }
        };
        let words = say!("Set-back of the hinge at the base", "Arretramento della cerniera alla base");
        let is_plain = self.curve.is_plain();
        let of_base = if is_plain { "t_b = (W + O)/(2 κ f_d l)" } else { "t_b = N_b/(2 κ f_d l)" };
        add("base", of_base, set_back.base, words);
        let words = say!("Set-back of the intermediate hinge", "Arretramento della cerniera intermedia");
        let of_middle = if is_plain { "t_m = (W_2 + O)/(2 κ f_d l)" } else { "t_m" };
        add("middle", of_middle, set_back.middle, words);
        let words = say!("Set-back of the hinge at the top", "Arretramento della cerniera in sommità");
        add("top", if is_plain { "t_t = O/(2 κ f_d l)" } else { "t_t" }, set_back.top, words);
        if is_set_back {
            ledger.begin("", "set-back");
            let share = set_back.base.max(set_back.middle) / of.parameters.thickness;
            let words = say!("Largest set-back over the thickness", "Arretramento massimo su spessore");
            ledger.add(Quantity::new("", "t/b", Unit::NONE, share, words));
        }
    }

    /// Adds the wall at its activation; with the tie at its strength where that counts.
    fn add_activation(&self, ledger: &mut Ledger) {
        let (at, curve) = (self.activation, &self.curve);
        let slope: f64 = curve.ties().map(Tie::slope).sum();
        let stiffness = curve.of_force(slope) / curve.d_per_u;
        let Names { pushed, lever, slope: of_stiffness, .. } = curve.names();
        let sum = if curve.has_several_ties() { "Σ " } else { "" };
        let pulls = curve.ties().map(|tie| tie.pull * tie.strength.unwrap_or(0.0));
        ledger.know(&[(&format!("Σ ({lever}) N_y"), 1e-3 * pulls.sum::<f64>())]);
        let tied = &*format!("{sum}{of_stiffness} K g/({pushed} e* d/u)");
        ledger.begin("activation", "tie");
        if !curve.has_several_ties() {
            curve.tie().iter().for_each(|tie| add_lever(curve.body(), tie, ledger));
        }
        let words = say! {
            "Multiplier of activation with the tie at its strength, without FC",
            "Moltiplicatore di attivazione con la catena alla resistenza, senza FC"
        };
        let equation = format!("α0 = [F_act + {sum}({lever}) N_y]/{pushed}");
        let multiplier = Quantity::new("alpha0", equation, Unit::NONE, at.alpha0, words).at("[C8.7.1.1]");
        let words = say! {
            "Acceleration of activation with the tie at its strength, without FC",
            "Accelerazione di attivazione con la catena alla resistenza, senza FC"
        };
        let equation = format!("a = {} + {sum}({lever}) N_y g/[{pushed} e*]", curve.own_symbol());
        let acceleration = Quantity::new("a", equation, Unit::ACCELERATION, at.acceleration, words);
        let words = if curve.has_several_ties() {
            say!("Forces of the ties at the activation", "Somma dei tiri delle catene all'attivazione")
        } else {
            say!("Force of the tie at the activation", "Tiro della catena all'attivazione")
        };
        let force = Quantity::new("tie_force", "N", Unit::KILONEWTONS, at.force, words).unlisted();
        if at.force == 0.0 {
            for (key, value) in
                [("alpha0", at.alpha0), ("a", at.acceleration), ("T0", at.t0), ("tie_force", 0.0)]
            {
                ledger.fact(key, value);
            }
            return;
        }
        ledger.add(multiplier);
        ledger.add(acceleration);
        ledger.know(&[("4π²/T0²", (TAU / curve.t0).powi(2)), (tied, stiffness)]);
        let words = say!("Period of wall and tie", "Periodo di parete e catena");
        let period =
            Quantity::new("T0", format!("T_0t = 2π/√[4π²/T0² + {tied}]"), Unit::SECONDS, at.t0, words);
        let period = period.at("[C8.7.1.6]");
        ledger.add(if curve.t0 > 0.0 { period } else { period.with_numbers("").unlisted() });
        ledger.add(force);
    }
}

impl LeastAlpha0 {
    /// Adds what the rules on the hinge give; a table of a report has them.
    fn add_to(&self, ledger: &mut Ledger) {
        ledger.begin("least_alpha0", "hinges");
        let words = say!("Least multiplier, without FC", "Moltiplicatore minimo, senza FC");
        ledger.add(Quantity::new("alpha0", "α_0,min", Unit::NONE, self.alpha0, words).at("C8.7.1.2.1.1"));
        for (key, value, words) in [
            ("hinge_ratio", Some(self.hinge), say!("Its hinge", "La sua cerniera")),
            ("zeta_E", self.zeta, say!("ζ_E with that hinge", "ζ_E con quella cerniera")),
            (
                "worst_hinge_ratio",
                self.worst_hinge,
                say!("Least favourable hinge", "Cerniera più sfavorevole"),
            ),
            ("worst_zeta_E", self.worst, say!("ζ_E with that hinge", "ζ_E con quella cerniera")),
        ] {
            ledger.add(Quantity::new(key, "", Unit::NONE, value, words).unlisted());
        }
    }
}

impl TieNumbers {
    /// Adds where the tie pulls, yields and breaks, and what its rupture takes.
    fn add_to(&self, side: &SideVerdict, of: OfSide<'_>, ledger: &mut Ledger) {
        let mm = Unit::MILLIMETRES;
        let Names { per_elongation, .. } = side.curve.names();
        ledger.begin("tie", "tie");
        let words = say!("The tie begins to pull at", "La catena inizia a tirare a");
        let engaged =
            Quantity::new("u_engaged", format!("u_g = g_0 {per_elongation}"), mm, self.engaged, words);
        ledger.add(if self.engaged > 0.0 { engaged } else { engaged.unlisted() });
        let words = say!("The tie reaches its strength at", "La catena raggiunge la resistenza a");
        let equation = format!("u_y = (N_y/K {{10³}} + g_0) {per_elongation}");
        ledger.add(Quantity::new("u_yield", equation, mm, self.yields, words));
        let words = say!("The tie breaks at", "La catena si rompe a");
        let equation = format!("u_r = (N_y/K {{10³}} + g_0 + e_p) {per_elongation}");
        ledger.add(Quantity::new("u_break", equation, mm, self.breaks, words));
        let strength = side.curve.tie().and_then(|tie| tie.strength);
        let of_anchor = strength.zip(side.curve.anchors).map(|(force, anchors)| force / anchors);
        for (name, value, words) in [
            ("strength", strength, say!("Strength of the tie", "Resistenza della catena")),
            ("one anchor", of_anchor, say!("Strength of one anchor", "Resistenza di un ancoraggio")),
        ] {
            let force = Quantity::new("", "", Unit::KILONEWTONS, value, words);
            ledger.add(force.unlisted().on_terminal(name));
        }
        match side.curve.tie_break() {
            Some(broken) => add_rupture(side, of, &broken, ledger),
            None => ledger.fact("loss", json!(self.loss)),
        }
    }
}

impl TieVerdict {
    /// Adds where one of several ties pulls, yields and breaks.
    fn add_to(&self, side: &SideVerdict, ledger: &mut Ledger) {
        let (mm, numbers) = (Unit::MILLIMETRES, self.numbers);
        let Names { per_elongation, .. } = side.curve.names();
        let [number, height] = [(self.place + 1).to_string(), shown(self.height)].map(Written);
        ledger.know(&[
            ("K", 1e-3 * self.tie.stiffness),
            ("N_y", 1e-3 * self.tie.strength.unwrap_or(f64::NAN)),
            ("g_0", 1e3 * self.tie.slack),
            ("e_p", 1e3 * self.tie.ultimate.unwrap_or(f64::NAN)),
            ("y", self.height),
        ]);
        ledger.begin("", "tie");
        let strength = self.tie.strength;
        let words = say! {
            "Tie {number} at {height} m: strength", "Catena {number} a {height} m: resistenza", number, height
        };
        ledger.add(Quantity::new("", "N_y", Unit::KILONEWTONS, strength, words));
        add_lever(side.curve.body(), &self.tie, ledger);
        let words = say!("Tie {number} begins to pull at", "La catena {number} inizia a tirare a", number);
        let engaged = Quantity::new("", format!("u_g = g_0 {per_elongation}"), mm, numbers.engaged, words);
        ledger.add(if numbers.engaged > 0.0 { engaged } else { engaged.unlisted() });
        let words = say!(
            "Tie {number} reaches its strength at",
            "La catena {number} raggiunge la resistenza a",
            number
        );
        let equation = format!("u_y = (N_y/K {{10³}} + g_0) {per_elongation}");
        ledger.add(Quantity::new("", equation, mm, numbers.yields, words));
        let words = say!("Tie {number} breaks at", "La catena {number} si rompe a", number);
        let equation = format!("u_r = (N_y/K {{10³}} + g_0 + e_p) {per_elongation}");
        ledger.add(Quantity::new("", equation, mm, numbers.breaks, words));
        let words = say! {
            "What the curve, with FC, loses there with the ties that hold, over its largest a",
            "Riduzione della capacità alla sua rottura, con le catene che restano, rapportata ad a_max"
        };
        let loss = Quantity::new("", "Δa/a_max", Unit::NONE, numbers.loss, words).at("C8.7.1.2.1.6");
        ledger.add(loss.with_numbers(""));
    }

    /// Its numbers by their names, in SI units.
    fn json(&self) -> Value {
        let [sld, slv_q] = self.required;
        let mut json = json!({
            "tie": self.place,
            "height": self.height,
            "u_engaged": self.numbers.engaged,
            "u_yield": self.numbers.yields,
            "u_break": self.numbers.breaks,
            "loss": self.numbers.loss,
            "force_at_activation": self.at_activation,
            "SLD": { "tie_required": sld },
            "SLV_q": { "tie_required": slv_q },
        });
        for (state, at) in &self.limits {
            json[state.key()] = json!({
                "tie_force": at.force,
                "tie_state": at.state,
                "tie_force_at_demand": at.force_at_demand,
                "tie_state_at_demand": at.state_at_demand,
            });
        }
        json
    }
}

/// Adds φ(y) of a tie of a strip, by which it is stretched and pulls.
fn add_lever(body: &Body, tie: &Tie, ledger: &mut Ledger) {
    if body.is_strip() {
        let equation = if tie.height <= body.hinge_height { "φ_y = y/h_1" } else { "φ_y = (h − y)/h_2" };
        let words = say!("Displacement of the tie over u", "Spostamento della catena su u");
        ledger.add(Quantity::new("", equation, Unit::NONE, tie.lever, words));
    }
}

/// Adds what the curve loses where the tie breaks.
fn add_rupture(side: &SideVerdict, of: OfSide<'_>, broken: &TieBreak, ledger: &mut Ledger) {
    let TieBreak { before, after, largest, loss, .. } = *broken;
    let sign = if after < 0.0 { "+" } else { "−" };
    let put = format!("({} {sign} {})/{}", shown(before), shown(after.abs()), shown(largest));
    let put = put.replace('-', "−");
    let words = say! {
        "What the curve, with FC, loses there for good, over its largest a",
        "Riduzione della capacità alla rottura della catena, rapportata ad a_max"
    };
    ledger
        .add(Quantity::new("loss", "Δa/a_max", Unit::NONE, loss, words).at("C8.7.1.2.1.6").with_numbers(put));
    let share = Written(format!("{:.2}", of.statement.rules(LimitState::Slv).fraction));
    let early = side.checks.slv.is_some_and(|check| check.limited_by_tie);
    let decides = if early {
        say! {
            "more than {limit}, before {share} d_0: d_SLV is there",
            "oltre {limit}, prima di {share} d_0: d_SLV è in quel punto", limit = LARGEST_LOSS, share
        }
    } else {
        say!("d_SLV stays at {share} d_0", "d_SLV resta a {share} d_0", share)
    };
    ledger.say(say!("Consequence", "Conseguenza"), decides.as_markup());
}
