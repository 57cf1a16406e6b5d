//! A capacity curve as the force law: displacements and forces, from a file or a list.
//!
//! # Oscillators
//! `m_eff` and λ may stand in place of a geometry. They are then those of a rigid body with these integrals,
//! where k₀ is the slope at which the curve ends, and λ̄ = min(λ, 1/λ):
//!
//! ```text
//! m = λ̄ m_eff    z_G = m g/k₀    arm± = u_ins±    I + r z_r² = m_eff z_G²    m z_G + r z_r = λ m_eff z_G
//! ```
//!
//! For λ > 1 a mass r = (λ − 1/λ)(λ + 1) `m_eff` moves along at `z_r` = `z_G`/(λ + 1); otherwise r = 0.

use std::ops::Range;
use std::path::{Path, PathBuf};

use files::{FileError, TomlFile, names, read_text, tables};
use ground_motion::columns::{Columns, Fault, Measured, Name};
use rocking_wall::choices::Mechanism;
use rocking_wall::variables::GROUPS;
use rocking_wall::wall::{Body, COMPUTED, ParameterError, Parameters, Sides, Statics, check_points};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::keys::{Group, KINEMATICS_GROUP, MULTILINEAR};
use crate::law::Law;

/// Largest file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;
/// Most points that a law keeps.
const MOST_KEPT: usize = 500;
const DEFAULT_TOLERANCE: f64 = 0.001;
/// Heights of the centroid of a body that stands for an oscillator \[m\].
const CENTROIDS: [f64; 2] = [0.001, 400.0];

/// The parameter of a geometry that an oscillator has, too.
const GRAVITY: &str = "gravity";

const FORMS: &str = "a displacement and a force in each row, below a header such as `u [mm],F [kN]` or \
                     `d* [mm],a* [g]`";

tables! {
    /// A capacity curve, in place of the other keys of the force law.
    #[derive(Debug)]
    pub struct CurveTable {
        /// Capacity curve (CSV), beside the scene file: a displacement in the first column, and the force F,
        /// or d* and a*, with units in the header. Displacements below 0 are those of the other side.
        pub file: Option<PathBuf>,
        /// Capacity curve in place of a file: pairs of a displacement \[m\] and the force F \[N\].
        pub curve: Option<Vec<[f64; 2]>>,
        /// Height at which the displacements are measured \[m\]; by default they are u, and d* beside a*.
        #[key(exclusiveMinimum = 0, maximum = 1000)]
        pub at_height: Option<f64>,
        /// Largest deviation of the law from the curve, over the largest force \[-\]; by default 0.001.
        #[key(minimum = 0, maximum = 0.1)]
        pub curve_tolerance: Option<f64>,
        /// What rocks, in place of a geometry.
        pub oscillator: Option<OscillatorTable>,
    }

    /// The constants of an oscillator; φ is its shape, 1 where u is measured.
    #[derive(Debug, Clone, Copy)]
    pub struct OscillatorTable {
        /// Effective mass `m_eff` = Σmφ² \[kg\].
        #[key(minimum = 0.001, maximum = 1e9)]
        pub effective_mass: f64,
        /// Participation λ = Σmφ/Σmφ² \[-\].
        #[key(minimum = 0.01, maximum = 10)]
        pub participation: f64,
    }
}

/// A capacity curve as it was given, and what the law keeps of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its file.
    pub file: Option<PathBuf>,
    /// Points [u, F] of the wall, the origin among them, u rising \[m, N\].
    pub points: Vec<[f64; 2]>,
    /// How many of them the law keeps, and how far it is from the others.
    short: String,
    /// Where it is farthest from them, and how it goes on.
    rest: String,
    /// What is improbable of the curve on its wall.
    pub doubts: Vec<String>,
    /// Whether an oscillator has it, in place of a geometry.
    pub is_of_oscillator: bool,
    /// F₀ \[N\] and `u_ins` \[m\] whose fractions its points became.
    scales: [Sides; 2],
}

impl Curve {
    /// Returns how many of its points the law keeps, how far it is from the others, how it goes on, and the
    /// doubts.
    pub fn note(&self) -> String {
        let kept = format!("{}{}", self.short, self.rest);
        let told = std::iter::once(&kept).chain(&self.doubts).filter(|words| !words.is_empty());
        told.map(String::as_str).collect::<Vec<_>>().join("; ")
    }

