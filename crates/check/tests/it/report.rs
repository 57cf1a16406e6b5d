//! What a reader of the Italian report has to find: each number with its formula, each sign and each limit
//! said, and nothing in English.

use check::{CheckFile, Language, Origin, WallCodes, check_walls, page, page_of_walls, read};
use run::walls::NamedWall;
use scene::Scene;

use crate::circolare::PARAPET;
use crate::circolare_hinges::palazzo;

/// A parapet, a strip whose hinges are searched and set back, and a façade with a tie, on one building.
fn walls() -> String {
    let at = |height_ratio: f64| format!("building = {{ height_ratio = {height_ratio} }}");
    format!(
        "{}[report]\nproject = \"Palazzo\"\nrevision = \"2\"\nnominal_life = 50\nuse_coefficient = 1\n\
         [[walls]]\nname = \"P1\"\n\
         geometry = {{ height = 1.2, thickness = 0.3, density = 1800 }}\nforce_law = {{ a1 = 0.05 }}\n\
         check = {{ before_activation = \"law\", {} }}\n\
         [[walls]]\nname = \"P2\"\n\
         geometry = {{ mechanism = \"vertical_spanning\", height = 3.4, thickness = 0.4, density = 1900, \
         overburden = 60e3, overburden_eccentricity = 0.05 }}\n\
         force_law = {{ a1 = 0.03 }}\n\
         check = {{ before_activation = \"law\", hinge = \"worst\", masonry_strength = 1.5e6, {} }}\n\
         [[walls]]\nname = \"P3\"\n\
         geometry = {{ height = 7, thickness = 0.5, density = 1900, overburden = 12e3, \
         overburden_eccentricity = 0.1 }}\n\
         tie = {{ tie_height = 6.8, tie_side = \"positive\" }}\n\
         check = {{ before_activation = \"rigid\", overburden_mass = 1, \
         rocking = \"one_sided_positive\", {}, tie = {{ at_activation = \"yield\", \
         bar = {{ diameter = 0.016, length = 6, yield_stress = 235e6, \
         ultimate_strain = 0.02, spacing = 3 }} }} }}\n",
        palazzo(1.0, "knowledge_level = \"LC1\""),
        at(1.0),
        at(0.83),
        at(0.37)
    )
}

pub(crate) fn report_of_walls(language: Language) -> String {
    report_of_file("walls.toml", &walls(), language)
}

fn report_of_file(name: &str, text: &str, language: Language) -> String {
    let file = CheckFile::parse(name, text).unwrap();
    let walls = file.walls(&[], &mut Vec::new(), &mut Vec::new()).unwrap();
    let codes = WallCodes::read(&file, &walls).unwrap();
    let verdicts = check_walls(&codes, &walls, 1);
    let mut report = file.report().unwrap();
    report.language = language;
    let origin = Origin::new("walls", &file, codes.shared().records(), &report, "wall");
    page_of_walls(&verdicts, &walls, &codes, &origin).unwrap()
}

/// The report of one wall.
pub(crate) fn report_of_one(text: &str) -> String {
    let file = CheckFile::parse("one.toml", text).unwrap();
    let code = read(&file).unwrap();
    let scene = Scene::parse("one.toml", text, ".".as_ref()).unwrap();
    let verdict = code.check((&scene).into()).unwrap();
    let (records, report) = (code.records(), file.report().unwrap());
    let origin = Origin::new("one", &file, records, &report, "wall");
    page(&verdict, &origin).unwrap()
}

fn text_of_one(text: &str) -> String {
    plain(&report_of_one(text))
}

/// The text of a page without its markup; spaces do not break and powers have `^`.
pub(crate) fn plain(page: &str) -> String {
    let mut text = String::new();
    for part in page.replace("<sup>", "<sup>^").split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, after)| after));
        // cells and sentences stay apart
        let is_end = ["/td", "/th", "/p", "/li", "/h2", "/text"].iter().any(|end| part.starts_with(end));
        text.push_str(if is_end { "\n" } else { "" });
    }
    text.replace("&gt;", ">").replace("&lt;", "<").replace("&quot;", "\"").replace('\u{a0}', " ")
}

fn assert_says(text: &str, all: &[&str]) {
    for said in all {
        assert!(text.contains(said), "the report does not say: {said}");
    }
}

fn assert_never_says(text: &str, all: &[&str]) {
    for said in all {
        assert!(!text.contains(said), "the report says: {said}");
    }
}

