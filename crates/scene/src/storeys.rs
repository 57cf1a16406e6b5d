//! Storeys between ground and wall: the record shakes the ground, the wall feels the floors.
//!
//! The storeys move as if there were no wall (cascade), which suits walls of up to a twentieth of the mass of
//! their floors.

use std::f64::consts::TAU;

use files::{FileError, Place, tables};
use ground_motion::{GroundMotion, GroundMotionError, Storey, Storeys};
use rocking_wall::choices::Mechanism;
use rocking_wall::simulation::Excitation;
use rocking_wall::wall::{Usual, Wall, Warning};
use toml::Spanned;

use crate::error::SceneError;

/// Damping ratio of a storey that states none (-).
const DAMPING: f64 = 0.05;
/// Largest ratio of a wall's mass to that of its floor that needs no warning.
pub const LIGHT: f64 = 1.0 / 20.0;

tables! {
    /// A storey: a floor, and the spring below it.
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    pub struct StoreyTable {
        /// Mass of the floor \[kg\]; not needed for a single storey with a period.
        #[key(exclusiveMinimum = 0)]
        pub mass: Option<f64>,
        /// Lateral stiffness of the storey \[N/m\].
        #[key(exclusiveMinimum = 0)]
        pub stiffness: Option<f64>,
        /// Period that the storey alone would have on the ground \[s\], instead of the stiffness.
        #[key(exclusiveMinimum = 0)]
        pub period: Option<f64>,
        /// Damping ratio (-).
        #[key(default = DAMPING)]
        pub damping_ratio: Option<f64>,
    }

    /// The floors that a wall stands on and leans on, counted from 1; 0 is the ground.
    #[derive(Clone, Copy, Debug, Default)]
    pub struct SupportsTable {
        /// Floor that the wall stands on: by default the roof, for a strip wall the floor below the roof.
        pub bottom: Option<usize>,
        /// Floor that a strip wall leans on: by default the one above the bottom.
        pub top: Option<usize>,
        /// Whether the drift between the supports acts on a strip wall.
        #[key(default = true)]
        pub drift: Option<bool>,
    }
}

/// Storeys, and the floors that support a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Floors {
    storeys: Storeys,
    /// The tables as they were given: a single storey may have a period alone, and no mass.
    tables: Vec<StoreyTable>,
    bottom: Option<usize>,
    top: Option<usize>,
    drift: bool,
}

/// A wall that is heavy beside a floor that supports it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the wall has {ratio:.2} of the mass of its floor, which moves as if there were no wall; above {LIGHT} \
     use `wall building`, whose walls act on the floors"
)]
pub struct HeavyWall {
    /// Its mass over that of the floor \[-\].
    pub ratio: f64,
}

impl Floors {
    /// Makes storeys from their tables; `supports` says which floors support the wall.
    ///
    /// # Errors
    /// What is wrong and the remedy, with the index of the storey where there is one.
    pub fn new(tables: &[StoreyTable], supports: SupportsTable) -> Result<Self, (Option<usize>, String)> {
        let single = tables.len() == 1;
        let storey = |(index, table): (usize, &StoreyTable)| {
            let StoreyTable { mass, stiffness, period, damping_ratio } = *table;
            let refused = |message: &str| (Some(index), message.to_owned());
            let mass = mass.or((single && stiffness.is_none()).then_some(1.0));
            let mass = mass.ok_or_else(|| refused("a storey needs a mass [kg]"))?;
            let stiffness = match (stiffness, period) {
                (Some(stiffness), None) => stiffness,
                // k = m (2π/T)²
                (None, Some(period)) if period > 0.0 => mass * (TAU / period) * (TAU / period),
                (None, Some(_)) => return Err(refused("the period of a storey must be above 0 s")),
                _ => return Err(refused("a storey needs either a stiffness [N/m] or a period [s]")),
            };
            Ok(Storey { mass, stiffness, damping_ratio: damping_ratio.unwrap_or(DAMPING) })
        };
        let storeys = tables.iter().enumerate().map(storey).collect::<Result<Vec<_>, _>>()?;
        let storeys = Storeys::new(&storeys).map_err(|error| (None, error.to_string()))?;
        let SupportsTable { bottom, top, drift } = supports;
        let highest = tables.len();
        if let Some(floor) = bottom.into_iter().chain(top).find(|floor| *floor > highest) {
            return Err((None, format!("there is no floor {floor}; floors count from 1 to {highest}")));
        }
        Ok(Self { storeys, tables: tables.to_vec(), bottom, top, drift: drift.unwrap_or(true) })
    }

