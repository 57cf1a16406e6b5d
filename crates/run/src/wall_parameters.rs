//! The parameters of a wall that a study or a check may state.

use files::suggestion;
use rocking_wall::wall::Bar;
use scene::GROUPS;

/// Groups of parameters that a wall of a study may state.
pub(crate) const WALL_GROUPS: [&str; 6] = ["geometry", "force_law", "damping", "impact", "tie", "solver"];
/// Parameters of these groups that the models of a study set.
pub(crate) const OF_MODELS: [(&str, &str); 2] = [
    ("damping_model", "damping_model is set by the study's models; state xi and c_bar only"),
    ("impact", "impact is set by the study's models; state restitution_source and restitution only"),
];

/// Whether the models of a study set a parameter.
pub(crate) fn is_of_models(name: &str) -> bool {
    OF_MODELS.iter().any(|(of_models, _)| *of_models == name)
}

/// Returns the names of the parameters that a wall of a study may state.
pub fn wall_parameters() -> impl Iterator<Item = &'static str> {
    let groups = GROUPS.iter().filter(|(group, _)| WALL_GROUPS.contains(group));
    let names = groups.flat_map(|(_, names)| names.iter().copied()).filter(|name| !is_of_models(name));
    names.chain(Bar::NUMBERS.map(|number| number.usual.name))
}

/// Refuses a name that is neither that of a parameter of a wall of a study nor one of `more`.
///
/// # Errors
/// The message, with all names.
pub fn check_parameter(name: &str, more: &[&'static str]) -> Result<(), String> {
    let known = || wall_parameters().chain(more.iter().copied());
    if known().any(|known| known == name) {
        return Ok(());
    }
    let alone = name.split(['[', '(']).next().unwrap_or_default().trim();
    let meant = suggestion(&alone.to_lowercase(), known());
    Err(format!(
        "{name:?} is not a parameter of a wall of a study{meant}; write one of these alone, their units are \
         fixed: {}",
        known().collect::<Vec<_>>().join(", ")
    ))
}
