//! The static checks of a side, and what governs a wall.

use report::apart;
use rocking_wall::scene::Floors;
use rocking_wall::wall::{Body, Warning};
use serde::Serialize;

use super::case::{Case, Demands};
use super::curve::Curve;
use super::demand::Demand;
use super::floor::Mode;
use super::side_verdict::{ActivationCheck, AtActivationNumbers, DisplacementCheck, TieBreak};
use super::statement::{Displacements, Statement};
use super::states::StateStatement;
use super::table::{AtActivation, Method, UseClass};
use super::tie::TieAtLimit;
use super::verdict::{Checked, Deciding, DynamicCheck, Governs, Outcome, Side, SideVerdicts};
use super::{ENTRY, LimitState};
use crate::code::Subject;
use crate::error::CheckError;

/// Share of the largest a that a curve loses where a tie breaks, above which that displacement is `d_SLV`,
/// C8.7.1.2.1.6 \[-\].
pub const LARGEST_LOSS: f64 = 0.5;
/// Largest `u_y`/`u_0` of a tie that acts at the activation \[-\].
const SOFTEST: f64 = 0.10;

impl Statement {
    /// Checks a wall.
    ///
    /// ```
    /// use check::circolare::Statement;
    /// use check::{CheckFile, Subject};
    /// use rocking_wall::wall::Parameters;
    ///
    /// let text = r#"
    /// [check]
    /// code = "circolare-2019"
    /// before_activation = "rigid"
    /// soil = "B"
    /// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
    /// "#;
    /// let statement = Statement::read(&CheckFile::parse("scene.toml", text)?)?;
    /// let parameters = Parameters::default();
    /// let checked = statement.checked(Subject::new(&parameters))?;
    /// assert!(!checked.outcome.passed && (checked.outcome.governs.zeta - 0.855812).abs() < 5e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckError`] of a statement that is missing or does not fit the wall, of a wall that the code does
    /// not cover, of a spectrum that ends too early, or of a run. Improbable numbers come first, since they
    /// may be the cause.
    pub fn checked<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        self.check_wall(subject).map_err(|error| {
            let of_wall = subject.parameters.unusual();
            error.with_doubts(of_wall.chain(super::warnings::improbable(self, subject.floors)).collect())
        })
    }

    fn check_wall<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        let case = Case::new(self, subject)?;
        let mut found_sides = [None, None];
        let mut warnings = Vec::new();
        for sign in case.sides().take(if case.alike { 1 } else { 2 }) {
            let (verdict, found) = super::sides::side(&case, sign)?;
            warnings.extend(found);
            found_sides[Side::of(sign) as usize] = Some(verdict);
        }
        let [positive, negative] = found_sides;
        let negative = if case.alike { positive.clone() } else { negative };
        let sides = SideVerdicts { positive, negative };
        let floors = subject.floors;
        let dynamic = super::dynamic::check(subject.parameters, &case, &sides)?;
        let governs = governing(self, &sides, dynamic.as_ref())?;
        let passed = governs.zeta >= 1.0
            && dynamic.as_ref().is_none_or(|d| self.table.method != Method::Dynamic || d.passed());
        // the wall as it is drawn: with the hinge of the side that governs
        let mut parameters = case.parameters.clone();
        let hinge = sides.shown(governs.side).and_then(|side| side.curve.hinge);
        parameters.hinge_ratio = hinge.unwrap_or(parameters.hinge_ratio);
        let wall = super::sides::drawn(&parameters)?;
        let demands = case.demands_at(wall.body())?;
        let of_statement = super::warnings::of_statement(self, &parameters, floors, &wall);
        let of_demands = super::warnings::of_demands(self, &demands);
        warnings.splice(0..0, of_statement.into_iter().chain(of_demands));
        let of_sides = sides.iter().flat_map(|(_, side)| super::warnings::of_side(side, self, &demands));
        warnings.extend(of_sides.collect::<Vec<_>>());
        warnings.extend(super::warnings::of_untied_side(&case, &sides, governs.side));
        warnings.extend(super::warnings::of_periods(&sides));
        warnings.extend(super::warnings::of_verdict(&case, &sides, passed));
        warnings.extend(super::warnings::of_sensitivity(&case, &sides));
        if let Some(dynamic) = &dynamic {
            warnings.extend(super::warnings::of_rocking(self, subject.parameters));
            warnings.extend(dynamic.warnings(&case));
        }
        let mut seen = std::collections::BTreeSet::new();
        warnings.retain(|warning| seen.insert(warning.clone()));
        let alike = case.alike;
        let outcome = Outcome { code: ENTRY.name, passed, governs, alike, sides, dynamic, warnings };
        Ok(Checked { statement: self, parameters, floors, wall, rule: case.rule, demands, outcome })
    }

    /// Returns whether a static check decides. The runs of the dynamic method take the hinge of the checks by
    /// displacement.
    pub(super) fn decides(&self, check: Deciding) -> bool {
        match check {
            Deciding::Sld => self.table.use_class == Some(UseClass::IV),
            Deciding::SlvWithQ => self.table.method == Method::Linear,
            Deciding::Slv | Deciding::Slc => self.table.method != Method::Linear,
        }
    }
}

