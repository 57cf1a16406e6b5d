//! Lists of records as selectors write them. The files of these tests are made up, in the layouts of the
//! selectors.

use std::fs;
use std::path::{Path, PathBuf};

use ground_motion::STANDARD_GRAVITY;
use study::codes::NoCodes;
use study::loaded::LoadedStudy;

const SAMPLES: [f64; 5] = [0.0, 0.11, -0.07, 0.31, 0.0];

/// An empty folder with records of PEER: `a1.AT2`, `a2.AT2` and `b1.AT2`, `b2.AT2`, each a multiple of the
/// samples.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    for (name, factor) in [("a1", 1.0), ("a2", 2.0), ("b1", 3.0), ("b2", 4.0)] {
        let samples = SAMPLES.map(|sample| (factor * sample).to_string()).join(" ");
        let text = format!("A\nNowhere, 1/1/2001, Hill, 90\nUNITS OF G\nNPTS= 5, DT= .01 SEC\n{samples}\n");
        fs::write(folder.join(format!("{name}.AT2")), text).unwrap();
    }
    folder
}

/// Reads a study with some lines in `[records]`.
fn load(folder: &Path, records: &str) -> Result<LoadedStudy, String> {
    let text = format!(
        "models = [\"CDC\"]\nlevels = {{ method = \"cloud\" }}\nintensity = {{ measure = \"PGA\" }}\n\
         [records]\n{records}\n[[walls]]\nname = \"w\"\ngeometry = {{ height = 2, thickness = 0.3 }}\n"
    );
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    LoadedStudy::read(&path, &NoCodes).map_err(|error| error.to_string())
}

/// Name, factor, weight and the second sample in g of each record.
fn listed(loaded: &LoadedStudy) -> Vec<(String, f64, f64, f64)> {
    let one = |record: &run::records::NamedRecord| {
        let sample = record.motion.samples()[1] / STANDARD_GRAVITY;
        let rounded = (sample * 1e6).round() / 1e6;
        (record.name.clone(), record.listed.factor, record.listed.weight, rounded)
    };
    loaded.study.records().iter().map(one).collect()
}

fn named(name: &str, factor: f64, weight: f64, sample: f64) -> (String, f64, f64, f64) {
    (name.to_owned(), factor, weight, sample)
}

/// Columns have many names, and cells may stand between commas, semicolons, tabs or blanks.
#[test]
fn tables_name_files_factors_and_weights() {
    let folder = folder("selection_tables");
    for text in [
        "file,scale_factor,weight\na1.AT2,2,1\nb1.AT2,0.5,3\n",
        "# a comment\nNo;Filename;SF;Weight;Mw\n1;\"a1.AT2\";2,0;1;6,5\n2;b1.AT2;0,5;3;7\n",
        "record\tScale Factor\tweights\na1.AT2\t2\t1\n\nb1.AT2\t0.5\t3\n",
        "File_1   factor w\na1.AT2 2 1\nb1.AT2 5e-1 3\n",
    ] {
        fs::write(folder.join("list.csv"), text).unwrap();
        let loaded = load(&folder, "selection = \"list.csv\"").unwrap();
        let expected = [named("a1.AT2", 2.0, 0.5, 0.22), named("b1.AT2", 0.5, 1.5, 0.165)];
        assert_eq!(listed(&loaded), expected, "{text}");
        let weights = &loaded.report.weights;
        assert_eq!([0, 1].map(|place| weights.of_record(place)), [0.5, 1.5]);
        assert!(loaded.inputs.contains(&folder.join("list.csv")), "{:?}", loaded.inputs);
    }
    // beside other files, and without factors
    fs::write(folder.join("list.csv"), "file\na1.AT2\n").unwrap();
    let loaded = load(&folder, "selection = \"list.csv\"\nfiles = [\"b?.AT2\"]").unwrap();
    let names: Vec<_> = listed(&loaded).into_iter().map(|(name, ..)| name).collect();
    assert_eq!(names, ["b1.AT2", "b2.AT2", "a1.AT2"]);
    assert!(loaded.report.weights.are_equal());
}

