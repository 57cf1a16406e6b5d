//! Reads the values of a floor that its FMU contains: `resources/floor.toml`, one `name = value` a line.

use fmu_export::{Causality, Kind, VariableId};

use crate::floor::Parameters;
use crate::variables::{IntegerVariable, RealVariable};

/// Reads the values of a text; those it does not state are the start values of the description.
///
/// # Errors
/// A message with the line, for a name that is no parameter and a value outside its limits.
pub(crate) fn read(bytes: &[u8]) -> Result<Parameters, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "resources/floor.toml is not UTF-8 text")?;
    let mut parameters = Parameters::default();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if !line.is_empty() {
            set(&mut parameters, line)
                .map_err(|message| format!("resources/floor.toml, line {}: {message}", index + 1))?;
        }
    }
    Ok(parameters)
}

fn set(parameters: &mut Parameters, line: &str) -> Result<(), String> {
    let (name, value) =
        line.split_once('=').ok_or_else(|| format!("expected name = value, found {line:?}"))?;
    let (name, value) = (name.trim(), value.trim());
    let refused = || format!("{name} = {value} is not a parameter of a floor within its limits");
    let real = RealVariable::from_name(name).map(|id| (id, id.variable()));
    let known = if let Some((id, variable)) = real.filter(|(_, v)| v.causality == Causality::Parameter) {
        let Kind::Real { min, max, .. } = variable.kind else { return Err(refused()) };
        let number: f64 = value.parse().map_err(|_| refused())?;
        let least = min.is_none_or(|min| number >= min);
        let most = max.is_none_or(|max| number <= max);
        number.is_finite() && least && most && parameters.set_real(id, number)
    } else if let Some(id) = IntegerVariable::from_name(name) {
        let Kind::Enumeration { items, .. } = id.variable().kind else { return Err(refused()) };
        let item = items.iter().find(|item| item.name == value.trim_matches('"'));
        item.is_some_and(|item| parameters.set_integer(id, item.value))
    } else {
        false
    };
    known.then_some(()).ok_or_else(refused)
}
