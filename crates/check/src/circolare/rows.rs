//! The verdict on a wall as every code has it: rows, numbers and notes.

use ::report::number;
use ::report::table::{Cell, Table, significant};
use rocking_wall::wall::{Parameters, Wall};
use serde_json::Value;

use super::statement::Statement;
use super::table::{Method, UseClass};
use super::verdict::{Checked, Deciding, DisplacementCheck, DynamicCheck, DynamicState, SideVerdict};
use super::{ENTRY, LimitState};
use crate::code::{Details, Ends, Row, Verdict, numbers};
use crate::error::CheckError;
use crate::report::{Figure, Origin};

impl<'a> Checked<'a> {
    /// The verdict.
    pub(super) fn verdict(self) -> Verdict<'a> {
        let governs = self.outcome.governs;
        Verdict {
            code: ENTRY,
            passed: self.outcome.passed,
            governs: governs.limit_state.name(),
            side: (!self.outcome.alike).then(|| governs.side.name()),
            zeta: governs.zeta,
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
                (Deciding::Sld, verdict.sld, LimitState::Sld, class_iv, "C8.7.1.2.1.5"),
                (
                    Deciding::SlvWithQ,
                    verdict.slv_q,
                    LimitState::Slv,
                    method == Method::Linear,
                    "C8.7.1.2.1.7",
                ),
            ];
            for (check, found, state, decides, clause) in activations {
                rows.extend(found.map(|found| Row {
                    check: check.name(),
                    side,
                    zeta: found.ratio,
                    passed: found.ratio >= 1.0,
                    decides,
                    ground: Some([found.ag, site(state)]),
                    ends: Ends::Accelerations([found.capacity, found.demand]),
                    clause,
                }));
            }
            let displacements = [(LimitState::Slv, verdict.slv), (LimitState::Slc, verdict.slc)];
            rows.extend(displacements.into_iter().filter_map(|(state, found)| Some((state, found?))).map(
                |(state, found)| Row {
                    check: state.key(),
                    side,
                    zeta: found.zeta,
                    passed: found.zeta >= 1.0,
                    decides: method == Method::Nonlinear,
                    ground: Some([found.ag, site(state)]),
                    ends: Ends::Displacements([found.d, found.demand]),
                    clause: "C8.7.1.2.1.8",
                },
            ));
        }
        for (state, found) in self.dynamic() {
            let is_slc = state == LimitState::Slc;
            rows.push(Row {
                check: if is_slc { "SLC under records" } else { "SLV under records" },
                side: if self.outcome.alike { "both sides" } else { found.side.name() },
                zeta: found.zeta,
                passed: found.passed,
                decides: method == Method::Dynamic,
                ground: Some([found.zeta * site(state), site(state)]),
                ends: Ends::Displacements([found.ratio * found.d, found.d]),
                clause: "C8.7.1.2.1.9",
            });
        }
        rows
    }

    /// The limit states of the dynamic check.
    pub(super) fn dynamic(&self) -> impl Iterator<Item = (LimitState, &DynamicState)> {
        let states = self.outcome.dynamic.iter().flat_map(DynamicCheck::states);
        states.map(|(check, found)| (check.state(), found))
    }

    fn notes(&self) -> Vec<String> {
        let governs = self.outcome.governs;
        let site = self.statement.state(governs.limit_state.state()).map_or(f64::NAN, |given| given.ag);
        let [bears, at_site] = [governs.zeta * site, site].map(|ag| number(ag, 3));
        let mut notes = vec![
            format!("It holds up to a_g = {bears} g; the site has {at_site} g."),
            "zeta_E is the a_g that just brings the wall to a limit state, over that of the site (NTC 8.3); \
             a check passes from 1 on."
                .to_owned(),
            format!(
                "Circolare 7/2019, C8.7.1.2.1; FC = {}; one resultant per body (C8.7.1.1), e* = 1.",
                self.statement.confidence_factor
            ),
            format!("{} decide; the other checks are for information.", deciding(self.statement)),
        ];
        for (name, _, side) in self.sides() {
            for (state, check) in [("SLV", side.slv), ("SLC", side.slc)] {
                let Some(check) = check else { continue };
                if check.limited_by_tie {
                    notes.push(format!("{name}: the tie breaks at d_{state}."));
                }
                if check.raised {
                    notes.push(format!("{name}: a_g of SLD is larger than that of {state} and replaces it."));
                }
            }
        }
        for (state, found) in self.dynamic() {
            notes.extend(of_runs(state, found));
        }
        notes
    }
}