#[test]
fn assumptions_signs_and_limits_are_declared() {
    let text = plain(&report_of_walls(Language::It));
    assert_says(
        &text,
        &[
            "FC = 1,35 (livello di conoscenza LC1), applicato ad a e a fm.",
            "fm = 1,5 MPa, γ = 1 anziché 2 (C8.7.1), κ = 0,85.",
            "la più sfavorevole tra 0,1 h e 0,9 h, per ogni verifica.",
            // the sign of u
            "u > 0: verso l'esterno",
            "interno",
            "esterno\n",
            "verso l'esterno (u > 0)\n",
            "eccentricità del carico in sommità, positiva verso l'esterno (u > 0)",
            // no tie that is broken at d_SLC raises SLC
            "lo SLD non innalza lo SLC: considera la catena, che a dSLC è rotta",
            // beyond the spectra of the code
            "NTC 3.2.3.2 ammette gli spettri in accelerazione fino a 4 s",
            "T > 4 s: oltre gli spettri in accelerazione",
            "TSLC = 4,4",
            // what a1 turns
            "in questo verso, non quello della parete: con a1 = 0,015 lo SLV passa da 0,877 a 1,098",
            "analisi di sensibilità: con a1 = 0,015 ζE = 1,031",
            // what the engineer stated
            "T1 dell'edificio è dichiarato dal progettista.",
            "γ1 = 3n/(2n + 1)",
            "[C7.2.10]",
            "Tensione di snervamento di progetto",
            "L'esito è riferito a ζE ≥ 1; per gli interventi di miglioramento si veda NTC 8.4.2.",
            "dSLC è riferito alla cerniera h1/h = 0,8233.",
            "475 anni",
        ],
    );
    assert_never_says(&text, &["si veda NTC 8,4", "Verso trattenuto dalla catena tie_side\npositivo"]);
}

#[test]
fn every_number_has_its_formula() {
    let text = plain(&report_of_walls(Language::It));
    assert_says(
        &text,
        &[
            "a = 0,8 e b = 1,1 nella [C7.2.6]",
            "= aZ A/[1 + (A − 1) (TSLV/(b T1) − 1)^1,2] = 7,473 · \
             3,051/[1 + 2,051 · (1,238/(1,1 · 0,32) − 1)^1,2] = 3,161 m/s²",
            "aZ,k = Se(Tk, ξk) γk ψk √(1 + 4 ξk²)",
            "a0 (1 − d/d0)/FC = 2,453 · (1 − 60/150)/1,35 = 1,09 m/s²",
            "ay = a0 (1 − dy/d0) = 2,453 · (1 − 7,5/150) = 2,330 m/s²",
            "T0 = 2π √(dy/ay) = 2π √(7,5 · 10⁻³/2,330)",
            "k0 = 2 (W + 2 O)/h = 2 · (6,357 + 2 · 0)/1,2 = 10,59 kN/m",
            "u0 = Fact/k0 = 1,589/10,59 · 10³ = 150 mm",
            // the strip at the hinge of each check
            "81,89",
            "0,8233",
            // the tie
            "N = max[0; (FC Sa − a0) (W + 2 r O) e*/(g 2 y/h)] = max[0; (1,35 · 1,365 − \
             0,5688) · 89,24/(9,81 · 2 · 6,8/7)] = 5,964 kN",
            "((W + 2 r O) e*)]/FC = [0,5688",
            "Simboli",
            "pendenza della retta che si annulla a u0",
            "Sa\naccelerazione richiesta da una verifica all'attivazione",
        ],
    );
}

/// Headings of numbers are looked up, too: their spaces do not break.
#[test]
fn headings_are_italian() {
    let text = plain(&report_of_walls(Language::It));
    assert_says(
        &text,
        &[
            "ag sopportata [g]",
            "ag del sito [g]",
            "SLV con q",
            "in ordine di ζE crescente",
            "Verifica dei meccanismi locali",
        ],
    );
    assert_never_says(&text, &["SLV with q", "bears", "site ag [g]", "\"worst\""]);
    let english = plain(&report_of_walls(Language::En));
    assert_says(
        &english,
        &["bears ag [g]", "u > 0: outwards", "Symbols", "local out-of-plane mechanisms by"],
    );
}