    /// Returns how many of its points the law keeps, and how far it is from the others.
    pub fn short_note(&self) -> &str {
        &self.short
    }

    /// Returns what says that these parameters are those of an oscillator, without the points of its curve.
    ///
    /// # Errors
    /// [`ParameterError`] of parameters that make no wall.
    pub fn of_oscillator(parameters: &Parameters) -> Result<Self, ParameterError> {
        let scales = scales(Statics::new(parameters)?.body());
        let (short, rest) = ("sent without its points".to_owned(), String::new());
        let (points, doubts) = (Vec::new(), Vec::new());
        Ok(Self { file: None, points, short, rest, doubts, is_of_oscillator: true, scales })
    }

    /// Refuses the name of a parameter that no oscillator has, if this is the curve of one.
    ///
    /// # Errors
    /// The message.
    pub fn refuse(&self, name: &str) -> Result<(), String> {
        if !self.is_of_oscillator || is_of_oscillator(name) {
            return Ok(());
        }
        Err(format!("{name} is that of a wall, and no oscillator has it; change `oscillator` in its file"))
    }

    /// Returns what is left of it after a change of the parameters: nothing with another force law, and
    /// without points to compare where F₀ or `u_ins` changed, with which the law is scaled.
    #[must_use]
    pub fn after_change(mut self, parameters: &Parameters) -> Option<Self> {
        parameters.multilinear.as_ref()?;
        let scales = Statics::new(parameters).map(|statics| scales(statics.body()));
        if scales.is_ok_and(|scales| scales != self.scales) {
            let scaled = "the curve is scaled with F0 and u_ins, which were changed after it was read, as by \
                          --set or cells of a table; not drawn";
            (self.short, self.rest) = (String::new(), String::new());
            (self.points, self.doubts) = (Vec::new(), vec![scaled.to_owned()]);
        }
        Some(self)
    }
}

/// Returns whether an oscillator has the parameter called `name`: those of a geometry are not its own.
pub fn is_of_oscillator(name: &str) -> bool {
    let geometry = GROUPS.iter().find(|(group, _)| *group == KINEMATICS_GROUP);
    name == GRAVITY || geometry.is_some_and(|(_, names)| !names.contains(&name))
}

fn scales(body: &Body) -> [Sides; 2] {
    [body.strength, body.instability]
}

/// Makes the force law of a capacity curve, if `[force_law]` states one. All tables have been applied;
/// `geometry` is one of them, and files are looked up in `folder`.
///
/// # Errors
/// [`FileError`] of a key, or of a row that no force law can have.
pub fn apply_curve(
    parameters: &mut Parameters,
    [force_law, geometry]: [&Group; 2],
    file: &TomlFile<'_>,
    folder: &Path,
) -> Result<Option<Curve>, FileError> {
    let Some((table, span)) = stated(force_law, geometry, file)? else { return Ok(None) };
    let place = file.place();
    let refused = |message: String| place.error(span.clone(), message);
    let path = table.file.map(|path| folder.join(path));
    let written = match (&path, table.curve) {
        (Some(path), None) => Written::read(path)?,
        (None, Some(points)) => Written {
            lines: vec![place.line(span.clone()); points.len()],
            points,
            units: [1.0; 2],
            is_spectral: false,
            file: place.name().to_owned(),
            header: None,
        },
        _ => {
            let message = "a capacity curve is one of file = \"FILE\" and curve = [[u, F], …]; give one";
            return Err(refused(message.to_owned()));
        }
    };
    written.refuse_mixture(table.at_height)?;
    let body = |parameters: &Parameters| match Statics::new(parameters) {
        Ok(statics) => Ok(statics.body().clone()),
        Err(error) => Err(refused(error.to_string())),
    };
    let points = if let Some(constants) = table.oscillator {
        written.of_wall(constants, None)?
    } else {
        let body = body(parameters)?;
        let lever = table.at_height.map(|height| body.lever(height));
        if lever.is_some_and(|lever| lever <= 0.0) || table.at_height > Some(body.height) {
            let top = body.height;
            return Err(refused(format!(
                "at_height is not on the wall, or does not move; the top is at {top} m"
            )));
        }
        let Body { effective_mass, participation, .. } = body;
        written.of_wall(OscillatorTable { effective_mass, participation }, lever)?
    };
    let law = Law::new(points, table.curve_tolerance.unwrap_or(DEFAULT_TOLERANCE));
    if law.kept.len() > MOST_KEPT {
        let count = law.kept.len();
        return Err(refused(format!("the law keeps {count} points, not {MOST_KEPT}; raise curve_tolerance")));
    }
    if let Some(constants) = table.oscillator {
        stand_in(parameters, constants, &law);
    }
    let scaled_by = body(parameters)?;
    parameters.multilinear = Some(law.fractions(&scaled_by).into());
    body(parameters)?;
    let is_of_oscillator = table.oscillator.is_some();
    let doubts = match table.oscillator {
        None => law.doubts(&scaled_by),
        Some(OscillatorTable { effective_mass, participation }) => {
            law.doubts_of_oscillator(effective_mass * participation * parameters.gravity)
        }
    };
    let (short, rest, scales) = (law.short_note(), law.rest_of_note(), scales(&scaled_by));
    Ok(Some(Curve { file: path, points: law.points, short, rest, doubts, is_of_oscillator, scales }))
}

