//! `cargo xtask figures --reliability`: how safe walls are that just pass the Italian check, for
//! `docs/reliability.md`. About 1,000 walls on soils A to D, on the ground and on a building of three
//! storeys.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use crate::command::{Result, make_folder, read, remove_folder, root, write};
use crate::figures::write_marked;
use crate::images::wall;

const DOCUMENT: &str = "docs/reliability.md";
const FOLDER: &str = "target/reliability";
/// Walls of a kind on one soil at one place.
const WALLS: u32 = 42;
const SOILS: [&str; 4] = ["A", "B", "C", "D"];
/// The first three generators of the R4 sequence, which fills its dimensions evenly. M. Roberts: The
/// unreasonable effectiveness of quasirandom sequences, 2018.
const SEQUENCE: [f64; 3] = [0.856_674_883_854_503, 0.733_891_856_627_126, 0.628_706_721_503_856];
/// Probability of a fall above which walls are counted.
const LIMIT: f64 = 0.10;

/// A kind of wall.
struct WallKind {
    name: &'static str,
    /// Damping models: viscous ones do not go with one-sided rocking.
    models: &'static str,
    /// What the check states of it.
    check: &'static str,
    /// Its floors in the building.
    supports: &'static str,
    /// Height \[m\] and slenderness.
    ranges: [[f64; 2]; 2],
}

const KINDS: [WallKind; 3] = [
    WallKind {
        name: "parapets",
        models: "[\"CR\", \"CDR\"]",
        check: "before_activation = \"law\"",
        supports: "{ bottom = 3 }",
        ranges: [[0.6, 3.0], [3.0, 12.0]],
    },
    WallKind {
        name: "façades",
        models: "[\"CR\"]",
        check: "before_activation = \"rigid\"\noverburden_mass = 0",
        supports: "{ bottom = 2 }",
        ranges: [[4.0, 12.0], [8.0, 16.0]],
    },
    WallKind {
        name: "strips",
        models: "[\"CR\", \"CDR\"]",
        check: "before_activation = \"law\"",
        supports: "{ bottom = 2, top = 3 }",
        ranges: [[2.5, 5.0], [8.0, 16.0]],
    },
];

/// Computes the tables under the program's own motions, and, where `ROCKING_WALL_RECORDS` names their folder,
/// under recorded ones; writes them into the document.
pub(crate) fn run() -> Result<()> {
    let mut figures = vec![("synthetic", tables("synthetic", "synthetic = { count = 30 }")?)];
    if let Some(folder) = std::env::var_os("ROCKING_WALL_RECORDS") {
        let files = Path::new(&folder).join("RSN*.AT2");
        figures
            .push(("recorded", tables("recorded", &format!("files = [{:?}]", files.display().to_string()))?));
    } else {
        println!("the table of recorded motions stays as it is: name their folder in ROCKING_WALL_RECORDS");
    }
    write_marked(DOCUMENT, &figures)?;
    println!("written {DOCUMENT}");
    Ok(())
}

/// The fall of a wall.
#[derive(Clone, Copy)]
struct Fall {
    margin: f64,
    probability: f64,
    /// Ground acceleration at which the check has ζ = 1 \[g\].
    ag_code: f64,
    /// Ground acceleration at which half of the records make it fall \[g\].
    theta: f64,
}

