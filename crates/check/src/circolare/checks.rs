//! The static checks of a wall, side by side, and what governs.

use rocking_wall::scene::Floors;
use rocking_wall::wall::{Parameters, Wall, Warning};

use super::curve::Curve;
use super::demand::{Demand, DisplacementDemand};
use super::floor::Mode;
use super::statement::{Source, StateStatement, Statement};
use super::table::{Method, UseClass};
use super::verdict::{
    ActivationCheck, Checked, Deciding, DisplacementCheck, DynamicCheck, Governs, Outcome, Side, SideVerdict,
    SideVerdicts, TieBreak,
};
use super::{ENTRY, LimitState};
use crate::code::Subject;
use crate::error::CheckError;
use crate::site::Records;

/// Factor of π √(d/a) in [C8.7.1.10] and [C8.7.1.11].
fn period_factor(state: LimitState) -> f64 {
    match state {
        LimitState::Sld | LimitState::Slv => 1.68,
        LimitState::Slc => 1.56,
    }
}

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
    /// let checked = statement.checked(Subject { parameters: &parameters, floors: None })?;
    /// assert!(!checked.outcome.passed && (checked.outcome.governs.zeta - 0.855812).abs() < 5e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckError`] of a statement that is missing or does not fit the wall, of a wall that the code does
    /// not cover, of a spectrum that ends too early, or of a run. Improbable numbers come first, since they
    /// may be the cause.
    pub fn checked<'a>(&'a self, subject: Subject<'a>) -> Result<Checked<'a>, CheckError> {
        let Subject { parameters, floors } = subject;
        self.check_wall(parameters, floors).map_err(|error| {
            let of_wall = Warning::unusual(parameters);
            error.with_doubts(of_wall.chain(super::warnings::improbable(self, floors)).collect())
        })
    }

    fn check_wall<'a>(
        &'a self,
        parameters: &'a Parameters,
        floors: Option<&'a Floors>,
    ) -> Result<Checked<'a>, CheckError> {
        let wall = Wall::new(parameters)?;
        let mut warnings = super::warnings::of_statement(self, parameters, floors, &wall);
        let mut demands = [const { None }; 3];
        for given in self.states.iter().flatten() {
            let demand = demand(given, floors, &wall, &self.records)?;
            warnings.extend(super::warnings::of_demand(given.state, &demand));
            demands[given.state as usize] = Some(demand);
        }
        let mut sides = [None, None];
        for sign in wall.sides() {
            let curve = Curve::new(&wall, parameters, self, sign)?;
            sides[Side::of(sign) as usize] = Some(side(&curve, self, &demands)?);
            warnings.extend(super::warnings::of_side(&curve, self, &demands));
        }
        let [positive, negative] = sides;
        let sides = SideVerdicts { positive, negative };
        warnings.extend(super::warnings::of_periods(&sides));
        let dynamic = super::dynamic::check(parameters, floors, self, &sides)?;
        warnings.extend(dynamic.iter().flat_map(|dynamic| dynamic.warnings(parameters, self)));
        let mut seen = std::collections::BTreeSet::new();
        warnings.retain(|warning| seen.insert(warning.clone()));
        let governs = governing(self, &sides, dynamic.as_ref())?;
        let passed = governs.zeta >= 1.0
            && dynamic.as_ref().is_none_or(|d| self.table.method != Method::Dynamic || d.passed());
        let alike = wall.has_equal_sides();
        let outcome = Outcome { code: ENTRY.name, passed, governs, alike, sides, dynamic, warnings };
        Ok(Checked { statement: self, parameters, floors, wall, demands, outcome })
    }
}

/// Makes the demand of a limit state.
fn demand(
    given: &StateStatement,
    floors: Option<&Floors>,
    wall: &Wall,
    records: &Records,
) -> Result<Demand, CheckError> {
    match &given.source {
        Source::Code(ground) => {
            let modes = if given.modes.is_empty() {
                modes_of_storeys(given, floors, wall)?
            } else {
                given.modes.clone()
            };
            Ok(given.floor(*ground, modes)?.map_or(Demand::Ground(*ground), Demand::Floor))
        }
        Source::Points(points, damping) => Ok(Demand::Points(points.clone(), *damping)),
        Source::Records => Ok(Demand::Records(records.felt(floors, wall)?)),
    }
}

