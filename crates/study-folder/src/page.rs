//! The page of a study; of each wall its IDA curves and fragilities, damping models side by side.

use std::fmt::Write;

use figures::escaped;
use figures::many_lines::ManyLines;
use figures::palette::{AMBER, BLACK, BLUE, BROWN, GREEN, GREY, PURPLE, RED, TEAL};
use figures::template::filled;
use study::fragility::{Interval, fractile, steps};
use study::ida::{Curve, Exceedance};
use study::results::WallResults;

use crate::contents::Manifest;
use crate::tables::in_g;

/// Colours of the models by their names, then of the others in turn.
const KNOWN: [(&str, &str); 6] =
    [("CR", BLACK), ("CDC", BLUE), ("CDR", GREEN), ("SDR", AMBER), ("CDR Eq. 14", RED), ("none", GREY)];
const OTHERS: [&str; 5] = [PURPLE, TEAL, BROWN, "#c2185b", "#5c6bc0"];
/// Sizes of the plots \[px\].
pub(crate) const LARGE: [f64; 2] = [420.0, 280.0];
const SMALL: [f64; 2] = [300.0, 250.0];
/// Demand at the right end of IDA curves.
const DEMAND_END: f64 = 1.08;
/// Intensities at which fractiles are drawn, points of a fitted curve.
pub(crate) const POINTS: u32 = 100;
/// Points of single curves on the whole page, about 12 bytes each; beyond it, only every nth record is drawn.
const MOST_POINTS: usize = 100_000;

/// Makes the page of a study with a number of runs from the sections of its walls, or of all together.
pub(crate) fn page(manifest: &Manifest, runs: usize, sections: &str) -> String {
    let contents = &manifest.contents;
    let mut key = String::new();
    for (index, model) in contents.models.iter().enumerate() {
        let _ = write!(
            key,
            "<span><i style=\"background:{}\"></i>{}</span>",
            color(manifest, index),
            escaped(&model.name)
        );
    }
    let facts = format!(
        "{} {}, {} records, {} damping models: {} runs. Intensity: {}. A run stops when the wall overturns, \
         |u| &gt; u<sub>ins</sub>; the lowest level at which it does is the collapse.",
        contents.walls.len(),
        if contents.walls.len() == 1 { "wall" } else { "walls" },
        contents.records.len(),
        contents.models.len(),
        runs,
        measure_words(manifest),
    );
    filled(
        include_str!("page.html"),
        &[
            ("title", &escaped(&manifest.title)),
            ("facts", &facts),
            ("reading", &reading(manifest)),
            ("key", &key),
            ("program", &escaped(&contents.program)),
            ("sections", sections),
        ],
    )
}

/// The intensity measure in words, with its periods.
fn measure_words(manifest: &Manifest) -> String {
    let contents = &manifest.contents;
    let periods =
        contents.measure_details.split_once("periods: ").map(|(_, rest)| rest.trim_end_matches([' ', '}']));
    match periods {
        Some(periods) => format!(
            "{}, the geometric mean of 5&nbsp;%-damped Sa at {} s",
            escaped(&contents.measure),
            escaped(periods.trim_matches(['[', ']']))
        ),
        None => escaped(&contents.measure),
    }
}

/// Explains medians, fits and intervals.
fn reading(manifest: &Manifest) -> String {
    let report = &manifest.report;
    let observed = if manifest.contents.grid.is_some() {
        "the numbers of exceedances at each level (Baker 2015, Eq. 11)"
    } else {
        "the records' own intensities; those that stood at the highest level count as censored (Baker \
         2015, Eq. 8)"
    };
    format!(
        "Fragilities: the steps are the records. The lines are lognormal curves, fitted by maximum \
         likelihood to {observed}. All limit states of a wall and model share one β, so that their curves do \
         not cross (Shinozuka et al. 2003). * marks a β that the limit states contradict (ratio of \
         likelihoods, 5&nbsp;%). Intervals contain 95&nbsp;% of {} resamples of the records, drawn with all \
         their results, so that ratios are paired. Ratios are to {}. “open” marks a number that the levels \
         leave open, with its bound.",
        report.resamples,
        escaped(&report.reference)
    )
}

/// Returns the colour of a model.
pub(crate) fn color(manifest: &Manifest, model: usize) -> &'static str {
    let models = &manifest.contents.models;
    let known = |name: &str| KNOWN.iter().find(|(known, _)| *known == name).map(|(_, color)| *color);
    known(&models[model].name).unwrap_or_else(|| {
        let before = models[..model].iter().filter(|model| known(&model.name).is_none()).count();
        OTHERS[before % OTHERS.len()]
    })
}

/// A wall and its results.
#[derive(Clone, Copy)]
struct Shown<'a> {
    manifest: &'a Manifest,
    wall: usize,
    results: &'a WallResults,
}