/// Reads the keys of a capacity curve with their place, and refuses others beside them.
fn stated(
    force_law: &Group,
    geometry: &Group,
    file: &TomlFile<'_>,
) -> Result<Option<(CurveTable, Range<usize>)>, FileError> {
    let (keys, place) = (names::<CurveTable>(), file.place());
    let mut table = DeTable::new();
    let mut other = None;
    for (key, value) in force_law.iter() {
        let name = key.get_ref().as_str();
        if keys.contains(&name) {
            let own = file.find(name, &value.span()).cloned();
            table.extend(own.map(|own| (Spanned::new(key.span(), name.to_owned().into()), own)));
        } else if value.get_ref().as_str() != Some(MULTILINEAR) {
            other = Some((key, "another force law"));
        }
    }
    let Some(span) = table.keys().map(Spanned::span).min_by_key(|span| span.start) else { return Ok(None) };
    let table = file.read_value(&Spanned::new(span.clone(), DeValue::Table(table)));
    let table: CurveTable = table.map_err(|fault| place.error(fault.span, fault.message))?;
    if table.oscillator.is_some() {
        let of_wall = geometry.keys().find(|key| key.get_ref() != GRAVITY);
        let of_wall = of_wall.or(force_law.keys().find(|key| key.get_ref() == "at_height"));
        other = other.or(of_wall.map(|key| (key, "a wall, and no oscillator has it")));
    }
    match other {
        None => Ok(Some((table, span))),
        Some((key, whose)) => {
            let message = format!("{} is that of {whose}; leave one of them out", key.get_ref());
            Err(place.error(key.span(), message))
        }
    }
}

/// The points of a curve as they are written.
struct Written {
    points: Vec<[f64; 2]>,
    /// SI values of the units of both numbers, and whether the second is an acceleration.
    units: [f64; 2],
    is_spectral: bool,
    file: String,
    /// The name above the displacements and its line, of a file.
    header: Option<(String, usize)>,
    /// The line of each point.
    lines: Vec<usize>,
}

impl Written {
    fn read(path: &Path) -> Result<Self, FileError> {
        let text = read_text(path, "a capacity curve (CSV)", MAX_FILE_BYTES)?;
        let file = ground_motion::shown_path(path);
        let read = Self::of_text(text.trim_start_matches('\u{feff}'), &file);
        read.map_err(|fault| FileError::on_line(file, fault.line(), fault.to_string()))
    }

