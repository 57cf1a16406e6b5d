//! Tests that every variable of the model description has a getter or a field, and that every field is
//! described.
//!
//! The compiler holds the rest together: code that names a variable does not build without it, a `match`
//! without a `_` arm does not build with one more, and the generated start values name every field of
//! [`Parameters`](rocking_wall::wall::Parameters).

use fmu_export::VariableId;
use rocking_wall::variables::{BooleanVariable, IntegerVariable, RealVariable};

fn read(file: &str) -> String {
    std::fs::read_to_string(crate::root().join(file)).unwrap()
}

/// Names and variants of the described variables.
fn described() -> Vec<(&'static str, String)> {
    let real = RealVariable::ALL.iter().map(|v| (v.variable().name, format!("RealVariable::{v:?}")));
    let integer = IntegerVariable::ALL.iter().map(|v| (v.variable().name, format!("IntegerVariable::{v:?}")));
    let boolean = BooleanVariable::ALL.iter().map(|v| (v.variable().name, format!("BooleanVariable::{v:?}")));
    real.chain(integer).chain(boolean).collect()
}

/// The getters of the unit, with the aliases of types written out.
fn getters() -> String {
    let model = read("src/unit/model.rs");
    let part = |from: &str, to: &str| {
        let start = model.find(from).unwrap_or_else(|| panic!("{from}"));
        model[start..start + model[start..].find(to).unwrap_or_else(|| panic!("{to}"))].to_owned()
    };
    (part("fn real(", "fn integer(") + &part("fn output(", "None,")).replace("V::", "RealVariable::")
        + &part("fn integer(", "fn boolean(").replace("V::", "IntegerVariable::")
        + &part("fn boolean(", "fn set_real(")
}

/// The fields of the parameters.
fn fields() -> Vec<String> {
    let file = read("src/wall/parameters.rs");
    let body = file.split_once("pub struct Parameters {").unwrap().1.split_once("\n}").unwrap().0;
    let names = body.lines().filter_map(|line| line.strip_prefix("    pub ")?.split_once(':'));
    names.map(|(name, _)| name.to_owned()).collect()
}

/// A variable is a field of the parameters or is named in a getter, and no getter has an arm for what is left
/// over.
#[test]
fn every_described_variable_is_wired() {
    let (getters, fields) = (getters(), fields());
    for (name, variant) in described() {
        let is_named = getters.match_indices(&variant).any(|(at, found)| {
            !getters[at + found.len()..].starts_with(|next: char| next.is_alphanumeric() || next == '_')
        });
        assert!(is_named != fields.iter().any(|field| field == name), "{name} is wired by name once");
    }
    assert!(!getters.contains("_ =>"), "{getters}");
}

/// A field is a described parameter, or one that only scenes carry.
#[test]
fn every_field_is_described() {
    let described = described();
    let left = fields().into_iter().filter(|field| described.iter().all(|(name, _)| name != field));
    assert_eq!(left.collect::<Vec<_>>(), ["kinematics", "multilinear"]);
}