/// Makes the section of a wall. Of a study of many runs, only every nth record is drawn.
pub(crate) fn section(manifest: &Manifest, wall: usize, results: &WallResults, runs: usize) -> String {
    let shown = Shown { manifest, wall, results };
    let every = runs.div_ceil(MOST_POINTS).max(1);
    let contents = &manifest.contents;
    let note = &contents.walls[wall];
    let top_of_collapses = top(shown, 1.0);
    let mut html = format!(
        "<section><h2>Wall {}</h2><p class=\"facts\">{}; e = {:.3}</p><div class=\"pair\">",
        escaped(&note.name),
        escaped(&shape(&note.parameters)),
        note.restitution
    );
    let fractions = &manifest.report.fractions;
    if let Some(collapse) = fractions.iter().position(|fraction| *fraction == 1.0) {
        let _ = write!(
            html,
            "<figure><figcaption>Collapse fragility</figcaption>{}</figure><div>{}</div>",
            fragility(shown, collapse, LARGE, top_of_collapses),
            table(shown, collapse)
        );
    }
    html.push_str("</div><h3>IDA curves, with their 16, 50 and 84 % fractiles</h3><div class=\"row\">");
    for (model, name) in contents.models.iter().enumerate().map(|(index, model)| (index, &model.name)) {
        let _ = write!(
            html,
            "<figure><figcaption>{}</figcaption>{}</figure>",
            escaped(name),
            curves(shown, model, every, top_of_collapses)
        );
    }
    html.push_str("</div><h3>Fragilities at fractions of u<sub>ins</sub></h3><div class=\"row\">");
    for (place, fraction) in fractions.iter().enumerate().filter(|(_, fraction)| **fraction < 1.0) {
        let _ = write!(
            html,
            "<figure><figcaption>P(u<sub>max</sub>/u<sub>ins</sub> &gt; {fraction})</figcaption>{}</figure>",
            fragility(shown, place, SMALL, top(shown, *fraction))
        );
    }
    html.push_str("</div></section>\n");
    html
}

/// Shape, law and loads of a wall, from its parameters.
fn shape(parameters: &str) -> String {
    let find = |name: &str| {
        parameters
            .lines()
            .find_map(|line| line.strip_prefix(name)?.strip_prefix(" = "))
            .map(|v| v.trim_matches('"'))
    };
    let text = |name| find(name).unwrap_or("?");
    let mut words =
        format!("{}, {} m × {} m", text("mechanism").replace('_', " "), text("height"), text("thickness"));
    if text("mechanism") == "vertical_spanning" {
        let _ = write!(words, ", h1 = {} h", text("hinge_ratio"));
    }
    let _ = write!(words, ", {}", text("force_law").replace('_', " "));
    if let Some(a1) = find("a1") {
        let _ = write!(words, ", a1 = {a1}");
    }
    if find("overburden").is_some_and(|load| load != "0.0") {
        let _ = write!(words, ", overburden {} N", text("overburden"));
    }
    words
}

/// Intensity at the end of a wall's axes \[g\]: nearly all exceedances of a fraction of `u_ins`.
fn top(shown: Shown<'_>, fraction: f64) -> f64 {
    let models = shown.manifest.contents.models.len();
    let largest = |model: usize| {
        let mut intensities: Vec<f64> = shown
            .results
            .exceedances(model, fraction)
            .into_iter()
            .map(|occurrence| match occurrence {
                Exceedance::At(intensity) | Exceedance::Above(intensity) => intensity,
            })
            .collect();
        intensities.sort_by(f64::total_cmp);
        let (most, all) = (fractile(&intensities, 0.9), intensities.last().copied());
        // one stray record must not squeeze the others
        (1.5 * most.unwrap_or(1.0)).min(all.unwrap_or(1.0))
    };
    1.05 * in_g((0..models).map(largest).fold(1e-6, f64::max))
}

/// Empirical steps and fitted curves of all models.
fn fragility(shown: Shown<'_>, place: usize, size: [f64; 2], top: f64) -> String {
    let Shown { manifest, wall, results } = shown;
    let fraction = manifest.report.fractions[place];
    let mut plot = ManyLines::new(size, [0.0, top], [0.0, 1.0]);
    for (model, summary) in results.summaries(place).iter().enumerate() {
        let color = color(manifest, model);
        let mut points = vec![[0.0, 0.0]];
        let mut before = 0.0;
        for (intensity, part) in steps(&results.exceedances(model, fraction)) {
            points.extend([[in_g(intensity), before], [in_g(intensity), part]]);
            before = part;
        }
        points.push([2.0 * top, before]);
        plot.line(&points, "steps", color);
        if let Ok(fit) = summary.fitted {
            let at = |k: u32| top * f64::from(k) / f64::from(POINTS);
            let probability = |x: f64| fit.probability(x * ground_motion::STANDARD_GRAVITY);
            let curve: Vec<_> = (1..=POINTS).map(|k| [at(k), probability(at(k))]).collect();
            plot.line(&curve, "fit", color);
        }
    }
    plot.svg(&format!("f{wall}-{place}"), [&format!("{} (g)", manifest.contents.measure), "probability"])
}

