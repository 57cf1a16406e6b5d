//! Tests `wall study spectrum`.

use ground_motion::SyntheticMotion;
use rocking_wall::wall::Parameters;
use study::spectrum::{Size, Slenderness, over_walls};

use crate::command_line::{
    args, assert_has, content, fails, folder, json, printed, refused, rows, setting, succeed,
};

#[test]
fn the_program_writes_a_table_and_a_page() {
    let folder = folder("spectrum");
    let arguments =
        ["study", "spectrum", "--synthetic", "--heights", "1:3:3", "--ratios", "5:15:2", "--csv", "s.csv"];
    let words = printed(&folder, &[&arguments[..], &["--html", "s.html", "--threads", "2"]].concat());
    // two axes, ratio, rocked, overturned, time
    let found = rows(&folder, "s.csv");
    let axes: Vec<_> = found.iter().map(|row| (row[0].as_str(), row[1].as_str())).collect();
    assert_eq!(
        axes,
        [("1.0", "5.0"), ("2.0", "5.0"), ("3.0", "5.0"), ("1.0", "15.0"), ("2.0", "15.0"), ("3.0", "15.0")]
    );
    let motion = SyntheticMotion::default().motion().unwrap();
    let defaults = Parameters::default();
    let expected =
        over_walls(&defaults, &motion, Size::Height, &[1.0, 2.0, 3.0], Slenderness::Ratio, &[5.0, 15.0], 1)
            .unwrap();
    for (row, point) in found.iter().zip(expected.points.iter().flatten()) {
        assert_eq!(row[2].parse::<f64>().unwrap(), point.ratio);
        assert_eq!(row[4].parse::<bool>().unwrap(), point.overturning.is_some());
        assert_eq!(row[5].parse::<f64>().ok(), point.overturning);
    }
    assert_has(&words, &["points     6:", "written    s.html"]);
    let page = content(&folder, "s.html");
    assert_eq!(page.matches("<title>height h (m) = ").count(), 6);
    assert!(!page.contains("{{") && !page.contains("NaN"), "a place left open");
    // the default parapet is beyond these axes, and on wider ones
    let own = "height h (m) = 4, slenderness h/b = 10: overturns at ";
    assert!(words.contains(own) && words.contains(", outside the map") && !page.contains(">your wall<"));
    let wider =
        ["study", "spectrum", "--synthetic", "--heights", "2:5:2", "--ratios", "5:15:2", "--html", "w.html"];
    succeed(&folder, &[&wider[..], &["--svg", "w.svg"]].concat());
    let svg = content(&folder, "w.svg");
    assert!(svg.starts_with("<svg xmlns") && svg.contains(">your wall</text>") && !svg.contains("<title>"));
    let page = content(&folder, "w.html");
    assert!(page.contains(">your wall</text>") && page.contains(own) && !page.contains("outside the map"));

    let rigid = "force_law=rigid_linear damping_model=none impact=restitution";
    let pulse = "study spectrum --pulse half_sine --frequency-ratios 2:3:2 --amplitude-ratios 0.5:9:2 \
                 --csv p.csv";
    succeed(&folder, &setting(pulse, rigid));
    let outcomes: Vec<_> =
        rows(&folder, "p.csv").iter().map(|row| [row[3].clone(), row[4].clone()]).collect();
    assert_eq!(outcomes, [["false", "false"], ["false", "false"], ["true", "true"], ["true", "true"]]);
    // a pulse with its frequency and amplitude is a motion like any other
    let pulse =
        args("study spectrum --pulse ricker --frequency 1 --amplitude 3 --radii 1:2:2 --angles 0.1:0.2:2");
    assert_has(&printed(&folder, &pulse), &["semi-diagonal R (m)"]);
    let pulse = args(
        "study spectrum --pulse falling_triangle --frequency 1 --amplitude 3 --heights 1:2:2 --ratios 5:9:2",
    );
    assert_has(&printed(&folder, &pulse), &["falling triangle of 3 m/s² at 1 Hz"]);
}

