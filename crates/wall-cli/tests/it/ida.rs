//! Tests `wall study ida` and `merge`: the same bytes for any threads, shards and interruptions, and what
//! they refuse.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::command_line::{assert_has, content, fails, folder, printed, program, refused, succeed, text};

/// Two walls, three synthetic records and one from a file, three models.
const STUDY: &str = r#"
title = "A small study {{facts}}"
models = ["CR", "CDC", { name = "CDR 5 %", model = "CDR", xi = 0.05 }]

[levels]
method = "hunt"
first = 0.1
increase = 0.1
top = 8
gap = 0.3

[records]
files = ["records/*.csv"]
unit = "g"
synthetic = { count = 3, duration = 12, step = 0.01 }

[report]
resamples = 200

[[walls]]
name = "parapet, low"
geometry = { height = 3, thickness = 0.3 }
force_law = { a1 = 0.009 }

[[walls]]
name = "strip"
geometry = { mechanism = "vertical_spanning", height = 3.75, thickness = 0.24, hinge_ratio = 0.58 }
force_law = { a1 = 0.02 }
"#;

const COUNT: usize = 2 * 4 * 3;
/// Parts of two combinations.
const PARTS: usize = COUNT / 2;

pub(crate) fn study(name: &str) -> PathBuf {
    let folder = folder(name);
    fs::write(folder.join("study.toml"), STUDY).unwrap();
    fs::create_dir(folder.join("records")).unwrap();
    let sample = |k: u32| {
        let time = f64::from(k) * 0.01;
        format!("{time:.2},{:.6}\n", 0.3 * (7.0 * time).sin() * (0.8 * time).sin())
    };
    let samples: Vec<_> = (0..400).map(sample).collect();
    let record = format!("time,a_g\n{}", samples.concat());
    fs::write(folder.join("records/beat.csv"), record).unwrap();
    folder
}

/// Every file of a folder of results, with its bytes.
pub(crate) fn bytes(path: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let read = |file: PathBuf| (file.strip_prefix(path).unwrap().to_owned(), fs::read(&file).unwrap());
    files(path).into_iter().map(read).collect()
}

/// The files of a folder and of those in it. A study that runs renames its own: they are not read.
fn files(path: &Path) -> Vec<PathBuf> {
    let (mut files, mut rest) = (Vec::new(), vec![path.to_owned()]);
    while let Some(folder) = rest.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap().path();
            if entry.is_dir() { rest.push(entry) } else { files.push(entry) }
        }
    }
    files.sort();
    files
}

pub(crate) fn part_files(results: &Path) -> Vec<PathBuf> {
    let runs = results.join("runs");
    files(results).into_iter().filter(|file| file.starts_with(&runs)).collect()
}

#[test]
fn threads_shards_and_interruptions_change_no_byte() {
    let folder = study("ida_bytes");
    let at = |name: &str| folder.join(name);
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "one", "--threads", "1"]);
    assert_has(&told, &["runs in", "on 1 thread"]);
    let whole = bytes(&at("one"));
    assert_eq!(part_files(&at("one")).len(), PARTS);
    for name in ["levels.csv", "collapses.csv", "fragilities.csv", "study.html", "study.json"] {
        assert!(whole.contains_key(Path::new(name)), "{name}");
    }
    succeed(&folder, &["study", "ida", "study.toml", "-o", "two", "--threads", "2"]);
    assert!(bytes(&at("two")) == whole, "two threads");

    // shards in folders of their own, and in one
    for shard in ["1/3", "2/3", "3/3"] {
        let own = format!("shard{}", &shard[..1]);
        let told = printed(&folder, &["study", "ida", "study.toml", "--shard", shard, "-o", &own]);
        assert_has(&told, &["wall study merge"]);
        assert!(!at(&own).join("levels.csv").exists());
        succeed(&folder, &["study", "ida", "study.toml", "--shard", shard, "-o", "shared"]);
    }
    fails(
        &folder,
        &["study", "merge", "shard1", "shard3", "-o", "part"],
        &["8 of 24", "missing", "parapet, low"],
    );
    succeed(&folder, &["study", "merge", "shard1", "shard2", "shard3", "-o", "merged"]);
    assert!(bytes(&at("merged")) == whole, "merged shards");
    succeed(&folder, &["study", "merge", "shared"]);
    assert!(bytes(&at("shared")) == whole, "a shared folder");

    // lost parts, truncated parts, a part of another number, a half-written file, no results
    let runs = part_files(&at("two"));
    fs::remove_file(&runs[3]).unwrap();
    let content = fs::read(&runs[7]).unwrap();
    fs::write(&runs[7], &content[..content.len() / 2]).unwrap();
    fs::write(&runs[9], &content).unwrap();
    fs::write(&runs[11], "").unwrap();
    fs::write(runs[3].with_file_name(".0000003.parquet.1.part"), "half").unwrap();
    fs::remove_file(at("two").join("fragilities.csv")).unwrap();
    let output = succeed(&folder, &["study", "ida", "study.toml", "-o", "two"]);
    assert_has(&text(&output.stderr), &["16 of 24 combinations are done already"]);
    assert!(bytes(&at("two")) == whole, "after losses");

    // another report of the same runs computes nothing again
    fs::write(at("study.toml"), STUDY.replace("resamples = 200", "resamples = 300")).unwrap();
    let output = succeed(&folder, &["study", "ida", "study.toml", "-o", "two"]);
    assert_has(&text(&output.stderr), &["24 of 24"]);
    let again = bytes(&at("two"));
    assert_eq!(again[Path::new("levels.csv")], whole[Path::new("levels.csv")]);
    assert_ne!(again[Path::new("fragilities.csv")], whole[Path::new("fragilities.csv")]);
}