    /// Returns the storeys.
    pub fn storeys(&self) -> &Storeys {
        &self.storeys
    }

    /// Returns the storeys in another state of the building: with a damping ratio of every mode, and another
    /// first period \[s\], with stiffnesses in proportion.
    ///
    /// # Errors
    /// [`SceneError::Value`] of a number that storeys cannot have.
    pub fn in_state(&self, damping_ratio: Option<f64>, period: Option<f64>) -> Result<Self, SceneError> {
        let softer = period.map_or(1.0, |period| self.storeys.periods()[0] / period);
        let storey = |storey: &Storey| Storey {
            stiffness: storey.stiffness * softer * softer,
            damping_ratio: damping_ratio.unwrap_or(storey.damping_ratio),
            ..*storey
        };
        let storeys: Vec<_> = self.storeys.storeys().iter().map(storey).collect();
        let storeys =
            Storeys::new(&storeys).map_err(|error| SceneError::Value { message: error.to_string() })?;
        Ok(Self { storeys, ..self.clone() })
    }

    /// Returns the same storeys below a wall that stands some floors above the stated one.
    ///
    /// # Errors
    /// [`SceneError::Value`] where no floor is stated, and above the highest.
    pub fn raised(&self, by: usize) -> Result<Self, SceneError> {
        let refused = |message: String| Err(SceneError::Value { message });
        let highest = self.storeys.storeys().len();
        match self.bottom {
            _ if by == 0 => Ok(self.clone()),
            None => refused(
                "[supports] bottom is missing: state the floor at the first level, 0 for the ground; each \
                 further level is a floor higher"
                    .to_owned(),
            ),
            Some(bottom) if bottom + by > highest => refused(format!(
                "level {} is at floor {} of {highest}: [supports] bottom = {bottom} is the floor at the \
                 first level, and each further level is a floor higher",
                by + 1,
                bottom + by
            )),
            Some(bottom) => Ok(Self { bottom: Some(bottom + by), ..self.clone() }),
        }
    }

    /// Returns the damping ratios that the storeys state.
    pub fn stated_damping(&self) -> impl Iterator<Item = f64> {
        self.tables.iter().filter_map(|table| table.damping_ratio)
    }

    /// Returns the floors at the bottom and, for a strip wall, at the top.
    ///
    /// # Errors
    /// [`SceneError::Value`] where a parapet has a top, or a strip wall no floor above its bottom.
    pub fn supports(&self, mechanism: Mechanism) -> Result<(usize, Option<usize>), SceneError> {
        let highest = self.storeys.storeys().len();
        let refused = |message: &str| Err(SceneError::Value { message: message.into() });
        match (mechanism, self.top) {
            (Mechanism::Parapet | Mechanism::RigidBody, None) => Ok((self.bottom.unwrap_or(highest), None)),
            (Mechanism::Parapet | Mechanism::RigidBody, Some(_)) => {
                refused("[supports] top: a parapet has no top support; leave it out")
            }
            (Mechanism::VerticalSpanning, top) => {
                let bottom = self.bottom.or(top.map(|top| top.saturating_sub(1))).unwrap_or(highest - 1);
                let top = top.unwrap_or(bottom + 1);
                if top > highest {
                    return refused("[supports]: a strip wall on the roof leans on nothing; state its top");
                }
                Ok((bottom, Some(top)))
            }
        }
    }

    /// Computes the motion of a wall's supports under a motion of the ground, up to `end` \[s\].
    ///
    /// # Errors
    /// [`SceneError::Value`] where the floors cannot support this kind of wall, or the motion takes
    /// too many samples.
    pub fn motion(
        &self,
        mechanism: Mechanism,
        ground: &Excitation,
        end: f64,
    ) -> Result<Excitation, SceneError> {
        let refused = |message: String| SceneError::Value { message };
        if ground.top().is_some() || ground.is_held() {
            let message = "storeys take one motion of the ground, linear between its samples; leave out \
                           [motion.top] and --hold";
            return Err(refused(message.into()));
        }
        let ground = ground.bottom();
        let failed = |error: GroundMotionError| refused(format!("storeys: {error}"));
        let floor = |floor: usize| {
            if floor == 0 {
                return Ok((ground.clone(), Vec::new()));
            }
            let motion = self.storeys.floor(ground, end, floor)?;
            Ok((motion.acceleration, motion.displacement))
        };
        let (bottom, top) = self.supports(mechanism)?;
        let (acceleration, below) = floor(bottom).map_err(failed)?;
        let Some(top) = top.filter(|top| *top != bottom) else {
            return Ok(Excitation::new(acceleration, None));
        };
        let (above_acceleration, above) = floor(top).map_err(failed)?;
        let step = [&acceleration, &above_acceleration].map(GroundMotion::step);
        let motion = Excitation::new(acceleration, Some(above_acceleration));
        if !self.drift {
            return Ok(motion);
        }
        let count = below.len().max(above.len());
        let at = |floor: &[f64], index: usize| floor.get(index).copied().unwrap_or(0.0);
        let drift = (0..count).map(|index| at(&above, index) - at(&below, index)).collect();
        Ok(motion.with_drift(GroundMotion::new(step[0].min(step[1]), drift).map_err(failed)?))
    }