/// A factor of 2 gives the bits of the record with doubled samples, in motion, intensity and runs.
#[test]
fn a_factor_is_that_of_the_samples() {
    let folder = folder("selection_factor");
    fs::write(folder.join("list.csv"), "file,sf\na1.AT2,2\n").unwrap();
    let scaled = load(&folder, "selection = \"list.csv\"").unwrap().study;
    let doubled = load(&folder, "files = [\"a2.AT2\"]").unwrap().study;
    assert_eq!(scaled.records()[0].motion, doubled.records()[0].motion);
    assert_eq!(scaled.intensity(0), doubled.intensity(0));
    assert_eq!(scaled.run(1).unwrap(), doubled.run(1).unwrap());
}

/// A search report of PEER: criteria above the list, notes and spectra below it, two components a row.
#[test]
fn reports_of_peer_list_records() {
    let folder = folder("selection_peer");
    let report = " PEER Ground Motion Database, Time Series Search Report -- NGA-West2 -- 2026-01-01\n\n\n \
        -- Summary of PEER Ground Motion Database Search Criteria --\nScale Factor Max:,9\n\
        Record Sequence Number:, \nPeriod Array:,0.1,1,3\n\n -- Summary of Metadata of Selected Records --\n\
        Result ID, Spectral Ordinate, Record Sequence Number, Mean Squared Error, Scale Factor, Tp-Pulse \
        Period (sec), Earthquake Name, Magnitude, Rjb (km), Rrup (km), Initial-search Scale Factor, \
        Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename\n\
        1, SRSS,1,0.2,1.5, -,\" \"\"Hill\"\"\",7,11.03,11,1.6, a1.AT2, a2.AT2 , a3.AT2  \n\
        2, SRSS,2,0.2,0.5, -,\" \"\"Dale\"\"\",7,17.3,17,2.1, b1.AT2, b2.AT2 , -----  \n\n\
        These records are UNSCALED, AS RECORDED\n\n -- Scaled Spectra --\nPeriod (sec),pSa (g)\n0.01,0.7\n";
    fs::write(folder.join("_SearchResults.csv"), report).unwrap();
    let all = [
        named("a1.AT2", 1.5, 1.0, 0.165),
        named("a2.AT2", 1.5, 1.0, 0.33),
        named("b1.AT2", 0.5, 1.0, 0.165),
        named("b2.AT2", 0.5, 1.0, 0.22),
    ];
    for (component, expected) in
        [("", vec![0, 1, 2, 3]), ("component = 1", vec![0, 2]), ("component = 2", vec![1, 3])]
    {
        let loaded = load(&folder, &format!("selection = \".\"\n{component}")).unwrap();
        let expected: Vec<_> = expected.into_iter().map(|place: usize| all[place].clone()).collect();
        assert_eq!(listed(&loaded), expected, "{component}");
    }
}

