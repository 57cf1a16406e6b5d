//! A side of a wall: its hinge by the rule that is stated, its numbers there, and what other rules give.

mod ledger;

use rocking_wall::wall::Body;
use serde::Serialize;

use super::activation::{AtActivationNumbers, at_activation};
use super::ties::{TieNumbers, TieVerdict, of_ties};
use super::{AtHinge, Checks, DisplacementCheck, Governing};
use crate::circolare::curve::Curve;
use crate::circolare::curve::case::{Case, has_plateau};
use crate::circolare::curve::hinge::{self, Search};
use crate::circolare::statement::states::Source;
use crate::circolare::statement::table::{Activation, Hinge};
use crate::error::CheckError;
use crate::words::names::{Deciding, LimitState, Side};
use crate::words::{Sentence, at_most, say};

/// Factors on a₁ or E whose verdicts are told.
const VARIED: [f64; 2] = [0.5, 2.0];

/// The outcome of one side.
#[derive(Clone, Debug)]
pub struct SideVerdict {
    /// The curve with the hinge of the check that governs, and its numbers.
    pub curve: Curve,
    /// The checks.
    pub checks: Checks,
    /// What the hinge of the least α0 gives, and the least favourable one.
    pub least_alpha0: Option<LeastAlpha0>,
    /// The wall at its activation, with the tie where it counts there.
    pub activation: AtActivationNumbers,
    /// The tie, on a side that it holds.
    pub tie: Option<TieNumbers>,
    /// Each of several ties that hold the side; none where one holds it alone.
    pub ties: Vec<TieVerdict>,
    /// `ζ_E` without the tie.
    pub untied: Option<Untied>,
    /// `ζ_E` with half and twice a₁ or E.
    pub sensitivity: Vec<Sensitivity>,
    /// Why other hinges could not be searched, where that failed.
    pub unsearched: Option<String>,
    /// The curves with the hinges of checks that have their own.
    pub others: Vec<Curve>,
}

impl SideVerdict {
    /// Checks a side.
    ///
    /// # Errors
    /// [`CheckError`] of a wall or a demand that has no check.
    pub(crate) fn new(case: &Case<'_>, sign: f64) -> Result<Self, CheckError> {
        let AtHinge { curve, checks } = by_rule(case, sign, case.rule, hinge::FINE)?;
        let informs = case.statement.informs;
        let is_tied = informs && curve.tie().is_some();
        // what only informs stops no check
        let untied = is_tied.then(|| by_rule(&case.untied(), sign, case.rule, hinge::FINE).ok()).flatten();
        let untied = untied.map(|AtHinge { checks, .. }| Untied {
            slv: checks.slv.map(|check| check.zeta),
            slc: checks.slc.map(|check| check.zeta),
        });
        let tie = curve.tie().map(|tie| TieNumbers::new(&curve, 0, tie));
        let activation = at_activation(&curve, case.statement)?;
        let ties = if curve.has_several_ties() { of_ties(case, sign, &curve, &checks)? } else { Vec::new() };
        let mut others: Vec<Curve> = Vec::new();
        for hinge in Deciding::ALL.into_iter().filter_map(|check| checks.hinge(check)) {
            if curve.hinge != Some(hinge) && others.iter().all(|other| other.hinge != Some(hinge)) {
                others.push(Curve::new(case, sign, Some(hinge))?);
            }
        }
        let sensitivity = if informs { sensitivity(case, sign) } else { Vec::new() };
        let mut side = Self {
            curve,
            checks,
            least_alpha0: None,
            activation,
            tie,
            ties,
            untied,
            sensitivity,
            unsearched: None,
            others,
        };
        if let Some(rule) = case.rule.filter(|_| informs) {
            side.unsearched = side.look_beside(case, sign, rule).err().map(|error| error.to_string());
        }
        Ok(side)
    }

    /// Finds what the hinge of the least α0 gives, and the least favourable one.
    fn look_beside(&mut self, case: &Case<'_>, sign: f64, rule: Hinge) -> Result<(), CheckError> {
        let statement = case.statement;
        let AtHinge { curve, checks } = by_rule(case, sign, Some(Hinge::LeastAlpha0), hinge::FINE)?;
        let finite = |zeta: f64| Some(zeta).filter(|zeta| zeta.is_finite());
        let found = self.least_alpha0.insert(LeastAlpha0 {
            alpha0: at_activation(&curve, statement)?.alpha0,
            hinge: curve.hinge.unwrap_or(f64::NAN),
            zeta: finite(checks.governing(statement).zeta),
            worst: None,
            worst_hinge: None,
            worst_check: None,
        });
        // spectra of records at every hinge would take long for what only informs
        let by_records = statement.states.iter().flatten().any(|given| given.source == Source::Records);
        let worst = match rule {
            Hinge::Worst => self.checks,
            _ if by_records => return Ok(()),
            Hinge::LeastAlpha0 | Hinge::Given => by_rule(case, sign, Some(Hinge::Worst), hinge::FINE)?.checks,
        };
        let Governing { check, zeta } = worst.governing(statement);
        found.worst = finite(zeta);
        found.worst_hinge = worst.hinge(check);
        found.worst_check = Some(check);
        Ok(())
    }

