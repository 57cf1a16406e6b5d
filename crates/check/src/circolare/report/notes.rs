//! What is to be said of the rows of a verdict, in sentences.

use std::collections::BTreeSet;

use rocking_wall::wall::TiePart;

use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::outcome::Checked;
use crate::circolare::runs::DynamicState;
use crate::circolare::runs::dynamic::DynamicCheck;
use crate::circolare::statement::table::Hinge;
use crate::words::names::LimitState;
use crate::words::{Sentence, Written, apart, at_most, fixed, joined, passed, say};

/// The least `ζ_E` of a retrofit (adeguamento), NTC 8.4.3 c) and e) \[-\].
const LEAST_OF_RETROFITS: f64 = 0.80;

impl Checked<'_> {
    /// All notes, those of sides and runs last.
    pub(super) fn notes(&self) -> Vec<Sentence> {
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
                "Circolare 7/2019, C8.7.1.2.1; FC = {factor}; {resultants}",
                "Circolare 7/2019, C8.7.1.2.1; FC = {factor}; {resultants}",
                factor, resultants = self.resultants()
            },
            say! {
                "{deciding}; the other checks are for information.",
                "{deciding}; le altre verifiche sono a titolo informativo.", deciding
            },
        ];
        notes.extend(self.statement.site_notes.iter().cloned());
        for note in self.levels().into_iter().flat_map(Self::notes_of_level) {
            // a note that several levels have is told once
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        notes
    }

    /// What is to be said of a body and its demands.
    fn notes_of_level(&self) -> Vec<Sentence> {
        let mut notes = Vec::new();
        for (side, verdict) in self.sides() {
            let name = self.told(side);
            let own = self.of_side(verdict);
            notes.extend(own.into_iter().map(|note| say!("{name}: {note}", "{name}: {note}", name, note)));
        }
        for (given, demand) in self.statement.demanded(&self.demands) {
            let Some(floor) = demand.floor() else { continue };
            if floor.peak_acceleration() > floor.printed_peak() {
                let [ground, printed] = apart([floor.peak_acceleration(), floor.printed_peak()], 4);
                notes.push(self.of_level(say! {
                    "{state}: a_g S = {ground} m/s² of the ground governs at the height, above a_Z = \
                     {printed} m/s² [C7.2.8].",
                    "{state}: in quota è determinante a_g S = {ground} m/s² del suolo, superiore ad a_Z = \
                     {printed} m/s² [C7.2.8].", state = given.state, ground, printed
                }));
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
        for tie in &side.ties {
            let height = at_most(self.above_base(tie.height), 4);
            let name = say!("the tie at {height} m", "la catena a {height} m", height);
            notes.extend(tie.limits.iter().map(|(state, at)| {
                let [force, later] = [at.force, at.force_at_demand].map(|force| at_most(1e-3 * force, 4));
                say! {
                    "{name} has {force} kN at d_{state} ({own}), {later} kN at the demand ({then}).",
                    "{name} ha {force} kN a d_{state} ({own}), {later} kN alla domanda ({then}).",
                    name, force, state, own = at.state.words(), later, then = at.state_at_demand.words()
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