    /// Returns what a user should know of a wall on these storeys: improbable periods, and a wall that is
    /// heavy beside a floor that supports it.
    pub fn warnings(&self, wall: &Wall) -> impl Iterator<Item = String> {
        let heavy = self.heavy(wall).map(|heavy| heavy.to_string());
        self.improbable().map(|warning| warning.to_string()).chain(heavy)
    }

    /// Finds the periods of storeys that are improbable.
    pub fn improbable(&self) -> impl Iterator<Item = Warning> {
        let given = self.tables.iter().filter_map(|table| table.period);
        given.filter_map(|period| Usual::period("period of a storey").warning(period))
    }

    /// Returns a warning where the wall is heavy beside a floor that supports it.
    pub fn heavy(&self, wall: &Wall) -> Option<HeavyWall> {
        let (bottom, top) = self.supports(wall.body().mechanism).ok()?;
        let floors = [Some(bottom), top].into_iter().flatten().filter(|floor| *floor > 0);
        let least = floors.map(|floor| self.storeys.storeys()[floor - 1].mass).fold(f64::INFINITY, f64::min);
        let ratio = wall.body().mass / least;
        let has_masses = self.tables.iter().all(|table| table.mass.is_some());
        (has_masses && ratio > LIGHT).then_some(HeavyWall { ratio })
    }

    /// Describes the storeys in a few words, for the facts about a motion.
    pub fn note(&self) -> String {
        let periods: Vec<_> = self.storeys.periods().iter().take(3).map(|t| format!("{t:.3}")).collect();
        let storeys = self.storeys.storeys().len();
        let more = if storeys > 3 { " …" } else { "" };
        let name = if storeys == 1 { "a floor".to_owned() } else { format!("{storeys} storeys") };
        format!("felt on {name}, T = {}{more} s", periods.join(", "))
    }

    /// Writes the tables that read as these storeys.
    pub(crate) fn to_toml(&self) -> String {
        let mut text = String::from("\n[supports]\n");
        let floors = [("bottom", self.bottom), ("top", self.top)];
        text.extend(floors.iter().filter_map(|(name, floor)| Some(format!("{name} = {}\n", (*floor)?))));
        text.extend([format!("drift = {}\n", self.drift)]);
        for StoreyTable { mass, stiffness, period, damping_ratio } in &self.tables {
            text.push_str("\n[[storeys]]\n");
            let elastic = [("mass", mass), ("stiffness", stiffness), ("period", period)];
            let values = elastic.into_iter().chain([("damping_ratio", damping_ratio)]);
            text.extend(values.filter_map(|(name, value)| Some(format!("{name} = {:?}\n", (*value)?))));
        }
        text
    }
}

/// Reads `[[storeys]]` and `[supports]` of a scene or a study; `None` where there are none.
///
/// # Errors
/// [`FileError`] with the line of the storey.
pub fn read_floors(
    tables: &[Spanned<StoreyTable>],
    supports: Option<&Spanned<SupportsTable>>,
    place: &Place<'_>,
) -> Result<Option<Floors>, FileError> {
    let storeys: Vec<_> = tables.iter().map(|table| *table.get_ref()).collect();
    match (tables, supports) {
        ([], None) => Ok(None),
        ([], Some(supports)) => {
            let message = "[supports] name floors; add [[storeys]], or leave it out";
            Err(place.error(supports.span(), message))
        }
        ([first, ..], supports) => {
            let own = supports.map(|supports| *supports.get_ref()).unwrap_or_default();
            let floors = Floors::new(&storeys, own).map_err(|(index, message)| {
                let span = match (index, supports) {
                    (Some(index), _) => tables[index].span(),
                    (None, Some(supports)) => supports.span(),
                    (None, None) => first.span(),
                };
                place.error(span, message)
            })?;
            Ok(Some(floors))
        }
    }
}