/// No damage of a file goes unseen: a flipped bit, a value that cannot be, a damaged description.
#[test]
fn damaged_files_are_computed_again() {
    let folder = study("ida_damage");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let (out, whole) = (folder.join("out"), bytes(&folder.join("out")));
    let runs = part_files(&out);
    // the lowest bit of a byte, of each file another one
    let flipped = 8;
    for (k, file) in runs.iter().take(flipped).enumerate() {
        let mut content = fs::read(file).unwrap();
        let at = content.len() * (k + 1) / (flipped + 1);
        content[at] ^= 1;
        fs::write(file, content).unwrap();
    }
    // values that cannot be, under their own checksum
    let parts = study::folder::Folder::open(&out).unwrap();
    for (k, bad) in [f64::NAN, f64::INFINITY, -0.5].into_iter().enumerate() {
        let file = &runs[flipped + k];
        let demand = parts.part(flipped + k).unwrap()[0].runs()[0].demand;
        let mut content = fs::read(file).unwrap();
        let at = content.windows(8).position(|bytes| bytes == demand.to_le_bytes()).unwrap();
        content[at..at + 8].copy_from_slice(&bad.to_le_bytes());
        let checksum = content.windows(9).rposition(|bytes| bytes == b"checksum ").unwrap() + 9;
        content[checksum..checksum + 32].fill(b'0');
        let own = scene::fingerprint(&content);
        content[checksum..checksum + 32].copy_from_slice(own.as_bytes());
        fs::write(file, content).unwrap();
    }
    drop(parts);
    fails(&folder, &["study", "merge", "out"], &["11 of 12 parts are damaged", "22 of 24 combinations"]);
    let again = succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert_has(&text(&again.stderr), &["11 of 12 parts are damaged"]);
    assert!(bytes(&out) == whole, "a damaged file went into the results");

    let description = out.join("study.json");
    let content = fs::read_to_string(&description).unwrap();
    assert!(content.contains(&format!("\"sources\": \"{}\"", study::SOURCES)) && study::SOURCES.len() == 32);
    fs::write(&description, content.replace("A small study", "A smaml study")).unwrap();
    fails(&folder, &["study", "merge", "out"], &["study.json", "damaged", "remove it"]);
    fs::remove_file(&description).unwrap();
    let again = succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert_has(&text(&again.stderr), &["24 of 24 combinations are done already"]);
    assert!(bytes(&out) == whole);
}

/// What one process writes is not removed by another that has finished.
#[cfg(unix)]
#[test]
fn processes_share_a_folder() {
    let folder = study("ida_two_processes");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    // another process works on the folder, and is writing this file
    let other = fs::File::open(folder.join("out/runs")).unwrap();
    other.lock_shared().unwrap();
    let part = folder.join("out/runs/0000/.0123456789abcdef.part");
    fs::write(&part, "half").unwrap();
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    assert!(part.exists(), "the part of another process was removed");
    drop(other);
    succeed(&folder, &["study", "merge", "out"]);
    assert!(!part.exists(), "the part of a killed process is left");
}

