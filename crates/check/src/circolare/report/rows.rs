//! The outcome as the verdict that every code has: rows, notes and the numbers of its sides.

use std::collections::BTreeSet;

use rocking_wall::wall::{Parameters, TiePart, Wall};
use serde_json::{Value, json};

use crate::circolare::checks::DisplacementCheck;
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::curve::ledger::OfSide;
use crate::circolare::outcome::{Checked, Outcome};
use crate::circolare::runs::DynamicState;
use crate::circolare::runs::dynamic::DynamicCheck;
use crate::circolare::statement::table::{Hinge, Method, UseClass};
use crate::code::verdict::{Details, Ends, Raise, Row, Section, Verdict};
use crate::error::CheckError;
use crate::sections::origin::{Figure, Origin};
use crate::words::entry::Entry;
use crate::words::ledger::Ledger;
use crate::words::names::{Deciding, LimitState, Side, Sides};
use crate::words::{
    Language, Sentence, Written, apart, at_most, fixed, joined, passed, say, side as told_side,
};

/// The least `ζ_E` of a retrofit (adeguamento), NTC 8.4.3 c) and e) \[-\].
const LEAST_OF_RETROFITS: f64 = 0.80;

impl<'a> Checked<'a> {
    /// The verdict.
    pub(crate) fn verdict(self, code: Entry) -> Verdict<'a> {
        let governs = self.outcome.governs;
        Verdict {
            code,
            passed: self.outcome.passed,
            governs: governs.limit_state.name(),
            side: self.which(governs.side),
            zeta: governs.zeta,
            target: self.statement.target,
            raise: self.raise(),
            rows: self.rows(),
            notes: self.notes(),
            warnings: self.outcome.warnings.clone(),
            details: Box::new(self),
        }
    }

    fn rows(&self) -> Vec<Row> {
        let mut rows = Vec::new();
        let method = self.statement.table.method;
        let target = self.statement.target;
        let class_iv = self.statement.table.use_class == Some(UseClass::IV);
        let site = |state| self.statement.state(state).map_or(f64::NAN, |given| given.ag);
        for (side, verdict) in self.sides() {
            let side = self.which(side);
            let activations = [
                (Deciding::Sld, verdict.checks.sld, class_iv, "C8.7.1.2.1.5"),
                (Deciding::SlvWithQ, verdict.checks.slv_q, method == Method::Linear, "C8.7.1.2.1.7"),
            ];
            for (check, found, decides, clause) in activations {
                let Some(found) = found else { continue };
                let ends = Ends::Accelerations([found.capacity, found.demand]);
                rows.push(Row {
                    passed: found.ratio >= target,
                    decides,
                    ground: Some([found.ag, site(check.state())]),
                    clause,
                    ..Row::new(check.name(), say!("{check}", "{check}", check), side, found.ratio, ends)
                });
            }
            rows.extend(verdict.by_displacement().map(|(state, found)| Row {
                passed: found.zeta >= target,
                ratio: found.ratio,
                decides: method == Method::Nonlinear,
                ground: Some([found.ag, site(state)]),
                displacement: Some(found.d / verdict.curve.d_per_u),
                clause: "C8.7.1.2.1.8",
                remark: remark(state, &found),
                ..Row::new(
                    state.key(),
                    Sentence::same(state.key()),
                    side,
                    found.zeta,
                    Ends::Displacements([found.d, found.demand]),
                )
            }));
        }
        for (state, found) in self.outcome.dynamic.iter().flat_map(DynamicCheck::states) {
            let judged = found.judged;
            let check = if state == LimitState::Slc { "SLC under records" } else { "SLV under records" };
            let title = say!("{state} under records", "{state} con accelerogrammi", state);
            let ends = Ends::Displacements([judged.ratio * judged.d, judged.d]);
            rows.push(Row {
                passed: judged.passed,
                decides: method == Method::Dynamic,
                ground: Some([found.zeta * site(state), site(state)]),
                clause: "C8.7.1.2.1.9",
                ..Row::new(check, title, self.which(judged.side), found.zeta, ends)
            });
        }
        rows
    }

    /// What the raise by SLD replaces: the least ratio by displacement by which a wall that passes would
    /// fail; of a wall that fails, that of the check that governs.
    fn raise(&self) -> Option<Raise> {
        let Outcome { governs, passed, sides, .. } = &self.outcome;
        if self.statement.table.method != Method::Nonlinear {
            return None;
        }
        let mut raised = Vec::new();
        for (side, verdict) in sides.iter() {
            for (state, check) in verdict.by_displacement() {
                let is_told = *passed || (side, state) == (governs.side, governs.limit_state.state());
                if is_told && check.raised && check.ratio < self.statement.target {
                    raised.push((check.ratio, state));
                }
            }
        }
        // the code has the raise for SLV only
        let has_slc = raised.iter().any(|(_, state)| *state == LimitState::Slc);
        let by = if has_slc {
            say! {
                "SLD, for SLC by analogy with C8.7.1.2.1.8", "SLD, allo SLC per analogia con C8.7.1.2.1.8"
            }
        } else {
            Sentence::same("SLD")
        };
        let (ratio, state) = raised.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        Some(Raise { check: state.key(), ratio, by })
    }

    fn notes(&self) -> Vec<Sentence> {
        let governs = self.outcome.governs;
        let site = self.statement.state(governs.limit_state.state()).map_or(f64::NAN, |given| given.ag);
        let [bears, site] = [governs.zeta * site, site].map(|ag| at_most(ag, 3));
        let (deciding, factor) = (self.statement.deciding_checks(), self.statement.confidence_factor);
        let mut notes = vec![
            say! {
                "It holds up to a_g = {bears} g; the site has {site} g.",
                "La parete sopporta a_g = {bears} g; a_g del sito: {site} g.", bears, site
            },
            say! {
                "zeta_E is the a_g that just brings the wall to a limit state, over that of the site (NTC \
                 8.3); a check passes for zeta_E ≥ {against}",
                "ζ_E è l'a_g che porta la parete allo stato limite, divisa per quella del sito (NTC 8.3). \
                 L'esito è riferito a ζ_E ≥ {against}", against = self.against()
            },
            say! {
                "Circolare 7/2019, C8.7.1.2.1; FC = {factor}; one resultant per body (C8.7.1.1), e* = 1.",
                "Circolare 7/2019, C8.7.1.2.1; FC = {factor}; una risultante per ogni corpo (C8.7.1.1), e* = \
                 1.", factor
            },
            say! {
                "{deciding}; the other checks are for information.",
                "{deciding}; le altre verifiche sono a titolo informativo.", deciding
            },
        ];
        notes.extend(self.statement.site_notes.iter().cloned());
        for (side, verdict) in self.sides() {
            let name = told_side(self.which(side));
            let own = self.of_side(verdict);
            notes.extend(own.into_iter().map(|note| say!("{name}: {note}", "{name}: {note}", name, note)));
        }
        for (given, demand) in self.statement.demanded(&self.demands) {
            let Some(floor) = demand.floor() else { continue };
            if floor.peak_acceleration() > floor.printed_peak() {
                let [ground, printed] = apart([floor.peak_acceleration(), floor.printed_peak()], 4);
                notes.push(say! {
                    "{state}: a_g S = {ground} m/s² of the ground governs at the height, above a_Z = \
                     {printed} m/s² [C7.2.8].",
                    "{state}: in quota è determinante a_g S = {ground} m/s² del terreno, superiore ad a_Z = \
                     {printed} m/s² [C7.2.8].", state = given.state, ground, printed
                });
            }
        }
        notes.extend(self.parameters.weaker_part().map(|part| match part {
            TiePart::Anchor => {
                say!("The tie: the anchor gives way first.", "La catena: cede prima l'ancoraggio.")
            }
            TiePart::Bar => say!("The tie: the bar gives way first.", "La catena: cede prima la barra."),
        }));
        for (state, found) in self.outcome.dynamic.iter().flat_map(DynamicCheck::states) {
            notes.extend(of_runs(state, found));
        }
        notes
    }

    /// The target, and which intervention it is of, NTC 8.4.
    fn against(&self) -> Sentence {
        let target = self.statement.target;
        let written = fixed(target, 2);
        if target == 1.0 {
            say! {
                "1. NTC 8.4.2 has what an improvement needs.",
                "1; per gli interventi di miglioramento si veda NTC 8.4.2."
            }
        } else if target < LEAST_OF_RETROFITS {
            say! {
                "{written}, the target of an improvement (NTC 8.4.2).",
                "{written}: intervento di miglioramento (NTC 8.4.2).", written
            }
        } else {
            say! {
                "{written}, the target of an improvement (NTC 8.4.2) or of a retrofit (NTC 8.4.3).",
                "{written}: intervento di miglioramento (NTC 8.4.2) o di adeguamento (NTC 8.4.3).", written
            }
        }
    }

    /// What is to be said of a side: its hinge, its tie, what raises it, and what a₁ or E changes.
    fn of_side(&self, side: &SideVerdict) -> Vec<Sentence> {
        let mut notes = Vec::new();
        let three = |zeta: Option<f64>| zeta.map_or(Written("–".to_owned()), |zeta| fixed(zeta, 3));
        if let (Some(rule), Some(found)) = (self.rule, side.least_alpha0) {
            let rule = match rule {
                Hinge::LeastAlpha0 => {
                    say!("hinge of the least multiplier", "cerniera del moltiplicatore minimo")
                }
                Hinge::Worst => say!("least favourable hinge", "cerniera più sfavorevole"),
                Hinge::Given => say!("hinge as given", "cerniera come fornita"),
            };
            let worst = found.worst_hinge.map(|x| {
                say! {
                    "; least favourable is {x} h: zeta_E = {zeta}",
                    "; la più sfavorevole è a {x} h: ζ_E = {zeta}", x = fixed(x, 4), zeta = three(found.worst)
                }
            });
            notes.push(say! {
                "{rule}; the least alpha0, {alpha0}, is at {hinge} h: zeta_E = {zeta}{worst}.",
                "{rule}; il minimo α0, {alpha0}, è a {hinge} h: ζ_E = {zeta}{worst}.",
                rule, alpha0 = at_most(found.alpha0, 4), hinge = fixed(found.hinge, 4),
                zeta = three(found.zeta), worst = worst.unwrap_or_default()
            });
        }
        for (state, check) in side.by_displacement() {
            if check.limited_by_tie {
                notes.push(say!("the tie breaks at d_{state}.", "la catena si rompe a d_{state}.", state));
            }
            notes.extend(check.tie.map(|tie| {
                say! {
                    "the tie has {force} kN at d_{state} ({own}), {later} kN at the demand ({then}).",
                    "la catena ha {force} kN a d_{state} ({own}), {later} kN alla domanda ({then}).",
                    force = at_most(1e-3 * tie.force, 4), state, own = tie.state.words(),
                    later = at_most(1e-3 * tie.force_at_demand, 4), then = tie.state_at_demand.words()
                }
            }));
        }
        if let Some(untied) = side.untied {
            let states = [(LimitState::Slv, untied.slv), (LimitState::Slc, untied.slc)].into_iter();
            let states: Vec<_> = states
                .filter_map(|(state, zeta)| {
                    Some(say!("{state} {zeta}", "{state} {zeta}", state, zeta = fixed(zeta?, 3)))
                })
                .collect();
            if !states.is_empty() {
                let states = joined(&states, ", ");
                notes.push(say!("untied, {states}.", "in assenza di catena, {states}.", states));
            }
        }
        notes.extend(side.sensitivity.iter().map(|varied| {
            let impossible = || say!("no check is possible", "nessuna verifica possibile");
            let result = varied.passed.map_or_else(impossible, passed);
            say! {
                "sensitivity: with {assigned} zeta_E = {zeta}, {result}.",
                "analisi di sensibilità: con {assigned} ζ_E = {zeta}, {result}.",
                assigned = varied.assigned(), zeta = three(varied.zeta), result
            }
        }));
        notes
    }
}

