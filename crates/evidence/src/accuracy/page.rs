//! The page of `wall accuracy`: for each problem error against run time, on logarithmic axes.

use std::collections::BTreeMap;
use std::fmt::Write;

use report::counted;
use report::escaped;
use report::palette::sign;
use report::plot::{Picture, Plot};
use report::template;

use super::figure::{SOLVERS, TOOLS, Tool, plot};
use super::linearisation::{self, BothRotations};
use super::{Measurement, WorkPrecision};

/// Settings of each of [`SOLVERS`], in markup.
const SETTINGS: [&str; 3] = [
    "steps of 1, 1/4, 1/16 sample",
    "tolerance 10<sup>−3</sup> … 10<sup>−12</sup>",
    "steps of 1 … 1/300 sample",
];

/// The measurements of other tools, scene by scene.
pub type Peers = BTreeMap<String, Vec<PeerRow>>;

/// Writes the page of problems, of small rotations and, if they are given, of other tools.
pub fn page(studies: &[WorkPrecision], rotations: &[BothRotations], peers: Option<&Peers>) -> String {
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
        include_str!("page.html"),
        &[
            ("title", "Error against run time"),
            ("key", &key.collect::<String>()),
            ("figures", &figures),
            ("rotations", &linearisation::page::section(rotations)),
            ("peers", &peers.map_or_else(String::new, section)),
        ],
    )
}

/// Draws the plots of all problems, one above the other, for a file; those of the peers instead, if they are
/// given.
pub fn picture(studies: &[WorkPrecision], peers: Option<&Peers>) -> Picture {
    let sized = |title: &str, plot| Plot { title: title.to_owned(), size: [560.0, 320.0], ..plot };
    let plots: Vec<_> = match peers {
        Some(peers) => peers.iter().map(|(scene, rows)| sized(scene, peer_plot(rows, true))).collect(),
        None => studies.iter().map(|study| sized(&study.name, solver_plot(study, true))).collect(),
    };
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

/// The plot of a scene of the peers; with their names if it is `named`.
fn peer_plot(rows: &[PeerRow], named: bool) -> Plot {
    let tools = TOOLS.map(|(name, color, mark)| {
        let rows = rows.iter().filter(|row| row.tool == name);
        let points = rows.clone().map(|row| (row.seconds * 1e3, row.error)).collect();
        let titles = rows
            .map(|row| {
                format!("{name}, {}: max error {:.1e}; {:.3} ms", row.setting, row.error, row.seconds * 1e3)
            })
            .collect();
        Tool { name: if named { name } else { "" }, color, mark, points, titles, joined: false }
    });
    plot(&tools, None)
}

/// A line of the CSV that `cargo xtask bench --peers` writes.
pub struct PeerRow {
    tool: String,
    setting: String,
    seconds: f64,
    error: f64,
}

/// Reads a line and its scene; `None` for the header and for a model that a tool does not offer.
fn peer(line: &str) -> Option<(String, PeerRow)> {
    let fields: Vec<&str> = line.split(',').collect();
    let [scene, tool, setting, seconds, error, ..] = fields[..] else { return None };
    let (seconds, error) =
        (seconds.parse().ok()?, error.parse().ok().filter(|error: &f64| error.is_finite())?);
    let row = PeerRow { tool: tool.to_owned(), setting: setting.to_owned(), seconds, error };
    Some((format!("Table 5, {scene}"), row))
}

/// Reads the CSV of `cargo xtask bench --peers`.
pub fn read_peers(csv: &str) -> Peers {
    let mut peers = Peers::new();
    for (scene, row) in csv.lines().filter_map(peer) {
        peers.entry(scene).or_default().push(row);
    }
    peers
}

/// The section on other tools.
fn section(peers: &Peers) -> String {
    let mut section = String::from("<h2>Beside other tools</h2>\n<p class=\"key\">");
    for (name, color, mark) in TOOLS {
        let _ = write!(section, "<span>{}{name}</span>", sign(color, mark));
    }
    section.push_str("</p>\n<main class=\"figures\">\n");
    for (scene, rows) in peers {
        let (scene, plot) = (escaped(scene), peer_plot(rows, false).svg());
        let _ = writeln!(section, "<figure><figcaption><b>{scene}</b></figcaption>{plot}</figure>");
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
