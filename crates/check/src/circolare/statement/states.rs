//! What the table `[check]` states of a limit state, of its ground and of the building.

use crate::error::CheckError;
use crate::file::site::check_points;
use crate::words::names::LimitState;

use super::height::HeightRatio;
use super::table::{BuildingTable, CheckTable, LimitStateTable, RecordScale};
use crate::ntc::floor::{FloorSpectrum, Mode};
use crate::ntc::ground::{G, GroundSpectrum, Hazard, Topography};

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
    /// Modes of the table `[check.building]` with the period of this limit state, of each level at which the
    /// wall may open; none at the ground, and no level without the table.
    pub modes: Vec<Vec<Mode>>,
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
pub(crate) fn limit_state(
    state: LimitState,
    given: &LimitStateTable,
    table: &CheckTable,
) -> Result<StateStatement, CheckError> {
    let refused = |key, message: String| refused(state, key, &message);
    let Some(ag) = given.ag else {
        let message = "ag is missing; state a_g in g, with F0 and TC, or the site on a grid in [check.site]";
        return Err(refused("ag", message.into()));
    };
    let of_sld = table.sld.as_ref().and_then(|sld| sld.damping);
    if given.displacement.is_some() && state != LimitState::Slc {
        let message = "a displacement of local instability belongs to SLC (C8.7.1.2.1.6)";
        return Err(refused("displacement", message.into()));
    }
    let source = source(state, ag, given, table)?;
    let levels = table.hinge_levels.as_ref().map_or(1, Vec::len);
    let of_building = table.building.as_ref().map(|building| modes(building, levels));
    let mut modes = of_building.transpose()?.unwrap_or_default();
    let first = modes.iter().flatten().next().copied();
    if let (Some(first), Some(period)) = (first, given.building_period) {
        for mode in modes.iter_mut().flatten() {
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
        damping: given.damping.unwrap_or(state.damping()),
        activation_damping: of_sld.unwrap_or(LimitState::Sld.damping()),
        source,
        building_damping: given.building_damping,
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
    match (given.f0.zip(given.tc), &given.spectrum, given.spectrum_damping) {
        (Some((f0, tc)), None, None) => {
            let Some(soil) = table.soil else {
                let message = "soil is missing; state soil = \"A\" to \"E\" (NTC 3.2.2)";
                return Err(CheckError::value(&["soil"], message));
            };
            let topography = table.topography.map_or(1.0, Topography::factor);
            Ok(Source::Code(GroundSpectrum::new(Hazard { ag, f0, tc }, soil, topography)))
        }
        (None, Some(points), Some(damping)) if given.f0.or(given.tc).is_none() => {
            let points: Vec<_> = points.iter().map(|[period, sa]| (*period, *sa)).collect();
            let place = |index| format!("point {} of the spectrum", index + 1);
            check_points(&points, "g", place).map_err(|message| refused(state, "spectrum", &message))?;
            let in_si = points.into_iter().map(|(period, sa)| (period, sa * G));
            Ok(Source::Points(in_si.collect(), damping))
        }
        (None, None, None)
            if given.f0.or(given.tc).is_none()
                && table.records.is_some()
                && table.record_scale == RecordScale::None =>
        {
            Ok(Source::Records)
        }
        _ => {
            let message = format!(
                "needs its site: [check.{state}] with ag, F0 and TC; or ag with a spectrum and \
                 spectrum_damping; or ag, with records and record_scale = \"none\""
            );
            Err(refused(state, "ag", &message))
        }
    }
}

/// Returns the modes at each of some levels.
fn modes(building: &BuildingTable, levels: usize) -> Result<Vec<Vec<Mode>>, CheckError> {
    match (building.storeys, building.period, &building.height_ratio, &building.modes) {
        _ if building.is_ground() => Ok(vec![Vec::new(); levels]),
        (Some(storeys), Some(period), Some(height_ratio), None) => {
            let ratios = match height_ratio {
                HeightRatio::One(ratio) if levels == 1 || *ratio == 0.0 => vec![*ratio; levels],
                HeightRatio::Each(ratios) if ratios.len() == levels => ratios.clone(),
                HeightRatio::One(_) | HeightRatio::Each(_) => {
                    let given = if let HeightRatio::Each(ratios) = height_ratio { ratios.len() } else { 1 };
                    let message = format!(
                        "building: height_ratio has {given} of the {levels} z/H of hinge_levels; give a list \
                         with one for each, such as [0.0, 0.35], or the number 0 of a building on the ground"
                    );
                    return Err(CheckError::value(&["building", "height_ratio"], message));
                }
            };
            // with z/H = 0 the wall is on the ground
            let at = |ratio| (ratio > 0.0).then(|| Mode::of_storeys(storeys, period, ratio));
            Ok(ratios.into_iter().map(|ratio| at(ratio).into_iter().collect()).collect())
        }
        (None, None, None, Some(_)) if levels > 1 => {
            let message = "building: modes are those of one place; with several hinge_levels give storeys, \
                           period and a list height_ratio";
            Err(CheckError::value(&["building", "modes"], message))
        }
        (None, None, None, Some(modes)) if !modes.is_empty() => Ok(vec![modes.clone()]),
        _ => {
            let message = "building: give storeys, period and height_ratio, or modes = [{ period, \
                           participation }]";
            Err(CheckError::value(&["building", "modes"], message))
        }
    }
}

impl StateStatement {
    /// The modes of the table `[check.building]` at a level; `None` without that table.
    pub(crate) fn modes_at(&self, level: usize) -> Option<&[Mode]> {
        self.modes.get(level).map(Vec::as_slice)
    }

    /// Makes the spectrum of the code at the place of the wall, with these modes of the building; of the
    /// ground where there is none. `bounded` says that accelerations are not below that of the ground.
    ///
    /// # Errors
    /// [`CheckError::Value`] without a damping of the building, or of one that leaves no amplification.
    pub(crate) fn floor(
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
