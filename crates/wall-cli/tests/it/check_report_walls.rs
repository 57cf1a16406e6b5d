//! Reports in Italian have no English of the program, and reports of several walls.

use std::fs;

use crate::command_line::{assert_has, content, fails, folder, refused, succeed};

/// A strip wall in a building, its hinge searched, its hinges set back, in use class IV.
const STRIP: &str = r#"
[geometry]
mechanism = "vertical_spanning"
height = 3.5
thickness = 0.3
density = 1800
overburden = 20000
overburden_eccentricity = 0.05
[force_law]
a1 = 0.03
[check]
code = "circolare-2019"
before_activation = "law"
soil = "C"
hinge = "worst"
topography = "T2"
masonry_strength = 1.5e6
masonry_gamma = 2
knowledge_level = "LC2"
use_class = "IV"
height_demand = "printed"
building = { storeys = 3, period = 0.3, height_ratio = 0.6 }
SLD = { ag = 0.08, F0 = 2.45, TC = 0.30, building_damping = 0.05 }
SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }
SLC = { ag = 0.20, F0 = 2.45, TC = 0.34, building_damping = 0.1, displacement = 0.1 }
"#;

/// A loaded parapet, held, on the ground, by the check with q.
const LINEAR: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
overburden = 3000
[check]
code = "circolare-2019"
method = "linear"
behaviour_factor = 1.5
before_activation = "rigid"
overburden_mass = 0.5
soil = "A"
topography = 1.1
SLV = { ag = 0.1, F0 = 2.45, TC = 0.32 }
"#;

/// A parapet under spectra of its own place.
const SPECTRUM: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[check]
code = "circolare-2019"
before_activation = "rigid"
SLV = { damping = 0.05, ag = 0.1, spectrum = [[0, 0.2], [0.3, 0.5], [4, 0.05]], spectrum_damping = 0.05 }
SLD = { ag = 0.05, spectrum = [[0, 0.1], [0.3, 0.25], [4, 0.02]], spectrum_damping = 0.05 }
"#;

/// A parapet on a floor under records, on a grid of the hazard.
const SITE: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[[storeys]]
period = 0.3
[check]
code = "circolare-2019"
method = "dynamic"
before_activation = "rigid"
rocking = "one_sided_positive"
soil = "B"
record_scale = "none"
site.grid = "grid.csv"
site.ag_unit = "g/10"
site.coordinates = [42.02, 13.03]
site.nominal_life = 50
site.use_coefficient = 1
SLD = { building_damping = 0.05 }
SLV = { building_damping = 0.1 }
SLC = { building_damping = 0.1 }
records = { synthetic = { count = 3, duration = 10, step = 0.02 } }
"#;

/// A façade with a bar that yields.
const TIED: &str = r#"
[geometry]
height = 6.0
thickness = 0.5
density = 1900
overburden = 10e3
overburden_eccentricity = 0.1

[force_law]
a1 = 0.03

[tie]
tie_height = 5.8
tie_side = "positive"

[tie.bar]
diameter = 0.016
length = 6.0
yield_stress = 235e6
ultimate_strain = 0.02
anchor_capacity = 60e3
spacing = 3.0

[check]
code = "circolare-2019"
before_activation = "law"
soil = "C"
overburden_mass = 1.0
rocking = "one_sided_positive"
tie = { at_activation = "yield" }
SLV = { ag = 0.18, F0 = 2.45, TC = 0.34 }

[report]
project = "Messa in sicurezza, the façade"
nominal_life = 50
use_coefficient = 1.0
language = "it"
"#;

/// A parapet by fractions of its displacement, under records.
const FRACTIONS: &str = r#"
[geometry]
height = 2
thickness = 0.4
density = 1800
[force_law]
a1 = 0.05
[check]
code = "fractions"
records = { synthetic = { count = 7, duration = 10, step = 0.02 } }
"#;

/// Words that no Italian text of the program has.
const ENGLISH: &str = "the of is are with and at from its not walls each taken before which without to \
                       for by has have under needs stands passed demand tie records spectrum onset \
                       displacement ratio quantity unit capacity secant points column bears site outwards";

