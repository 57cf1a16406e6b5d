//! Records at the level of shaking of a limit state.

use scene::Floors;

use super::compatibility::{Compatibility, Ratios};
use crate::circolare::checks::sides::SideVerdict;
use crate::circolare::curve::case::Case;
use crate::circolare::statement::Statement;
use crate::circolare::statement::states::{Source, StateStatement};
use crate::circolare::statement::table::{Polarities, RecordScale};
use crate::code::Subject;
use crate::error::CheckError;
use crate::file::site::Level;
use crate::ntc::ground::G;

/// Shortest period at which records are held against the spectrum \[s\].
const SHORTEST: f64 = 0.15;

/// The factors and the building of a limit state, with what is to be said of them.
pub(crate) fn level(statement: &Statement, subject: Subject<'_>, name: &str) -> Result<Level, CheckError> {
    let given = statement.states.iter().flatten().find(|given| given.state.key() == name);
    let Some(given) = given else {
        let message = format!("{name} is not stated; give its ag, F0 and TC, or another of SLD, SLV and SLC");
        return Err(CheckError::value(&[name], message));
    };
    if statement.records.named.is_empty() {
        return Err(CheckError::value(
            &["records"],
            "there are no records; give --records, or [check.records]",
        ));
    }
    has_storeys(statement, subject.floors)?;
    let case = Case::new(statement, subject, 0)?;
    let mut longest = 0.0_f64;
    // only a scale by the spectrum asks how far it counts
    if statement.table.record_scale == RecordScale::Spectrum {
        for sign in case.sides() {
            let side = SideVerdict::new(&case, sign)?;
            longest = longest.max(side.displacement(given.state).map_or(0.0, |check| check.period));
        }
    }
    let (factors, compatibility) = scaled(&case, given, longest)?;
    let of_records = compatibility.iter().flat_map(|own| own.warnings(name, factors.iter().copied()));
    let of_rocking = statement.differs_in_rocking(subject.parameters);
    let warnings = of_rocking.into_iter().chain(of_records).map(|warning| warning.to_string()).collect();
    let both_signs = statement.table.polarities == Polarities::Both;
    let floors = subject.floors.map(|floors| floors.in_state(given.building_damping, given.building_period));
    Ok(Level { factors, floors: floors.transpose()?, both_signs, warnings })
}

/// Refuses runs of a wall whose height in the building only `[check.building]` states.
pub(crate) fn has_storeys(statement: &Statement, floors: Option<&Floors>) -> Result<(), CheckError> {
    if statement.building().is_some() && floors.is_none() {
        let message = "the records move the ground: give [[storeys]] in place of [check.building]";
        return Err(CheckError::value(&["building"], message));
    }
    Ok(())
}

/// The factors of the records, and their mean spectrum beside that of the ground; `longest` is `T_SLV` or
/// `T_SLC` \[s\].
pub(crate) fn scaled(
    case: &Case<'_>,
    given: &StateStatement,
    longest: f64,
) -> Result<(Vec<f64>, Option<Compatibility>), CheckError> {
    let statement = case.statement;
    let (records, scale) = (&statement.records, statement.table.record_scale);
    let Source::Code(ground) = &given.source else {
        if scale == RecordScale::None {
            return Ok((vec![1.0; records.named.len()], None));
        }
        let name = if scale == RecordScale::Ag { "ag" } else { "spectrum" };
        let message =
            format!("record_scale = {name:?} needs S of F0 and TC; give them, or record_scale = \"none\"");
        return Err(CheckError::value(&["record_scale"], message));
    };
    let first =
        case.floors.as_ref().map(|floors| given.building_period.unwrap_or(floors.storeys().periods()[0]));
    let range = statement.table.record_range;
    let range = range
        .unwrap_or([SHORTEST, [2.0, 2.0 * first.unwrap_or(0.0), longest].into_iter().fold(0.0, f64::max)]);
    let ratios = Ratios::new(records, ground, range)?;
    let factors: Vec<f64> = match scale {
        RecordScale::None => vec![1.0; records.named.len()],
        RecordScale::Ag => {
            let peak = given.ag * G * ground.s;
            records.named.iter().map(|record| peak / record.motion.peak()).collect()
        }
        RecordScale::Spectrum => ratios.factors(),
    };
    let compatibility = ratios.judged(&factors);
    Ok((factors, Some(compatibility)))
}
