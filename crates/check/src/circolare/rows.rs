//! The verdict on a wall as every code has it: rows, numbers and notes.

use std::fmt::Write;

use ::report::table::{Cell, Digits, Table};
use ::report::{apart, number};
use rocking_wall::wall::{Parameters, TiePart, Wall};
use serde_json::{Value, json};

use super::checks::DisplacementCheck;
use super::dynamic::DynamicCheck;
use super::lines::{DISPLACEMENT, SIDE};
use super::outcome::{Checked, Outcome};
use super::runs::DynamicState;
use super::sides::SideVerdict;
use super::table::{Method, UseClass};
use crate::entry::Entry;
use crate::error::CheckError;
use crate::names::{Deciding, LimitState};
use crate::report::markup::or_dash;
use crate::report::{Figure, Origin};
use crate::verdict::{Details, Ends, Raise, Row, Verdict, numbers};

impl<'a> Checked<'a> {
    /// The verdict.
    pub(super) fn verdict(self, code: Entry) -> Verdict<'a> {
        let governs = self.outcome.governs;
        Verdict {
            code,
            passed: self.outcome.passed,
            governs: governs.limit_state.name(),
            side: (!self.outcome.alike).then(|| governs.side.name()),
            zeta: governs.zeta,
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
        let class_iv = self.statement.table.use_class == Some(UseClass::IV);
        let site = |state| self.statement.state(state).map_or(f64::NAN, |given| given.ag);
        for (side, _, verdict) in self.sides() {
            let activations = [
                (Deciding::Sld, verdict.checks.sld, class_iv, "C8.7.1.2.1.5"),
                (Deciding::SlvWithQ, verdict.checks.slv_q, method == Method::Linear, "C8.7.1.2.1.7"),
            ];
            for (check, found, decides, clause) in activations {
                rows.extend(found.map(|found| Row {
                    decides,
                    ground: Some([found.ag, site(check.state())]),
                    clause,
                    ..Row::new(
                        check.name(),
                        side,
                        found.ratio,
                        Ends::Accelerations([found.capacity, found.demand]),
                    )
                }));
            }
            rows.extend(verdict.by_displacement().map(|(state, found)| Row {
                decides: method == Method::Nonlinear,
                ground: Some([found.ag, site(state)]),
                displacement: Some(found.d / verdict.curve.d_per_u),
                clause: "C8.7.1.2.1.8",
                remark: remark(state, &found),
                ..Row::new(state.key(), side, found.zeta, Ends::Displacements([found.d, found.demand]))
            }));
        }
        for (state, found) in self.outcome.dynamic.iter().flat_map(DynamicCheck::states) {
            let (judged, is_slc) = (found.judged, state == LimitState::Slc);
            let check = if is_slc { "SLC under records" } else { "SLV under records" };
            let side = if self.outcome.alike { "both sides" } else { judged.side.name() };
            let ends = Ends::Displacements([judged.ratio * judged.d, judged.d]);
            rows.push(Row {
                passed: judged.passed,
                decides: method == Method::Dynamic,
                ground: Some([found.zeta * site(state), site(state)]),
                clause: "C8.7.1.2.1.9",
                ..Row::new(check, side, found.zeta, ends)
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
                if is_told && check.raised && check.ratio < 1.0 {
                    raised.push((check.ratio, state));
                }
            }
        }
        // the code has the raise for SLV only
        let has_slc = raised.iter().any(|(_, state)| *state == LimitState::Slc);
        let by = if has_slc { "SLD, for SLC by analogy with C8.7.1.2.1.8" } else { "SLD" };
        let (ratio, state) = raised.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        Some(Raise { check: state.key(), ratio, by })
    }

    fn notes(&self) -> Vec<String> {
        let governs = self.outcome.governs;
        let site = self.statement.state(governs.limit_state.state()).map_or(f64::NAN, |given| given.ag);
        let [bears, at_site] = [governs.zeta * site, site].map(|ag| number(ag, 3));
        let mut notes = vec![
            format!("It holds up to a_g = {bears} g; the site has {at_site} g."),
            "zeta_E is the a_g that just brings the wall to a limit state, over that of the site (NTC 8.3); \
             a check passes for zeta_E ≥ 1. NTC 8.4.2 has what an improvement needs."
                .to_owned(),
            format!(
                "Circolare 7/2019, C8.7.1.2.1; FC = {}; one resultant per body (C8.7.1.1), e* = 1.",
                self.statement.confidence_factor
            ),
            format!("{}; the other checks are for information.", self.statement.deciding_checks()),
        ];
        notes.extend(self.statement.site_notes.iter().cloned());
        for (name, _, side) in self.sides() {
            notes.extend(self.of_side(side).into_iter().map(|note| format!("{name}: {note}")));
        }
        for (given, demand) in self.statement.demanded(&self.demands) {
            let Some(floor) = demand.floor() else { continue };
            if floor.peak_acceleration() > floor.printed_peak() {
                let [ground, printed] = apart([floor.peak_acceleration(), floor.printed_peak()], 4);
                notes.push(format!(
                    "{}: a_g S = {ground} m/s² of the ground governs at the height, above a_Z = {printed} \
                     m/s² [C7.2.8].",
                    given.state
                ));
            }
        }
        if let Some(part) = self.parameters.weaker_part() {
            let part = if part == TiePart::Anchor { "the anchor" } else { "the bar" };
            notes.push(format!("The tie: {part} gives way first."));
        }
        for (state, found) in self.outcome.dynamic.iter().flat_map(DynamicCheck::states) {
            notes.extend(of_runs(state, found));
        }
        notes
    }
}

impl Checked<'_> {
    /// What is to be said of a side: its hinge, its tie, what raises it, and what a₁ or E changes.
    fn of_side(&self, side: &SideVerdict) -> Vec<String> {
        let mut notes = Vec::new();
        let three = |zeta: Option<f64>| or_dash(zeta, |zeta| format!("{zeta:.3}"));
        if let (Some(rule), Some(found)) = (self.rule, side.least_alpha0) {
            let mut note = format!(
                "{}; the least alpha0, {}, is at {:.4} h: zeta_E = {}",
                ["hinge of the least multiplier", "least favourable hinge", "hinge as given"][rule as usize],
                number(found.alpha0, 4),
                found.hinge,
                three(found.zeta)
            );
            if let Some(x) = found.worst_hinge {
                let _ = write!(note, "; least favourable is {x:.4} h: zeta_E = {}", three(found.worst));
            }
            notes.push(note + ".");
        }
        for (state, check) in side.by_displacement() {
            if check.limited_by_tie {
                notes.push(format!("the tie breaks at d_{state}."));
            }
            if let Some(tie) = check.tie {
                notes.push(format!(
                    "the tie has {} kN at d_{state} ({}), {} kN at the demand ({}).",
                    number(1e-3 * tie.force, 4),
                    tie.state.name(),
                    number(1e-3 * tie.force_at_demand, 4),
                    tie.state_at_demand.name()
                ));
            }
        }
        if let Some(untied) = side.untied {
            let states = [("SLV", untied.slv), ("SLC", untied.slc)].into_iter();
            let states = states.filter_map(|(state, zeta)| Some(format!("{state} {:.3}", zeta?)));
            let states: Vec<_> = states.collect();
            if !states.is_empty() {
                notes.push(format!("untied, {}.", states.join(", ")));
            }
        }
        for varied in &side.sensitivity {
            let passed = match varied.passed {
                Some(true) => "passed",
                Some(false) => "not passed",
                None => "no check is possible",
            };
            notes.push(format!(
                "sensitivity: with {} zeta_E = {}, {passed}.",
                varied.assigned(),
                three(varied.zeta)
            ));
        }
        notes
    }
}

