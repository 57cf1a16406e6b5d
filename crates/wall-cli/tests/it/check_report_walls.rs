//! Reports of several walls.

use std::fs;

use crate::check_languages::{ENGLISH, foreign, texts};
use crate::command_line::{assert_has, content, fails, folder, json, refused, succeed};

/// Three parapets, and their check.
fn parapets() -> (String, &'static str) {
    let wall = |name: &str, height: f64| {
        format!(
            "[[walls]]\nname = {name:?}\n\
             geometry = {{ height = {height}, thickness = 0.3, density = 1800 }}\n"
        )
    };
    let check = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
                 SLV = { ag = 0.15, F0 = 2.4, TC = 0.32 }\n[report]\nproject = \"Three <parapets>\"\n";
    ([wall("low", 0.8), wall("tie & co", 2.5), wall("middle", 1.2)].concat(), check)
}

/// A cover with the wall that governs and all walls, then a sheet for each; names stay as they are written.
#[test]
fn a_report_of_walls_has_a_cover_and_sheets() {
    let folder = folder("report_walls");
    let (walls, check) = parapets();
    fs::write(folder.join("walls.toml"), walls + check).unwrap();
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
            "<span><span translate=\"no\">low</span></span></td>",
            "Site hazard",
            // the data of each wall, beside its numbers
            "<span>simple overturning</span></td>",
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
            &[
                &format!("{height} m</span></td><td>file</td>"),
                "<code translate=\"no\">check.before_activation</code>",
            ],
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
    let left: Vec<_> = texts(&italian).iter().filter_map(|text| foreign(text, ENGLISH)).collect();
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
}

/// A wall that cannot be checked stands on the cover; the report is written all the same.
#[test]
fn walls_without_a_verdict_stand_on_the_cover() {
    let folder = folder("report_mixed");
    let (walls, check) = parapets();
    fs::write(folder.join("walls.toml"), walls.clone() + check).unwrap();
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

/// A table of walls has columns for what differs from wall to wall, its headers may be Italian, and the
/// report says that the rows state it.
#[test]
fn rows_state_their_check() {
    let folder = folder("check_rows");
    let walls = "Parete;Meccanismo;Altezza;Spessore;Massa volumica;Carico in sommità;Quota relativa;\
                 prima dell'attivazione;Massa solidale\n\
                 P1;ribaltamento semplice;1,2;0,3;1800;3000;1;rigida;0,5\n\
                 P2;ribaltamento semplice;1,2;0,3;1800;3000;0;rigida;1\n";
    fs::write(folder.join("walls.csv"), walls).unwrap();
    let check = "[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\n\
                 building = { storeys = 3, period = 0.3 }\n\
                 SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n";
    fs::write(folder.join("walls.toml"), format!("walls = [{{ table = \"walls.csv\" }}]\n{check}")).unwrap();
    succeed(&folder, &["check", "walls.toml", "--csv", "out.csv", "--report", "walls.html"]);
    // each row beside a scene of its own
    let table = content(&folder, "out.csv");
    for (name, ratio, mass) in [("P1", "1", "0.5"), ("P2", "0", "1")] {
        let scene = format!(
            "[geometry]\nheight = 1.2\nthickness = 0.3\ndensity = 1800\noverburden = 3000\n{}",
            check.replace("period = 0.3", &format!("period = 0.3, height_ratio = {ratio}")).replace(
                "[check]\n",
                &format!("[check]\nbefore_activation = \"rigid\"\noverburden_mass = {mass}\n")
            )
        );
        fs::write(folder.join("scene.toml"), scene).unwrap();
        let zeta = json(&folder, &["check", "scene.toml", "--json"])["governs"]["zeta_E"].to_string();
        assert!(table.lines().any(|line| line.starts_with(name) && line.contains(&zeta)), "{zeta} {table}");
    }
    let page = content(&folder, "walls.html");
    assert_eq!(page.matches("<code translate=\"no\">check.overburden_mass</code></td><td>stated").count(), 2);
    let bad = walls.replace("rigida;1", "molle;1");
    fs::write(folder.join("walls.csv"), bad).unwrap();
    refused(&folder, &["check", "walls.toml"], &["wall \"P2\": [check] before_activation"]);
}