/// What the raise by SLD makes of a check by displacement; empty without it.
fn remark(state: LimitState, check: &DisplacementCheck) -> Sentence {
    if !check.raised {
        return Sentence::default();
    }
    let exceeded = if check.ratio < 1.0 {
        say! {
            "; demand exceeds capacity; the a_g of activation replaces it (C8.7.1.2.1.8)",
            "; la domanda supera la capacità; vale l'a_g di attivazione (C8.7.1.2.1.8)"
        }
    } else {
        Sentence::default()
    };
    let [ratio, zeta, ag] = [check.ratio, check.zeta, check.ag].map(|value| fixed(value, 3));
    say! {
        "{state} {ratio}, raised to {zeta} by SLD (a_g {ag} g){exceeded}",
        "{state} {ratio}, portato a {zeta} dallo SLD (a_g {ag} g){exceeded}", state, ratio, zeta, ag, exceeded
    }
}

/// The dynamic check of a limit state, and its runs.
fn of_runs(state: LimitState, check: &DynamicState) -> Vec<Sentence> {
    let records: BTreeSet<_> = check.runs.iter().map(|run| &run.record).collect();
    let judged = check.judged;
    let mut notes = vec![say! {
        "{state} under {records} records in {runs} runs: {result}; d = {d} mm, threshold over it {ratio}, \
         zeta_E = {zeta}; {beyond} runs beyond d_0, {reached} at the strength of the tie",
        "{state} con {records} accelerogrammi in {runs} analisi: {result}; d = {d} mm, soglia su d {ratio}, \
         ζ_E = {zeta}; {beyond} analisi oltre d_0, {reached} alla resistenza della catena",
        state, records = records.len(), runs = check.runs.len(), result = passed(judged.passed),
        d = at_most(1e3 * judged.d, 4), ratio = fixed(judged.ratio, 3), zeta = fixed(check.zeta, 3),
        beyond = judged.beyond_d0, reached = judged.at_strength
    }];
    notes.extend(check.compatibility.as_ref().map(|found| {
        let which = if found.compatible {
            say!("compatible", "compatibile")
        } else {
            say!("not compatible", "non compatibile")
        };
        say! {
            "{state}: the mean spectrum of the records is {least} (T = {from} s) to {largest} (T = {to} s) \
             of that of the ground: {which} (NTC 3.2.3.6)",
            "{state}: lo spettro medio degli accelerogrammi va da {least} (T = {from} s) a {largest} (T = \
             {to} s) di quello del suolo: {which} (NTC 3.2.3.6)",
            state, least = fixed(found.least, 3), from = fixed(found.least_at, 3),
            largest = fixed(found.largest, 3), to = fixed(found.largest_at, 3), which
        }
    }));
    // lines of single runs are indented: a report has a table of its own
    notes.extend(check.runs.iter().map(|run| {
        let [positive, negative] = [run.d[0], -run.d[1]].map(|d| at_most(1e3 * d, 4));
        let beyond = if run.beyond_d0 { say!("  beyond d_0", "  oltre d_0") } else { Sentence::default() };
        let reached = if run.at_strength {
            say!("  tie at its strength", "  catena alla resistenza")
        } else {
            Sentence::default()
        };
        say! {
            "  {record} x {factor} d = {positive} / {negative} mm{beyond}{reached}",
            "  {record} x {factor} d = {positive} / {negative} mm{beyond}{reached}",
            record = format!("{:<30}", run.record),
            factor = Written(format!("{:<8.4}", run.sign * run.factor)), positive, negative, beyond, reached
        }
    }));
    notes
}

