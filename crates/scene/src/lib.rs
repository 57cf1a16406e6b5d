#![doc = include_str!("../README.md")]
//!
//! # Tables of a scene
//! The tables `[geometry]`, `[force_law]`, `[damping]`, `[impact]`, `[tie]`, `[start]` and `[solver]` hold
//! the parameters of the model description under the same names; `[motion]` says what moves the supports, or
//! the ground below `[[storeys]]`, and `[supports]` between which of these the wall stands. `[check]` is read
//! by whoever checks. An FMU made from a scene carries what its unit needs of it as bytes:
//! [`UnitScene`](rocking_wall::unit::UnitScene).

mod body;
mod curve;
mod document;
mod error;
mod keys;
mod law;
mod motion;
mod parameter;
pub mod response;
mod schema;
mod shocks;
mod storeys;
mod writing;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use files::{FileError, TomlFile, check_value, read_text};
use fmu_export::VariableId;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::{BooleanVariable, Mechanism, RealVariable};
use rocking_wall::wall::{Kinematics, Parameters, Wall, Warning, usage};

pub use body::{BODIES, BodyTable, LoadTable, OF_BODY, OpeningTable, PartTable};
pub use curve::{Curve, CurveTable, apply_curve, is_of_oscillator};
pub use document::{Document, read_shape};
pub use keys::{Group, KINEMATICS, POINTS, TieTables};
pub use motion::{DEFAULT_TAIL, LONGEST_TAIL};
pub use motion::{HarmonicTable, MotionTable, RickerTable, SineTable, SyntheticTable};
pub use parameter::{input_names, parameter_text, set_names};
pub use rocking_wall::variables::GROUPS;
pub use shocks::{RecordProblem, RecordTable, Shocks, fingerprint};
pub use storeys::{Floors, HeavyWall, LIGHT, StoreyTable, SupportsTable};

pub use error::SceneError;
pub use parameter::{apply_group, apply_tables, check_limits};
pub use schema::{BarTable, parameter, parameters, variable};
pub use storeys::read_floors;
pub use writing::to_toml;

/// A wall, the motion of its supports, and the length of the run.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Title, for people.
    pub title: String,
    /// The wall and its solver.
    pub parameters: Parameters,
    /// The capacity curve that the force law follows, where it was given.
    pub curve: Option<Curve>,
    /// What moves the supports, or the ground below the storeys; `None` for free vibration or for motion that
    /// comes through inputs.
    pub excitation: Option<Excitation>,
    /// Storeys between ground and wall.
    pub floors: Option<Floors>,
    /// Inputs that stay variables of the scene's FMU.
    pub inputs: Vec<RealVariable>,
    /// End of the run \[s\].
    pub stop_time: f64,
    /// Step of the output \[s\].
    pub output_step: f64,
    /// Fractions of `u_ins` whose first crossings are reported.
    pub thresholds: Vec<f64>,
    /// Facts about the motion worth showing: source, scale, peak.
    pub motion_notes: Vec<String>,
    /// Files that the motion and the force law were read from.
    pub files: Vec<PathBuf>,
}

impl Default for Scene {
    /// The defaults of the model description: released by hand, without motion.
    fn default() -> Self {
        Self {
            title: "Free rocking of the default parapet".into(),
            parameters: Parameters::default(),
            curve: None,
            excitation: None,
            floors: None,
            inputs: vec![RealVariable::AG],
            stop_time: 30.0,
            output_step: DEFAULT_OUTPUT_STEP,
            thresholds: DEFAULT_THRESHOLDS.to_vec(),
            motion_notes: Vec::new(),
            files: Vec::new(),
        }
    }
}

/// Limit states of a scene that states none, as fractions of `u_ins`.
pub const DEFAULT_THRESHOLDS: [f64; 4] = [0.1, 0.4, 0.6, 1.0];
/// Most limit states.
pub const MOST_THRESHOLDS: u32 = 100;

/// Output step of a scene without motion \[s\].
const DEFAULT_OUTPUT_STEP: f64 = 0.01;
/// Longest run \[s\]; a longer one is a typing error, like a longer step or more points of output.
pub const LONGEST_RUN: f64 = 1e7;
/// Longest step of the output \[s\].
const LONGEST_OUTPUT_STEP: f64 = 1e3;
const MOST_POINTS: f64 = 2e7;

impl Scene {
    /// Returns whether an oscillator rocks, in place of a geometry.
    pub fn is_of_oscillator(&self) -> bool {
        self.curve.as_ref().is_some_and(|curve| curve.is_of_oscillator)
    }