    /// The curve with a hinge that a check has.
    pub(crate) fn at(&self, hinge: Option<f64>) -> &Curve {
        self.others.iter().find(|other| other.hinge == hinge).unwrap_or(&self.curve)
    }

    /// The check of a limit state by displacement.
    pub(crate) fn displacement(&self, state: LimitState) -> Option<DisplacementCheck> {
        match state {
            LimitState::Sld => None,
            LimitState::Slv => self.checks.slv,
            LimitState::Slc => self.checks.slc,
        }
    }

    /// The checks by displacement that are made.
    pub(crate) fn by_displacement(&self) -> impl Iterator<Item = (LimitState, DisplacementCheck)> {
        LimitState::ALL.into_iter().filter_map(|state| Some((state, self.displacement(state)?)))
    }
}

/// What the hinge of the least α0 gives, and beside it the least favourable one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastAlpha0 {
    /// The least α0 \[-\].
    pub alpha0: f64,
    /// Its hinge, of h \[-\].
    pub hinge: f64,
    /// The least `ζ_E` that decides with that hinge \[-\].
    pub zeta: Option<f64>,
    /// The least `ζ_E` that decides with any hinge of the range; `None` where it was not searched \[-\].
    pub worst: Option<f64>,
    /// Its hinge, of h \[-\].
    pub worst_hinge: Option<f64>,
    /// The check that has it; `None` where it was not searched.
    pub worst_check: Option<Deciding>,
}

/// `ζ_E` of a side without its tie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Untied {
    /// SLV \[-\].
    pub slv: Option<f64>,
    /// SLC \[-\].
    pub slc: Option<f64>,
}

/// The verdict on a side with another a₁ or E; without numbers where the check is impossible.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sensitivity {
    /// `a1` or `young_modulus`.
    pub parameter: &'static str,
    /// Its value.
    pub value: f64,
    /// The least `ζ_E` that decides \[-\].
    #[serde(rename = "zeta_E")]
    pub zeta: Option<f64>,
    /// Whether the side passes.
    pub passed: Option<bool>,
    /// `ζ_E` of SLV \[-\].
    #[serde(rename = "SLV")]
    pub slv: Option<f64>,
    /// `ζ_E` of SLC \[-\].
    #[serde(rename = "SLC")]
    pub slc: Option<f64>,
    /// `ζ_E` of each check, in the order of [`Deciding::ALL`]; infinite for one that is not made \[-\].
    #[serde(skip)]
    pub(crate) zetas: [f64; 4],
}

impl Sensitivity {
    /// Returns the parameter and its value for people: E in `MPa`.
    pub(crate) fn assigned(&self) -> Sentence {
        match self.parameter {
            "young_modulus" => {
                say!("E = {value} MPa", "E = {value} MPa", value = at_most(1e-6 * self.value, 4))
            }
            name => say!("{name} = {value}", "{name} = {value}", name, value = at_most(self.value, 4)),
        }
    }
}

/// The outcomes of both sides; `None` for one to which the wall cannot rock.
#[derive(Clone, Debug)]
pub struct SideVerdicts {
    /// u > 0.
    pub positive: Option<SideVerdict>,
    /// u < 0.
    pub negative: Option<SideVerdict>,
}

impl SideVerdicts {
    /// Checks the sides to which a wall rocks; of sides that are alike, once.
    pub(crate) fn new(case: &Case<'_>) -> Result<Self, CheckError> {
        let mut sides = Self { positive: None, negative: None };
        for sign in case.sides().take(if case.alike { 1 } else { 2 }) {
            let verdict = Some(SideVerdict::new(case, sign)?);
            match Side::of(sign) {
                Side::Positive => sides.positive = verdict,
                Side::Negative => sides.negative = verdict,
            }
        }
        if case.alike {
            sides.negative = sides.positive.clone();
        }
        Ok(sides)
    }

    /// The verdict of a side.
    pub(crate) fn of(&self, side: Side) -> Option<&SideVerdict> {
        match side {
            Side::Positive => self.positive.as_ref(),
            Side::Negative => self.negative.as_ref(),
        }
    }

    /// The verdict of a side; where the wall is not checked to that, of the other.
    pub(crate) fn shown(&self, side: Side) -> Option<&SideVerdict> {
        self.of(side).or(self.positive.as_ref()).or(self.negative.as_ref())
    }

    /// The sides there are.
    pub fn iter(&self) -> impl Iterator<Item = (Side, &SideVerdict)> {
        let sides = [(Side::Positive, &self.positive), (Side::Negative, &self.negative)];
        sides.into_iter().filter_map(|(side, verdict)| Some((side, verdict.as_ref()?)))
    }
}

