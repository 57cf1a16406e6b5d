//! Figure 15 of the paper: the collapse of the nine walls of Table 5 under each damping model.
//!
//! The tested claims: with calibrated damping (Eqs. 20–22) the median collapse intensity is about that of
//! restitution. With the damping of Eq. (14) it is far above, which is unconservative.

use std::path::PathBuf;

use evidence::reproduce::collapse::figure_15;
use fragility::Summary;
use ground_motion::{RecordOptions, SyntheticMotion, read};
use run::parallel::threads;
use run::records::NamedRecord;

use crate::records::folder;

/// Checks the paper's statements about Figure 15 for every wall.
#[allow(clippy::print_stderr, reason = "the figures behind a verdict")]
fn check(records: Vec<NamedRecord>, tolerance: f64) {
    let found = figure_15(records, threads(None)).unwrap();
    assert_eq!((found.walls.len(), found.figure.charts.len(), found.table.rows.len()), (9, 9, 9));
    for (index, models) in found.walls.iter().enumerate() {
        let wall = index + 1;
        let [cr, cdc, cdr, sdr, equation_14] = models.as_slice() else { panic!("five models") };
        eprintln!("wall {wall}: {}", models.iter().map(words).collect::<Vec<_>>().join("; "));
        assert_eq!(cr.theta_ratio.range, [1.0, 1.0]);
        for (name, calibrated) in [("CDC", cdc), ("CDR", cdr), ("SDR", sdr)] {
            let ratio = calibrated.theta_ratio.estimate;
            assert!((ratio - 1.0).abs() <= tolerance, "wall {wall}, {name}: {ratio}");
        }
        // the whole interval is above 1; its estimate is above 1.05 and above the calibrated ratio
        let unsafe_ratio = equation_14.theta_ratio;
        assert!(
            unsafe_ratio.range[0] > 1.0 && unsafe_ratio.estimate > 1.05,
            "wall {wall}, Eq. 14: {unsafe_ratio:?}"
        );
        assert!(
            equation_14.median_ratio.estimate > 1.05,
            "wall {wall}, Eq. 14: {:?}",
            equation_14.median_ratio
        );
        assert!(unsafe_ratio.estimate > cdr.theta_ratio.estimate + 0.05, "wall {wall}");
    }
}

fn words(summary: &Summary) -> String {
    let [low, high] = summary.theta_ratio.range;
    let (median, theta) = (summary.median_ratio.estimate, summary.theta_ratio.estimate);
    format!("median {median:.3}, theta {theta:.3} ({low:.3} … {high:.3})")
}

/// Real records if there are any, which cannot be copied into the project, and synthetic ones otherwise.
#[test]
#[allow(clippy::print_stderr, reason = "what was not run")]
fn equation_14_overestimates() {
    let Some(folder) = folder() else {
        eprintln!("not run: no real records (set ROCKING_WALL_RECORDS to their folder)");
        let record = |seed| {
            NamedRecord::new(
                format!("seed {seed}"),
                SyntheticMotion { seed, duration: 15.0, step: 0.01, peak: 3.0 }.motion().unwrap(),
            )
        };
        // with twelve records θ has a standard error of about β/√12 = 0.1, and the ratio of two models a
        // smaller one
        return check((1..=12).map(record).collect(), 0.2);
    };
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "AT2"));
    files.sort();
    assert!(files.len() >= 20, "{} AT2 records in {}", files.len(), folder.display());
    let record = |path: &PathBuf| {
        NamedRecord::new(path.display().to_string(), read(path, &RecordOptions::default()).unwrap().motion)
    };
    check(files.iter().map(record).collect(), 0.1);
}

#[test]
fn a_figure_without_records_is_refused() {
    let error = figure_15(Vec::new(), threads(None)).unwrap_err().to_string();
    assert!(error.contains("record"), "{error}");
}