    /// Returns the warnings of its wall; that of large rotations is none of an oscillator, which does not
    /// rotate.
    pub fn warnings_of<'a>(&self, wall: &'a Wall) -> impl Iterator<Item = &'a Warning> + use<'a> {
        let is_of_oscillator = self.is_of_oscillator();
        let is_told = move |warning: &&Warning| {
            !(is_of_oscillator && matches!(warning, Warning::LargeRotations { .. }))
        };
        wall.warnings().iter().filter(is_told)
    }

    /// Returns what is improbable of its capacity curve.
    pub fn doubts(&self) -> &[String] {
        self.curve.as_ref().map_or(&[], |curve| &curve.doubts)
    }

    /// Reads a scene file; records it names are looked up beside it.
    ///
    /// # Errors
    /// [`SceneError`], with file, line, value and remedy.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        Self::parse(&name, &Self::text(path)?, path.parent().unwrap_or(Path::new(".")))
    }

    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// [`FileError`] of a file that cannot be read, is too large, is not UTF-8 or says nothing.
    pub fn text(path: &Path) -> Result<String, FileError> {
        let text = read_text(path, "a scene file (TOML)", document::MAX_FILE_BYTES)?;
        if text.lines().any(|line| !matches!(line.trim_ascii_start().bytes().next(), None | Some(b'#'))) {
            return Ok(text);
        }
        let reason = "is empty or has comments alone; state the wall, as in `geometry.height = 3`, or give \
                      no file for the default wall";
        Err(FileError::whole(ground_motion::shown_path(path), reason))
    }

    /// Reads a scene from its text; `name` stands for the file in messages, records are looked up in
    /// `folder`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn parse(name: &str, text: &str, folder: &Path) -> Result<Self, SceneError> {
        Self::of(&TomlFile::new(name, text)?, folder)
    }

    /// Reads a scene from a file that is parsed already; records are looked up in `folder`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn of(file: &TomlFile<'_>, folder: &Path) -> Result<Self, SceneError> {
        let (document, place): (Document, _) = (file.read()?, file.place());
        let floors = read_floors(&document.storeys, document.supports.as_ref(), place)?;
        let title = document.title.clone().unwrap_or_else(|| name_of(place.name()));
        let mut scene = Self { title, floors, ..Self::default() };
        if let Some(table) = &document.motion {
            let loaded = motion::load(table, place, folder, scene.floors.is_some())?;
            scene.shake(loaded.excitation, loaded.tail, loaded.notes);
            scene.files = loaded.records;
        }
        if document.inputs.is_some() {
            scene.inputs = document.inputs(place)?;
            if !scene.inputs.is_empty() {
                // a coupled wall starts upright like a shaken one, unless the scene says otherwise
                scene.parameters.u_start = 0.0;
            }
        }
        scene.curve = apply_tables(&mut scene.parameters, &document.groups(), &document.tie, file, folder)?;
        scene.files.extend(scene.curve.iter().filter_map(|curve| curve.file.clone()));
        if let Some(given) = &document.thresholds {
            scene.thresholds.clone_from(given);
        }
        scene.stop_time = document.stop_time.unwrap_or(scene.stop_time);
        scene.output_step = document.output_step.unwrap_or(scene.output_step);
        match (&document.motion, scene.moved_apart(scene.excitation.as_ref())) {
            (Some(table), Some(message)) => Err(place.error(table.span(), message).into()),
            _ => Ok(scene),
        }
    }

    /// Sets one parameter by name from text, as `--set xi=0.03` does.
    ///
    /// # Errors
    /// [`SceneError::Value`] naming the variable, the value and the limit.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), SceneError> {
        parameter::set_from_text(&mut self.parameters, &mut self.curve, name, text)
    }

    /// Sets how long the scene runs, the step of its output \[s\] and its limit states, those that are given.
    ///
    /// # Errors
    /// [`SceneError::Value`] naming the value and its limit.
    ///
    /// ```
    /// # use scene::Scene;
    /// let error = Scene::default().set_output(Some(0.0), None, None).unwrap_err();
    /// assert!(error.to_string().starts_with("stop_time = 0 must be above 0 and at most 1e7: End"));
    /// ```
    pub fn set_output(
        &mut self,
        stop_time: Option<f64>,
        output_step: Option<f64>,
        thresholds: Option<Vec<f64>>,
    ) -> Result<(), SceneError> {
        let refused = |message| SceneError::Value { message };
        for (key, given, own) in [
            ("stop_time", stop_time, &mut self.stop_time),
            ("output_step", output_step, &mut self.output_step),
        ] {
            if let Some(given) = given {
                check_value::<Document>(key, given).map_err(refused)?;
                *own = given;
            }
        }
        if let Some(given) = thresholds {
            check_value::<Document>("thresholds", given.clone()).map_err(refused)?;
            self.thresholds = given;
        }
        Ok(())
    }

    /// Replaces the motion; the run lasts as long as the motion and `tail` seconds more, and starts upright.
    pub fn shake(&mut self, excitation: Excitation, tail: f64, notes: Vec<String>) {
        self.stop_time = excitation.duration() + tail;
        self.output_step = excitation.bottom().step().max(1e-3);
        self.excitation = Some(excitation);
        self.motion_notes = notes;
        self.motion_notes.extend(self.floors.iter().map(Floors::note));
        self.inputs.clear();
        self.parameters.u_start = 0.0;
    }

    /// Returns the motion of the supports: the scene's own motion, or the motion of the floors that it
    /// excites. It lasts to the end of the run.
    ///
    /// # Errors
    /// [`SceneError::Value`] where a parapet, or a strip wall in full rotations, has a different motion at
    /// its top, or where the floors cannot support this kind of wall.
    pub fn support_motion(&self) -> Result<Option<Cow<'_, Excitation>>, SceneError> {
        let refused = |message: &str| SceneError::Value { message: message.into() };
        let motion = match (&self.floors, &self.excitation) {
            (None, motion) => motion.as_ref().map(Cow::Borrowed),
            (Some(floors), Some(ground)) => {
                let end = self.stop_time.max(ground.duration());
                Some(Cow::Owned(floors.motion(self.parameters.mechanism, ground, end)?))
            }
            (Some(_), None) => {
                return Err(refused("storeys move under a motion of the ground; give [motion] or --record"));
            }
        };
        self.moved_apart(motion.as_deref()).map_or(Ok(motion), |message| Err(refused(message)))
    }

    /// Says what is wrong with a motion of the top support that the wall does not have, or not apart.
    fn moved_apart(&self, motion: Option<&Excitation>) -> Option<&'static str> {
        motion?.top()?;
        match (self.parameters.mechanism, self.parameters.kinematics) {
            (Mechanism::Parapet, _) => Some("a parapet has no top support; leave [motion.top] out"),
            (Mechanism::RigidBody, _) => Some("a rigid body has no top support; leave [motion.top] out"),
            (_, Kinematics::Trigonometric) => Some(
                "kinematics = trigonometric knows one motion for both supports; leave [motion.top] out, or \
                 set kinematics = linear",
            ),
            (_, Kinematics::Linear) => None,
        }
    }

    /// Returns whether this scene's FMU lists the variable called `name`. Enumerations are frozen: the
    /// library reads them from the scene.
    pub fn uses(&self, name: &str) -> bool {
        use RealVariable as V;
        let p = &self.parameters;
        let matters = || {
            let mut usages = p.ties().flat_map(|tie| usage(&p.tied_by(tie)));
            usages.any(|usage| usage.name == name && usage.matters)
        };
        match V::from_name(name) {
            None => BooleanVariable::from_name(name).is_some() && matters(),
            Some(input @ (V::AG | V::ABottom | V::ATop | V::Drift)) => self.inputs.contains(&input),
            // 0 stands for "none", and so does -1
            Some(V::Overburden) if p.overburden == 0.0 => false,
            // the parameters are those of one tie
            Some(V::TieHeight | V::TieStiffness | V::TieSlack | V::TieStrength | V::TieUltimate)
                if !p.further_ties.is_empty() =>
            {
                false
            }
            Some(V::TieStiffness) if p.tie_stiffness == 0.0 => false,
            Some(V::TieStrength) if p.tie_strength == 0.0 => false,
            Some(V::TieUltimate) if p.tie_ultimate == -1.0 => false,
            Some(_) => matters(),
        }
    }

    /// Returns the number of output intervals of the run.
    ///
    /// # Errors
    /// [`SceneError::TooLong`] beyond 2·10⁷.
    pub fn output_count(&self) -> Result<usize, SceneError> {
        let count = (self.stop_time / self.output_step - 1e-9).ceil();
        if count <= MOST_POINTS {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < count ≤ 2e7")]
            Ok(count.max(1.0) as usize)
        } else {
            Err(SceneError::TooLong { stop: self.stop_time, step: self.output_step, limit: MOST_POINTS })
        }
    }
}

/// Returns a title made from a file name.
fn name_of(file: &str) -> String {
    Path::new(file)
        .file_stem()
        .map_or_else(|| file.to_owned(), |stem| stem.to_string_lossy().replace(['_', '-'], " "))
}
