//! Damping models by their short names.

use toml::{Spanned, Value};

use files::{FileError, Place, Schema, object, one_of, suggestion, text, with};
use fmu_export::VariableId;
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{COMPUTED, Damping, Ratio};
use run::model::{EnergyLoss, Model, damping_models, label};
use scene::{check_limits, parameters};

/// Keys of a model that is a table.
const KEYS: [&str; 4] = ["name", "model", "xi", "c_bar"];

/// Lists the short names, for messages.
fn names() -> String {
    let quoted = |name: String| if name.contains(' ') { format!("{name:?}") } else { name };
    EnergyLoss::all().map(|loss| quoted(loss.name())).collect::<Vec<_>>().join(", ")
}

/// Describes a model: a name, or a table with its ratio.
pub(super) fn model_schema() -> Schema {
    let own = [
        ("name", text("Name in tables; by default that of the model.")),
        ("model", one_of(damping_models().map(|model| label(model).name))),
    ];
    let mut keys: Schema = own.map(|(key, schema)| (key.to_owned(), schema.into())).into_iter().collect();
    let is_ratio = |key: &String| Ratio::ALL.iter().any(|ratio| ratio.name() == key);
    keys.extend(parameters("damping").into_iter().filter(|(key, _)| is_ratio(key)));
    let table = with(object(keys), "required", vec!["model"]);
    let names: Vec<_> = EnergyLoss::all().map(EnergyLoss::name).collect();
    with(Schema::new(), "anyOf", vec![one_of(names.iter().map(String::as_str)), table])
}

pub(super) fn model(value: &Spanned<Value>, place: &Place<'_>) -> Result<Model, FileError> {
    let refuse = |message: String| place.error(value.span(), message);
    let named = |short: &str| {
        let unknown = || refuse(format!("{short:?} is not a damping model; the models are {}", names()));
        EnergyLoss::named(short).ok_or_else(unknown)
    };
    match value.get_ref() {
        Value::String(text) => named(text).map(Model::new),
        Value::Table(table) => {
            if let Some(key) = table.keys().find(|key| !KEYS.contains(&key.as_str())) {
                let (meant, keys) = (suggestion(key, KEYS), KEYS.join(", "));
                return Err(refuse(format!("unknown key {key:?} of a model{meant}; it holds {keys}")));
            }
            let other_kind = |key: &str, expected: &str, found: &Value| {
                refuse(format!("{key} of a model must be {expected}, found {}", found.type_str()))
            };
            let text = |key: &str| match table.get(key) {
                None => Ok(None),
                Some(Value::String(text)) => Ok(Some(text.as_str())),
                Some(found) => Err(other_kind(key, "a text in quotes", found)),
            };
            let name = text("name")?;
            let no_model = || refuse(format!("a model in a table needs model = one of {}", names()));
            let short = text("model")?.ok_or_else(no_model)?;
            let no_table = || refuse(format!("{short:?} takes no ratio; write it as \"{short}\""));
            let EnergyLoss::Viscous(Damping { model, .. }) = named(short)? else { return Err(no_table()) };
            let taken = model.ratio_name().ok_or_else(no_table)?;
            let mut others = Ratio::ALL.map(Ratio::name).into_iter().filter(|key| *key != taken);
            if let Some(other) = others.find(|key| table.contains_key(*key)) {
                return Err(refuse(format!("{short:?} takes no {other}; give {taken}, or leave it out")));
            }
            let number = match table.get(taken) {
                None => COMPUTED,
                Some(Value::Float(number)) => *number,
                #[allow(clippy::cast_precision_loss, reason = "beyond 2⁵³ it is beyond the limit too")]
                Some(Value::Integer(number)) => *number as f64,
                Some(found) => return Err(other_kind(taken, "a number without quotes", found)),
            };
            if let Some(variable) = RealVariable::from_name(taken) {
                check_limits(variable.variable(), number).map_err(refuse)?;
            }
            let damping = Damping::new(model, number).map_err(|error| refuse(error.to_string()))?;
            let model = Model::new(EnergyLoss::Viscous(damping));
            Ok(Model { name: name.map_or(model.name, str::to_owned), ..model })
        }
        _ => Err(refuse(format!("a model is a name or a table; the models are {}", names()))),
    }
}