/// Numbers of sections are unique; the foot of a page names project, revision and wall.
#[test]
fn pages_name_project_and_wall() {
    let page = report_of_walls(Language::It);
    let foot = |text: &str| {
        let letters = text.chars().map(|letter| format!("\\{:x} ", u32::from(letter)));
        format!("content: \"{}\"", letters.collect::<String>())
    };
    for text in ["Palazzo · rev. 2", "Palazzo · rev. 2 · P2"] {
        assert!(page.contains(&foot(text)), "{text}");
    }
    assert!(page.contains("style=\"page: wall2\"") && page.contains("counter(part) \".\" counter(own)"));
}

/// Only what has a hazard is said to decide.
#[test]
fn limit_states_without_hazard_do_not_decide() {
    let text = "[geometry]\nheight = 6\nthickness = 0.5\ndensity = 1900\n[tie]\ntie_height = 5.8\n\
                tie_stiffness = 5e6\ntie_strength = 10e3\n\
                [check]\ncode = \"circolare-2019\"\nsoil = \"C\"\nbefore_activation = \"rigid\"\n\
                SLV = { ag = 0.18, F0 = 2.45, TC = 0.34 }\n[report]\nlanguage = \"it\"\n";
    let text = text_of_one(text);
    assert_says(
        &text,
        &[
            "Non verificati: dati sismici non forniti per SLD, SLC (NTC 8.3, 7.3.6).",
            "Decide lo SLV in spostamento; le altre verifiche sono a titolo informativo.",
            "Decide lo SLV in spostamento (C8.7.1.2.1.8).",
            "in assenza di catena, SLV ",
        ],
    );
    assert_never_says(&text, &["SLC –", "Decidono"]);
}

/// A wall that passes by the raise of SLC says that this is by analogy, as one that fails by it does.
#[test]
fn a_raise_by_analogy_is_named() {
    let data: toml::Table = include_str!("../data/circolare.toml").parse().unwrap();
    let case = |index: usize| {
        data["cases"][index]["scene"].as_str().unwrap().replace("[check]\n", "[check]\nraise_slc = true\n")
    };
    let passed =
        "PASSED by the raise of SLD, for SLC by analogy with C8.7.1.2.1.8; SLC by displacement 0.599";
    let text = text_of_one(&case(2));
    assert_says(&text, &[passed, "Check of local out-of-plane mechanisms by Circolare"]);
    let failed = "raised by SLD, for SLC by analogy with C8.7.1.2.1.8; SLC by displacement 0.301 (u > 0)";
    assert_says(&text_of_one(&case(4)), &["NOT PASSED: SLC governs with", failed]);
    // of two that are raised the least is named, and the analogy stays
    let both = case(2).replace("ag = 0.1006202520392437", "ag = 0.2");
    let passed = "PASSED by the raise of SLD, for SLC by analogy with C8.7.1.2.1.8; SLV by displacement 0.";
    assert_says(&text_of_one(&both), &[passed]);
}

/// Runs may fall to a side that the static checks leave out: what judges it there is printed. A parapet with
/// the hinge at its edge overturns at half its thickness.
#[test]
fn every_threshold_of_runs_is_printed() {
    let text = |rocking: &str| {
        format!(
            "{PARAPET}{rocking}[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\n\
             soil = \"B\"\nrocking = \"one_sided_positive\"\nmethod = \"dynamic\"\n\
             records = {{ synthetic = {{ count = 3, duration = 10, step = 0.02 }} }}\n\
             SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32 }}\n"
        )
    };
    let left_out = "Threshold on the side u < 0, which the static checks leave out: overturning";
    assert_says(&text_of_one(&text("")), &[&format!("{left_out}\n(d/u) uins = 200 mm")]);
    // a wall that rocks to one side in its runs, too, has no threshold on the other
    let one = "[impact]\nimpact = \"restitution\"\nrocking = \"one_sided_positive\"\nrestitution = 0.5\n\
               [damping]\ndamping_model = \"none\"\n";
    assert_never_says(&text_of_one(&text(one)), &[left_out]);
}

/// A parameter that is stated comes from its file, also where its value is that of the default.
#[test]
fn what_a_table_of_walls_states_is_not_a_default() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let table = folder.join("stated.csv");
    std::fs::write(&table, "name,height,thickness,density,width\na,4,0.4,1800,1\nb,4,0.4,1800,\n").unwrap();
    let width = rocking_wall::wall::Parameters::default().width;
    assert_eq!(width, 1.0, "the table states the default");
    let text = "check = { code = \"circolare-2019\", before_activation = \"rigid\", soil = \"B\", \
                SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 } }\nwalls = [{ table = \"stated.csv\" }]\n";
    let name = folder.join("stated.toml");
    let text = plain(&report_of_file(name.to_str().unwrap(), text, Language::En));
    let origins: Vec<_> =
        text.split("Length along the wall\n1 m\n").skip(1).map(|after| after.lines().next()).collect();
    assert_eq!(origins, [Some("file"), Some("default")]);
}