/// The folder of `EzGM`: names and steps line by line; the samples, in g, have their factors.
#[test]
fn folders_of_ezgm_are_scaled() {
    let folder = folder("selection_ezgm");
    fs::create_dir(folder.join("set")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join("set").join(name), text).unwrap();
    for (name, sample) in [("A_ACC.txt", 0.1), ("B_ACC.txt", 0.2), ("C_ACC.txt", 0.3), ("D_ACC.txt", 0.4)] {
        write(name, &format!("0.00000e+00\n{sample:.5e}\n0.00000e+00\n"));
    }
    write("GMR_names.txt", "A_ACC.txt\nB_ACC.txt\n");
    write("GMR_dts.txt", "0.00500\n0.01000\n");
    write("GMR_sf_used.txt", "1.50000\n2.00000\n");
    let loaded = load(&folder, "selection = \"set\"").unwrap();
    assert_eq!(listed(&loaded), [named("A_ACC.txt", 1.0, 1.0, 0.1), named("B_ACC.txt", 1.0, 1.0, 0.2)]);
    let steps: Vec<_> = loaded.study.records().iter().map(|record| record.motion.step()).collect();
    assert_eq!(steps, [0.005, 0.01]);
    // the options are for files of which the list states nothing
    let options = load(&folder, "selection = \"set\"\nunit = \"m/s2\"\nstep = 1").unwrap();
    assert_eq!(options.study.records(), loaded.study.records());
    fs::remove_file(folder.join("set/GMR_names.txt")).unwrap();
    write("GMR_H1_names.txt", "A_ACC.txt\nB_ACC.txt\n");
    write("GMR_H2_names.txt", "C_ACC.txt\nD_ACC.txt\n");
    let names = |records: &str| -> Vec<String> {
        listed(&load(&folder, records).unwrap()).into_iter().map(|(name, ..)| name).collect()
    };
    assert_eq!(names("selection = \"set\""), ["A_ACC.txt", "C_ACC.txt", "B_ACC.txt", "D_ACC.txt"]);
    assert_eq!(names("selection = \"set\"\ncomponent = 2"), ["C_ACC.txt", "D_ACC.txt"]);
    write("GMR_dts.txt", "0.005\n");
    let error = load(&folder, "selection = \"set\"").unwrap_err();
    assert!(error.contains("2 of file, 2 of file2, 1 of dt beside each other; write a line"), "{error}");
}

/// What is wrong in a list is said with its file, line, column and remedy.
#[test]
fn wrong_lists_are_refused() {
    let folder = folder("selection_wrong");
    let list = "selection = \"list.csv\"";
    for (text, records, expected) in [
        ("file,sf\na1.AT2,x\n", list, "list.csv, line 2: sf: expected a finite number, found `x`"),
        ("file,sf\na1.AT2,0\n", list, "list.csv, line 2: sf: 0 must be above 0, at most 1e5"),
        ("file,sf\na1.AT2,-1.5\n", list, "line 2: sf: -1.5 must be above 0"),
        (
            "file,sf\na1.AT2,\n",
            list,
            "line 2: sf: expected a finite number, found ``; the cell is empty: complete it",
        ),
        ("file,weight\na1.AT2,0\n", list, "line 2: weight: 0 must be above 0"),
        ("file,weight\na1.AT2,inf\n", list, "line 2: weight: expected a finite number, found `inf`"),
        ("file\na1.AT2\nc.AT2\n", list, "c.AT2 does not exist; put the file there, or correct the row"),
        ("file\na1.AT2\nb1.AT2\na1.AT2\n", list, "a1.AT2 is named above this line too"),
        (
            "file\na1.AT2\n",
            "selection = \"list.csv\"\nfiles = [\"a1.AT2\"]",
            "or by `files`; delete one of them",
        ),
        ("name,sf\na1.AT2,1\n", list, "line 1: no column of files; name one `file`, beside `scale_factor`"),
        (
            "file,scale_facotr\na1.AT2,2\n",
            list,
            "unknown column \"scale_facotr\" (did you mean \"scale_factor\"?)",
        ),
        (
            "file,sf,Scale Factor\na1.AT2,2,3\n",
            list,
            "\"sf\" and \"Scale Factor\" state the same; delete one",
        ),
        ("file,sf\na1.AT2\n", list, "line 2: expected one value for each column, 2 in all"),
        (
            "event_id,gmv_PGA,custom_site_id\n0,0.1,a\n",
            list,
            "fields of OpenQuake are intensities of events at sites",
        ),
        ("file\n", list, "lists no record; write a row for each"),
        ("file\na1.AT2\n", "selection = \"list.csv\"\ncomponent = 2", "lists no second component; write its"),
        ("file\na1.AT2\n", "selection = \"list.csv\"\ncomponent = 3", "component = 3"),
        (
            "file\na1.AT2\n",
            "files = [\"a1.AT2\"]\ncomponent = 1",
            "component is that of a list; name one by selection",
        ),
        (
            "file\na1.AT2\n",
            "selection = \"lst.csv\"",
            "selection = \"lst.csv\": no such list; name a table of records",
        ),
        (
            "file\na1.AT2\n",
            "selection = \".\"",
            "a folder that has one of _SearchResults.csv, selection.csv, GMR",
        ),
        ("file\na1.AT2\n", "unit = \"g\"", "[records] needs files = [...], selection = \"…\", sequences = "),
        ("", list, "list.csv, line 1: expected a list of records"),
    ] {
        fs::write(folder.join("list.csv"), text).unwrap();
        let error = load(&folder, records).unwrap_err();
        assert!(
            error.contains(expected),
            "{error}
for {expected}"
        );
    }
}