/// The modes of the storeys of a scene, `γ_k` `ψ_k` by the weights of the wall's supports. Their periods are
/// in proportion where the limit state has its own T₁.
pub(super) fn modes_of_storeys(
    given: &StateStatement,
    floors: Option<&Floors>,
    body: &Body,
) -> Result<Vec<Mode>, CheckError> {
    let Some(floors) = floors else { return Ok(Vec::new()) };
    let (bottom, top) = floors.supports(body.mechanism)?;
    let [at_bottom, at_top] = body.support_weights;
    let chain = floors.storeys();
    let shape = |floor: usize, mode: usize| if floor == 0 { 0.0 } else { chain.participation(mode, floor) };
    let periods = chain.periods();
    let stretch = given.building_period.map_or(1.0, |period| period / periods[0]);
    let mode = |(index, period): (usize, &f64)| Mode {
        period: period * stretch,
        participation: at_bottom * shape(bottom, index) + top.map_or(0.0, |top| at_top * shape(top, index)),
    };
    let modes: Vec<Mode> = periods.iter().enumerate().map(mode).collect();
    // supports on the ground move with it
    Ok(if modes.iter().all(|mode| mode.participation == 0.0) { Vec::new() } else { modes })
}

/// The checks of a side; `None` for one that is not made.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Checks {
    /// SLD, activation.
    #[serde(rename = "SLD", skip_serializing_if = "Option::is_none")]
    pub sld: Option<ActivationCheck>,
    /// SLV with q.
    #[serde(rename = "SLV_q", skip_serializing_if = "Option::is_none")]
    pub slv_q: Option<ActivationCheck>,
    /// SLV by displacement.
    #[serde(rename = "SLV", skip_serializing_if = "Option::is_none")]
    pub slv: Option<DisplacementCheck>,
    /// SLC by displacement.
    #[serde(rename = "SLC", skip_serializing_if = "Option::is_none")]
    pub slc: Option<DisplacementCheck>,
}

impl Checks {
    /// Makes those of the checks that are wanted, in the order of [`Deciding::ALL`]; SLD raises the last two.
    pub(super) fn new(
        curve: &Curve,
        statement: &Statement,
        demands: &Demands,
        [wants_sld, wants_slv_q, wants_slv, wants_slc]: [bool; 4],
    ) -> Result<Self, CheckError> {
        let of = |state: LimitState| statement.demanded(demands).find(|(given, _)| given.state == state);
        let sld = of(LimitState::Sld)
            .filter(|_| wants_sld || wants_slv || wants_slc)
            .map(|(given, demand)| activation(curve, statement, (given, demand), given.damping, 1.0))
            .transpose()?;
        let q = statement.behaviour_factor;
        // a spectrum of another damping than that of the activation leaves this check out
        let slv_q = of(LimitState::Slv)
            .filter(|_| wants_slv_q)
            .filter(|(given, demand)| {
                statement.table.method == Method::Linear || demand.has_damping(given.activation_damping)
            })
            .map(|(given, demand)| activation(curve, statement, (given, demand), given.activation_damping, q))
            .transpose()?;
        let floor = sld.map(|sld| sld.ag);
        let by_displacement = |state: LimitState, is_wanted: bool| {
            let rules = statement.rules(state);
            of(state)
                .filter(|_| is_wanted)
                .map(|stated| displacement(curve, stated, rules, floor))
                .transpose()
        };
        let slv = by_displacement(LimitState::Slv, wants_slv)?;
        let slc = by_displacement(LimitState::Slc, wants_slc)?;
        if let (Some(slv), Some(slc)) = (slv, slc)
            && slc.d < slv.d
        {
            let [slc, slv] = apart([slc.d, slv.d].map(|d| 1e3 * d), 4);
            let message = format!("SLC comes before SLV: d_SLC = {slc} mm is below d_SLV = {slv} mm");
            return Err(CheckError::value(&["SLC", "displacement"], message));
        }
        Ok(Self { sld, slv_q, slv, slc })
    }

