//! The report of `wall check`.

use std::path::Path;

use crate::command_line::{assert_has, content, folder, refused, succeed};

/// The tied parapet on the roof, example (c) of the check by Circolare 7/2019.
const TIED: &str = "title = \"A <b>tied</b> parapet & \\\"its\\\" roof\"\n\
    [geometry]\nheight = 4\nthickness = 0.4\ndensity = 1800\n[force_law]\na1 = 0.03\n\
    [tie]\ntie_stiffness = 200e3\ntie_height = 3\ntie_slack = 0.03\ntie_strength = 5e3\n\
    [check]\ncode = \"circolare-2019\"\nbefore_activation = \"law\"\nsoil = \"B\"\n\
    building = { storeys = 3, period = 0.3, height_ratio = 1 }\n\
    SLD = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.05 }\n\
    SLV = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n\
    SLC = { ag = 0.15, F0 = 2.45, TC = 0.32, building_damping = 0.1 }\n";

/// A loaded parapet under three records, which decide.
const SHAKEN: &str = "[geometry]\nheight = 2\nthickness = 0.4\ndensity = 1800\noverburden = 3000\n\
    overburden_eccentricity = 0.05\n\
    [check]\ncode = \"circolare-2019\"\nmethod = \"dynamic\"\nbefore_activation = \"rigid\"\n\
    overburden_mass = 0.5\nsoil = \"C\"\nknowledge_level = \"LC1\"\n\
    SLV = { ag = 0.1, F0 = 2.45, TC = 0.32 }\n\
    records = { synthetic = { count = 3, duration = 10, step = 0.02 } }\n";

/// Writes the report of a scene, and returns it.
fn report(folder: &Path, scene: &str, more: &[&str]) -> String {
    std::fs::write(folder.join("scene.toml"), scene).unwrap();
    succeed(folder, &[&["check", "scene.toml", "--report", "report.html"], more].concat());
    content(folder, "report.html")
}

/// The text of a page without its markup.
fn plain(markup: &str) -> String {
    let mut text = String::new();
    for part in markup.split('<') {
        text.push_str(part.split_once('>').map_or(part, |(_, after)| after));
    }
    text.replace("&gt;", ">").replace("&lt;", "<").replace("&quot;", "\"").replace("&amp;", "&")
}

/// The sections of a report: their headlines and their texts.
fn sections(page: &str) -> Vec<(String, String)> {
    let parts = page.split("<h2>").skip(1).map(|part| part.split_once("</h2>").unwrap());
    parts.map(|(title, content)| (plain(title), plain(content))).collect()
}

/// The text of the section whose headline begins with `title`.
fn section(page: &str, title: &str) -> String {
    let found = sections(page).into_iter().find(|(headline, _)| headline.starts_with(title));
    found.unwrap_or_else(|| panic!("no section {title}")).1
}