/// A slip in the name of a column, or a unit beside it, does not let all records count alike.
#[test]
fn unclear_columns_are_refused() {
    let folder = folder("selection_columns");
    for (column, expected) in [
        ("weigth", "unknown column \"weigth\" (did you mean \"weight\"?); rename or delete it"),
        ("Weigth [-]", "(did you mean \"weight\"?)"),
        ("probability weight", "(did you mean \"weight\"?)"),
        ("multiplier", "(did you mean \"scale_factor\"?)"),
        ("unti", "(did you mean \"unit\"?)"),
        ("SF [%]", "\"SF [%]\" is in \"%\", but its values are read as plain numbers; convert"),
        ("SF %", "is in \"%\""),
        ("weight (kN)", "is in \"kN\""),
        ("dt [ms]", "\"dt [ms]\" is in \"ms\", but its values are read as s;"),
    ] {
        fs::write(folder.join("list.csv"), format!("file,{column}\na1.AT2,2\n")).unwrap();
        let error = load(&folder, "selection = \"list.csv\"").unwrap_err();
        assert!(error.contains("list.csv, line 1: ") && error.contains(expected), "{error}\nfor {expected}");
    }
    let known = ["SF [-]", "weight (-)", "set", "No", "magnitude", "Vertical Acc. Filename", "file_3"];
    for (column, value) in known.map(|column| (column, "2")).into_iter().chain([("dt [s]", "0.01")]) {
        fs::write(folder.join("list.csv"), format!("file,{column}\na1.AT2,{value}\n")).unwrap();
        assert!(load(&folder, "selection = \"list.csv\"").is_ok(), "{column}");
    }
}

/// A list states units and steps of files without their own, whatever the options are.
#[test]
fn a_list_states_units_and_steps() {
    let folder = folder("selection_units");
    for name in ["c.txt", "d.txt"] {
        fs::write(folder.join(name), "0.0\n0.5\n0.0\n").unwrap();
    }
    fs::write(folder.join("list.csv"), "file,unit,dt\nc.txt,g,0.01\nd.txt,cm/s2,0.02\n").unwrap();
    let loaded = load(&folder, "selection = \"list.csv\"\nunit = \"m/s2\"\nstep = 1").unwrap();
    let motions = loaded.study.records().iter().map(|record| &record.motion);
    let found: Vec<_> = motions.map(|motion| (motion.step(), motion.samples()[1])).collect();
    assert_eq!(found, [(0.01, 0.5 * STANDARD_GRAVITY), (0.02, 0.5 / 100.0)]);
    fs::write(folder.join("list.csv"), "file,unit,dt\nc.txt,ft,0.01\n").unwrap();
    let error = load(&folder, "selection = \"list.csv\"").unwrap_err();
    assert!(error.contains("list.csv, line 2: unit: ") && error.contains("ft"), "{error}");
}

