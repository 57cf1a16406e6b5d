//! What the table `[check]` states of a limit state, of its ground and of the building.

use crate::error::CheckError;

use super::LimitState;
use super::floor::{FloorSpectrum, Mode};
use super::ground::{GroundSpectrum, Hazard, Soil};
use super::table::{BuildingTable, CATEGORIES, CheckTable, LimitStateTable, RecordScale, Topography};

/// What is stated of a limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct StateStatement {
    /// Which.
    pub state: LimitState,
    /// `a_g` \[g\].
    pub ag: f64,
    /// ξ of the mechanism \[-\].
    pub damping: f64,
    /// ξ of the activation, that of SLD \[-\].
    pub activation_damping: f64,
    /// Where the demand comes from.
    pub source: Source,
    /// `ξ_k` of the building \[-\].
    pub building_damping: Option<f64>,
    /// T₁ of the building in this limit state \[s\].
    pub building_period: Option<f64>,
    /// Modes of the table `[check.building]`, with the period of this limit state; none on the ground.
    pub modes: Vec<Mode>,
    /// u of a local instability \[m\].
    pub displacement: Option<f64>,
}

/// Where a demand comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The spectrum of the code.
    Code(GroundSpectrum),
    /// Points (T, `S_a`) at the wall's place, of one damping \[s, m/s², -\].
    Points(Vec<(f64, f64)>, f64),
    /// The records of the check.
    Records,
}

/// Refuses what is stated of a limit state.
fn refused(state: LimitState, key: &str, message: &str) -> CheckError {
    CheckError::value(&[state.key(), key], format!("{state}: {message}"))
}

/// Checks what is stated of a limit state.
pub(super) fn limit_state(
    state: LimitState,
    given: &LimitStateTable,
    table: &CheckTable,
) -> Result<StateStatement, CheckError> {
    let refused = |key, message: String| refused(state, key, &message);
    let Some(ag) = given.ag else {
        let message = "ag is missing; state a_g in g, with F0 and TC, or the site on a grid in [check.site]";
        return Err(refused("ag", message.into()));
    };
    if !(ag > 0.0 && ag <= 1.0) {
        return Err(refused("ag", format!("a_g = {ag} must be above 0 and at most 1 g; give it in g")));
    }
    let ratio = |key, value: f64| {
        if value > 0.0 && value <= 0.5 {
            return Ok(value);
        }
        Err(refused(key, format!("{key} = {value} is a ratio, such as 0.08; above 0 and at most 0.5")))
    };
    let damping = ratio("damping", given.damping.unwrap_or(state.damping()))?;
    let of_sld = table.sld.as_ref().and_then(|sld| sld.damping);
    let building_damping = given.building_damping.map(|xi| ratio("building_damping", xi)).transpose()?;
    if let Some(period) = given.building_period.filter(|period| !(*period > 0.0 && period.is_finite())) {
        return Err(refused("building_period", format!("building_period = {period} s must be above 0")));
    }
    if given.displacement.is_some() && state != LimitState::Slc {
        let message = "a displacement of local instability belongs to SLC (C8.7.1.2.1.6)";
        return Err(refused("displacement", message.into()));
    }
    let source = source(state, ag, given, table)?;
    let mut modes = table.building.as_ref().map(modes).transpose()?.unwrap_or_default();
    if let (Some(first), Some(period)) = (modes.first().copied(), given.building_period) {
        for mode in &mut modes {
            mode.period *= period / first.period;
        }
    }
    if !matches!(source, Source::Code(_)) && table.building.is_some() {
        let message = "a spectrum and records are those of the wall's own place; leave [check.building] out, \
                       or give F0 and TC";
        return Err(refused("ag", message.into()));
    }
    Ok(StateStatement {
        state,
        ag,
        damping,
        activation_damping: of_sld.unwrap_or(LimitState::Sld.damping()),
        source,
        building_damping,
        building_period: given.building_period,
        modes,
        displacement: given.displacement,
    })
}

fn source(
    state: LimitState,
    ag: f64,
    given: &LimitStateTable,
    table: &CheckTable,
) -> Result<Source, CheckError> {
    let refused = |key, message: String| refused(state, key, &message);
    match (given.f0, given.tc, &given.spectrum) {
        (Some(_), Some(_), None) if given.spectrum_damping.is_some() => {
            Err(refused("spectrum_damping", "spectrum_damping is that of a spectrum; leave it out".into()))
        }
        (Some(f0), Some(tc), None) => {
            if !(f0 >= 2.2 && f0.is_finite()) {
                return Err(refused("F0", format!("F0 = {f0} is below 2.2 (NTC 3.2.3.2.1)")));
            }
            if !(tc > 0.0 && tc.is_finite()) {
                return Err(refused("TC", format!("T_C* = {tc} s must be above 0")));
            }
            let hazard = Hazard { ag, f0, tc };
            Ok(Source::Code(GroundSpectrum::new(hazard, soil(table)?, topography(table)?)))
        }
        (None, None, Some(points)) => {
            let Some(damping) = given.spectrum_damping else {
                return Err(refused("spectrum", "state spectrum_damping, the ratio of that spectrum".into()));
            };
            let rises = points.windows(2).all(|pair| pair[1][0] > pair[0][0]);
            let begins = points.first().is_some_and(|point| point[0] == 0.0);
            let positive = points.iter().all(|point| point[0].is_finite() && point[1] > 0.0);
            if !(rises && begins && positive && points.len() > 1 && points.iter().all(|p| p[1].is_finite())) {
                let message = "expected points [T, Sa] in s and g: T from 0 on that rises, Sa above 0";
                return Err(refused("spectrum", message.into()));
            }
            let points = points.iter().map(|[period, sa]| (*period, sa * super::G)).collect();
            Ok(Source::Points(points, damping))
        }
        (None, None, None) if table.records.is_some() && table.record_scale == RecordScale::None => {
            Ok(Source::Records)
        }
        (None, None, None) if table.records.is_some() => Err(refused(
            "ag",
            "a demand from the records takes them as they are: state record_scale = \"none\", or F0 and TC"
                .into(),
        )),
        (None, None, None) => Err(refused(
            "ag",
            format!("needs its site: [check.{state}] with ag, F0 and TC, or a spectrum or records"),
        )),
        (Some(_), _, Some(_)) | (_, Some(_), Some(_)) => {
            Err(refused("spectrum", "give F0 and TC, or a spectrum, not both".into()))
        }
        _ => Err(refused("ag", "F0 and TC go together; give both".into())),
    }
}