/// Kills the command at its start and between its parts, and starts it again.
#[test]
fn a_killed_study_goes_on() {
    let folder = study("ida_killed");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "whole"]);
    let (all, broken) = (part_files(&folder.join("whole")).len(), folder.join("broken"));
    let there = || if broken.is_dir() { part_files(&broken).len() } else { 0 };
    // two kills do; what an attempt has run to its end before its kill is not killed between its parts
    for wanted in [0, 1, 1, 1, 1] {
        let before = there();
        if (1..all).contains(&before) {
            break;
        }
        let _ = fs::remove_dir_all(&broken);
        let mut child = program(&folder, &["study", "ida", "study.toml", "-o", "broken", "--threads", "1"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while there() < wanted && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        // SIGKILL: the process cannot clean up
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!((1..all).contains(&there()), "it was never killed between its parts");
    for part in part_files(&broken) {
        if part.extension().is_some_and(|ending| ending == "parquet") {
            assert!(fs::read(&part).unwrap().ends_with(b"PAR1"), "{}", part.display());
        }
    }
    succeed(&folder, &["study", "ida", "study.toml", "-o", "broken"]);
    assert!(bytes(&folder.join("broken")) == bytes(&folder.join("whole")));
}

#[test]
fn tables_and_page_hold_the_runs() {
    let folder = study("ida_tables");
    succeed(&folder, &["study", "ida", "study.toml"]);
    let results = folder.join("study_results");
    let read = |name: &str| content(&results, name);
    let collapses = read("collapses.csv");
    assert_eq!(collapses.lines().count(), 1 + COUNT);
    for line in collapses.lines().skip(1) {
        // the name of the first wall holds a comma and is quoted
        let cells: Vec<_> = line.trim_start_matches("\"parapet, low\"").split(',').collect();
        let [collapse, standing] = [3, 4].map(|column| cells[column].parse::<f64>().unwrap());
        assert!(standing < collapse && collapse <= standing * 1.0102, "{line}");
    }
    let levels = read("levels.csv");
    let fragilities = read("fragilities.csv");
    assert_eq!(fragilities.lines().count(), 1 + 2 * 3 * 4);
    // overturned runs are those whose demand is above 1
    for line in levels.lines().skip(1) {
        let cells: Vec<_> = line.rsplit(',').collect();
        let (overturned, demand) = (cells[1] == "true", cells[2].parse::<f64>().unwrap());
        assert_eq!((overturned, demand >= 1.0), (!cells[0].is_empty(), overturned), "{line}");
    }
    let page = read("study.html");
    assert!(page.len() < 3_000_000 && page.contains("A small study {{facts}}"));
    assert!(!page.contains("NaN") && !page.contains("http") && !page.contains("inf"), "a page of its own");
    // for each wall the collapse, three models' curves and three fractions
    assert_eq!(page.matches("<svg").count(), 2 * (1 + 3 + 3));
    assert!(page.contains("AvgSA (g)") && page.contains("u_max / u_ins") && page.contains("CDR 5 %"));
    let panels = read("fragilities.svg");
    assert!(panels.starts_with("<svg xmlns") && panels.matches("font-weight=\"600\">Wall ").count() == 2);
    // all walls at one glance, and each curve with its record
    assert_eq!(page.matches("<div class=\"track\">").count(), 2);
    assert!(page.contains("<title>synthetic 1</title>") && page.contains("<td>synthetic 1</td>"));
}

#[test]
fn other_studies_and_bad_ones_are_refused() {
    let folder = study("ida_refused");
    succeed(&folder, &["study", "ida", "study.toml", "-o", "out", "--shard", "1/8"]);
    let change = |name: &str, from: &str, to: &str| {
        assert!(STUDY.contains(from), "{from}");
        fs::write(folder.join(name), STUDY.replace(from, to)).unwrap();
    };
    change("wall.toml", "height = 3,", "height = 3.1,");
    let other = ["out", "another study", "height = 3.0", "height = 3.1", "give another folder"];
    refused(&folder, &["study", "ida", "wall.toml", "-o", "out"], &other);
    // both are valid, so neither is to be removed
    succeed(&folder, &["study", "ida", "wall.toml", "-o", "other", "--shard", "1/8"]);
    let words = ["other: holds another study than the first folder", "height = 3.1", "of one study only"];
    refused(&folder, &["study", "merge", "out", "other", "-o", "both"], &words);
    fs::write(folder.join("records/beat.csv"), "time,a_g\n0,0\n0.01,0.1\n0.02,0\n").unwrap();
    refused(&folder, &["study", "ida", "study.toml", "-o", "out"], &["another study", "fingerprint"]);
    for command in [&["study", "ida", "study.toml"][..], &["study", "merge", "out"]] {
        refused(&folder, &[command, &["-o", "-"]].concat(), &["-o -", "a folder of files", "give a folder"]);
    }
    refused(&folder, &["study", "merge", "records"], &["study.json", "`wall study ida`"]);
    refused(&folder, &["study", "ida", "none.toml"], &["none.toml"]);
    fails(&folder, &["study", "ida", "study.toml", "--shard", "9/8"], &["9/8", "I/N"]);
    let cases: [(&str, &str, &[&str]); 23] = [
        ("method = \"hunt\"", "method = \"climb\"", &["line 6", "climb", "hunt, step, grid"]),
        ("gap = 0.3", "gap = 3", &["gap", "3", "from 0.01 to 1"]),
        ("gap = 0.3", "values = [1]", &["line 5", "values", "no part"]),
        ("first = 0.1", "first = 0", &["first", "above 0"]),
        ("first = 0.1\n", "", &["line 5", "needs first"]),
        ("top = 8", "top = nan", &["top", "NaN"]),
        ("\"CDC\"", "\"CDX\"", &["line 3", "CDX", "CDR"]),
        ("\"CDC\"", "\"CR\"", &["line 3", "\"CR\"", "twice"]),
        ("xi = 0.05", "xi = 11", &["line 3", "xi = 11.0 is above its maximum, 10.0"]),
        ("xi = 0.05", "xi = -0.5", &["line 3", "xi = -0.5", "or -1 where it is not given"]),
        ("xi = 0.05", "c_bar = 0.5", &["line 3", "takes no c_bar", "give xi"]),
        ("xi = 0.05", "e = 0.9", &["line 3", "unknown key \"e\" of a model", "xi, c_bar"]),
        ("xi = 0.05", "xi = \"much\"", &["line 3", "xi of a model must be a number", "found string"]),
        ("[report]", "[report]\nreference = \"SDR\"", &["SDR", "not among the models"]),
        ("[report]", "[report]\nfractions = [0.5, 1.5]", &["1.5", "at most 1"]),
        ("a1 = 0.009", "a1 = -0.009", &["a1", "-0.009", "below its minimum"]),
        ("a1 = 0.009", "xi = 0.009", &["xi", "[damping]"]),
        ("name = \"strip\"", "name = \"parapet, low\"", &["parapet, low", "twice"]),
        ("name = \"strip\"", "colour = \"red\"", &["colour", "geometry"]),
        ("records/*.csv", "records/*.AT2", &["line 13", "records/*.AT2", "no match"]),
        ("unit = \"g\"", "unit = \"feet\"", &["line 14", "feet", "cm/s2"]),
        ("count = 3", "count = 0", &["line 15", "count = 0", "10000"]),
        ("[levels]", "[intensity]\nmeasure = \"Sa\"\n\n[levels]", &["line 5", "period = 0.5"]),
    ];
    for (from, to, words) in cases {
        change("bad.toml", from, to);
        refused(&folder, &["study", "ida", "bad.toml", "-o", "new"], words);
    }
}

/// The study of the project runs unchanged; its walls are those of Table 5.
#[test]
fn the_example_is_a_study() {
    let folder = folder("ida_example");
    let file = crate::root().join("studies/table_5.toml");
    // one of its 900 combinations; all of them take seconds in a release build
    let file = file.to_str().unwrap();
    let told = printed(&folder, &["study", "ida", file, "-o", "out", "--shard", "7/900"]);
    assert_has(&told, &["shard 7 of 900 is done"]);
    assert_eq!(part_files(&folder.join("out")).len(), 1);
}

/// Walls that stand at every level leave medians open. Tables state the bound, neither `inf` nor `NaN`.
#[test]
fn open_medians_have_their_bound() {
    let folder = study("ida_open");
    let from = STUDY.find("method").unwrap();
    let to = STUDY.find("[records]").unwrap();
    let grid = "method = \"grid\"\nvalues = [0.05, 0.1, 0.15, 0.2]\n\n";
    let text_of = format!("{}{grid}{}", &STUDY[..from], &STUDY[to..]);
    fs::write(folder.join("study.toml"), text_of).unwrap();
    let told = printed(&folder, &["study", "ida", "study.toml", "-o", "out"]);
    let table = content(&folder, "out/fragilities.csv");
    let page = content(&folder, "out/study.html");
    assert!(told.contains("  open >0.200  "), "{told}");
    for (text, bound) in [(&told, "open >0.200"), (&table, ",open >0.2"), (&page, "open &gt;0.200")] {
        assert!(text.contains(bound), "{text}");
        // the message on NRML has the word
        let numbers = text.replace("would be 0 or infinite", "");
        assert!(!numbers.contains("inf") && !numbers.contains("NaN"), "{text}");
    }
    // stripes are points: of runs, and of the fractions that exceed a limit state
    assert!(page.contains("stroke-linecap=\"round\"") && page.contains("stroke-width=\"1.4\""));
    assert!(!page.contains("class=\"faint\"") && !page.contains("stroke-width=\"1\""));
    assert!(page.contains("<td class=\"number\">open &gt;0.200</td>"), "records that never collapsed");
}
