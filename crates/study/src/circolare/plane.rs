//! The a(d) plane of a check: the curve of a side over what its limit states demand.

use std::f64::consts::TAU;

use rocking_wall::scene::Floors;
use rocking_wall::wall::{Parameters, Wall};

use super::checks::demand;
use super::demand::Demand;
use super::error::CheckError;
use super::statement::Statement;
use super::verdict::{DisplacementCheck, Side, SideVerdict, Verdict};
use super::{LimitState, Records};

/// Points of a demand.
const POINTS: u32 = 160;
/// Longest period of the demands over the longest of the limit states \[-\].
const REACH: f64 = 2.0;

/// What is drawn of one side.
#[derive(Clone, Debug)]
pub struct Plane {
    /// The side.
    pub side: Side,
    /// Corners (d, a) of the curve, with FC and the tie \[m, m/s²\].
    pub capacity: Vec<(f64, f64)>,
    /// The checks by displacement.
    pub states: Vec<PlaneState>,
}

/// What is drawn of a check by displacement.
#[derive(Clone, Debug)]
pub struct PlaneState {
    /// The limit state.
    pub state: LimitState,
    /// Its numbers.
    pub check: DisplacementCheck,
    /// Points (`S_d`, `S_e`) of the demand over periods that rise from 0 \[m, m/s²\].
    pub demand: Vec<(f64, f64)>,
}

impl Plane {
    /// Lays the curve of the side that governs over the demands of SLV and SLC.
    ///
    /// ```
    /// use rocking_wall::scene::Place;
    /// use rocking_wall::wall::Parameters;
    /// use study::circolare::{Plane, Records, check, read_table};
    ///
    /// let text = r#"
    /// [check]
    /// code = "circolare-2019"
    /// before_activation = "rigid"
    /// soil = "B"
    /// SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
    /// "#;
    /// let statement = read_table(&Place::new("scene.toml", text))?.unwrap().statement()?;
    /// let (wall, records) = (Parameters::default(), Records::default());
    /// let verdict = check(&wall, None, &statement, &records)?;
    /// let plane = Plane::new(&wall, None, &statement, &records, &verdict)?;
    /// // at T = 0 the ground demands a_g S
    /// assert_eq!(plane.states[0].demand[0].0, 0.0);
    /// assert!((plane.states[0].demand[0].1 - 1.7658).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckError`] of a record, or of a floor that is not there.
    pub fn new(
        parameters: &Parameters,
        floors: Option<&Floors>,
        statement: &Statement,
        records: &Records,
        verdict: &Verdict,
    ) -> Result<Self, CheckError> {
        let wall = Wall::new(parameters)?;
        let governing = verdict.governs.side;
        let mut sides = verdict.sides.iter();
        let Some((_, shown)) = sides.find(|(side, _)| *side == governing) else {
            return Err(CheckError::wall("the wall rocks to no side"));
        };
        let checks = || shown.displacement_checks();
        let longest = REACH * checks().map(|(_, check)| check.period).fold(0.0, f64::max);
        let mut states = Vec::new();
        for (state, check) in checks() {
            if let Some(given) = statement.state(state) {
                let demand = demand(given, floors, &wall, records)?;
                let demand = demand.drawn(state, longest, given.damping);
                states.push(PlaneState { state, check, demand });
            }
        }
        Ok(Self { side: governing, capacity: shown.corners.clone(), states })
    }
}

impl SideVerdict {
    fn displacement_checks(&self) -> impl Iterator<Item = (LimitState, DisplacementCheck)> {
        let checks = [(LimitState::Slv, self.slv), (LimitState::Slc, self.slc)];
        checks.into_iter().filter_map(|(state, check)| Some((state, check?)))
    }
}

impl Demand {
    /// Points (`S_d`, `S_e`) up to a period, or to the end of a spectrum that ends before \[m, m/s²\].
    fn drawn(&self, state: LimitState, longest: f64, xi: f64) -> Vec<(f64, f64)> {
        let mut points = Vec::new();
        for index in 0..=POINTS {
            // closer at short periods, where the acceleration changes most
            let period = longest * (f64::from(index) / f64::from(POINTS)).powi(2);
            let acceleration = match self {
                Self::Ground(ground) => Ok(ground.pseudo_acceleration(period, xi)),
                _ => self.acceleration(state, period, xi),
            };
            match acceleration {
                Ok(acceleration) => points.push((acceleration * (period / TAU).powi(2), acceleration)),
                Err(_) => break,
            }
        }
        points
    }
}