/// Of a wall that was made, not read, no parameter is a default.
#[test]
fn a_wall_of_no_file_states_everything() {
    let text = format!(
        "{PARAPET}[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
         SLV = {{ ag = 0.15, F0 = 2.45, TC = 0.32 }}\n"
    );
    let file = CheckFile::parse("one.toml", &text).unwrap();
    let code = read(&file).unwrap();
    let scene = Scene::parse("one.toml", &text, ".".as_ref()).unwrap();
    let verdict = code.check((&scene).into()).unwrap();
    let (records, report) = (code.records(), file.report().unwrap());
    let width = |wall: Option<&NamedWall>| {
        let origin = Origin { wall, ..Origin::new("one", &file, records, &report, "wall") };
        let text = plain(&page(&verdict, &origin).unwrap());
        let (_, after) = text.split_once("Length along the wall\n1 m\n").unwrap();
        after.lines().next().unwrap().to_owned()
    };
    assert_eq!(width(None), "default", "the scene leaves it open");
    assert_eq!(width(Some(&NamedWall::new("one", scene.parameters.clone()))), "file");
}

/// A ratio that is computed stands in the unit of its parameter: c̄, not the ξ that is equivalent.
#[test]
fn a_computed_ratio_is_that_of_the_model() {
    let text = format!(
        "{PARAPET}[damping]\ndamping_model = \"free_standing_block\"\n[check]\ncode = \"fractions\"\n\
         spectrum = [[0, 2], [4, 0.6]]\nunit = \"m/s2\"\n"
    );
    let scene = Scene::parse("one.toml", &text, ".".as_ref()).unwrap();
    let e = rocking_wall::wall::Wall::new(&scene.parameters).unwrap().restitution().positive;
    let c_bar = rocking_wall::wall::equivalence::free_standing_block(e);
    let report = text_of_one(&text);
    let mut rows = report.split("Damping constant of a free-standing block\n").skip(1);
    let row = rows.next().unwrap();
    let shown: f64 = row.split_whitespace().next().unwrap().parse().unwrap();
    // six digits
    assert!((shown / c_bar - 1.0).abs() < 5e-6, "{shown} for {c_bar}");
}

/// What parts and an opening weigh, by hand, each specific weight with the heights that have it.
#[test]
fn loads_of_parts_are_their_volumes() {
    let text = "[geometry]\npart = [\n{ height = 3, thickness = 0.5, density = 1800, width = 2 },\n\
                { height = 2, thickness = 0.4, density = 1600, width = 2 },\n]\n\
                opening = [{ base = 1, height = 1.2, width = 0.8 }]\n\
                [check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\nsoil = \"B\"\n\
                SLV = { ag = 0.1, F0 = 2.4, TC = 0.32 }\n";
    let said = text_of_one(text);
    let g = 9.81;
    let [lower, upper] = [1800.0 * g * 3.0 * 0.5 * 2.0, 1600.0 * g * 2.0 * 0.4 * 2.0].map(|w| 1e-3 * w);
    let opening = 1e-3 * 1800.0 * g * 1.2 * 0.5 * 0.8;
    let rows = [
        ("Part from 0 to 3 m", lower),
        ("Part from 3 to 5 m", upper),
        ("Opening from 1 to 2.2 m", -opening),
        ("Own weight W", lower + upper - opening),
        ("Specific weight of the masonry from 0 to 3 m", 1.8 * g),
        ("Specific weight of the masonry from 3 to 5 m", 1.6 * g),
    ];
    for (name, value) in rows {
        let row: Vec<_> = said.lines().skip_while(|line| *line != name).take(3).collect();
        let told = row.last().and_then(|cell| cell.split_once(" kN")).map(|(told, _)| told.replace('−', "-"));
        // with four digits
        let told: f64 = told.unwrap_or_else(|| panic!("{name} of {said}")).parse().unwrap();
        assert!((told - value).abs() <= 6e-4 * value.abs(), "{name}: {told}, by hand {value}");
    }
    // parts that are alike share it
    let alike = text_of_one(&text.replace("1600", "1800"));
    assert_eq!(alike.matches("Specific weight of the masonry").count(), 1);
}
