//! The check by Circolare 7/2019 beside an independent script, on random walls, sites and buildings.

use serde_json::Value;

use crate::circolare::sides_in_json;

/// Both compute the same formulas in double precision: some tens of roundings, and the modes of storeys to
/// 1e-9 of their periods in the script.
const TOLERANCE: f64 = 1e-8;

#[test]
fn cases_of_an_independent_script() {
    let data: toml::Table = include_str!("../data/circolare.toml").parse().unwrap();
    let (mut cases, mut numbers) = (0, 0);
    for case in data["cases"].as_array().unwrap() {
        let case = case.as_table().unwrap();
        // the script raises SLC as SLV
        let scene = &case["scene"].as_str().unwrap().replace("[check]\n", "[check]\nraise_slc = true\n");
        let found = sides_in_json(scene);
        for (side, expected) in case.iter().filter(|(key, _)| *key != "scene") {
            compare(expected, &found[side], side, scene, &mut numbers);
        }
        cases += 1;
    }
    assert!(cases == 32 && numbers > 1300, "{numbers} numbers of {cases} cases");
}

fn compare(expected: &toml::Value, found: &Value, place: &str, scene: &str, numbers: &mut usize) {
    match expected {
        toml::Value::Table(table) => {
            for (key, expected) in table {
                compare(expected, &found[key], &format!("{place}.{key}"), scene, numbers);
            }
        }
        expected => {
            let (expected, found) = (expected.as_float().unwrap(), found.as_f64().unwrap_or(f64::NAN));
            let error = (found - expected).abs();
            assert!(error <= TOLERANCE * expected.abs(), "{place}: {found}, expected {expected}\n{scene}");
            *numbers += 1;
        }
    }
}