    fn of_text(text: &str, file: &str) -> Result<Self, Fault> {
        let is_length = |name: &Name| matches!(name.measured(), Some(Measured::Length(_)));
        let columns = Columns::of_numbers(text, is_length, FORMS)?;
        let (_, length) = columns.measuring(0..1, "displacements in m, cm or mm", |of| match of {
            Measured::Length(unit) => Some(unit),
            Measured::Force(_) | Measured::Acceleration(_) => None,
        })?;
        let forces = "forces in N, kN or MN, or of accelerations in m/s2 or g, beside the first";
        let (force, unit) = columns.measuring(1..columns.width(), forces, |of| match of {
            Measured::Force(unit) | Measured::Acceleration(unit) => Some(unit),
            Measured::Length(_) => None,
        })?;
        let is_spectral = matches!(columns.names()[force].measured(), Some(Measured::Acceleration(_)));
        let (mut points, mut lines) = (Vec::new(), Vec::new());
        columns.read(force, |u, force, line| {
            points.push([u, force]);
            lines.push(line);
            Ok(())
        })?;
        let header = Some((columns.names()[0].text().to_owned(), columns.line()));
        Ok(Self { points, units: [length, unit], is_spectral, file: file.to_owned(), header, lines })
    }

    /// Refuses a name of the displacements that says another thing than how they would be read.
    fn refuse_mixture(&self, at_height: Option<f64>) -> Result<(), FileError> {
        let Some((name, line)) = &self.header else { return Ok(()) };
        let reason = match (name.as_str(), self.is_spectral, at_height) {
            ("d*", _, Some(_)) => "d* is not measured at a height; leave at_height out, or name them d or u",
            ("d*", false, None) => "d* goes with accelerations a*; beside forces give u, which is λ d*",
            ("u", true, None) => {
                "beside accelerations they would be read as d* = u/λ; name them d*, give forces beside u, or \
                 give the at_height where u was measured"
            }
            _ => return Ok(()),
        };
        Err(FileError::on_line(&*self.file, *line, format!("the displacements are named {name}: {reason}")))
    }

    /// Returns the points as u \[m\] and F \[N\] of Eq. (12), of displacements `lever` u; without the origin.
    fn of_wall(mut self, constants: OscillatorTable, lever: Option<f64>) -> Result<Vec<[f64; 2]>, FileError> {
        let refused = |written: &Self, at: usize, reason: &str| {
            let [u, force] = written.points.get(at).copied().unwrap_or_default();
            let line = written.lines.get(at).or(written.lines.last()).copied().unwrap_or(1);
            Err(FileError::on_line(&*written.file, line, format!("[{u}, {force}] of the curve: {reason}")))
        };
        if let Some(zero) = self.points.iter().position(|point| point[0] == 0.0) {
            if self.points[zero][1] != 0.0 {
                let reason = "a curve begins at the origin; give the small displacement at which this force \
                              is reached, or force_law = \"rigid_linear\" in place of a curve";
                return refused(&self, zero, reason);
            }
            self.points.remove(zero);
            self.lines.remove(zero);
        }
        if let Err(ParameterError::Points { number, reason, .. }) = check_points(&self.points) {
            return refused(&self, number - 1, reason);
        }
        let OscillatorTable { effective_mass, participation } = constants;
        // d* = u/λ, a* = F/(λ m_eff)
        let [u, force] =
            if self.is_spectral { [participation, participation * effective_mass] } else { [1.0; 2] };
        let scales = [lever.map_or(u, |lever| 1.0 / lever) * self.units[0], force * self.units[1]];
        Ok(self.points.iter().map(|point| [point[0] * scales[0], point[1] * scales[1]]).collect())
    }
}

/// Sets the rigid body that stands for an oscillator.
fn stand_in(parameters: &mut Parameters, constants: OscillatorTable, law: &Law) {
    let OscillatorTable { effective_mass, participation } = constants;
    let mut ends = law.ends().map(|end| (end.u, -end.slope));
    let (arm, slope) = ends.next().unwrap_or_default();
    let p = parameters;
    p.body_mass = effective_mass * participation.min(1.0 / participation);
    let z = (p.body_mass * p.gravity / slope).clamp(CENTROIDS[0], CENTROIDS[1]);
    p.mechanism = Mechanism::RigidBody;
    (p.height, p.centroid_height) = (2.0 * z, z);
    (p.arm, p.arm_inner) = (arm, ends.next().map_or(COMPUTED, |(arm, _)| arm));
    p.load_mass = (effective_mass * (participation - 1.0 / participation) * (participation + 1.0)).max(0.0);
    p.load_mass_height = if p.load_mass > 0.0 { z / (participation + 1.0) } else { 0.0 };
    p.load_inertia = p.load_mass * p.load_mass_height * p.load_mass_height;
    p.inertia = effective_mass * z * z - p.load_inertia;
}
