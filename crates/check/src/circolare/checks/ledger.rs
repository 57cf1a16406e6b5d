//! What is said of the static checks: each with its clause, its equations and the numbers put in.

use serde_json::json;

use super::spectrum::{self, At};
use super::{ActivationCheck, DisplacementCheck};
use crate::circolare::curve::Curve;
use crate::circolare::curve::ledger::{Names, OfSide, gives};
use crate::circolare::curve::tie;
use crate::circolare::statement::states::StateStatement;
use crate::ntc::demand::{Demand, LONGEST_PERIOD};
use crate::words::ledger::{Ledger, Quantity, Unit};
use crate::words::names::{Deciding, LimitState};
use crate::words::{Sentence, Written, passed, say, shown};

/// A check whose numbers are shown.
#[derive(Clone, Copy)]
pub(in crate::circolare) struct OfCheck<'a> {
    pub(in crate::circolare) side: OfSide<'a>,
    /// The curve of the side, with the hinge that governs.
    pub(in crate::circolare) curve: &'a Curve,
    /// The curve with the hinge of this check.
    pub(in crate::circolare) own: &'a Curve,
    pub(in crate::circolare) given: &'a StateStatement,
    pub(in crate::circolare) demand: &'a Demand,
    /// Whether the tie counts at the activation.
    pub(in crate::circolare) is_tied: bool,
}

/// The result of a check as markup.
fn result(is_passed: bool) -> Sentence {
    let said = passed(is_passed);
    if is_passed {
        said
    } else {
        say!("<span class=\"fails\">{said}</span>", "<span class=\"fails\">{said}</span>", said)
    }
}

/// Adds where the hinge of a check is; in the report only where it is not that of its side.
fn add_hinge(own: Option<f64>, side: Option<f64>, ledger: &mut Ledger) {
    let Some(at) = own else { return };
    let words =
        say!("Hinge of this check, with its own curve", "Cerniera di questa verifica, con la sua curva");
    let hinge = Quantity::new("hinge_ratio", "h_1/h", Unit::NONE, at, words).with_numbers("");
    ledger.add(if own == side { hinge.unlisted() } else { hinge });
}

/// Adds the last lines of a check: `a_g` and the result.
fn add_end(of: OfCheck<'_>, zeta: f64, ag: f64, ledger: &mut Ledger) {
    let OfCheck { given, side, .. } = of;
    ledger.know(&[("ζ_E", zeta), ("a_g", given.ag)]);
    let words = say!("Acceleration that it bears", "Accelerazione sopportata");
    ledger.add(Quantity::new("ag", "a_g,cap = ζ_E a_g", Unit::GRAVITY, ag, words));
    ledger.say(say!("Result", "Esito"), result(zeta >= side.statement.target));
}

impl ActivationCheck {
    /// Adds the check.
    pub(in crate::circolare) fn add_to(&self, check: Deciding, of: OfCheck<'_>, ledger: &mut Ledger) {
        let OfCheck { curve, given, demand, is_tied, .. } = of;
        let (key, q) = match check {
            Deciding::SlvWithQ => ("SLV_q", of.side.statement.behaviour_factor),
            _ => (check.name(), 1.0),
        };
        ledger.begin(key, check.name());
        add_hinge(self.hinge, curve.hinge, ledger);
        let held = self.t0 == 0.0;
        let symbol = match (is_tied, held) {
            (true, _) => "a",
            (false, true) => "a_0",
            (false, false) => "a_y",
        };
        let words = if is_tied {
            say! {
                "Capacity with the tie at its strength, with FC",
                "Capacità con la catena alla resistenza, con FC"
            }
        } else {
            say!("Capacity, with FC", "Capacità, con FC")
        };
        ledger.know(&[(symbol, self.acceleration)]);
        let formula = if q == 1.0 { format!("{symbol}/FC") } else { format!("q {symbol}/FC") };
        let clause = if held { "[C8.7.1.8]" } else { "[C8.7.1.9]" };
        ledger.add(Quantity::new("capacity", formula, Unit::ACCELERATION, self.capacity, words).at(clause));
        self.add_demand(given.activation_damping, demand, ledger);
        let words = say!("Safety index", "Indice di sicurezza");
        let put = format!("{}/{}", shown(self.capacity), shown(self.demand));
        ledger.add(
            Quantity::new("ratio", "ζ_E", Unit::NONE, self.ratio, words).at("NTC 8.3").with_numbers(put),
        );
        add_end(of, self.ratio, self.ag, ledger);
        ledger.begin(key, "required");
        self.add_required(check, of, q, ledger);
    }

