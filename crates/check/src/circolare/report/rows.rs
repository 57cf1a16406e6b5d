//! The outcome as the verdict that every code has: rows, notes and the numbers of its sides.

use rocking_wall::wall::{Parameters, Wall};
use serde_json::Value;

use crate::circolare::checks::DisplacementCheck;
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::curve::ledger::OfSide;
use crate::circolare::outcome::{Checked, Outcome};
use crate::circolare::runs::dynamic::DynamicCheck;
use crate::circolare::statement::table::{Method, UseClass};
use crate::code::row::{Ends, Row};
use crate::code::verdict::{Details, Raise, Section, Verdict};
use crate::error::CheckError;
use crate::ntc::demand::{Demand, LONGEST_PERIOD};
use crate::sections::origin::{Figure, Origin};
use crate::words::entry::Entry;
use crate::words::ledger::Ledger;
use crate::words::names::{Deciding, LimitState, Side, Sides};
use crate::words::{Language, Sentence, fixed, joined, say};

/// A raise by a smaller share of a ratio is a rounding \[-\].
const ROUNDING: f64 = 1e-9;

impl<'a> Checked<'a> {
    /// The verdict.
    pub(crate) fn verdict(self, code: Entry) -> Verdict<'a> {
        let governs = self.outcome.governs;
        Verdict {
            code,
            passed: self.outcome.passed,
            governs: governs.limit_state.name(),
            side: self.which(governs.side),
            level: governs.level,
            zeta: governs.zeta,
            target: self.statement.target,
            raise: self.raise(),
            rows: self.levels().into_iter().flat_map(Self::rows).collect(),
            notes: self.notes(),
            warnings: self.warnings(),
            before: None,
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
                remark: remark(state, verdict, &found, self.demands[state as usize].as_ref()),
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
        let level = self.stated_level();
        rows.into_iter().map(|row| Row { level, ..row }).collect()
    }

    /// What the raise by SLD replaces: the least ratio by displacement by which a wall that passes would
    /// fail; of a wall that fails, that of the check that governs.
    fn raise(&self) -> Option<Raise> {
        let Outcome { governs, passed, .. } = &self.outcome;
        if self.statement.table.method != Method::Nonlinear {
            return None;
        }
        let mut raised = Vec::new();
        for (level, side, verdict) in self.levels().into_iter().flat_map(Self::sides_at) {
            for (state, check) in verdict.by_displacement() {
                let governing = (governs.level, governs.side, governs.limit_state.state());
                let is_told = *passed || (level, side, state) == governing;
                let is_raised = check.zeta > (1.0 + ROUNDING) * check.ratio;
                if is_told && is_raised && check.ratio < self.statement.target {
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
}

/// What is to be said beside a check by displacement: what the raise by SLD makes of it, and a period beyond
/// the spectra of accelerations.
fn remark(
    state: LimitState,
    side: &SideVerdict,
    check: &DisplacementCheck,
    demand: Option<&Demand>,
) -> Sentence {
    let mut parts = Vec::new();
    if check.raised {
        let [ratio, zeta, ag] = [check.ratio, check.zeta, check.ag].map(|value| fixed(value, 3));
        parts.push(say! {
            "{state} {ratio}, raised to {zeta} by SLD (a_g {ag} g)",
            "{state} {ratio}, portato a {zeta} dallo SLD (a_g {ag} g)", state, ratio, zeta, ag
        });
        if check.ratio < 1.0 {
            parts.push(say! {
                "demand exceeds capacity; the a_g of activation replaces it (C8.7.1.2.1.8)",
                "la domanda supera la capacità; vale l'a_g di attivazione (C8.7.1.2.1.8)"
            });
        }
        let is_broken = check.has_broken_tie;
        if side.activation.force > 0.0 && is_broken {
            parts.push(say! {
                "the tie, which SLD counts, is broken at d_{state}",
                "la catena, considerata dallo SLD, è rotta a d_{state}", state
            });
        }
    }
    if check.period > LONGEST_PERIOD && demand.is_some_and(|demand| demand.ground().is_some()) {
        parts.push(say! {
            "T_{state} = {period} s, above 4 s (NTC 3.2.3.2)",
            "T_{state} = {period} s, oltre 4 s (NTC 3.2.3.2)", state, period = fixed(check.period, 2)
        });
    }
    joined(&parts, "; ")
}

impl Details for Checked<'_> {
    fn wall(&self) -> &Wall {
        &self.wall
    }

    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn json(&self, _: &Verdict<'_>) -> Value {
        self.all_numbers()
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