/// Names the checks that decide.
fn deciding(statement: &Statement) -> String {
    let method = match statement.table.method {
        Method::Nonlinear => "SLV and SLC by displacement",
        Method::Linear => "The checks of SLV with q",
        Method::Dynamic => "The runs under records",
    };
    let class_iv = statement.table.use_class == Some(UseClass::IV);
    format!("{method}{}", if class_iv { ", and SLD in use class IV," } else { "" })
}

/// The dynamic check of a limit state, and its runs.
fn of_runs(state: LimitState, check: &DynamicState) -> Vec<String> {
    let mut notes = vec![format!(
        "{state} under {} records: {}; d = {} m, threshold over it {:.3}, zeta_E = {:.3}",
        check.runs.len(),
        if check.passed { "passed" } else { "not passed" },
        significant(check.d, 6),
        check.ratio,
        check.zeta
    )];
    notes.extend(check.runs.iter().map(|run| {
        let [positive, negative] = [run.d[0], -run.d[1]].map(|d| significant(d, 6));
        let beyond = if run.beyond_d0 { "  beyond d0" } else { "" };
        format!("  {:<30} x {:<8.4} d = {positive} / {negative} m{beyond}", run.record, run.factor)
    }));
    notes
}

/// A name, its unit, and the number of a side, if it has one.
type Line = (&'static str, &'static str, fn(&SideVerdict) -> Option<f64>);

const SIDE: [Line; 15] = [
    ("alpha0", "-", |side| Some(side.alpha0)),
    ("e*", "-", |side| Some(side.e_star)),
    ("M*", "kg", |side| Some(side.mass)),
    ("a0", "m/s2", |side| Some(side.a0)),
    ("d0", "m", |side| Some(side.d0)),
    ("T0", "s", |side| Some(side.t0)),
    ("d_y", "m", |side| Some(side.dy)),
    ("a_y", "m/s2", |side| Some(side.ay)),
    ("SLD capacity", "m/s2", |side| side.sld.map(|check| check.capacity)),
    ("SLD demand", "m/s2", |side| side.sld.map(|check| check.demand)),
    ("SLD zeta_E", "-", |side| side.sld.map(|check| check.ratio)),
    ("SLD a_g", "g", |side| side.sld.map(|check| check.ag)),
    ("SLV with q, demand", "m/s2", |side| side.slv_q.map(|check| check.demand)),
    ("SLV with q, zeta_E", "-", |side| side.slv_q.map(|check| check.ratio)),
    ("SLV with q, a_g", "g", |side| side.slv_q.map(|check| check.ag)),
];

/// A name, its unit, and the number of a check by displacement.
type DisplacementLine = (&'static str, &'static str, fn(&DisplacementCheck) -> f64);

const DISPLACEMENT: [DisplacementLine; 6] = [
    ("d", "m", |check| check.d),
    ("a", "m/s2", |check| check.a),
    ("T", "s", |check| check.period),
    ("demand S_d", "m", |check| check.demand),
    ("zeta_E", "-", |check| check.zeta),
    ("a_g", "g", |check| check.ag),
];

impl Details for Checked<'_> {
    fn wall(&self) -> &Wall {
        &self.wall
    }

    fn parameters(&self) -> &Parameters {
        self.parameters
    }

    fn json(&self, _: &Verdict<'_>) -> Value {
        serde_json::to_value(&self.outcome).unwrap_or_default()
    }

    fn numbers(&self) -> Table {
        let shown: Vec<_> = self.sides().map(|(name, _, side)| (name, side)).collect();
        let mut table = numbers(shown.iter().map(|(name, _)| *name));
        let mut row = |name: String, unit: &'static str, values: Vec<Option<f64>>| {
            if values.iter().any(Option::is_some) {
                let values = values.into_iter().map(Cell::from);
                table.row([name.into(), unit.into()].into_iter().chain(values));
            }
        };
        for (name, unit, value) in SIDE {
            row(name.to_owned(), unit, shown.iter().map(|(_, side)| value(side)).collect());
        }
        let states: [(_, fn(&SideVerdict) -> _); 2] = [("SLV", |side| side.slv), ("SLC", |side| side.slc)];
        for (state, pick) in states {
            for (name, unit, value) in DISPLACEMENT {
                let values = shown.iter().map(|(_, side)| pick(side).as_ref().map(value)).collect();
                row(format!("{state} {name}"), unit, values);
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

    fn sections(&self, origin: &Origin<'_>) -> Result<Vec<(String, String)>, CheckError> {
        super::report::sections(self, origin)
    }
}
