//! Damping models by their short names.

use toml::{Spanned, Value};

use fmu_export::VariableId;
use rocking_wall::scene::{
    Place, SceneError, Schema, check_limits, object, one_of, parameters, suggestion, text, with,
};
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{COMPUTED, Damping, Ratio};
use run::model::{EnergyLoss, Model, damping_models, label};

/// Returns the keys of a model that is a table.
fn keys() -> impl Iterator<Item = &'static str> {
    ["name", "model"].into_iter().chain(Ratio::ALL.map(Ratio::name))
}

/// Lists the short names, for messages.
fn names() -> String {
    let quoted = |name: String| if name.contains(' ') { format!("{name:?}") } else { name };
    EnergyLoss::all().map(|loss| quoted(loss.name())).collect::<Vec<_>>().join(", ")
}

/// Describes a model that has no options.
fn no_table(short: &str) -> String {
    format!("{short:?} takes no ratio; write it as \"{short}\"")
}

/// Describes a model: a name, or a table with its ratio.
pub(super) fn model_schema() -> Schema {
    let own = [
        ("name", text("Name in tables; by default that of the model.")),
        ("model", one_of(damping_models().map(|model| label(model).name))),
    ];
    let mut properties: Schema =
        own.map(|(key, schema)| (key.to_owned(), schema.into())).into_iter().collect();
    properties.extend(parameters("damping").into_iter().filter(|(key, _)| keys().any(|own| own == key)));
    let table = with(object(properties), "required", vec!["model"]);
    let names: Vec<_> = EnergyLoss::all().map(EnergyLoss::name).collect();
    with(Schema::new(), "anyOf", vec![one_of(names.iter().map(String::as_str)), table])
}

pub(super) fn model(value: &Spanned<Value>, place: &Place<'_>) -> Result<Model, SceneError> {
    let refuse = |message: String| place.error(value.span(), message);
    let named = |short: &str| {
        let unknown = || refuse(format!("{short:?} is not a damping model; the models are {}", names()));
        EnergyLoss::named(short).ok_or_else(unknown)
    };
    match value.get_ref() {
        Value::String(text) => named(text).map(Model::new),
        Value::Table(table) => {
            if let Some(key) = table.keys().find(|key| keys().all(|own| own != *key)) {
                let (meant, all) = (suggestion(key, keys()), keys().collect::<Vec<_>>().join(", "));
                return Err(refuse(format!("unknown key {key:?} of a model{meant}; it holds {all}")));
            }
            let text = |key: &str| table.get(key).and_then(Value::as_str);
            let short =
                text("model").ok_or_else(|| refuse(format!("a model needs model = one of {}", names())))?;
            let EnergyLoss::Viscous(Damping { model, .. }) = named(short)? else {
                return Err(refuse(no_table(short)));
            };
            let taken = model.ratio_name().ok_or_else(|| refuse(no_table(short)))?;
            let mut others = Ratio::ALL.map(Ratio::name).into_iter().filter(|key| *key != taken);
            if let Some(other) = others.find(|key| table.contains_key(*key)) {
                return Err(refuse(format!("{short:?} takes no {other}; give {taken}, or leave it out")));
            }
            let number = match table.get(taken) {
                None => COMPUTED,
                Some(Value::Float(number)) => *number,
                #[allow(clippy::cast_precision_loss, reason = "beyond 2⁵³ it is beyond the limit too")]
                Some(Value::Integer(number)) => *number as f64,
                Some(_) => return Err(refuse(format!("{taken} of a model must be a number"))),
            };
            if let Some(variable) = RealVariable::from_name(taken) {
                check_limits(variable.variable(), number).map_err(refuse)?;
            }
            let damping = Damping::new(model, number).map_err(|error| refuse(error.to_string()))?;
            let model = Model::new(EnergyLoss::Viscous(damping));
            Ok(Model { name: text("name").map_or(model.name, str::to_owned), ..model })
        }
        _ => Err(refuse(format!("a model is a name or a table; the models are {}", names()))),
    }
}
