//! The page of `wall accuracy`: for each problem error against run time, on logarithmic axes.

use std::collections::BTreeSet;
use std::fmt::Write;

use figures::escaped;
use figures::palette::sign;
use figures::plot::{Picture, Plot};
use figures::work_precision::{SOLVERS, TOOLS, Tool, plot};
use study::accuracy::{Measurement, WorkPrecision};
use study::counted;

use figures::template;

/// Settings of each of [`SOLVERS`], in markup.
const SETTINGS: [&str; 3] = [
    "steps of 1, 1/4, 1/16 sample",
    "tolerance 10<sup>−3</sup> … 10<sup>−12</sup>",
    "steps of 1 … 1/300 sample",
];

/// The page; `rotations` is its section on small rotations, `peers_csv` the output of
/// `cargo xtask bench --peers`.
pub(crate) fn page(studies: &[WorkPrecision], rotations: &str, peers_csv: Option<&str>) -> String {
    let mut figures = String::new();
    for study in studies {
        let fate = match study.overturning {
            Some(time) => format!("overturns at {time:.3} s"),
            None => format!("u<sub>max</sub>/u<sub>ins</sub> = {:.3}", study.peak),
        };
        let reference = if study.exact { "exact" } else { "adaptive at 10<sup>−13</sup>" };
        let _ = writeln!(
            figures,
            "<figure><figcaption><b>{}</b><br>{fate}; reference: {reference}</figcaption>{}</figure>",
            escaped(&study.name),
            solver_plot(study, false).svg()
        );
    }
    let key = SOLVERS.iter().zip(SETTINGS).map(|(&(name, color, mark), settings)| {
        format!("<span>{}{name}: {settings}</span>", sign(color, mark))
    });
    template::page(
        include_str!("work_precision.html"),
        &[
            ("title", "Error against run time"),
            ("key", &key.collect::<String>()),
            ("figures", &figures),
            ("rotations", rotations),
            ("peers", &peers_csv.map_or_else(String::new, peers)),
        ],
    )
}

/// Draws the plots of all problems, one above the other, for a file.
pub(crate) fn picture(studies: &[WorkPrecision]) -> Picture {
    let plots: Vec<_> = studies
        .iter()
        .map(|study| Plot { title: study.name.clone(), size: [560.0, 320.0], ..solver_plot(study, true) })
        .collect();
    Picture::stacked(&plots)
}

/// The plot of a problem; with the names of the solvers if it is `named`.
fn solver_plot(study: &WorkPrecision, named: bool) -> Plot {
    let tools = SOLVERS.map(|(name, color, mark)| {
        let rows: Vec<&Measurement> =
            study.measurements.iter().filter(|row| row.setting.solver() == name).collect();
        let points = rows.iter().map(|row| (row.seconds * 1e3, row.error_max)).collect();
        let titles = rows.iter().map(|row| hover(study, row)).collect();
        Tool { name: if named { name } else { "" }, color, mark, points, titles, joined: true }
    });
    plot(&tools, Some(study.rounding()))
}

/// The plot of a scene of the peers.
fn peer_plot(rows: &[&PeerRow<'_>]) -> String {
    let tools = TOOLS.map(|(name, color, mark)| {
        let rows = rows.iter().filter(|row| row.tool == name);
        let points = rows.clone().map(|row| (row.seconds * 1e3, row.error)).collect();
        let titles = rows
            .map(|row| {
                format!("{name}, {}: max error {:.1e}; {:.3} ms", row.setting, row.error, row.seconds * 1e3)
            })
            .collect();
        Tool { name, color, mark, points, titles, joined: false }
    });
    plot(&tools, None).svg()
}

/// A line of the CSV that `cargo xtask bench --peers` writes.
struct PeerRow<'a> {
    scene: &'a str,
    tool: &'a str,
    setting: &'a str,
    seconds: f64,
    error: f64,
}

impl<'a> PeerRow<'a> {
    /// Reads a line; `None` for the header and for a model that a tool does not offer.
    fn parse(line: &'a str) -> Option<Self> {
        let mut fields = line.split(',');
        let (scene, tool, setting) = (fields.next()?, fields.next()?, fields.next()?);
        let (seconds, error) = (fields.next()?.parse().ok()?, fields.next()?.parse().ok()?);
        Some(Self { scene, tool, setting, seconds, error })
    }
}

/// The section on other tools.
fn peers(csv: &str) -> String {
    let rows: Vec<PeerRow<'_>> = csv.lines().filter_map(PeerRow::parse).collect();
    let mut section = String::from("<h2>Beside other tools</h2>\n<p class=\"key\">");
    for (name, color, mark) in TOOLS {
        let _ = write!(section, "<span>{}{name}</span>", sign(color, mark));
    }
    section.push_str("</p>\n<main class=\"figures\">\n");
    for scene in rows.chunk_by(|a, b| a.scene == b.scene).map(|rows| rows[0].scene).collect::<BTreeSet<_>>() {
        let rows: Vec<_> = rows.iter().filter(|row| row.scene == scene && row.error.is_finite()).collect();
        let _ = writeln!(
            section,
            "<figure><figcaption><b>Table 5, {}</b></figcaption>{}</figure>",
            escaped(scene),
            peer_plot(&rows)
        );
    }
    section + "</main>\n"
}

fn hover(study: &WorkPrecision, row: &Measurement) -> String {
    let Measurement { seconds, error_max, error_rms, error_peak, work, .. } = row;
    format!(
        "{}, {}: max error {error_max:.1e}, rms {error_rms:.1e}{}; {:.3} ms, {}, {}, {}",
        row.setting.solver(),
        row.setting.describe(study.step),
        error_peak.map_or_else(String::new, |error| format!(", peak {error:.1e}")),
        seconds * 1e3,
        counted(work.pieces, "piece"),
        counted(work.corners, "corner"),
        counted(work.impacts, "impact")
    )
}