    fn add_demand(&self, xi: f64, demand: &Demand, ledger: &mut Ledger) {
        let held = self.t0 == 0.0;
        let [t0, percent] = [self.t0, 100.0 * xi].map(|value| Written(shown(value)));
        let at_t0 = say! {
            "Demand at `T0` = {t0} s, `ξ` = {percent} %",
            "Domanda a `T0` = {t0} s, `ξ` = {percent} %", t0, percent
        };
        let of_t0 = spectrum::equation(ledger, demand, At { symbol: "T0", period: self.t0 }, xi);
        let bare = say!("Demand", "Domanda");
        let (words, clause, equation) = match demand {
            Demand::Ground(_) if held => (bare, "[3.2.2], T = 0", "a_g S"),
            Demand::Ground(_) => (at_t0, "[3.2.2]", &*of_t0),
            Demand::Floor(floor) if floor.ground_governs(self.t0, xi) => {
                let height = if held { "a_Z" } else { "S_eZ" };
                let words = say! {
                    "Demand: the ground governs, above the {height} of the height",
                    "Domanda: determinante il suolo, superiore alla {height} in quota", height
                };
                (words, "[3.2.2]", "a_g S")
            }
            Demand::Floor(_) if held => (bare, "[C7.2.8]", "a_Z"),
            Demand::Floor(_) => (at_t0, "[C7.2.6]", &*of_t0),
            Demand::Points(..) | Demand::Records(_) => (at_t0, "", "S_e(T0, ξ)"),
        };
        let clause = if clause.is_empty() { spectrum::source(demand) } else { Sentence::same(clause) };
        ledger.add(Quantity::new("demand", equation, Unit::ACCELERATION, self.demand, words).at(clause));
    }

    /// Adds the strength that brings `ζ_E` to the target.
    fn add_required(&self, check: Deciding, of: OfCheck<'_>, q: f64, ledger: &mut Ledger) {
        let OfCheck { curve, is_tied, .. } = of;
        let demand = if q == 1.0 { "S_a" } else { "S_a/q" };
        let (own, target) = (curve.own_symbol(), of.side.statement.target);
        let factor = if target == 1.0 { "" } else { "ζ_t " };
        let Names { pushed, lever, .. } = curve.names();
        let equation = format!("N = max[0; ({factor}FC {demand} − {own}) {pushed} e*/(g {lever})]");
        let words = say! {
            "Required force for ζ_E = {target}, {check}",
            "Tiro richiesto per ζ_E = {target}, {check}", target, check
        };
        ledger.know(&[("S_a", self.demand), ("ζ_t", target)]);
        let force = Quantity::new("tie_required", equation, Unit::KILONEWTONS, self.required, words);
        // a tie that does not count here changes the period, and with it the demand
        ledger.add(if is_tied || curve.t0 == 0.0 { force } else { force.with_numbers("") });
        let of_anchor = self.required.zip(curve.anchors).map(|(force, anchors)| force / anchors);
        let words = say!("Required of one anchor", "Tiro richiesto a un ancoraggio");
        let force = Quantity::new("", "", Unit::KILONEWTONS, of_anchor, words);
        ledger.add(force.unlisted().on_terminal("one anchor needs"));
    }
}

