//! The documentation against the description.

use rocking_floor::unit::Unit;

use super::page;

const PAGE: &str = include_str!("../../modelDescription/documentation/index.html");
const XML: &str = include_str!("../../modelDescription/modelDescription.xml");

#[test]
fn the_documentation_lists_every_variable_with_its_default() {
    let variables = page::variables::<Unit>();
    for variable in &variables {
        let row = page::row(PAGE, variable);
        assert!(row.contains(variable.description), "{}: {row}", variable.name);
    }
    assert_eq!(PAGE.matches("<tr><td><code>").count(), variables.len() + 2, "and the two couplings");
    page::assert_needs_nothing_from_outside(PAGE);
}

#[test]
fn the_description_is_of_this_version_and_dateless() {
    assert!(XML.contains(&format!("version=\"{}\"", env!("CARGO_PKG_VERSION"))));
    assert!(XML.contains("guid=\"{fingerprint}\"") && !XML.contains("generationDateAndTime="));
    assert!(page::variables::<Unit>().iter().map(|variable| variable.reference).eq(1..=48));
}
