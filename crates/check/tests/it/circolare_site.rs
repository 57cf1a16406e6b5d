//! The site on a grid of the hazard: the numbers of the limit states, and what is refused.

use std::fs;
use std::path::{Path, PathBuf};

use check::{CheckFile, Subject, read};
use scene::Scene;

use crate::circolare::{PARAPET, near};

/// Two by two nodes with the same numbers, a_g rising tenfold from 30 to 3000 years.
const GRID: &str = "lon,lat,ag_30,F0_30,TC_30,ag_3000,F0_3000,TC_3000\n\
                    13.00,42.00,0.5,2.4,0.28,5,2.5,0.36\n13.05,42.00,0.5,2.4,0.28,5,2.5,0.36\n\
                    13.05,42.05,0.5,2.4,0.28,5,2.5,0.36\n13.00,42.05,0.5,2.4,0.28,5,2.5,0.36\n";
const SITE: &str = "site = { grid = \"grid.csv\", ag_unit = \"g/10\", coordinates = [42.02, 13.03], \
                    nominal_life = 50, use_coefficient = 1 }";

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("grid.csv"), GRID).unwrap();
    folder
}

/// Checks a parapet with more lines in `[check]`; returns ζ_E and the notes, or the refusal.
fn checked(name: &str, more: &str) -> Result<(f64, Vec<String>), String> {
    checked_in(&folder(name), more)
}

fn checked_in(folder: &Path, more: &str) -> Result<(f64, Vec<String>), String> {
    let text = format!(
        "{PARAPET}[force_law]\na1 = 0.03\n[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\n\
         soil = \"B\"\n{more}\n"
    );
    let path = folder.join("scene.toml").display().to_string();
    let scene = Scene::parse(&path, &text, std::path::Path::new(".")).unwrap();
    let file = CheckFile::parse(&path, &text).unwrap();
    let assumed = file.assumed(&[]);
    let subject = Subject { assumed: &assumed, ..(&scene).into() };
    let code = read(&file).map_err(|error| file.located(error).to_string())?;
    let verdict = code.check(subject).map_err(|error| file.located(error).to_string())?;
    Ok((verdict.zeta, verdict.notes.iter().map(ToString::to_string).collect()))
}

/// By hand: T_R = −50/ln 0.9 = 474.561 years is 0.599585 of the way from 30 to 3000 by logarithms; a_g =
/// 0.05 · 10^0.599585 = 0.198864 g, F0 = 2.4 (2.5/2.4)^0.599585 = 2.459468, T_C* = 0.28 (0.36/0.28)^0.599585
/// = 0.325536 s.
#[test]
fn limit_states_take_their_numbers_from_the_grid() {
    let stated = "SLV = { ag = 0.198864, F0 = 2.459468, TC = 0.325536 }";
    let (from_grid, notes) = checked("site_numbers", &format!("{SITE}\nSLV = {{}}")).unwrap();
    let (typed, _) = checked("site_typed", stated).unwrap();
    near(from_grid, typed, "zeta");
    let told = notes.join("\n");
    for words in [
        "SLV: T_R = 474.6 years: a_g = 0.1989 g, F0 = 2.459, T_C* = 0.3255 s.",
        "latitude 42.02°, longitude 13.03° on the grid of grid.csv",
        "the mean of its four nodes",
        "straight over log T_R (NTC 2008, Annex A)",
    ] {
        assert!(told.contains(words), "{told}");
    }
    let node = SITE.replace("42.02, 13.03", "42.05, 13.0");
    let (_, notes) = checked("site_node", &format!("{node}\nSLV = {{}}")).unwrap();
    assert!(notes.join("\n").contains("of grid.csv: the numbers of the node that it is,"), "{notes:?}");
    // a limit state with its own numbers keeps them; one year is below the grid
    let short = SITE.replace("nominal_life = 50", "nominal_life = 1");
    let (_, notes) = checked("site_own", &format!("{short}\n{stated}\nSLC = {{}}")).unwrap();
    let told = notes.join("\n");
    assert!(
        told.contains("SLC: T_R = 19.5 years, taken as 30, the nearest of the grid: a_g = 0.05 g"),
        "{told}"
    );
    assert!(!told.contains("SLV: T_R"), "{told}");
}

