//! Damping models by their short names.

use toml::{Spanned, Value};

use crate::ida::{Damping, Model, RatioSource};
use fmu_export::VariableId;
use rocking_wall::scene::{Place, SceneError, check_limits, suggestion};
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{COMPUTED, given};

/// Short names, for messages.
const MODELS: &str =
    "none, CR, \"CR rigid\", CDC, CDR, SDR, block, and CDC, CDR, SDR with \" Eq. 14\" after it";

/// Keys of a model that is a table.
const KEYS: [&str; 4] = ["name", "model", "xi", "c_bar"];

pub(super) fn model(value: &Spanned<Value>, place: &Place<'_>) -> Result<Model, SceneError> {
    let refuse = |message: String| place.error(value.span(), message);
    let known = |short: &str, source: RatioSource| match short {
        "none" => Some(Damping::None),
        "CR" => Some(Damping::Restitution),
        "CR rigid" => Some(Damping::RigidRestitution),
        "CDC" => Some(Damping::ConstantCoefficient(source)),
        "CDR" => Some(Damping::ConstantRatio(source)),
        "SDR" => Some(Damping::StiffnessProportional(source)),
        "block" => Some(Damping::FreeStandingBlock(source)),
        _ => None,
    };
    let unknown = |short: &str| refuse(format!("{short:?} is not a damping model; the models are {MODELS}"));
    match value.get_ref() {
        Value::String(text) => {
            let damping = match text.strip_suffix(" Eq. 14") {
                Some(short @ ("CDC" | "CDR" | "SDR")) => known(short, RatioSource::Equation14),
                Some(_) => None,
                None => known(text, RatioSource::Computed),
            };
            damping.map(Model::new).ok_or_else(|| unknown(text))
        }
        Value::Table(table) => {
            if let Some(key) = table.keys().find(|key| !KEYS.contains(&key.as_str())) {
                let meant = suggestion(key, KEYS);
                return Err(refuse(format!(
                    "unknown key {key:?} of a model{meant}; it holds {}",
                    KEYS.join(", ")
                )));
            }
            let text = |key: &str| table.get(key).and_then(Value::as_str);
            let short =
                text("model").ok_or_else(|| refuse(format!("a model needs model = one of {MODELS}")))?;
            let (variable, taken, other) = match short {
                "block" => (RealVariable::CBar, "c_bar", "xi"),
                _ => (RealVariable::Xi, "xi", "c_bar"),
            };
            if table.contains_key(other) {
                return Err(refuse(format!("{short:?} takes no {other}; give {taken}, or leave it out")));
            }
            let number = match table.get(taken) {
                None => COMPUTED,
                Some(Value::Float(number)) => *number,
                #[allow(clippy::cast_precision_loss, reason = "beyond 2⁵³ it is beyond the limit too")]
                Some(Value::Integer(number)) => *number as f64,
                Some(_) => return Err(refuse(format!("{taken} of a model must be a number"))),
            };
            check_limits(variable.variable(), number).map_err(refuse)?;
            let number = given(taken, number).map_err(|error| refuse(error.to_string()))?;
            let damping = match short {
                "CDC" | "CDR" | "SDR" | "block" => {
                    known(short, number.map_or(RatioSource::Computed, RatioSource::Given))
                }
                _ => return Err(refuse(format!("{short:?} takes no {taken}; write it as \"{short}\""))),
            };
            let mut model = damping.map(Model::new).ok_or_else(|| unknown(short))?;
            if let Some(name) = text("name") {
                name.clone_into(&mut model.name);
            }
            Ok(model)
        }
        _ => Err(refuse(format!("a model is a name or a table; the models are {MODELS}"))),
    }
}