/// One file that asks for nothing, with every tag closed, and nothing left of its template.
fn check_whole(page: &str) {
    // names of the page itself, and the empty icon
    let own = ["http://www.w3.org/2000/svg", "href=\"data:,\"", "url(#"];
    let links = own.iter().fold(page.to_owned(), |page, name| page.replace(name, ""));
    for request in ["http:", "https:", "src=", "href=", "@import", "url(", "<script"] {
        assert!(!links.contains(request), "the page has {request}");
    }
    for tag in ["section", "table", "tr", "td", "th", "figure", "svg", "div", "b", "i", "sub", "li", "p"] {
        let [opened, bare] = [" ", ">"].map(|end| page.matches(&format!("<{tag}{end}")).count());
        assert_eq!(opened + bare, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    for rest in ["{{", "}}", "NaN", "inf ", "Some("] {
        assert!(!page.contains(rest), "the page has {rest}");
    }
    assert!(page.contains("<title>") && page.ends_with("</html>\n"));
}

/// Every section, and in it the numbers of the worked example.
#[test]
fn the_report_has_every_number_of_the_worked_example() {
    let page = report(&folder("report_tied"), TIED, &["--date", "3 March 2027 <draft>"]);
    check_whole(&page);
    assert!(page.contains("A &lt;b&gt;tied&lt;/b&gt; parapet &amp; &quot;its&quot; roof</span></h1>"));
    assert!(page.contains("3 March 2027 &lt;draft&gt;"));
    assert!(plain(&page).contains("NOT PASSED: SLV governs with ζE = 0.728 (u > 0)"));
    let titles: Vec<_> = sections(&page).into_iter().map(|(title, _)| title).collect();
    assert_eq!(
        titles,
        [
            "Verdict",
            "Warnings",
            "Choice of the mechanism",
            "Hypotheses",
            "Site hazard",
            "Statements of the engineer",
            "Materials and level of knowledge",
            "Loads",
            "The wall",
            "Demand at the wall",
            "Capacity curve",
            "The tie",
            "SLD: activation C8.7.1.2.1.5",
            "SLV with q C8.7.1.2.1.7",
            "SLV by displacement C8.7.1.2.1.8",
            "SLC by displacement C8.7.1.2.1.8",
            "Origin of the data",
            "Symbols",
            "Readings of the code",
            "Program (NTC 10.2)",
            "Document"
        ]
    );
    for (title, numbers) in [
        ("Verdict", "0.7275 0.7908 0.9131 0.07061 0.1846"),
        ("Statements", "1.35 LC1 C8.7.1.2.1.3"),
        ("Site", "1.2 1.382 0.1474 0.4421 2.2 1.766"),
        ("Demand", "1.286 5.59 4.632 4.919 3.051 2.84"),
        ("Capacity", "28.25 2.825 0.1 2.88 0.981 200 0.4989 6 0.9516"),
        ("The tie", "36.67 0.7647"),
        ("SLD", "0.7049 9.982 0.07061 0.01059 [C8.7.1.9] [C7.2.6]"),
        ("SLV with q", "1.41 7.637 0.1846"),
        ("SLV by", "36.67 2.522 0.6363 4.914 50.4 38.98 0.7275 0.1091 2.261 0.7908"),
        ("SLC by", "120 0.2907 3.149 0.5232 131.4 36.29 0.9131 0.137 [C8.7.1.11]"),
        ("Warnings", "ag does not rise from SLD to SLV"),
    ] {
        assert_has(&section(&page, title), &numbers.split(' ').collect::<Vec<_>>());
    }
    // the wall, two spectra and the curves of both sides; these with a form for phones
    assert_eq!(page.matches("<svg").count(), 1 + 2 * 4);
    assert!(
        page.contains("K = 200 kN/m") && page.contains("y</tspan><tspan dy=\"-3\">&#8203;</tspan> = 5 kN")
    );
    let readings = section(&page, "Readings");
    assert_has(&readings, &["A tie:", "Units of ξk"]);
    assert!(!readings.contains("several modes") && !readings.contains("Runs under records"), "{readings}");
}

/// Inputs say where they come from; the fingerprint follows them and not the name of the file.
#[test]
fn inputs_have_an_origin_and_a_fingerprint() {
    let folder = folder("report_inputs");
    // value and origin of a parameter, and its key at the end
    let row = |page: &str, what: &str, key: &str| {
        let (_, own) = page.split_once(&format!("<td>{what}</td>")).unwrap();
        let keyed = format!("<td>{what}</td><td><code translate=\"no\">{key}</code></td>");
        assert!(page.contains(&keyed), "{keyed}");
        plain(own.split("</tr>").next().unwrap())
    };
    let thickness = |page: &str| row(page, "Thickness of the wall", "thickness");
    let fingerprint = |page: &str| {
        let document = section(page, "Document");
        document.split("fingerprint of the inputs").nth(1).unwrap()[..32].to_owned()
    };
    let page = report(&folder, TIED, &[]);
    assert_eq!(thickness(&page), "0.4 mfile");
    assert_eq!(row(&page, "Density of the masonry", "density"), "1800 kg/m³file");
    assert_eq!(row(&page, "Length along the wall", "width"), "1 mdefault");
    assert!(section(&page, "Document").contains("datenot given"));
    let thick = report(&folder, TIED, &["--set", "thickness=0.5"]);
    assert_eq!(thickness(&thick), "0.5 mcommand line");
    let copy = report(&folder, TIED, &["--date", "today"]);
    assert_eq!(fingerprint(&page), fingerprint(&copy));
    assert_ne!(fingerprint(&page), fingerprint(&thick));
    assert_ne!(fingerprint(&page), fingerprint(&report(&folder, &(TIED.to_owned() + "\n"), &[])));
}

/// Runs decide: their section has every record, and what the engineer stated of mass and FC.
#[test]
fn runs_under_records_stand_in_the_report() {
    let page = report(&folder("report_shaken"), SHAKEN, &[]);
    check_whole(&page);
    let runs = section(&page, "Runs under records");
    assert_has(&runs, &["synthetic 1", "synthetic 2", "synthetic 3", "Largest of the maxima", "0/6"]);
    assert!(!section(&page, "Verdict").contains("synthetic 1"));
    for (title, words) in [
        ("Statements", "r = 0.5 of the overburden"),
        ("Statements", "FC = 1.35 (level of knowledge LC1)"),
        ("Statements", "held by transverse walls"),
        ("Statements", "Not checked, no hazard is given: SLD, SLC"),
        ("Readings", "Runs under records"),
        // both terms of an eccentric overburden
        ("Capacity", "[17.13 · 0.4 − 2 · 3 · (−0.05)]/2"),
    ] {
        assert_has(&section(&page, title), &[words]);
    }
}

/// Walls and demands of other kinds: a beam, one side, given spectra, a law of points, storeys, a strip.
#[test]
fn every_kind_of_wall_and_demand_has_its_report() {
    let folder = folder("report_kinds");
    let points = "spectrum = [[0, 0.3], [0.5, 0.6], [6, 0.05]], spectrum_damping";
    let one_sided = format!(
        "[geometry]\nheight = 3\nthickness = 0.5\ndensity = 1800\n[damping]\ndamping_model = \"none\"\n\
         [impact]\nimpact = \"restitution\"\nrestitution = 0.4\nrocking = \"one_sided_positive\"\n\
         [check]\ncode = \"circolare-2019\"\nuse_class = \"IV\"\n\
         SLD = {{ ag = 0.1, {points} = 0.05 }}\n\
         SLC = {{ ag = 0.2, {points} = 0.1, displacement = 0.12 }}\n"
    );
    let page = report(&folder, &one_sided, &[]);
    check_whole(&page);
    for (title, words) in [
        ("Verdict", "SLD in use class IV"),
        ("Statements", "becomes unstable at u = 0.12 m"),
        ("Statements", "rocks to one side"),
        ("The wall", "transverse walls"),
        ("Demand", "given by 3 points at 10 % damping"),
        ("SLC by", "the largest from T0 to TSLC"),
    ] {
        assert_has(&section(&page, title), &[words]);
    }
    // the wall, the spectra at its place, one side
    assert_eq!(page.matches("<svg").count(), 1 + 2 * 2);
    let law = "[force_law]\nforce_law = \"multilinear\"\npoints = [[0.05, 0.6], [0.3, 0.7], [1, 0]]\n";
    let storeys = "[[storeys]]\nmass = 50e3\nstiffness = 40e6\n".repeat(2);
    let on_storeys =
        SHAKEN.replace("rigid", "law").replace("[check]", &(law.to_owned() + &storeys + "[check]"));
    let page = report(&folder, &on_storeys.replace("TC = 0.32", "TC = 0.32, building_damping = 0.1"), &[]);
    check_whole(&page);
    for (title, words) in [
        ("The wall", "(0.05, 0.6) (0.3, 0.7) (1, 0)"),
        ("Demand", "felt on 2 storeys"),
        ("Capacity", "Largest force of the law"),
        ("Readings", "several modes"),
    ] {
        assert_has(&section(&page, title), &[words]);
    }
    let strip = "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3\nthickness = 0.25\n\
         density = 1800\n\
         overburden = 10e3\nhinge_ratio = 0.6\n[check]\ncode = \"circolare-2019\"\nsoil = \"B\"\n\
         before_activation = \"beam\"\nyoung_modulus = 0.75e9\n\
         SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }\n";
    let page = report(&folder, strip, &[]);
    check_whole(&page);
    for (title, words) in [
        ("Statements", "a uniform beam with E = 750 MPa"),
        ("Capacity", "(2/1.8) · 23.24 · 0.25 + 10 · (0.25 + 2 · 0)/1.2"),
        ("Capacity", "2.2 · 12 · 3 · √(17.66/(750 · 10³ · 9.81))"),
        ("Demand", "The wall stands on the ground"),
        ("SLV by", "[3.2.10]"),
    ] {
        assert_has(&section(&page, title), &[words]);
    }
}

#[test]
fn a_report_is_refused_without_a_wall_and_the_code() {
    let folder = folder("report_refused");
    std::fs::write(folder.join("plain.toml"), "[geometry]\nheight = 3\n").unwrap();
    std::fs::write(folder.join("scene.toml"), TIED).unwrap();
    let walls = TIED.split_once("[check]").unwrap().1;
    std::fs::write(folder.join("walls.toml"), format!("walls = [{{ name = \"a\" }}]\n[check]{walls}"))
        .unwrap();
    let report = ["--report", "report.html"];
    let refuses = |arguments: &[&str], words: &[&str]| {
        refused(&folder, &[&["check"], arguments, &report[..]].concat(), words);
    };
    refuses(&["plain.toml"], &["plain.toml", "the table [check] is missing"]);
    refuses(&[], &["there is no file"]);
    refuses(&["walls.toml"], &["no wall could be checked; wall \"a\": height, thickness"]);
    refuses(&["scene.toml", "--find", "thickness"], &["--report covers the wall as given"]);
    refused(&folder, &["check", "scene.toml", "--report", "scene.toml"], &["scene.toml"]);
}

/// The project stands in the report, which is Italian by the file, and English by the option.
#[test]
fn the_project_and_the_language_are_stated() {
    let folder = folder("report_project");
    let project = "[report]\nlanguage = \"it\"\nproject = \"Tie & tower\"\nnominal_life = 50\n\
                   use_coefficient = 1.5\n";
    let scene = TIED.to_owned() + project;
    let page = report(&folder, &scene, &[]);
    assert!(page.contains("<html lang=\"it\">"));
    // V_R = 75 years; 75/-ln(0.9) = 711.8
    assert_has(&plain(&page), &["CommessaTie & tower", "75 anni", "712 anni", "Timbro e firma"]);
    assert_has(&plain(&page), &["VERIFICA NON SODDISFATTA", "SLV è determinante con ζE = 0,728"]);
    let english = report(&folder, &scene, &["--lang", "en"]);
    assert_has(&plain(&english), &["ProjectTie & tower", "712 years", "Stamp and signature", "NOT PASSED"]);
    for (key, words) in [
        ("coordinates = [142.3, 13.4]", "must be latitude and longitude in degrees"),
        ("nominal_life = -1", "nominal_life = -1 must be above 0: Nominal life V_N [years]"),
        ("engineer = \"X\"", "engineer"),
    ] {
        std::fs::write(folder.join("scene.toml"), format!("{TIED}[report]\n{key}\n")).unwrap();
        refused(&folder, &["check", "scene.toml", "--report", "report.html"], &["scene.toml", "line", words]);
    }
    std::fs::write(folder.join("scene.toml"), TIED).unwrap();
    refused(&folder, &["check", "scene.toml", "--report", "r.pdf"], &["no output is a PDF", "browser"]);
}

/// A façade on a building, held by a bar or by a brittle tie, examples 13 and 11 of the check: what the bar
/// makes, and the forces of the tie and of one anchor.
#[test]
fn a_tie_has_its_own_section() {
    let folder = folder("report_tie");
    let facade = "[geometry]\nheight = 7\nthickness = 0.5\ndensity = 1900\noverburden = 12e3\n\
        overburden_eccentricity = 0.1\n[tie]\ntie_height = 6.8\ntie_side = \"positive\"\n";
    let check = "[check]\ncode = \"circolare-2019\"\nbefore_activation = \"rigid\"\noverburden_mass = 1\n\
        rocking = \"one_sided_positive\"\nsoil = \"B\"\n\
        building = { storeys = 3, period = 0.32, height_ratio = 0.37 }\n\
        SLD = { ag = 0.104, F0 = 2.332, TC = 0.281, building_damping = 0.05 }\n\
        SLV = { ag = 0.261, F0 = 2.364, TC = 0.347, building_damping = 0.1 }\n\
        SLC = { ag = 0.334, F0 = 2.4, TC = 0.364, building_damping = 0.15 }\n";
    let bar = "tie = { at_activation = \"yield\", bar = { diameter = 0.016, length = 6, \
               yield_stress = 235e6, ultimate_strain = 0.02, anchor_capacity = 60e3, spacing = 3 } }\n";
    let page = report(&folder, &format!("{facade}{check}{bar}"), &[]);
    check_whole(&page);
    let tie = section(&page, "The tie");
    for numbers in [
        // K, N_y, e_p, u_r, α0, a, N of the tie and of one anchor
        "2346 kN/m",
        "= 47.25 kN",
        "= 15.75 kN",
        "= 113.3 mm",
        "= 61.76 mm",
        "= 0.4009",
        "71.3615.7515.7547.25at its strength",
        "140.7000broken",
        // what the activation needs, of one anchor three times as much
        "SLD5.9645.96417.89",
        "SLV with q6.6686.66820.01",
        "ζE = 0.4849",
    ] {
        assert_has(&tie, &[numbers]);
    }
    assert_has(&section(&page, "The wall"), &["Diameter of the bar16 mmfile", "2346 kN/mcomputed"]);
    assert_has(
        &section(&page, "SLD"),
        &["with the tie at its strength, with FC", "a/FC = 3.933/1.35 = 2.913"],
    );
    // a_Z of SLV is below that of the ground
    assert_has(&section(&page, "SLV with q"), &["the ground governs", "ag S = 2.560 · 1.153 = 2.953"]);
    // the tie fills a quarter of the curve, which needs no second figure
    assert!(!page.contains("The beginning of the curve"));
    // so it is with another damping, where it differs from a_g S by a rounding; a bar that tears as it yields
    // is brittle
    let torn = bar.replace("ultimate_strain = 0.02", "ultimate_strain = 0.001");
    let damped = check.replace("building_damping = 0.1 }", "building_damping = 0.12 }");
    let page = report(&folder, &[facade, &damped, &torn].concat(), &[]);
    assert_has(&section(&page, "SLV with q"), &["the ground governs", "ag S = 2.560 · 1.153 = 2.953"]);
    assert_has(
        &section(&page, "The tie"),
        &["max(0; εu L − Ny/K) = max(0; 0.001 · 6000 − 15.75/2346 · 10³) = 0 mm", "the bar (brittle)"],
    );
    let brittle = facade.to_owned() + "tie_stiffness = 5e6\ntie_strength = 10e3\n" + check;
    let page = report(&folder, &brittle, &[]);
    check_whole(&page);
    assert_has(&plain(&page), &["The beginning of the curve, u > 0, up to d = 2.379 mm"]);
    assert!(!section(&page, "The tie").contains("one anchor"));
    assert_has(&section(&page, "Statements"), &["The tie does not count at the activation"]);
}

/// A strip whose hinge is searched and set back, examples 6 and 7 of the check: what each rule gives, and the
/// force of the side with its own hinge.
#[test]
fn hinges_have_their_own_section() {
    let folder = folder("report_hinges");
    let scene = |hinge: &str, ratio: &str| {
        format!(
            "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3.4\nthickness = 0.4\ndensity = 1900\n\
             overburden = 60e3\noverburden_eccentricity = 0.05\n{ratio}\n[force_law]\na1 = 0.03\n\
             [check]\ncode = \"circolare-2019\"\nhinge = {hinge:?}\nbefore_activation = \"law\"\n\
             soil = \"B\"\nraise_slc = true\nmasonry_strength = 1.5e6\nconfidence_factor = 1.2\n\
             building = {{ storeys = 3, period = 0.32, height_ratio = 0.83 }}\n\
             SLD = {{ ag = 0.104, F0 = 2.332, TC = 0.281, building_damping = 0.05 }}\n\
             SLV = {{ ag = 0.261, F0 = 2.364, TC = 0.347, building_damping = 0.1 }}\n\
             SLC = {{ ag = 0.334, F0 = 2.4, TC = 0.364, building_damping = 0.15 }}\n"
        )
    };
    let page = report(&folder, &scene("worst", ""), &[]);
    check_whole(&page);
    let hinges = section(&page, "Hinges");
    assert_has(
        &hinges,
        &[
            "Hinge of the least multiplier0.659",
            "Least favourable hinge0.80440.8003yes",
            "α0,min = 1.465",
            "SLV with q0.63182.202",
            "SLV0.62740.8159",
        ],
    );
    let curve = section(&page, "Capacity");
    // of each side its own hinge
    assert_eq!(curve.matches("(2/h1) (W + O) b + O (b + 2 c)/h2 = (2/").count(), 2, "{curve}");
    assert_has(&curve, &["h1 = 2.735 m", "= 52.03 kN", "= 42.10 kN"]);
    let own = section(&page, "SLV by");
    assert_has(&own, &["Hinge of this check, with its own curveh1/h = 0.6274"]);
    assert!(!section(&page, "SLC by").split("Side u < 0").nth(1).unwrap().contains("own curve"));
    let page = report(&folder, &scene("given", "hinge_ratio = 0.5"), &[]);
    let hinges = section(&page, "Hinges");
    assert_has(
        &hinges,
        &["fd = fm/(γ FC) = 1.5/(1 · 1.2) = 1.25 MPa", "= 40.16 mm", "= 34.20 mm", "= 28.24 mm"],
    );
    assert_has(&hinges, &["Hinge as given0.5"]);
    assert_has(&section(&page, "Capacity"), &["α0 = Fact/W = 47.93/25.35 = 1.891"]);
}