/// The place of the least α0 on a side, of h \[-\], C8.7.1.2.1.1, ties that count at the activation included.
fn least_alpha0(case: &Case<'_>, sign: f64) -> Result<f64, CheckError> {
    let alpha0 = |x: f64| {
        let curve = Curve::new(case, sign, Some(x));
        let activation = curve.and_then(|curve| at_activation(&curve, case.statement));
        activation.map(|found| found.alpha0).map_err(|error| error.at_hinge(x))
    };
    let range @ [from, to] = case.statement.hinge_range;
    // of a rectangle F₀ h = 2 (W + O) b/x + O (b + 2c)/(1 − x), least where (1 − x)²/x² = r,
    // r = O (b + 2c)/[2 (W + O) b]
    let is_tied = case.parameters.ties().any(|tie| tie.stiffness > 0.0);
    let is_plain = case.statement.masonry.is_none() && !has_plateau(&case.parameters) && !is_tied;
    if is_plain && case.parameters.is_rectangle() {
        let curve = Curve::new(case, sign, Some(0.5 * (from + to)))?;
        let Body { weight, overburden, height, .. } = *curve.body();
        let first = 2.0 * (weight + overburden) * case.parameters.thickness;
        let h1 = curve.body().hinge_height;
        let second = (curve.body().strength.of(sign) - first / h1) * (height - h1);
        let ratio = second / first;
        // the ends are walls, too
        alpha0(from)?;
        alpha0(to)?;
        return Ok(if ratio <= 0.0 { to } else { (1.0 / (1.0 + ratio.sqrt())).clamp(from, to) });
    }
    let jumps = hinge::jumps(&case.parameters);
    Ok(hinge::least(hinge::FINE, range, &jumps, |x, _| Ok::<_, CheckError>([alpha0(x)?]))?[0].unwrap_or(to))
}

/// The checks of a side by a rule on the hinge, searched as finely as stated, and the curve with the hinge of
/// the check that governs. A coarse search is for the checks that decide.
fn by_rule(case: &Case<'_>, sign: f64, rule: Option<Hinge>, search: Search) -> Result<AtHinge, CheckError> {
    match rule {
        None => Checks::at(case, sign, None),
        Some(Hinge::Given) => Checks::at(case, sign, Some(case.parameters.hinge_ratio)),
        Some(Hinge::LeastAlpha0) => Checks::at(case, sign, Some(least_alpha0(case, sign)?)),
        Some(Hinge::Worst) => {
            let range = case.statement.hinge_range;
            let counts = Deciding::ALL.map(|check| search.is_fine() || case.statement.decides(check));
            let places = hinge::least(search, range, &hinge::jumps(&case.parameters), |x, which| {
                let wanted = which.map_or(counts, |which| std::array::from_fn(|check| check == which));
                let mut zetas = Checks::of_these(case, sign, Some(x), wanted)?.checks.zetas();
                for (zeta, _) in zetas.iter_mut().zip(counts).filter(|(_, counts)| !counts) {
                    *zeta = f64::INFINITY;
                }
                Ok::<_, CheckError>(zetas)
            })?;
            let at = |which: usize| places[which].map(|x| Checks::at(case, sign, Some(x))).transpose();
            let found = [at(0)?, at(1)?, at(2)?, at(3)?];
            let [sld, slv_q, slv, slc] =
                found.each_ref().map(|found| found.as_ref().map(|found| found.checks));
            let checks = Checks {
                sld: sld.and_then(|checks| checks.sld),
                slv_q: slv_q.and_then(|checks| checks.slv_q),
                slv: slv.and_then(|checks| checks.slv),
                slc: slc.and_then(|checks| checks.slc),
            };
            let governs = checks.governing(case.statement).check;
            let curve = match found.into_iter().nth(governs as usize).flatten() {
                Some(found) => found.curve,
                None => Checks::at(case, sign, Some(least_alpha0(case, sign)?))?.curve,
            };
            Ok(AtHinge { curve, checks })
        }
    }
}

/// `ζ_E` with half and twice a₁ (`law`) or E (`beam`).
fn sensitivity(case: &Case<'_>, sign: f64) -> Vec<Sensitivity> {
    let statement = case.statement;
    let (parameter, value) = match case.activation {
        Activation::Law if case.parameters.multilinear.is_none() => ("a1", case.parameters.a1),
        Activation::Beam => ("young_modulus", case.young_modulus.unwrap_or(f64::NAN)),
        _ => return Vec::new(),
    };
    let one = |factor: f64| {
        let value = factor * value;
        // without a check where the wall with this value has none
        let checks =
            by_rule(&case.with(factor), sign, case.rule, hinge::COARSE).ok().map(|found| found.checks);
        let zeta = checks.map(|checks| checks.governing(statement).zeta);
        Sensitivity {
            parameter,
            value,
            zeta: zeta.filter(|zeta| zeta.is_finite()),
            passed: zeta.map(|zeta| zeta >= statement.target),
            slv: checks.and_then(|checks| Some(checks.slv?.zeta)),
            slc: checks.and_then(|checks| Some(checks.slc?.zeta)),
            zetas: checks.map_or([f64::NAN; 4], |checks| checks.zetas()),
        }
    };
    VARIED.map(one).to_vec()
}