/// The modes of the storeys of a scene, `γ_k` `ψ_k` by the weights of the wall's supports. Their periods are
/// in proportion where the limit state has its own T₁.
fn modes_of_storeys(
    given: &StateStatement,
    floors: Option<&Floors>,
    wall: &Wall,
) -> Result<Vec<Mode>, CheckError> {
    let Some(floors) = floors else { return Ok(Vec::new()) };
    let (bottom, top) = floors.supports(wall.body().mechanism)?;
    let [at_bottom, at_top] = wall.body().support_weights;
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

fn side(
    curve: &Curve<'_>,
    statement: &Statement,
    demands: &[Option<Demand>; 3],
) -> Result<SideVerdict, CheckError> {
    let of = |state: LimitState| statement.state(state).zip(demands[state as usize].as_ref());
    let sld = of(LimitState::Sld)
        .map(|(given, demand)| activation(curve, statement, given, demand, given.damping, 1.0))
        .transpose()?;
    let q = statement.behaviour_factor;
    // a spectrum of another damping than that of the activation leaves this check out
    let slv_q = of(LimitState::Slv)
        .filter(|(given, demand)| {
            statement.table.method == Method::Linear || demand.has_damping(given.activation_damping)
        })
        .map(|(given, demand)| activation(curve, statement, given, demand, given.activation_damping, q))
        .transpose()?;
    let floor = sld.map(|sld| sld.ag);
    let by_displacement = |state: LimitState| {
        of(state).map(|(given, demand)| displacement(curve, given, demand, floor)).transpose()
    };
    let (slv, slc) = (by_displacement(LimitState::Slv)?, by_displacement(LimitState::Slc)?);
    if let (Some(slv), Some(slc)) = (slv, slc)
        && slc.d < slv.d
    {
        let message = format!("SLC comes before SLV: d_SLC = {} m is below d_SLV = {} m", slc.d, slv.d);
        return Err(CheckError::value(&["SLC", "displacement"], message));
    }
    Ok(SideVerdict {
        alpha0: curve.alpha0,
        e_star: 1.0,
        mass: curve.mass,
        a0: curve.a0(),
        d0: curve.d0(),
        t0: curve.elastic.period,
        dy: curve.elastic.displacement,
        ay: curve.elastic.acceleration,
        d_per_u: curve.stretch,
        sld,
        slv_q,
        slv,
        slc,
        acting_force: curve.acting,
        pushed_weight: curve.pushed_weight,
        tie_break: curve.tie_break(),
        corners: curve.corners(),
    })
}

/// C8.7.1.2.1.5 with the capacity times `factor`: `a_0` of a wall that is held, or `a_y`, over FC.
fn activation(
    curve: &Curve<'_>,
    statement: &Statement,
    given: &StateStatement,
    demand: &Demand,
    xi: f64,
    factor: f64,
) -> Result<ActivationCheck, CheckError> {
    let capacity = factor * curve.elastic.acceleration / statement.confidence_factor;
    let demand = demand.acceleration(given.state, curve.elastic.period, xi)?;
    let ratio = capacity / demand;
    Ok(ActivationCheck { capacity, demand, ratio, ag: ratio * given.ag })
}

/// Share of the largest a that a curve loses where a tie breaks, above which that displacement is `d_SLV`,
/// C8.7.1.2.1.6 \[-\].
pub const LARGEST_LOSS: f64 = 0.5;

/// Returns the displacement u of a limit state, and whether the tie breaks there, C8.7.1.2.1.6 \[m\].
fn limit(curve: &Curve<'_>, given: &StateStatement) -> Result<(f64, bool), CheckError> {
    if given.state == LimitState::Slc {
        let of_curve = 0.60 * curve.zero;
        let Some(local) = given.displacement else { return Ok((of_curve, false)) };
        if !(local > 0.0 && local < curve.zero) {
            let message =
                format!("SLC.displacement = {local} m must be above 0 and below u_0 = {} m", curve.zero);
            return Err(CheckError::value(&["SLC", "displacement"], message));
        }
        return Ok((of_curve.min(local), false));
    }
    let of_curve = 0.40 * curve.zero;
    Ok(match curve.tie_break() {
        Some(TieBreak { u, loss, .. }) if u < of_curve && loss > LARGEST_LOSS => (u, true),
        _ => (of_curve, false),
    })
}

fn displacement(
    curve: &Curve<'_>,
    given: &StateStatement,
    demand: &Demand,
    floor: Option<f64>,
) -> Result<DisplacementCheck, CheckError> {
    let state = given.state;
    let (u, limited_by_tie) = limit(curve, given)?;
    let (d, a) = (curve.stretch * u, curve.tied(u));
    if a <= 0.0 {
        return Err(CheckError::wall(format!("{state}: a is not positive at d = {d} m")));
    }
    let period = Curve::period(period_factor(state), d, a);
    let t0 = curve.elastic.period;
    let elastic = curve.elastic.displacement;
    if elastic >= d || t0 >= period {
        return Err(CheckError::wall(format!(
            "the elastic branch reaches d_{state}: the wall does not rock before {state} (it ends at d_y = \
             {elastic} m with T0 = {t0} s; d_{state} = {d} m with T = {period} s)"
        )));
    }
    let DisplacementDemand { acceleration, displacement: demand, terms: demand_terms } =
        demand.displacement(state, [t0, period], given.damping)?;
    let ratio = d / demand;
    let least = floor.unwrap_or(0.0);
    let raised = least > ratio * given.ag;
    let ag = if raised { least } else { ratio * given.ag };
    let zeta = if raised { least / given.ag } else { ratio };
    Ok(DisplacementCheck {
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
    })
}

/// Returns the smallest `ζ_E` of the checks that decide.
fn governing(
    statement: &Statement,
    sides: &SideVerdicts,
    dynamic: Option<&DynamicCheck>,
) -> Result<Governs, CheckError> {
    let mut all = Vec::new();
    for (side, verdict) in sides.iter() {
        let mut add = |limit_state, zeta: Option<f64>| {
            all.extend(zeta.map(|zeta| Governs { side, limit_state, zeta }));
        };
        if statement.table.use_class == Some(UseClass::IV) {
            add(Deciding::Sld, verdict.sld.map(|check| check.ratio));
        }
        match statement.table.method {
            Method::Nonlinear => {
                add(Deciding::Slv, verdict.slv.map(|check| check.zeta));
                add(Deciding::Slc, verdict.slc.map(|check| check.zeta));
            }
            Method::Linear => add(Deciding::SlvWithQ, verdict.slv_q.map(|check| check.ratio)),
            Method::Dynamic => {}
        }
    }
    if statement.table.method == Method::Dynamic {
        let Some(dynamic) = dynamic else {
            let message = "method = \"dynamic\" needs records; add [check.records] with files";
            return Err(CheckError::value(&["method"], message));
        };
        all.extend(dynamic.governs());
    }
    let least = all.into_iter().min_by(|a, b| a.zeta.total_cmp(&b.zeta));
    least.ok_or_else(|| CheckError::wall("no limit state decides; give [check.SLV] or [check.SLC]"))
}