/// Curves of one model: intensity up, demand across.
fn curves(shown: Shown<'_>, model: usize, every: usize, top: f64) -> String {
    let Shown { manifest, wall, results } = shown;
    let all = results.curves(model);
    let color = color(manifest, model);
    let mut plot = ManyLines::new(SMALL, [0.0, DEMAND_END], [0.0, top]);
    for curve in all.iter().step_by(every) {
        plot.line(&path(curve), "record", color);
    }
    for (part, class) in [(0.16, "fractile outer"), (0.84, "fractile outer"), (0.5, "fractile")] {
        plot.line(&fractile_path(all, part, top), class, color);
    }
    plot.svg(&format!("c{wall}-{model}"), ["u_max / u_ins", &format!("{} (g)", manifest.contents.measure)])
}

/// A curve up to its collapse, where it goes flat.
fn path(curve: &Curve) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0, 0.0]];
    for run in curve.runs() {
        if run.overturning.is_some() {
            let standing = points.last().map_or(0.0, |point| point[0]);
            points.extend([[standing, in_g(run.intensity)], [2.0 * DEMAND_END, in_g(run.intensity)]]);
            break;
        }
        points.push([run.demand, in_g(run.intensity)]);
    }
    points
}

/// The demand that a part of the records does not exceed, over the intensity.
fn fractile_path(curves: &[Curve], part: f64, top: f64) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0, 0.0]];
    for k in 1..=POINTS {
        let intensity = top * f64::from(k) / f64::from(POINTS);
        let si = intensity * ground_motion::STANDARD_GRAVITY;
        // unknown above the highest level of a record that stood
        let Some(mut demands) = curves.iter().map(|curve| curve.demand(si)).collect::<Option<Vec<f64>>>()
        else {
            break;
        };
        demands.sort_by(f64::total_cmp);
        let Some(demand) = fractile(&demands, part) else { break };
        if demand.is_infinite() {
            let standing = points.last().map_or(0.0, |point| point[0]);
            points.extend([[standing, intensity], [2.0 * DEMAND_END, intensity]]);
            break;
        }
        points.push([demand, intensity]);
    }
    points
}

/// Medians, dispersions and ratios.
fn table(shown: Shown<'_>, collapse: usize) -> String {
    let Shown { manifest, wall, results } = shown;
    let (contents, report) = (&manifest.contents, &manifest.report);
    let mut html = format!(
        "<table><thead><tr><th>model</th><th>ξ (%)</th><th>median (g)</th><th>θ (g)</th><th>β</th>\
         <th>median / {0}</th><th>θ / {0}</th><th>censored</th><th>stands again</th></tr></thead><tbody>",
        escaped(&report.reference)
    );
    for (model, summary) in results.summaries(collapse).iter().enumerate() {
        let xi = contents.walls[wall].xi[model];
        let again = results.curves(model).iter().filter(|curve| curve.resurrections() > 0).count();
        let reference = contents.models[model].name == report.reference;
        let ratio = |interval: &Interval| if reference { "1".to_owned() } else { words(interval, 1.0) };
        let gravity = ground_motion::STANDARD_GRAVITY;
        let _ = write!(
            html,
            "<tr><td><i style=\"background:{}\"></i>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
             <td>{}</td><td>{}</td><td>{}</td><td>{again}</td></tr>",
            color(manifest, model),
            escaped(&contents.models[model].name),
            if xi > 0.0 { format!("{:.2}", 100.0 * xi) } else { "–".to_owned() },
            words(&summary.median, gravity),
            words(&summary.theta, gravity),
            match summary.fitted {
                Ok(fit) if summary.contradicted => format!("{:.2} *", fit.dispersion),
                Ok(fit) => format!("{:.2}", fit.dispersion),
                Err(error) => format!("<span title=\"{}\">–</span>", escaped(&error.to_string())),
            },
            ratio(&summary.median_ratio),
            ratio(&summary.theta_ratio),
            summary.censored,
        );
    }
    html.push_str("</tbody></table>");
    html
}

/// An estimate over its interval.
fn words(interval: &Interval, unit: f64) -> String {
    let [estimate, low, high] = interval.texts(unit, Some(3)).map(|text| escaped(&text));
    format!("{estimate}<br><small>{low} … {high}</small>")
}
