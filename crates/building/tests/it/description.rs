//! Tests the description of a building as a system of FMUs.

use std::collections::BTreeSet;
use std::path::Path;

use building::{Building, Parts};

/// The description of the three storeys among the scenes, with a title.
fn described(title: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/building/three_storeys.toml");
    let mut building = Building::read(&path).unwrap();
    title.clone_into(&mut building.title);
    Parts::read(&building).unwrap().description(&building, 0.0025)
}

/// The values of an attribute.
fn values<'a>(xml: &'a str, attribute: &str) -> BTreeSet<&'a str> {
    let parts = xml.split(attribute).skip(1);
    parts.filter_map(|rest| rest.strip_prefix("=\"")?.split('"').next()).collect()
}

#[test]
fn every_unit_of_a_connector_has_its_base_units() {
    let xml = described("Units");
    let units = values(&xml, " unit");
    assert_eq!(units, BTreeSet::from(["1", "N", "m", "m/s", "m/s2", "s"]));
    for unit in units {
        let described = xml.split(&format!("<ssc:Unit name=\"{unit}\"><ssc:BaseUnit")).nth(1);
        let base = described.unwrap_or_else(|| panic!("{unit} is not described"));
        assert_eq!(base.starts_with("/>"), unit == "1", "{unit}: {}", &base[..20]);
    }
}

/// `OMSimulator` accepts only identifiers as names. The annotation tells it that a system has a master.
#[test]
fn names_are_identifiers_and_the_system_states_its_step() {
    let xml = described("A \"tall\" house");
    let (system, units) = xml.split_once("<ssd:Units>").unwrap();
    let names = values(system, " name");
    let components = ["floor_1", "floor_2", "gable", "parapet", "roof", "strip"];
    assert_eq!(values(system, "<ssd:Component name"), BTreeSet::from(components));
    for named in ["SystemStructureDescription version=\"1.0\"", "System"] {
        assert!(system.contains(&format!("<ssd:{named} name=\"building\"")), "{named}");
    }
    for name in names {
        assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{name}");
    }
    assert!(values(units, "Unit name").contains("m/s2"));
    assert!(xml.contains("<oms:FixedStepMaster description=\"oms-ma\" stepSize=\"0.0025\""));
}

#[test]
fn titles_are_escaped() {
    let xml = described("a \"b\" <c> & d\n");
    assert!(xml.contains("<ssd:System name=\"building\" description=\"a &quot;b&quot; &lt;c> &amp; d \">"));
}