/// The texts of a page: what stands between tags other than those of formulas, and the labels of pictures.
/// What users write and names of parameters are left out.
fn texts(page: &str) -> Vec<String> {
    let mut page = page.to_owned();
    for (begins, ends) in [
        ("<style", "</style>"),
        ("<title", "</title>"),
        ("<span translate", "</span>"),
        ("<small translate", "</small>"),
    ] {
        while let Some(from) = page.find(begins) {
            let to = from + page[from..].find(ends).unwrap() + ends.len();
            page.replace_range(from..to, "<br>");
        }
    }
    for tag in ["i", "b", "sub", "sup"] {
        page = page.replace(&format!("<{tag}>"), "").replace(&format!("</{tag}>"), "");
    }
    let labels = page.split("aria-label=\"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned());
    let text =
        page.split('<').map(|part| part.split_once('>').map_or("", |(_, text)| text).trim().to_owned());
    text.chain(labels).filter(|text| !text.is_empty()).collect()
}

/// Names of the program and of keys stand in brackets.
fn english(text: &str) -> Option<&str> {
    let is_name = text.starts_with("wall (rocking-wall)") || text.starts_with("[check]");
    let words = || text.split(|c: char| !c.is_alphabetic() && c != '_').filter(|word| !word.is_empty());
    words().find(|word| {
        !is_name && ENGLISH.split(' ').any(|own| own == *word) && !text.contains(&format!("[check.{word}]"))
    })
}

#[test]
fn italian_reports_have_no_english() {
    let folder = folder("report_italian");
    let nodes = [(13.0, 42.0), (13.05, 42.0), (13.0, 42.05), (13.05, 42.05)];
    let rows = nodes.map(|(lon, lat)| format!("{lon},{lat},0.5,2.4,0.28,5,2.5,0.36\n"));
    let grid = "lon,lat,ag_30,F0_30,TC_30,ag_3000,F0_3000,TC_3000\n".to_owned() + &rows.concat();
    fs::write(folder.join("grid.csv"), grid).unwrap();
    let beam =
        STRIP.replace("\"law\"", "\"beam\"\nyoung_modulus = 1e9").replace("\"worst\"", "\"least_alpha0\"");
    let anchor = TIED.replace("60e3", "30e3");
    let torn = TIED.replace("ultimate_strain = 0.02", "ultimate_strain = 0.001");
    let (before, after) = TIED.split_once("[tie.bar]").unwrap();
    let check = after.split_once("[check]").unwrap().1.replace("yield", "none");
    let brittle =
        format!("{before}tie_stiffness = 5e6\ntie_strength = 10e3\ntie_slack = 0.001\n[check]{check}");
    let given =
        STRIP.replace("\"worst\"", "\"given\"").replace("[force_law]", "hinge_ratio = 0.6\n[force_law]");
    let seven = SITE.replace("count = 3", "count = 7").replace("\"none\"", "\"spectrum\"");
    // a hinge at the end of its range, beside a squat body, with an overburden in another unit
    let squat = STRIP.replace("overburden = 20000", "overburden = 0.02\nhinge_ratio = 0.95");
    let squat = squat.replace("\"worst\"", "\"worst\"\nhinge_range = [0.9, 0.96]");
    let squat = squat.replace(", displacement = 0.1 }", " }");
    let points = "spectrum = [[0, 2], [0.5, 5], [4, 0.6]]\nunit = \"m/s2\"\n[tie]\ntie_height = 1.5\n\
                  tie_stiffness = 2e6\ntie_strength = 2e3\n";
    let of_points = FRACTIONS.split("records").next().unwrap().to_owned() + points;
    let on_a_floor = FRACTIONS.replace("[check]", "[[storeys]]\nperiod = 0.3\n[check]");
    let wall = "\n[geometry]\nheight = 2\nthickness = 0.4\ndensity = 1800\n";
    let examples = check::CODES.map(|code| (code.name, code.example.to_owned() + wall));
    let scenes = [
        ("strip", STRIP),
        ("beam", &beam),
        ("linear", LINEAR),
        ("spectrum", SPECTRUM),
        ("site", SITE),
        ("tied", TIED),
        ("anchor", &anchor),
        ("torn", &torn),
        ("brittle", &brittle),
        ("given", &given),
        ("seven", &seven),
        ("squat", &squat),
        ("fractions", FRACTIONS),
        ("of_points", &of_points),
        ("on_a_floor", &on_a_floor),
    ];
    for (name, scene) in scenes.into_iter().chain(examples.iter().map(|(name, scene)| (*name, &**scene))) {
        fs::write(folder.join("scene.toml"), scene).unwrap();
        succeed(&folder, &["check", "scene.toml", "--lang", "it", "--report", &format!("{name}.html")]);
        let page = content(&folder, &format!("{name}.html"));
        assert!(page.contains("<html lang=\"it\""), "{name}");
        let all = texts(&page);
        assert!(all.len() > 50, "{name}");
        let left: Vec<_> = all.iter().filter_map(|text| Some((english(text)?, text))).collect();
        assert!(left.is_empty(), "{name}: these texts are English: {left:#?}");
    }
    assert_has(&content(&folder, "torn.html"), &["la barra (fragile)", "Area della sezione della barra"]);
    // the runs rock as the scene does
    let said = "Nelle verifiche statiche la parete oscilla solo verso u &gt; 0, verso l'esterno.";
    assert_has(&content(&folder, "site.html"), &[said]);
}

/// A cover with the wall that governs and all walls, then a sheet for each; names stay as they are written.
#[test]
fn a_report_of_walls_has_a_cover_and_sheets() {
    let folder = folder("report_walls");
    let wall = |name: &str, height: f64| {
        format!(
            "[[walls]]\nname = {name:?}\n\
             geometry = {{ height = {height}, thickness = 0.3, density = 1800 }}\n"
        )
    };
    let check = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
                 SLV = { ag = 0.15, F0 = 2.4, TC = 0.32 }\n[report]\nproject = \"Three <parapets>\"\n";
    let walls = [wall("low", 0.8), wall("tie & co", 2.5), wall("middle", 1.2)].concat();
    fs::write(folder.join("walls.toml"), walls.clone() + check).unwrap();
    succeed(&folder, &["check", "walls.toml", "--report", "walls.html", "--date", "3 March 2027"]);
    let page = content(&folder, "walls.html");
    let (cover, sheets) = page.split_once("<div class=\"sheet\"").unwrap();
    let sheets: Vec<_> = sheets.split("<div class=\"sheet\"").collect();
    assert_has(
        cover,
        &[
            "<h1><span translate=\"no\">Three &lt;parapets&gt;</span></h1>",
            "3 March 2027",
            "<p>Governing wall: <span translate=\"no\">tie &amp; co</span></p>",
            "<td><span translate=\"no\">low</span></td>",
            "Site hazard",
            // the data of each wall, beside its numbers
            "<td>simple overturning</td><td>2.5</td><td>0.3</td><td>0</td>",
        ],
    );
    // the worst first, each with its own numbers and where they come from
    for (sheet, (name, height)) in sheets.iter().zip([("tie &amp; co", 2.5), ("middle", 1.2), ("low", 0.8)]) {
        assert_has(
            sheet,
            &[&format!("<h1><span translate=\"no\">{name}</span></h1>"), "Statements of the engineer"],
        );
        assert_has(
            sheet,
            &[&format!("{height} m</span></td><td>file</td>"), "<td>[check] before_activation</td>"],
        );
    }
    // what the walls share stands once
    for once in
        ["Fingerprints are", "Stamp and signature", "Site hazard", "Readings of the code", "Lumping: "]
    {
        assert_eq!((sheets.len(), page.matches(once).count()), (3, 1), "{once}");
    }
    // in Italian the name of a wall is not translated
    succeed(&folder, &["check", "walls.toml", "--report", "muri.html", "--lang", "it"]);
    let italian = content(&folder, "muri.html");
    let left: Vec<_> = texts(&italian).iter().filter_map(|text| english(text).map(str::to_owned)).collect();
    assert!(left.is_empty(), "{left:?}");
    assert_has(
        &italian,
        &[
            "tie &amp; co",
            "Parete determinante:",
            "Pareti che soddisfano la verifica: ",
            "<html lang=\"it\"",
            "Riepilogo delle pareti",
        ],
    );

    // a wall that cannot be checked stands on the cover; the report is written all the same
    let bad = "[[walls]]\nname = \"unknown\"\ngeometry = { height = 2, thickness = 0.3 }\n";
    fs::write(folder.join("mixed.toml"), walls + bad + check).unwrap();
    fails(
        &folder,
        &["check", "mixed.toml", "--report", "mixed.html"],
        &["1 of 4 walls could not be checked"],
    );
    let page = content(&folder, "mixed.html");
    assert_has(&page, &["1 of 4 walls could not be checked", "density not stated"]);
    fs::write(folder.join("none.toml"), bad.to_owned() + check).unwrap();
    let words = ["no wall could be checked; wall \"unknown\": density not stated"];
    refused(&folder, &["check", "none.toml", "--report", "none.html"], &words);
    refused(&folder, &["check", "walls.toml", "--report", "walls.toml"], &["walls.toml"]);
}
