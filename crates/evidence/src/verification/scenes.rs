//! Formulas that the variables of a wall show.

use std::collections::BTreeMap;
use std::path::Path;

use fmu_export::VariableId;
use ground_motion::GroundMotion;
use rocking_wall::scene::Scene;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::RealVariable;
use serde::Deserialize;

use super::error::VerificationError;
use super::formula::{Check, Formula};

const FORMULAS: &str = include_str!("formulas.toml");
const REFERENCES: &str = include_str!("references.csv");

/// A variable of the model description at a time of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// Time \[s\].
    pub time: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    formula: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    title: String,
    section: String,
    statement: String,
    reference: String,
    why: String,
    /// Texts of scenes by their names.
    scenes: BTreeMap<String, String>,
    motion: Option<Samples>,
}

/// Motion of the supports, straight between samples.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Samples {
    step: f64,
    bottom: Vec<f64>,
    top: Option<Vec<f64>>,
    drift: Option<Vec<f64>>,
}

impl Samples {
    fn excitation(&self) -> Result<Excitation, VerificationError> {
        let motion = |samples: &Vec<f64>| GroundMotion::new(self.step, samples.clone());
        let excitation = Excitation::new(motion(&self.bottom)?, self.top.as_ref().map(motion).transpose()?);
        Ok(match &self.drift {
            Some(drift) => excitation.with_drift(motion(drift)?),
            None => excitation,
        })
    }
}

/// A line of the references.
struct Reference {
    scene: &'static str,
    quantity: Quantity,
    value: f64,
    scale: f64,
    bound: f64,
}

fn references() -> impl Iterator<Item = Reference> {
    REFERENCES.lines().skip(1).map(|line| {
        let mut fields = line.split(',');
        let [scene, name] = [(); 2].map(|()| fields.next().unwrap_or_default());
        let numbers: Vec<f64> = fields.filter_map(|field| field.parse().ok()).collect();
        let [time, value, scale, bound] = numbers[..] else { panic!("references.csv: {line}") };
        Reference { scene, quantity: Quantity { name, time }, value, scale, bound }
    })
}

/// Checks the formulas that the variables of a wall show, and nothing that only studies compute: what an FMU
/// can be asked for. `values` computes the quantities of a scene, as for [`verify`](super::verify).
///
/// # Errors
/// Those of `values`, and [`VerificationError`] for a scene that cannot be read.
///
/// # Panics
/// If `values` returns more or fewer numbers than it is asked for.
pub fn verify_scenes<E: From<VerificationError>>(
    mut values: impl FnMut(&Scene, &[Quantity]) -> Result<Vec<Option<f64>>, E>,
) -> Result<Vec<Formula>, E> {
    let document: Document = toml::from_str(FORMULAS).expect("formulas.toml is part of the program");
    let mut formulas = Vec::new();
    for entry in document.formula {
        let mut checks = Vec::new();
        for (name, text) in &entry.scenes {
            let scene = scene(name, text, entry.motion.as_ref())?;
            let references: Vec<_> = references().filter(|reference| reference.scene == name).collect();
            let quantities: Vec<_> = references.iter().map(|reference| reference.quantity).collect();
            let computed = values(&scene, &quantities)?;
            assert_eq!(computed.len(), quantities.len(), "a value for each quantity");
            checks.extend(references.iter().zip(computed).map(|(reference, value)| check(reference, value)));
        }
        let joined = |text: &str| text.trim().replace('\n', " ");
        formulas.push(Formula {
            statement: joined(&entry.statement),
            reference: joined(&entry.reference),
            why: joined(&entry.why),
            title: entry.title,
            section: entry.section,
            checks,
        });
    }
    Ok(formulas)
}

fn scene(name: &str, text: &str, motion: Option<&Samples>) -> Result<Scene, VerificationError> {
    let mut scene = Scene::parse(name, text, Path::new("."))?;
    if let Some(samples) = motion {
        scene.excitation = Some(samples.excitation()?);
    }
    Ok(scene)
}

fn check(reference: &Reference, computed: Option<f64>) -> Check {
    let Reference { scene, quantity: Quantity { name, time }, value, scale, bound } = *reference;
    let quantity = if time == 0.0 { name.to_owned() } else { format!("{name} at {time:.3} s") };
    let unit = RealVariable::from_name(name).and_then(|variable| variable.variable().unit);
    let unit = unit.filter(|unit| *unit != "1").unwrap_or("-");
    Check { case: scene.to_owned(), quantity, unit, reference: value, computed, scale, bound }
}