fn tables(motions: &str, records: &str) -> Result<String> {
    let folder = root().join(FOLDER).join(motions);
    // the folder of a study by another build would be refused
    remove_folder(&folder)?;
    make_folder(&folder)?;
    // by kind, place, check and model; and by kind, place, soil
    let (mut all, mut by_soil) = (BTreeMap::<_, Vec<Fall>>::new(), BySoil::new());
    for (order, kind) in KINDS.iter().enumerate() {
        write(folder.join(format!("{}.csv", kind.name)), walls(order, kind))?;
        for soil in SOILS {
            for place in ["ground", "storeys"] {
                let name = format!("{}_{soil}_{place}", kind.name);
                let file = folder.join(format!("{name}.toml"));
                write(&file, study(kind, soil, place, records))?;
                let [file, results] = [file, folder.join(&name)].map(|path| path.display().to_string());
                wall(&["study", "reliability", &file, "-o", &results])?;
                for ((check, model), falls) in falls(&Path::new(&results).join("reliability.csv"))? {
                    if model == "CR" && check != "SLV with q" {
                        by_soil.insert((order, place, check.clone(), soil), falls.clone());
                    }
                    all.entry((order, place, check, model)).or_default().extend(falls);
                }
            }
        }
    }
    let mut text = head("model");
    for ((kind, place, check, model), falls) in &all {
        // writing to a String cannot fail
        let _ = writeln!(text, "| {} | {place} | {check} | {model} | {} |", KINDS[*kind].name, shown(falls));
    }
    let _ = writeln!(text, "\nWith CR, soil by soil:\n{}", head("soil").trim_end());
    for ((kind, place, check, soil), falls) in &by_soil {
        let _ = writeln!(text, "| {} | {place} | {check} | {soil} | {} |", KINDS[*kind].name, shown(falls));
    }
    Ok(text + &over_ground(&by_soil)? + "\n")
}

/// Falls with CR by kind, place, check and soil.
type BySoil = BTreeMap<(usize, &'static str, String, &'static str), Vec<Fall>>;

/// Compares the walls on storeys with the same walls on the ground: medians of both accelerations, soil by
/// soil.
fn over_ground(by_soil: &BySoil) -> Result<String> {
    let mut rows = BTreeMap::<_, [Vec<String>; 2]>::new();
    for ((kind, place, check, soil), falls) in by_soil {
        let ground = &by_soil[&(*kind, "ground", check.clone(), *soil)];
        if ground.len() != falls.len() {
            return Err(format!("{} on soil {soil}: a wall falls at one place only", KINDS[*kind].name));
        }
        if *place == "ground" {
            continue;
        }
        let ratio = |of: fn(&Fall) -> f64| {
            let ratios = falls.iter().zip(ground).map(|(fall, ground)| of(fall) / of(ground));
            format!("{:.2}", fractile(ratios, 50))
        };
        let [asked, borne] = rows.entry((*kind, check)).or_default();
        asked.push(ratio(|fall| fall.ag_code));
        borne.push(ratio(|fall| fall.theta));
    }
    let mut text = String::from("\nStoreys over ground, medians with CR:\n\n| walls | check |");
    for name in ["a_g,code", "θ"] {
        let _ = write!(text, " {name}: {} |", SOILS.join(" | "));
    }
    let _ = writeln!(text, "\n|{}", "---|".repeat(2 + 2 * SOILS.len()));
    for ((kind, check), [asked, borne]) in rows {
        let cells = [asked, borne].concat().join(" | ");
        let _ = writeln!(text, "| {} | {check} | {cells} |", KINDS[kind].name);
    }
    Ok(text)
}

/// The first lines of a table whose fourth column is `varied`.
fn head(varied: &str) -> String {
    let columns = ["walls", "place", "check", varied, "θ/a_g,code: 5 %", "50 %", "95 %", "P(fall): 50 %"];
    format!("\n| {} | 95 % | P > {LIMIT} |\n|{}\n", columns.join(" | "), "---|".repeat(10))
}

/// The value that some per cent of the values do not exceed.
fn fractile(values: impl Iterator<Item = f64>, percent: usize) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[(percent * values.len()).div_ceil(100).max(1) - 1]
}

/// Fractiles of margins and probabilities, and the share of walls above the limit.
fn shown(falls: &[Fall]) -> String {
    let margin = |percent| fractile(falls.iter().map(|fall| fall.margin), percent);
    let probability = |percent| fractile(falls.iter().map(|fall| fall.probability), percent);
    let above = falls.iter().filter(|fall| fall.probability > LIMIT).count();
    format!(
        "{:.2} | {:.2} | {:.2} | {:.3} | {:.3} | {:.0} %",
        margin(5),
        margin(50),
        margin(95),
        probability(50),
        probability(95),
        100.0 * above as f64 / falls.len() as f64
    )
}

