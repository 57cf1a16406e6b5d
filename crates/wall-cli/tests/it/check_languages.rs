//! Reports in Italian have no English of the program, and those in English no Italian.

mod scenes;

use std::fs;
use std::path::Path;

use check::{CheckFile, Language, Origin, ReportTable, Subject, baseline, page, read};

use crate::command_line::{assert_has, content, folder};
use scenes::{FACADE, FRACTIONS, LINEAR, SITE, SPECTRUM, STRIP, TIED, TIED_STRIP, TWO_TIES, WEDGE};

/// Records that begin in the middle of the shaking.
const CUT: &str = "files = [\"cut*.txt\"], unit = \"m/s2\", step = 0.02";

/// Words that no Italian text of the program has.
pub(crate) const ENGLISH: &str = "the of is are with and at from its not walls each taken before which \
                       without to for by has have under needs stands passed demand tie records spectrum \
                       onset displacement ratio quantity unit capacity secant points column bears site \
                       outwards";

/// Words that no English text of the program has.
const ITALIAN: &str = "della dello degli dei delle gli è sono non verso parete catena spostamento domanda \
                       capacità verifica soddisfatta alla allo nel suolo piani sottosuolo dichiarato peso \
                       carico spettro lo il un una";

/// The texts of a page: what stands between tags other than those of formulas, and the labels of pictures.
/// What users write and names of parameters are left out.
pub(crate) fn texts(page: &str) -> Vec<String> {
    let mut page = page.to_owned();
    for (begins, ends) in [
        ("<style", "</style>"),
        ("<title", "</title>"),
        ("<span translate", "</span>"),
        ("<code translate", "</code>"),
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

/// The words of a language that a text has.
pub(crate) fn foreign(text: &str, language: &'static str) -> Option<&'static str> {
    let words: Vec<&str> =
        text.split(|c: char| !c.is_alphabetic() && c != '_').filter(|word| !word.is_empty()).collect();
    language.split(' ').find(|own| words.contains(own))
}

/// Scenes that differ from those above in what is stated.
fn variants() -> Vec<(&'static str, String)> {
    let of_strip = |from: &str, to: &str| STRIP.replace(from, to);
    let table = |more: &str| LINEAR.replace("[check]\n", &format!("[check]\n{more}\n"));
    let tall = LINEAR.replace("height = 2\n", "height = 9\n").replace("\nmethod = \"linear\"", "");
    let slc = |text: &str| text.replace("SLV = {", "SLC = {");
    let law = |law: &str| {
        let text = LINEAR.replace("[check]", &format!("[force_law]\n{law}\n[check]"));
        text.replace("\"rigid\"", "\"law\"").replace("method = \"linear\"\n", "")
    };
    let declared = "[report]\nmechanism = \"x\"\nmaterials = \"x\"\nloads = \"x\"\nmonolithic = true\n\
                    masonry_quality = false\nintervention = \"x\"\nclient = \"x\"\n";
    vec![
        ("target", table("target = 0.6")),
        ("retrofit", table("target = 0.9\nuse_class = \"III\"")),
        ("raised", of_strip("[check]\n", "[check]\nraise_slc = true\n")),
        ("ground", of_strip("height_ratio = 0.6", "height_ratio = 0")),
        (
            "modes",
            of_strip(
                "storeys = 3, period = 0.3, height_ratio = 0.6",
                "modes = [{ period = 0.3, participation = 1.1 }, { period = 0.1, participation = -0.3 }]",
            ),
        ),
        ("inwards", table("rocking = \"one_sided_negative\"")),
        ("outwards", table("rocking = \"one_sided_positive\"")),
        ("tall", tall.clone()),
        ("tall_slc", slc(&tall)),
        ("trilinear", law("force_law = \"trilinear\"\na1 = 0.03\nd1 = 0.8")),
        ("points", law("force_law = \"multilinear\"\npoints = [[0.05, 0.9], [1.0, 0.0]]")),
        ("knowledge", table("knowledge_level = \"LC3\"\ncompression_considered = true")),
        (
            "heavy_tie",
            TIED.replace("diameter = 0.016", "diameter = 0.06").replace("anchor_capacity = 60e3\n", ""),
        ),
        ("declared", LINEAR.to_owned() + declared),
        ("quiet", SITE.replace("\"g/10\"", "\"m/s2\"")),
        (
            "spring",
            of_strip("\"worst\"", "\"given\"")
                .replace("overburden_eccentricity", "hinge_ratio = 0.5\noverburden_eccentricity"),
        ),
        ("facade", FACADE.to_owned()),
        ("facade_each", FACADE.replace("[check]\n", "[check]\nresultants = \"each\"\n")),
        ("two_ties", TWO_TIES.to_owned()),
        ("cut_records", SITE.replace("synthetic = { count = 3, duration = 10, step = 0.02 }", CUT)),
        ("wedge_between", WEDGE.to_owned()),
        ("wedge_at_its_end", WEDGE.replace("[5, 60]", "[5, 6]")),
        ("tied_strip", TIED_STRIP.to_owned()),
        ("worst_strip", TIED_STRIP.replace("[check]\n", "[check]\nhinge = \"worst\"\n")),
        ("slack_strip", TIED_STRIP.replace("yield\"", "none\"").replace("6e3", "6e3\ntie_slack = 0.003")),
        ("before", WEDGE.replace("[check]\n", "[check]\nbaseline = \"before.toml\"\n")),
        ("class_four", of_strip("SLD = {", "#SLD = {")),
    ]
}

/// The scenes of the project that are checked.
fn shipped() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");
    let parapet = [format!("{folder}/checked_parapet.toml").into()];
    let mechanisms = fs::read_dir(format!("{folder}/mechanisms")).unwrap();
    let shipped: Vec<_> = mechanisms.map(|entry| entry.unwrap().path()).chain(parapet).collect();
    assert!(shipped.len() >= 5, "{shipped:?}");
    let named = |path: std::path::PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    shipped.into_iter().map(named).collect()
}

/// The reports of one check, in both languages.
fn reports(path: &Path, text: &str) -> [(Language, String); 2] {
    let file = CheckFile::parse(path.to_str().unwrap(), text).unwrap();
    let (scene, code) = (file.scene().unwrap(), read(&file).unwrap());
    let assumed = file.assumed(&[]);
    let mut verdict = code.check(Subject { assumed: &assumed, ..(&scene).into() }).unwrap();
    verdict.before = baseline(&file, &*code, &mut Vec::new()).unwrap();
    let report = file.report().unwrap();
    Language::ALL.map(|language| {
        let report = ReportTable { language, ..report.clone() };
        let origin = Origin::new(&scene.title, &file, code.records(), &report, "wall");
        assert!(!verdict.text(&scene.title, language).is_empty());
        (language, page(&verdict, &origin).unwrap())
    })
}

fn assert_is_in(language: Language, name: &str, page: &str) {
    let others = match language {
        Language::It => ENGLISH,
        Language::En => ITALIAN,
    };
    let language = language.name();
    assert!(page.contains(&format!("<html lang=\"{language}\"")), "{name}");
    let all = texts(page);
    assert!(all.len() > 50, "{name}");
    let own = |text: &&String| !text.starts_with("wall ");
    let left: Vec<_> =
        all.iter().filter(own).filter_map(|text| Some((foreign(text, others)?, text))).collect();
    assert!(left.is_empty(), "{name} in {language}: these texts are not: {left:#?}");
}

#[test]
fn reports_have_one_language() {
    let folder = folder("report_languages");
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
    // one record: each spectrum takes a while
    let on_a_floor = FRACTIONS.replace("[check]", "[[storeys]]\nperiod = 0.3\n[check]");
    let on_a_floor = on_a_floor.replace("count = 7", "count = 1");
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
    // shaking that begins and ends at its peak
    for (name, rate) in [("cut1.txt", 0.2), ("cut2.txt", 0.3), ("cut3.txt", 0.4)] {
        let samples = (0..500).map(|step| format!("{:.6}\n", (rate * f64::from(step)).cos()));
        fs::write(folder.join(name), samples.collect::<String>()).unwrap();
    }
    fs::write(folder.join("before.toml"), TIED.replace("0.016", "0.008")).unwrap();
    let (variants, shipped) = (variants(), shipped());
    let scenes = scenes.into_iter().chain(examples.iter().map(|(name, scene)| (*name, &**scene)));
    let scenes = scenes.chain(variants.iter().map(|(name, scene)| (*name, &**scene)));
    let scenes: Vec<_> = scenes.chain(shipped.iter().map(|(name, scene)| (&**name, &**scene))).collect();
    assert_eq!(scenes.len(), 49, "docs/model.md counts them");
    for (name, scene) in scenes {
        for (language, page) in reports(&folder.join("scene.toml"), scene) {
            fs::write(folder.join(format!("{name}-{}.html", language.name())), &page).unwrap();
            assert_is_in(language, name, &page);
        }
    }
    assert_has(&content(&folder, "torn-it.html"), &["la barra (fragile)", "Area della sezione della barra"]);
    assert_has(&content(&folder, "cut_records-it.html"), &["manca l'inizio?", "manca la fine?"]);
    // the runs rock as the scene does
    let said = "Nelle verifiche statiche la parete oscilla solo verso u &gt; 0, verso l'esterno.";
    assert_has(&content(&folder, "site-it.html"), &[said]);
}