/// A text that holds the lines of the grid needs no file, and says the same of the wall.
#[test]
fn the_lines_of_a_grid_stand_for_its_file() {
    let more = format!("{SITE}\nSLV = {{}}");
    let (from_file, notes) = checked("site_file", &more).unwrap();
    let path = folder("site_file").join("a.toml").display().to_string();
    let text = format!("[check]\n{more}\n# with a comment\n");
    let told = CheckFile::parse(&path, &text).unwrap().self_contained().unwrap();
    assert!(!told.contains("grid.csv") && told.ends_with("# with a comment\n"), "{told}");
    let (_, table) = told.split_once('\n').unwrap();
    let (from_lines, said) = checked_in(Path::new("nowhere"), table).unwrap();
    assert_eq!(from_lines, from_file);
    let of_file = |note: &String| note.replace("grid of grid.csv", "grid in the file");
    assert_eq!(said, notes.iter().map(of_file).collect::<Vec<_>>());
    // what holds its lines already stays as it is
    let again = CheckFile::parse("nowhere/a.toml", &told).unwrap().self_contained().unwrap();
    assert_eq!(again, told);
    let told = checked_in(Path::new("nowhere"), &table.replace("2.4,0.28,5", "2.4,0.28,x")).unwrap_err();
    assert!(told.contains("grid of [check.site], line 2:"), "{told}");
}

/// A report has coordinates, V_N and C_U of the site, and none that differ from them.
#[test]
fn a_report_is_about_the_site_of_the_check() {
    let report = |given: &str| {
        let text = format!("[check]\ncode = \"circolare-2019\"\n{SITE}\nSLV = {{}}\n{given}");
        CheckFile::parse("scene.toml", &text).unwrap().report().map_err(|error| error.to_string())
    };
    for given in ["", "[report]\nproject = \"x\"", "[report]\nnominal_life = 50"] {
        let table = report(given).unwrap();
        let found = (table.coordinates, table.nominal_life, table.use_coefficient);
        assert_eq!(found, (Some([42.02, 13.03]), Some(50.0), Some(1.0)));
    }
    for (given, words) in [
        (
            "nominal_life = 100",
            "line 6: [report] nominal_life = 100.0 differs from 50.0 of [check.site]; leave it",
        ),
        ("use_coefficient = 1.5", "use_coefficient = 1.5 differs from 1.0 of [check.site]"),
        ("coordinates = [42.1, 13.03]", "coordinates = [42.1, 13.03] differs from [42.02, 13.03] of"),
    ] {
        let told = report(&format!("[report]\n{given}")).unwrap_err();
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn sites_that_cannot_be_are_refused() {
    let both = |from: &str, to: &str| format!("{}\nSLV = {{}}", SITE.replace(from, to));
    for (more, words) in [
        (both("42.02, 13.03", "13.03, 42.02"), "in no cell of the grid; the nearest node is at lon"),
        (both("42.02", "142.02"), "coordinates = [142.02, 13.03] must be latitude and longitude"),
        (both("nominal_life = 50", "nominal_life = 0"), "nominal_life = 0 must be above 0"),
        (both("g/10", "gal"), "ag_unit = \"gal\" is not one of \"g\", \"g/10\", \"m/s2\""),
        (both("ag_unit = \"g/10\", ", ""), "grid.csv, line 2: a_g = 5 g is above 1.5 g"),
        (both("grid.csv", "none.csv"), "none.csv: cannot be read"),
        (format!("{SITE}\nSLV = {{ F0 = 2.4 }}"), "gives ag, F0 and TC together; state all or none"),
        (format!("{SITE}\nSLV = {{ ag = 0.1, F0 = 2.4, TC = 0.3 }}"), "no limit state takes its numbers"),
        ("SLV = {}".to_owned(), "ag is missing; state a_g in g, with F0 and TC, or the site"),
    ] {
        let told = checked("site_refused", &more).unwrap_err();
        assert!(told.contains(words), "{told}\nfor {words}");
    }
}