#[test]
fn bad_requests_are_refused() {
    let folder = folder("spectrum_refused");
    let strip =
        ["study", "spectrum", "--synthetic", "--set", "mechanism=vertical_spanning", "--radii", "1:2:2"];
    let cases: [(&[&str], &[&str]); 12] = [
        (&["study", "spectrum"], &["--record", "--pulse", "scene"]),
        (
            &["study", "spectrum", "--pulse", "cosine"],
            &["--pulse: \"cosine\"", "ricker, ", "falling_triangle"],
        ),
        (
            &["study", "spectrum", "--pulse", "ricker", "--heights", "1:2:2"],
            &["--heights", "--frequency", "--amplitude"],
        ),
        (
            &["study", "spectrum", "--pulse", "triangle", "--frequency", "0", "--amplitude", "1"],
            &["frequency", "0", "positive"],
        ),
        (&["study", "spectrum", "--pulse", "ricker", "--scale", "2"], &["--scale", "--record"]),
        (&["study", "spectrum", "--synthetic", "--heights", "1:2"], &["--heights 1:2", "FROM:TO:COUNT"]),
        (&["study", "spectrum", "--synthetic", "--heights", "2:1:5"], &["2:1:5", "FROM < TO"]),
        (
            &["study", "spectrum", "--synthetic", "--angles", "0.1:2:3"],
            &["angle", "= 1.05", "at most 0.7854"],
        ),
        (&["study", "spectrum", "--synthetic", "--ratios", "5:9:501"], &["COUNT from 2 to 500"]),
        (&["study", "spectrum", "--record", "none.AT2"], &["none.AT2", "cannot be read"]),
        (
            &["study", "spectrum", "--synthetic", "--set", "force_law=rigid_linear"],
            &["constant_ratio", "free_standing_block"],
        ),
        (&strip, &["semi-diagonal", "vertical spanning", "heights"]),
    ];
    for (arguments, words) in cases {
        refused(&folder, &[arguments, &["--csv", "out.csv", "--html", "out.html"]].concat(), words);
    }
}

/// The pulses of a record as text, JSON, CSV and picture.
#[test]
fn the_pulses_of_a_record_are_found() {
    let folder = folder("pulse_of");
    succeed(&folder, &["record", "--synthetic", "--samples", "r.csv"]);
    // 8 s are enough: the search compares each pulse with every sample
    let start: Vec<_> = content(&folder, "r.csv").lines().take(801).map(str::to_owned).collect();
    std::fs::write(folder.join("r.csv"), start.join("\n")).unwrap();
    let command = ["study", "spectrum", "--pulse-of", "r.csv", "--scale", "0.8"];
    let text = printed(&folder, &[&command[..], &["--csv", "p.csv", "--svg", "p.svg"]].concat());
    assert_has(
        &text,
        &["record r.csv", "amplitudes with the same peak", "misfit", "written p.csv", "written p.svg"],
    );
    let pulses = json(&folder, &[&command[..], &["--json"]].concat());
    let pulses = pulses["pulses"].as_array().unwrap();
    assert_eq!((pulses.len(), rows(&folder, "p.csv").len()), (3, 3));
    let index = |at: usize| pulses[at]["index"].as_f64().unwrap();
    assert!(index(0) >= index(1) && index(1) >= index(2) && index(2) > 0.0);
    assert!(content(&folder, "p.svg").contains("ricker, T = "));
}

#[test]
fn what_has_no_pulses_is_refused() {
    let folder = folder("no_pulse_of");
    succeed(&folder, &["record", "--synthetic", "--samples", "r.csv"]);
    std::fs::write(folder.join("zeros.txt"), "0\n".repeat(50)).unwrap();
    std::fs::write(folder.join("small.txt"), "0.1\n-0.1\n".repeat(50)).unwrap();
    std::fs::write(folder.join("words.txt"), "one two\n").unwrap();
    let of = |more: &[&'static str]| [&["study", "spectrum", "--pulse-of"], more].concat();
    for (arguments, words) in [
        (of(&["none.csv"]), "none.csv"),
        (of(&["words.txt"]), "words.txt"),
        (of(&["zeros.txt", "--unit", "m/s2", "--record-step", "0.01"]), "zeros.txt"),
        (of(&["r.csv", "--csv", "r.csv"]), "r.csv"),
        (of(&["r.csv", "--scale", "nan"]), "scale"),
        (of(&["r.csv", "--unit", "furlong"]), "furlong"),
        (of(&["r.csv", "--set", "heigth=3"]), "did you mean"),
        (
            of(&[
                "small.txt",
                "--unit",
                "m/s2",
                "--record-step",
                "0.01",
                "--set",
                "force_law=rigid_linear",
                "--set",
                "damping_model=none",
            ]),
            "stays at rest under the record",
        ),
    ] {
        fails(&folder, &arguments, &[words]);
    }
    for more in [
        &["--record", "r.csv"][..],
        &["--pulse", "ricker"],
        &["--heights", "1:2:3"],
        &["--ratios", "5:9:2"],
        &["--radii", "1:2:3"],
        &["--angles", "0.1:0.2:3"],
        &["--html", "a.html"],
        &["--synthetic"],
        &["--frequency-ratios", "1:2:3"],
        &["--frequency", "2"],
        &["--svg", "a.png"],
    ] {
        fails(&folder, &[&of(&["r.csv"])[..], more].concat(), &["--"]);
    }
    fails(&folder, &["study", "spectrum", "--json"], &["--pulse-of"]);
}