impl DisplacementCheck {
    /// Adds the check.
    pub(in crate::circolare) fn add_to(&self, of: OfCheck<'_>, ledger: &mut Ledger) {
        let OfCheck { curve, given, demand, .. } = of;
        let state = given.state;
        ledger.begin(state.key(), state.key());
        add_hinge(self.hinge, curve.hinge, ledger);
        self.add_capacity(of, ledger);
        let clause = if state == LimitState::Slc { "[C8.7.1.11]" } else { "[C8.7.1.10]" };
        let factor = of.side.statement.rules(state).period_factor;
        let equation = format!("T_{state} = {factor} π √(d_{state} {{10⁻³}}/a)");
        ledger.know(&[("a", self.a)]);
        let words = say!("Period", "Periodo");
        ledger.add(Quantity::new("T", equation, Unit::SECONDS, self.period, words).at(clause));
        if self.period > LONGEST_PERIOD && demand.ground().is_some() {
            ledger.say(
                say!("Range of the spectra, NTC 3.2.3.2", "Campo di validità degli spettri, NTC 3.2.3.2"),
                say! {
                    "T &gt; 4 s: beyond the spectra of accelerations; that of displacements, [3.2.10] to \
                     [3.2.12], is printed for all periods",
                    "T &gt; 4 s: oltre gli spettri in accelerazione; quello in spostamento, da [3.2.10] a \
                     [3.2.12], è scritto per ogni periodo"
                },
            );
        }
        self.add_demand(of, ledger);
        ledger.know(&[("S_d", 1e3 * self.demand)]);
        let words = say!("Capacity over demand", "Rapporto capacità/domanda");
        ledger.add(Quantity::new("ratio", format!("d_{state}/S_d"), Unit::NONE, self.ratio, words));
        let of_site = format!("a_g,{state}");
        ledger.know(&[("a_g,SLD", self.ag), (&of_site, given.ag)]);
        if self.raised {
            let words = say! {
                "Acceleration by displacement, which the larger one of activation at SLD replaces",
                "Accelerazione in spostamento, sostituita da quella maggiore di attivazione allo SLD"
            };
            let equation = format!("(d_{state}/S_d) {of_site}");
            ledger.add(Quantity::new("", equation, Unit::GRAVITY, self.ratio * given.ag, words));
        }
        ledger.add(if self.raised {
            let words = say!("Safety index, raised by SLD", "Indice di sicurezza, innalzato dallo SLD");
            let equation = format!("ζ_E = a_g,SLD/{of_site}");
            Quantity::new("zeta_E", equation, Unit::NONE, self.zeta, words).at("C8.7.1.2.1.8")
        } else {
            let words = say!("Safety index", "Indice di sicurezza");
            let equation = format!("ζ_E = d_{state}/S_d");
            Quantity::new("zeta_E", equation, Unit::NONE, self.zeta, words).at("NTC 8.3").with_numbers("")
        });
        add_end(of, self.zeta, self.ag, ledger);
        ledger.fact("limited_by_tie", self.limited_by_tie);
        ledger.fact("raised_to_SLD", self.raised);
        self.tie.iter().for_each(|tie| tie.add_to(curve.anchors, ledger));
    }

    fn add_capacity(&self, of: OfCheck<'_>, ledger: &mut Ledger) {
        let OfCheck { curve, own, given, .. } = of;
        let state = given.state;
        let fraction = of.side.statement.rules(state).fraction;
        let of_curve = fraction * own.d0;
        let u = 1e3 * self.d / curve.d_per_u;
        ledger.know(&[("d", 1e3 * self.d), ("u_r", u), ("u", u), ("d_0", 1e3 * own.d0)]);
        let (words, capacity) = if self.limited_by_tie {
            (
                say!("Capacity, where the tie breaks", "Capacità, alla rottura della catena"),
                "(d/u) u_r".to_owned(),
            )
        } else if (self.d - of_curve).abs() > 1e-9 * of_curve {
            let words = say! {
                "Capacity, at the local instability stated", "Capacità, all'instabilità locale dichiarata"
            };
            (words, "(d/u) u".to_owned())
        } else {
            (say!("Capacity", "Capacità"), format!("{fraction:.2} d_0"))
        };
        let equation = format!("d_{state} = {capacity}");
        ledger.add(Quantity::new("d", equation, Unit::MILLIMETRES, self.d, words).at("C8.7.1.2.1.6"));
        let equation = format!("a(d_{state}){}", self.on_curve(of.side, own, ledger));
        let words = say!("The curve there, with FC", "La curva in quel punto, con FC");
        ledger.add(Quantity::new("a", equation, Unit::ACCELERATION, self.a, words).at("[C8.7.1.3]"));
    }