/// A factor that no record can have is refused on its line: 20 g × 10⁵ exceeds 10⁶ m/s².
#[test]
fn a_factor_beyond_all_records_is_refused() {
    let folder = folder("selection_large");
    let text = "NPTS= 3, DT= .01 SEC\n0 20 0\n";
    fs::write(folder.join("c.AT2"), format!("A\nNowhere, 1/1/2001, Hill, 90\nUNITS OF G\n{text}")).unwrap();
    fs::write(folder.join("list.csv"), "file,sf\na1.AT2,1\nc.AT2,100000\n").unwrap();
    let error = load(&folder, "selection = \"list.csv\"").unwrap_err();
    assert!(error.contains("list.csv, line 3: ") && error.contains("cannot be scaled by 100000"), "{error}");
}

/// Rows below a blank line count, with a title above the list as without it.
#[test]
fn blank_lines_end_no_list() {
    let folder = folder("selection_blank");
    let list = "file,weight\na1.AT2,1\n\na2.AT2,1\n,\nb1.AT2,1\n";
    for text in [list.to_owned(), format!("Selected for site X\n\n{list}")] {
        fs::write(folder.join("list.csv"), &text).unwrap();
        let names: Vec<_> = listed(&load(&folder, "selection = \"list.csv\"").unwrap());
        assert_eq!(names.len(), 3, "{text}");
    }
    fs::write(folder.join("list.csv"), format!("Selected for site X\n{list}\nChosen by hand\n")).unwrap();
    let error = load(&folder, "selection = \"list.csv\"").unwrap_err();
    assert!(error.contains("list.csv, line 9: expected one value for each column, 2 in all"), "{error}");
}

/// A row without a second component gives one record, and none where the second is asked for.
#[test]
fn a_component_may_be_missing() {
    let folder = folder("selection_missing");
    for none in ["", "---", " - "] {
        let text = format!("file,file2,sf\na1.AT2,{none},1\nb1.AT2,b2.AT2,1\n");
        fs::write(folder.join("list.csv"), text).unwrap();
        let names = |records: &str| -> Result<Vec<String>, String> {
            Ok(listed(&load(&folder, records)?).into_iter().map(|(name, ..)| name).collect())
        };
        assert_eq!(names("selection = \"list.csv\"").unwrap(), ["a1.AT2", "b1.AT2", "b2.AT2"]);
        assert_eq!(names("selection = \"list.csv\"\ncomponent = 1").unwrap(), ["a1.AT2", "b1.AT2"]);
        let error = names("selection = \"list.csv\"\ncomponent = 2").unwrap_err();
        assert!(error.contains("list.csv, line 2: file2: the row has no such component"), "{error}");
    }
    fs::write(folder.join("list.csv"), "file,file2\n---,a2.AT2\n").unwrap();
    let error = load(&folder, "selection = \"list.csv\"").unwrap_err();
    assert!(error.contains("list.csv, line 2: file: the row has no such component"), "{error}");
}

/// Sequences whose files have equal names go by their whole paths.
#[test]
fn sequences_of_equal_names_go_by_their_paths() {
    let folder = folder("selection_sequences");
    for event in ["e1", "e2"] {
        fs::create_dir(folder.join(event)).unwrap();
        for (from, to) in [("a1.AT2", "H.AT2"), ("b1.AT2", "K.AT2")] {
            fs::copy(folder.join(from), folder.join(event).join(to)).unwrap();
        }
    }
    let sequences = "sequences = [[\"e1/H.AT2\", \"e1/K.AT2\"], [\"e2/H.AT2\", \"e2/K.AT2\"], \
                     [\"a1.AT2\", \"b1.AT2\"]]";
    let names: Vec<_> = listed(&load(&folder, sequences).unwrap()).into_iter().map(|one| one.0).collect();
    let path = |name: &str| folder.join(name).display().to_string();
    let whole =
        |event: &str| format!("{} + {}", path(&format!("{event}/H.AT2")), path(&format!("{event}/K.AT2")));
    assert_eq!(names, [whole("e1"), whole("e2"), "a1.AT2 + b1.AT2".to_owned()]);
}