    /// `ζ_E` of the checks, in the order of [`Deciding::ALL`]; infinite for one that is not made.
    pub(super) fn zetas(&self) -> [f64; 4] {
        let of = |zeta: Option<f64>| zeta.unwrap_or(f64::INFINITY);
        [
            of(self.sld.map(|check| check.ratio)),
            of(self.slv_q.map(|check| check.ratio)),
            of(self.slv.map(|check| check.zeta)),
            of(self.slc.map(|check| check.zeta)),
        ]
    }

    /// Where the hinge is in a check, of h \[-\].
    pub(super) fn hinge(&self, check: Deciding) -> Option<f64> {
        match check {
            Deciding::Sld => self.sld?.hinge,
            Deciding::SlvWithQ => self.slv_q?.hinge,
            Deciding::Slv => self.slv?.hinge,
            Deciding::Slc => self.slc?.hinge,
        }
    }

    /// The check that governs this side, and its `ζ_E`; infinite where none decides.
    pub(super) fn governing(&self, statement: &Statement) -> (Deciding, f64) {
        let all = Deciding::ALL.into_iter().zip(self.zetas());
        let deciding = all.filter(|(check, _)| statement.decides(*check));
        deciding.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((Deciding::Slv, f64::INFINITY))
    }
}

/// C8.7.1.2.1.5 with the capacity times `factor`: `a_0` of a wall that is held, or `a_y`, over FC, with the
/// tie at its strength where it counts at the activation.
fn activation(
    curve: &Curve,
    statement: &Statement,
    (given, demand): (&StateStatement, &Demand),
    xi: f64,
    factor: f64,
) -> Result<ActivationCheck, CheckError> {
    let own = curve.ay;
    let AtActivationNumbers { acceleration, t0, .. } = at_activation(curve, statement)?;
    let capacity = factor * acceleration / statement.confidence_factor;
    let required = match curve.tie() {
        // N = max(0, [FC S_L/C_L − a_y] s1 e*/(g A)), with the demand of the wall with its tie
        Some(tie) if tie.slack == 0.0 => {
            let demand = demand.acceleration(given.state, curve.tied_period(), xi)?;
            let lacking = statement.confidence_factor * demand / factor - own;
            Some((lacking / curve.of_force(tie.lever)).max(0.0))
        }
        _ => None,
    };
    let demand = demand.acceleration(given.state, t0, xi)?;
    let ratio = capacity / demand;
    Ok(ActivationCheck {
        hinge: curve.hinge,
        capacity,
        demand,
        ratio,
        ag: ratio * given.ag,
        required,
        acceleration,
        t0,
    })
}

/// The wall at its activation, with the tie where it counts there.
pub(super) fn at_activation(curve: &Curve, statement: &Statement) -> Result<AtActivationNumbers, CheckError> {
    let pull = tie_at_activation(curve, statement)?;
    Ok(AtActivationNumbers {
        alpha0: curve.alpha0 + pull / curve.pushed_weight,
        acceleration: curve.ay + curve.of_force(pull),
        t0: if pull > 0.0 { curve.tied_period() } else { curve.t0 },
        force: curve.tie().map_or(0.0, |tie| pull / tie.lever),
    })
}

/// A `N_y`, the force of the tie at the place of F at the activation; 0 where it does not count \[N\].
///
/// # Errors
/// [`CheckError`] of a tie that does not act there.
fn tie_at_activation(curve: &Curve, statement: &Statement) -> Result<f64, CheckError> {
    if statement.at_activation() == AtActivation::None {
        return Ok(0.0);
    }
    let Some(tie) = curve.tie() else { return Ok(0.0) };
    let refused = |message: String| {
        let message = format!("at_activation = \"yield\" {message}");
        Err(CheckError::value(&["tie", "at_activation"], message))
    };
    let Some(strength) = tie.strength else {
        return refused("needs a tie with tie_strength, N_y in N, or a bar".into());
    };
    if tie.slack > 0.0 {
        return refused(format!(
            "needs a tight tie: with tie_slack = {} m the wall rocks before the tie pulls; state \"none\", \
             or leave tie_slack out",
            tie.slack
        ));
    }
    let (yields, limit) = (strength / tie.stiffness / tie.lever, SOFTEST * curve.zero);
    if yields > limit {
        let [yields, limit] = apart([yields, limit].map(|u| 1e3 * u), 4);
        return refused(format!(
            "needs a stiff tie: this one has its strength at u_y = {yields} mm, beyond {SOFTEST} u_0 = \
             {limit} mm; state \"none\", or a stiffer tie"
        ));
    }
    Ok(tie.lever * strength)
}