impl Details for Checked<'_> {
    fn wall(&self) -> &Wall {
        &self.wall
    }

    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn json(&self, _: &Verdict<'_>) -> Value {
        let mut json = json!(self.outcome);
        for (side, verdict) in self.outcome.sides.iter() {
            json["sides"][side.key()] = self.ledger(side, verdict).json().into();
        }
        json
    }

    fn ledgers(&self) -> Vec<(Sides, Ledger)> {
        self.sides().map(|(side, verdict)| (self.which(side), self.ledger(side, verdict))).collect()
    }

    fn figure(&self, language: Language) -> Result<Figure, CheckError> {
        let governs = self.outcome.governs.side;
        let shown = self.sides().find(|(side, _)| *side == governs).or(self.sides().next());
        let Some((side, verdict)) = shown else { return Err(CheckError::wall("the wall has no side")) };
        super::capacity::figure(self, self.which(side), verdict, language)
    }

    fn overview(&self, language: Language) -> Vec<(String, String)> {
        super::overview::of(self, language)
    }

    fn site(&self, language: Language) -> Result<Vec<Section>, CheckError> {
        super::site::section(self, language)
    }

    fn symbols(&self, language: Language) -> String {
        super::symbols::list(language)
    }

    fn readings(&self) -> Vec<Sentence> {
        super::readings::of(self)
    }

    fn sections(&self, origin: &Origin<'_>) -> Result<Vec<Section>, CheckError> {
        super::sections(self, origin)
    }
}

impl Checked<'_> {
    /// The wall on a side.
    pub(super) fn of(&self, side: Side) -> OfSide<'_> {
        OfSide { statement: self.statement, parameters: &self.parameters, side }
    }

    /// The numbers of a side.
    pub(crate) fn ledger(&self, side: Side, verdict: &SideVerdict) -> Ledger {
        verdict.ledger(self.of(side), &self.demands)
    }
}
