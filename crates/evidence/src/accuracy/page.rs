//! The page of `wall verify accuracy`: for each problem error against run time, on logarithmic axes.

use std::collections::BTreeMap;

use report::page::Page;
use report::palette::sign;
use report::plot::{Plot, stacked};
use report::{counted, escaped};

use super::figure::{Point, SOLVERS, TOOLS, plot};
use super::{Measurement, WorkPrecision};
use crate::reproduce::Figure;
use crate::reproduce::page::drawn as section_of;

/// Settings of each of [`SOLVERS`], in markup.
const SETTINGS: [&str; 3] = [
    "steps of 1, 1/4, 1/16 sample",
    "tolerance 10<sup>−3</sup> … 10<sup>−12</sup>",
    "steps of 1 … 1/300 sample",
];

/// The measurements of other tools, scene by scene.
pub type Peers = BTreeMap<String, Vec<Point>>;

const INTRODUCTION: &str = "\
<p>Each point is one solver at one step or tolerance. It shows the largest error \
of u over u<sub>ins</sub> at the samples of the record while the wall stands, against the least of several \
run times. Down and to the left is better. Point at a mark to see its numbers.</p>
<p>The grey line is the error that rounding alone can cause: 100 ε times the factor by which the wall \
amplifies a change of its motion. The points of <i>exact</i> are compared with the adaptive solver at \
10<sup>−13</sup>. They divide the record's step by 1, 4 and 16; their error does not depend on the \
step.</p>";

/// Writes the page of problems, of the figures of small rotations and, if they are given, of other tools.
pub fn page(studies: &[WorkPrecision], rotations: &[Figure], peers: Option<&Peers>) -> String {
    let drawn = |study: &WorkPrecision| {
        let fate = match study.overturning {
            Some(time) => format!("overturns at {time:.3} s"),
            None => format!("u<sub>max</sub>/u<sub>ins</sub> = {:.3}", study.peak),
        };
        let reference = if study.exact { "exact" } else { "adaptive at 10<sup>−13</sup>" };
        let caption = format!("<b>{}</b><br>{fate}; reference: {reference}", escaped(&study.name));
        figure(&caption, &solver_plot(study, false))
    };
    let settings = SOLVERS.iter().zip(SETTINGS);
    let key =
        settings.map(|(&(name, color, mark), settings)| (sign(color, mark), format!("{name}: {settings}")));
    let page =
        Page::new("Error against run time").text(INTRODUCTION).text(&figures(key, studies.iter().map(drawn)));
    let page = match peers {
        None => page,
        Some(peers) => {
            let key = TOOLS.map(|(name, color, mark)| (sign(color, mark), name.to_owned()));
            let drawn = |(scene, rows): (&String, &Vec<Point>)| {
                figure(&format!("<b>{}</b>", escaped(scene)), &plot(&TOOLS, rows, None, false))
            };
            page.section("Beside other tools", &figures(key, peers.iter().map(drawn)))
        }
    };
    let rotations: String = rotations.iter().map(section_of).collect();
    page.section("What small rotations leave out", &rotations).html()
}

/// A plot with its caption, which is markup.
fn figure(caption: &str, plot: &Plot) -> String {
    format!("<figure><figcaption>{caption}</figcaption>{}</figure>\n", plot.svg())
}

/// Figures under a key: signs and words, which are markup.
fn figures(key: impl IntoIterator<Item = (String, String)>, figures: impl Iterator<Item = String>) -> String {
    let key: Vec<_> = key.into_iter().map(|(sign, words)| sign + &words).collect();
    let (key, figures) = (key.join("</span>\n<span>"), figures.collect::<String>());
    format!("<p class=\"key\"><span>{key}</span></p>\n<div class=\"figures\">\n{figures}</div>")
}

/// Draws the plots of all problems, one above the other, for a file; those of the peers instead, if they are
/// given.
pub fn picture(studies: &[WorkPrecision], peers: Option<&Peers>) -> String {
    let sized = |title: &String, plot| Plot { title: title.clone(), size: [560.0, 320.0], ..plot };
    let plots: Vec<_> = match peers {
        Some(peers) => peers.iter().map(|(scene, rows)| sized(scene, beside_legend(rows))).collect(),
        None => studies.iter().map(|study| sized(&study.name, solver_plot(study, true))).collect(),
    };
    stacked(&plots)
}

/// The plot of tools on a problem, whose legend stands right of the slowest.
fn beside_legend(points: &[Point]) -> Plot {
    let mut plot = plot(&TOOLS, points, None, true);
    let times = points.iter().map(|point| 1e3 * point.seconds);
    let [fastest, slowest] = [times.clone().fold(f64::INFINITY, f64::min), times.fold(0.0, f64::max)];
    // two thirds of a logarithmic axis are for the marks
    plot.axes[0].range = Some([0.6 * fastest, slowest * (slowest / fastest).sqrt()]);
    plot
}

/// The plot of a problem; with the names of the solvers if it is `named`.
fn solver_plot(study: &WorkPrecision, named: bool) -> Plot {
    let point = |row: &Measurement| Point {
        tool: row.setting.solver().to_owned(),
        seconds: row.seconds,
        error: row.error_max,
        title: hover(study, row),
    };
    let points: Vec<_> = study.measurements.iter().map(point).collect();
    plot(&SOLVERS, &points, Some(study.rounding()), named)
}

/// Reads a line and its scene; `None` for the header and for a model that a tool does not offer.
fn peer(line: &str) -> Option<(String, Point)> {
    let fields: Vec<&str> = line.split(',').collect();
    let [scene, tool, setting, seconds, error, ..] = fields[..] else { return None };
    let seconds: f64 = seconds.parse().ok()?;
    let error = error.parse().ok().filter(|error: &f64| error.is_finite())?;
    let title = format!("{tool}, {setting}: max error {error:.1e}; {:.3} ms", seconds * 1e3);
    Some((format!("Table 5, {scene}"), Point { tool: tool.to_owned(), seconds, error, title }))
}

/// Reads the CSV of `cargo xtask bench --peers`.
pub fn read_peers(csv: &str) -> Peers {
    let mut peers = Peers::new();
    for (scene, row) in csv.lines().filter_map(peer) {
        peers.entry(scene).or_default().push(row);
    }
    peers
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