/// What the raise by SLD makes of a check by displacement; empty without it.
fn remark(state: LimitState, check: &DisplacementCheck) -> String {
    if !check.raised {
        return String::new();
    }
    let exceeded = if check.ratio < 1.0 {
        "; demand exceeds capacity; the a_g of activation replaces it (C8.7.1.2.1.8)"
    } else {
        ""
    };
    let DisplacementCheck { ratio, zeta, ag, .. } = *check;
    format!("{state} {ratio:.3}, raised to {zeta:.3} by SLD (a_g {ag:.3} g){exceeded}")
}

/// The dynamic check of a limit state, and its runs.
fn of_runs(state: LimitState, check: &DynamicState) -> Vec<String> {
    let records: std::collections::BTreeSet<_> = check.runs.iter().map(|run| &run.record).collect();
    let judged = check.judged;
    let mut notes = vec![format!(
        "{state} under {} records in {} runs: {}; d = {} mm, threshold over it {:.3}, zeta_E = {:.3}; {} \
         runs beyond d_0, {} at the strength of the tie",
        records.len(),
        check.runs.len(),
        if judged.passed { "passed" } else { "not passed" },
        number(1e3 * judged.d, 4),
        judged.ratio,
        check.zeta,
        judged.beyond_d0,
        judged.at_strength
    )];
    if let Some(found) = &check.compatibility {
        notes.push(format!(
            "{state}: the mean spectrum of the records is {:.3} (T = {:.3} s) to {:.3} (T = {:.3} s) of that \
             of the ground: {} (NTC 3.2.3.6)",
            found.least,
            found.least_at,
            found.largest,
            found.largest_at,
            if found.compatible { "compatible" } else { "not compatible" }
        ));
    }
    notes.extend(check.runs.iter().map(|run| {
        let [positive, negative] = [run.d[0], -run.d[1]].map(|d| number(1e3 * d, 4));
        let beyond = if run.beyond_d0 { "  beyond d_0" } else { "" };
        let beyond =
            if run.at_strength { beyond.to_owned() + "  tie at its strength" } else { beyond.into() };
        format!(
            "  {:<30} x {:<8.4} d = {positive} / {negative} mm{beyond}",
            run.record,
            run.sign * run.factor
        )
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
        json!(self.outcome)
    }

    fn numbers(&self) -> Table {
        let shown: Vec<_> = self.sides().map(|(name, _, side)| (name, side)).collect();
        let mut table = numbers(shown.iter().map(|(name, _)| *name), Digits::Significant(4));
        let mut row = |name: String, unit: &'static str, factor: f64, values: Vec<Option<f64>>| {
            if values.iter().any(Option::is_some) {
                let values = values.into_iter().map(|value| Cell::from(value.map(|value| factor * value)));
                table.row([name.into(), unit.into()].into_iter().chain(values));
            }
        };
        for (name, unit, factor, value) in SIDE {
            row(name.to_owned(), unit, factor, shown.iter().map(|(_, side)| value(side)).collect());
        }
        for state in [LimitState::Slv, LimitState::Slc] {
            for (name, unit, factor, value) in DISPLACEMENT {
                let of = |side: &SideVerdict| side.displacement(state).and_then(|check| value(side, &check));
                let values = shown.iter().map(|(_, side)| of(side)).collect();
                row(format!("{state} {name}"), unit, factor, values);
            }
        }
        table
    }

    fn figure(&self) -> Result<Figure, CheckError> {
        let governs = self.outcome.governs.side;
        let shown = self.sides().find(|(_, side, _)| *side == governs).or(self.sides().next());
        let Some((name, _, side)) = shown else { return Err(CheckError::wall("the wall has no side")) };
        super::report::capacity::figure(self, name, side)
    }

    fn overview(&self) -> Vec<(String, String)> {
        super::report::overview::of(self)
    }

    fn site(&self) -> Result<Vec<(String, String)>, CheckError> {
        super::report::site::section(self)
    }

    fn symbols(&self) -> String {
        super::report::symbols::list()
    }

    fn readings(&self) -> Vec<String> {
        super::report::readings::of(self)
    }

    fn sections(&self, origin: &Origin<'_>) -> Result<Vec<(String, String)>, CheckError> {
        super::report::sections(self, origin)
    }
}
