//! Damping models by their short names.

use serde::Deserialize;
use toml::{Spanned, Value};

use fmu_export::VariableId;
use rocking_wall::scene::{Place, SceneError, Schema, check_limits, object, one_of, parameters, text, with};
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{COMPUTED, Damping, Ratio};
use run::model::{EnergyLoss, Model, damping_models, label};

/// A model that is a table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelTable {
    name: Option<String>,
    model: String,
    xi: Option<f64>,
    c_bar: Option<f64>,
}

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

pub(super) fn model(value: &Spanned<Value>, place: &Place<'_>) -> Result<Model, SceneError> {
    let refuse = |message: String| place.error(value.span(), message);
    let named = |short: &str| {
        let unknown = || refuse(format!("{short:?} is not a damping model; the models are {}", names()));
        EnergyLoss::named(short).ok_or_else(unknown)
    };
    match value.get_ref() {
        Value::String(text) => named(text).map(Model::new),
        Value::Table(table) => {
            let read = table.clone().try_into::<ModelTable>();
            let ModelTable { name, model: short, xi, c_bar } = read.map_err(|error| {
                refuse(format!("a model in a table, with model = one of {}: {}", names(), error.message()))
            })?;
            let no_table = || refuse(format!("{short:?} takes no ratio; write it as \"{short}\""));
            let EnergyLoss::Viscous(Damping { model, .. }) = named(&short)? else { return Err(no_table()) };
            let taken = model.ratio_name().ok_or_else(no_table)?;
            let given = Ratio::ALL.map(|ratio| match ratio {
                Ratio::Xi => (ratio.name(), xi),
                Ratio::CBar => (ratio.name(), c_bar),
            });
            if let Some((other, _)) = given.iter().find(|(key, ratio)| *key != taken && ratio.is_some()) {
                return Err(refuse(format!("{short:?} takes no {other}; give {taken}, or leave it out")));
            }
            let number = xi.or(c_bar).unwrap_or(COMPUTED);
            if let Some(variable) = RealVariable::from_name(taken) {
                check_limits(variable.variable(), number).map_err(refuse)?;
            }
            let damping = Damping::new(model, number).map_err(|error| refuse(error.to_string()))?;
            let model = Model::new(EnergyLoss::Viscous(damping));
            Ok(Model { name: name.unwrap_or(model.name), ..model })
        }
        _ => Err(refuse(format!("a model is a name or a table; the models are {}", names()))),
    }
}