/// Returns the displacement u of a limit state, and whether the tie breaks there, C8.7.1.2.1.6 \[m\].
fn limit(curve: &Curve, given: &StateStatement, fraction: f64) -> Result<(f64, bool), CheckError> {
    let of_curve = fraction * curve.zero;
    if given.state == LimitState::Slc {
        let Some(local) = given.displacement else { return Ok((of_curve, false)) };
        if !(local > 0.0 && local < curve.zero) {
            let [_, zero] = apart([local, curve.zero], 4);
            let message = format!("SLC.displacement = {local} m must be above 0 and below u_0 = {zero} m");
            return Err(CheckError::value(&["SLC", "displacement"], message));
        }
        return Ok((of_curve.min(local), false));
    }
    Ok(match curve.tie_break() {
        Some(TieBreak { u, loss, .. }) if u < of_curve && loss > LARGEST_LOSS => (u, true),
        _ => (of_curve, false),
    })
}

fn displacement(
    curve: &Curve,
    (given, demand): (&StateStatement, &Demand),
    rules: Displacements,
    floor: Option<f64>,
) -> Result<DisplacementCheck, CheckError> {
    let state = given.state;
    let Displacements { fraction, period_factor } = rules;
    let (u, limited_by_tie) = limit(curve, given, fraction)?;
    let (d, a) = (curve.d_per_u * u, curve.tied(u));
    if a <= 0.0 {
        return Err(CheckError::wall(format!("{state}: a is not positive at d = {d} m")));
    }
    let (elastic, end) = (curve.dy, fraction * curve.d0);
    if end <= elastic {
        let [elastic, end] = apart([elastic, end].map(|d| 1e3 * d), 4);
        return Err(CheckError::wall(format!(
            "{state}: the elastic branch ends at d_y = {elastic} mm, beyond {fraction:.2} d_0 = {end} mm: \
             lower a1 or raise E"
        )));
    }
    let period = Curve::period(period_factor, d, a);
    let t0 = curve.tied_period().min(period);
    let (acceleration, demand, demand_terms) = demand.displacement(state, [t0, period], given.damping)?;
    let ratio = d / demand;
    let least = floor.unwrap_or(0.0);
    let raised = least > ratio * given.ag;
    let ag = if raised { least } else { ratio * given.ag };
    let zeta = if raised { least / given.ag } else { ratio };
    let tie = curve.tie().map(|tie| TieAtLimit::new(tie, [u, demand / curve.d_per_u]));
    Ok(DisplacementCheck {
        hinge: curve.hinge,
        d,
        a,
        period,
        acceleration,
        demand,
        demand_terms,
        ratio,
        ag,
        zeta,
        limited_by_tie,
        raised,
        tie,
    })
}

/// Returns the smallest `ζ_E` of the checks that decide.
fn governing(
    statement: &Statement,
    sides: &SideVerdicts,
    dynamic: Option<&DynamicCheck>,
) -> Result<Governs, CheckError> {
    let is_dynamic = statement.table.method == Method::Dynamic;
    let mut all = Vec::new();
    for (side, verdict) in sides.iter() {
        for (limit_state, zeta) in Deciding::ALL.into_iter().zip(verdict.checks.zetas()) {
            let by_runs = is_dynamic && limit_state != Deciding::Sld;
            if statement.decides(limit_state) && !by_runs && zeta.is_finite() {
                all.push(Governs { side, limit_state, zeta });
            }
        }
    }
    if is_dynamic {
        let Some(dynamic) = dynamic else {
            let message = "method = \"dynamic\" needs records; add [check.records] with files";
            return Err(CheckError::value(&["method"], message));
        };
        all.extend(dynamic.governs());
    }
    let least = all.into_iter().min_by(|a, b| a.zeta.total_cmp(&b.zeta));
    least.ok_or_else(|| CheckError::wall("no limit state decides; give [check.SLV] or [check.SLC]"))
}