fn soil(table: &CheckTable) -> Result<Soil, CheckError> {
    let Some(given) = &table.soil else {
        return Err(CheckError::value(&["soil"], "soil is missing; state soil = \"A\" to \"E\" (NTC 3.2.2)"));
    };
    Soil::ALL.into_iter().find(|soil| soil.name() == given).ok_or_else(|| {
        let letter = given.to_uppercase();
        let message = match Soil::ALL.iter().find(|soil| soil.name() == letter) {
            Some(soil) => format!("soil {given:?}: did you mean {:?}?", soil.name()),
            None => format!(
                "soil {given:?}: NTC 3.2.2 has formulas for A to E; give a spectrum of a local analysis"
            ),
        };
        CheckError::value(&["soil"], message)
    })
}

fn topography(table: &CheckTable) -> Result<f64, CheckError> {
    let (factor, given) = match &table.topography {
        None => return Ok(1.0),
        Some(Topography::Factor(factor)) => {
            (Some(*factor).filter(|factor| (1.0..=1.4).contains(factor)), factor.to_string())
        }
        Some(Topography::Category(name)) => {
            let mut categories = CATEGORIES.into_iter();
            (categories.find(|(category, _)| category == name).map(|(_, factor)| factor), format!("{name:?}"))
        }
    };
    factor.ok_or_else(|| {
        let message = format!("topography = {given} must be \"T1\" to \"T4\", or S_T from 1 to 1.4");
        CheckError::value(&["topography"], message)
    })
}

fn modes(building: &BuildingTable) -> Result<Vec<Mode>, CheckError> {
    let refused =
        |key, message: String| Err(CheckError::value(&["building", key], format!("building: {message}")));
    match (building.storeys, building.period, building.height_ratio, &building.modes) {
        (Some(storeys), Some(period), Some(height_ratio), None) => {
            if storeys < 1 {
                return refused("storeys", format!("storeys = {storeys} must be at least 1"));
            }
            if !(period > 0.0 && period.is_finite()) {
                return refused("period", format!("period = {period} s must be above 0"));
            }
            if !(0.0..=1.0).contains(&height_ratio) {
                let message = format!("height_ratio = {height_ratio} is z/H, from 0 to 1");
                return refused("height_ratio", message);
            }
            Ok(vec![Mode::of_storeys(storeys, period, height_ratio)])
        }
        (None, None, None, Some(modes)) => {
            let usable =
                |mode: &Mode| mode.period > 0.0 && mode.period.is_finite() && mode.participation.is_finite();
            if modes.is_empty() || !modes.iter().all(usable) {
                return refused("modes", "each mode needs a period above 0 s and a participation".into());
            }
            Ok(modes.clone())
        }
        _ => refused(
            "modes",
            "give storeys, period and height_ratio, or modes = [{ period, participation }]".into(),
        ),
    }
}

impl StateStatement {
    /// Makes the spectrum of the code at the place of the wall, with these modes of the building; of the
    /// ground where there is none. `bounded` says that accelerations are not below that of the ground.
    ///
    /// # Errors
    /// [`CheckError::Value`] without a damping of the building, or of one that leaves no amplification.
    pub(super) fn floor(
        &self,
        ground: GroundSpectrum,
        modes: Vec<Mode>,
        bounded: bool,
    ) -> Result<Option<FloorSpectrum>, CheckError> {
        if modes.is_empty() {
            return Ok(None);
        }
        let name = self.state.key();
        let Some(xi) = self.building_damping else {
            let message = "state building_damping, the damping of the building in this limit state \
                           (C8.7.1.2.1.4)";
            return Err(refused(self.state, "building_damping", message));
        };
        let floor = FloorSpectrum::new(ground, modes, xi);
        if floor.printed_peak() <= 0.0 {
            let message =
                format!("{name}: a_Z = 0: the wall stands on the ground; leave [check.building] out");
            return Err(CheckError::value(&["building"], message));
        }
        let largest = self.damping.max(self.activation_damping);
        if floor.amplification(largest) <= 1.0 {
            let message = format!("xi_k = {xi} leaves no amplification: [C7.2.6] does not hold");
            return Err(refused(self.state, "building_damping", &message));
        }
        Ok(Some(if bounded { floor.not_below_ground() } else { floor }))
    }
}
