//! The scene file as it is written: tables, keys, values, and where they stand.

use files::{FileError, Place, TomlFile, fraction, one_of, tables};
use fmu_export::VariableId;
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::Parameters;
use serde::de::IgnoredAny;
use toml::Spanned;

use crate::keys::{Group, TieTables};
use crate::motion::MotionTable;
use crate::parameter::{apply_group, input_names};
use crate::storeys::{StoreyTable, SupportsTable};
use crate::{DEFAULT_THRESHOLDS, LONGEST_OUTPUT_STEP, LONGEST_RUN, MOST_THRESHOLDS};

/// Largest scene file that is read.
pub(crate) const MAX_FILE_BYTES: u64 = 4 << 20;

tables! {
    /// A scene.
    #[derive(Debug, Default)]
    pub struct Document {
        /// Title, for people; else the file's name.
        pub title: Option<String>,
        /// Inputs that stay variables of the scene's FMU: by default `a_g`, and none for a scene with its own
        /// motion.
        #[key(items = one_of(input_names()), uniqueItems = true)]
        pub inputs: Option<Vec<Spanned<String>>>,
        /// End of the run \[s\]; by default the motion's duration and tail, or 30 s.
        #[key(exclusiveMinimum = 0, maximum = LONGEST_RUN)]
        pub stop_time: Option<f64>,
        /// Step of the output \[s\]; by default the motion's own, or 0.01 s.
        #[key(exclusiveMinimum = 0, maximum = LONGEST_OUTPUT_STEP)]
        pub output_step: Option<f64>,
        /// Limit states as fractions of `u_ins`, whose first crossings a run reports.
        #[key(items = fraction(), maxItems = MOST_THRESHOLDS, default = DEFAULT_THRESHOLDS.to_vec())]
        pub thresholds: Option<Vec<f64>>,
        /// Shape, mass and loads.
        #[serde(default)]
        pub geometry: Group,
        /// Restoring force.
        #[serde(default)]
        pub force_law: Group,
        /// Viscous damping.
        #[serde(default)]
        pub damping: Group,
        /// Restitution.
        #[serde(default)]
        pub impact: Group,
        /// Tie of the wall, or a list of several.
        #[serde(default)]
        pub tie: TieTables,
        /// Initial displacement and velocity.
        #[serde(default)]
        pub start: Group,
        /// Solver and tolerance.
        #[serde(default)]
        pub solver: Group,
        /// Storeys between the ground and the wall, the lowest first; the motion shakes the ground.
        #[serde(default)]
        pub storeys: Vec<Spanned<StoreyTable>>,
        /// The floors that support the wall.
        pub supports: Option<Spanned<SupportsTable>>,
        /// What moves the supports, or the ground below the storeys.
        pub motion: Option<Spanned<MotionTable>>,
        /// A check by a code, which a run does not need.
        pub check: Option<IgnoredAny>,
        /// What the report of that check says of the project.
        pub report: Option<IgnoredAny>,
    }

    /// The shape of a wall without its motion.
    #[derive(Debug)]
    struct ShapeDocument {
        /// Shape, mass and loads.
        #[serde(default)]
        geometry: Group,
    }
}

/// Reads the default wall with the shape that a text states, which has a table `[geometry]` alone.
///
/// # Errors
/// [`FileError`] with line, value and remedy; `name` stands for the file.
pub fn read_shape(name: &str, text: &str) -> Result<Parameters, FileError> {
    let file = TomlFile::new(name, text)?;
    let (document, mut parameters): (ShapeDocument, _) = (file.read()?, Parameters::default());
    apply_group(&mut parameters, "geometry", &document.geometry, &file)?;
    Ok(parameters)
}

impl Document {
    /// Returns the tables of parameters with their names, but for those of the ties.
    pub fn groups(&self) -> [(&'static str, &Group); 6] {
        [
            ("geometry", &self.geometry),
            ("force_law", &self.force_law),
            ("damping", &self.damping),
            ("impact", &self.impact),
            ("start", &self.start),
            ("solver", &self.solver),
        ]
    }

    /// The inputs the scene names.
    pub(crate) fn inputs(&self, place: &Place<'_>) -> Result<Vec<RealVariable>, FileError> {
        let mut inputs = Vec::new();
        for name in self.inputs.iter().flatten() {
            let input = input_names().find(|input| input == name.get_ref()).and_then(RealVariable::from_name);
            let input = input.filter(|input| !inputs.contains(input)).ok_or_else(|| {
                let known = input_names().collect::<Vec<_>>().join(", ");
                let message = format!("{:?} is not one of the inputs {known}, each once", name.get_ref());
                place.error(name.span(), message)
            })?;
            inputs.push(input);
        }
        Ok(inputs)
    }
}