/// Returns the falls of the walls, in their order, by check and model.
fn falls(path: &Path) -> Result<BTreeMap<(String, String), Vec<Fall>>> {
    let text = read(path)?;
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut found = BTreeMap::<_, Vec<Fall>>::new();
    for line in lines {
        let cells: BTreeMap<&str, &str> = names.iter().copied().zip(line.split(',')).collect();
        let number = |name: &str| cells.get(name).and_then(|cell| cell.parse::<f64>().ok());
        if cells.get("event") == Some(&"fall")
            && let [Some(margin), Some(probability), Some(ag_code), Some(theta)] =
                ["margin", "probability", "ag_code_g", "theta_g"].map(number)
        {
            let key = (cells["check"].to_owned(), cells["model"].to_owned());
            found.entry(key).or_default().push(Fall { margin, probability, ag_code, theta });
        }
    }
    Ok(found)
}

/// Makes the walls of a kind as CSV: heights and slendernesses of its ranges, evenly spread. Half of the
/// façades have no overburden, the others up to their weight; strips have up to five times theirs, and their
/// hinge at the least α0, x = 1/(1 + √(O/(2 (W + O)))), at most 0.9.
fn walls(order: usize, kind: &WallKind) -> String {
    let mut text = String::from(
        "name,mechanism,height,thickness,density,overburden,hinge_ratio,a1,rocking,restitution_source\n",
    );
    for k in 1..=WALLS {
        let part = |dimension: usize| (0.5 + f64::from(k) * SEQUENCE[dimension]).fract();
        let [height, slenderness] = [0, 1].map(|place| {
            let [from, to] = kind.ranges[place];
            from + part(place) * (to - from)
        });
        let over = [0.0, (2.0 * part(2) - 1.0).max(0.0), 5.0 * part(2)][order];
        let thickness = height / slenderness;
        let overburden = over * 1800.0 * 9.81 * height * thickness;
        let hinge = (1.0 / (1.0 + (over / (2.0 * (1.0 + over))).sqrt())).min(0.9);
        let (mechanism, rocking, source, hinge) = match order {
            0 => ("parapet", "two_sided", "", String::new()),
            1 => ("parapet", "one_sided_positive", "analytic", String::new()),
            _ => ("vertical_spanning", "two_sided", "", hinge.to_string()),
        };
        // writing to a String cannot fail
        let _ = writeln!(
            text,
            "{} {k},{mechanism},{height},{thickness},1800,{overburden},{hinge},0.05,{rocking},{source}",
            kind.name
        );
    }
    text
}

/// Makes the study of a kind on a soil, on the ground or in a building of T₁ = 0.3 s.
fn study(kind: &WallKind, soil: &str, place: &str, records: &str) -> String {
    let WallKind { name, models, check, supports, .. } = kind;
    let storey = "[[storeys]]\nmass = 1e5\nstiffness = 2.2e8\ndamping_ratio = 0.1\n";
    let (storeys, damping, supports) = match place {
        "ground" => (String::new(), "", String::new()),
        _ => (storey.repeat(3), ", building_damping = 0.1", format!("supports = {supports}\n")),
    };
    format!(
        "models = {models}\n\
         levels = {{ method = \"hunt\", first = 0.05, increase = 0.05, top = 50 }}\n\
         records = {{ {records} }}\n\
         intensity = {{ measure = \"code\" }}\n\
         report = {{ resamples = 100 }}\n\
         [check]\ncode = \"circolare-2019\"\n{check}\nsoil = \"{soil}\"\n\
         SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32{damping} }}\n\
         SLC = {{ ag = 0.20, F0 = 2.45, TC = 0.33{damping} }}\n\
         {storeys}[[walls]]\ntable = \"{name}.csv\"\n{supports}"
    )
}