    /// The formula behind `a(d)` of the line of the wall with the force of its tie; empty where a law of
    /// another form has the curve.
    fn on_curve(&self, of: OfSide<'_>, curve: &Curve, ledger: &mut Ledger) -> String {
        let factor = of.statement.confidence_factor;
        let own = curve.a0 * (1.0 - self.d / curve.d0);
        ledger.know(&[("a_0", curve.a0), ("d_0", 1e3 * curve.d0)]);
        if gives(own / factor, self.a) {
            return " = a_0 (1 − d/d_0)/FC".to_owned();
        }
        let force = self.tie.map_or(0.0, |tie| tie.force);
        let Names { pushed, lever, .. } = curve.names();
        ledger.know(&[("N", 1e-3 * force)]);
        // just before d: a tie that breaks there still holds
        let u = self.d / curve.d_per_u * (1.0 - 1e-12);
        let pulls = curve.ties().map(|tie| tie.pull * tie::force(tie, u));
        let pull: f64 = pulls.sum();
        let several = curve.has_several_ties();
        let pulled = if several { format!("Σ ({lever}) N") } else { format!("({lever}) N") };
        if several {
            ledger.know(&[(&pulled, 1e-3 * pull)]);
        }
        let is_tied = gives((own + curve.of_force(pull)) / factor, self.a);
        let formula = || format!(" = [a_0 (1 − d/d_0) + {pulled} g/({pushed} e*)]/FC");
        is_tied.then(formula).unwrap_or_default()
    }

    /// Adds the demand of displacement: both terms where there are two.
    fn add_demand(&self, of: OfCheck<'_>, ledger: &mut Ledger) {
        let OfCheck { given, demand, .. } = of;
        let (t, xi, mm) = (format!("T_{}", given.state), given.damping, Unit::MILLIMETRES);
        let percent = Written(shown(100.0 * xi));
        let words = say! {
            "Spectrum at `{t}` and `ξ` = {percent} %", "Spettro a `{t}` e `ξ` = {percent} %", t, percent
        };
        let equation = spectrum::equation(ledger, demand, At { symbol: &t, period: self.period }, xi);
        let of_spectrum = Quantity::new("S_e", equation, Unit::ACCELERATION, self.acceleration, words);
        ledger.add(of_spectrum.at(spectrum::source(demand)));
        let symbol = if demand.floor().is_some() { "S_eZ" } else { "S_e" };
        let at_period = format!("{symbol}({t})");
        let first_term = format!("{at_period} {t}²/(4π²) {{10³}}");
        ledger.know(&[(&at_period, self.acceleration)]);
        let bare = say!("Demand", "Domanda");
        let (words, clause, equation) = match (demand, self.demand_terms) {
            (Demand::Points(..) | Demand::Records(_), _) => {
                let words =
                    say!("Demand: the largest from `T0` to `{t}`", "Domanda: il massimo da `T0` a `{t}`", t);
                (words, "C8.7.1.2.1.8", "S_d = max S_e T²/(4π²)".to_owned())
            }
            (Demand::Floor(floor), [Some(first), Some(second)]) => {
                let words = say!("Demand, first term", "Domanda, primo termine");
                ledger.add(
                    Quantity::new("", format!("S_d,1 = {first_term}"), mm, first, words).at("[C8.7.1.12]"),
                );
                let at_first = floor.acceleration(floor.first_period(), xi);
                let equation = spectrum::equation(
                    ledger,
                    demand,
                    At { symbol: "T_1", period: floor.first_period() },
                    xi,
                );
                let words = say!("Spectrum at T_1", "Spettro a T_1");
                ledger.add(Quantity::new("", equation, Unit::ACCELERATION, at_first, words).at("[C7.2.6]"));
                ledger.know(&[("S_eZ(T_1)", at_first)]);
                let words = say!("Demand, second term", "Domanda, secondo termine");
                let equation = "S_d,2 = S_eZ(T_1) (1.1 T_1)²/(4π²) {10³}";
                ledger.add(Quantity::new("", equation, mm, second, words).at("[C8.7.1.12]"));
                let words = say!("Demand, the larger of both terms", "Domanda, il maggiore dei due termini");
                (words, "[C8.7.1.12]", "S_d = max(S_d,1; S_d,2)".to_owned())
            }
            (Demand::Floor(_), _) => (bare, "[C8.7.1.12]", format!("S_d = {first_term}")),
            (Demand::Ground(ground), _) if self.period > ground.t_e => {
                let words = say!("Demand, beyond T_E", "Domanda, oltre T_E");
                (words, "[3.2.11], [3.2.12]", format!("S_d = S_De({t}, ξ)"))
            }
            (Demand::Ground(_), _) => (bare, "[3.2.10]", format!("S_d = {first_term}")),
        };
        ledger.add(Quantity::new("demand", equation, mm, self.demand, words).at(clause));
        ledger.fact("demand_terms", json!(self.demand_terms));
    }
}
