//! The page of a study: for each wall its IDA curves and fragilities, damping models side by side.

use std::fmt::Write;

use fragility::{Dispersion, Interval, Lognormal, Summary};
use report::table::{Cell, Column, Digits, Table};
use report::{SCROLLS, counted, escaped, number, template};

use crate::ida::{Collapse, Crossing, Exceedance, Layout, Polarity, SENSITIVE_ABOVE};
use crate::results::WallResults;

use super::contents::{Contents, Manifest};
use super::legend::{key, spelled_out};
use super::plots::{Shown, curves, fragility, top};
use super::tables::{OF_INTENSITY, OF_RATIO, with_ends};

/// Most points of single curves on the page, about 14 bytes each. With more, only every nth record is drawn.
const MOST_POINTS: usize = 100_000;
/// Parameters that tell walls apart.
const SHOWN: [&str; 7] = ["mechanism", "height", "thickness", "hinge_ratio", "overburden", "force_law", "a1"];
/// Most records whose collapse the page lists.
const MOST_LISTED: usize = 200;

/// Makes the page of a study with a number of runs from the sections of its walls, or of all together.
/// `sensitive` counts the collapses with a sensitivity, and those above [`SENSITIVE_ABOVE`].
pub(crate) fn page(manifest: &Manifest, runs: usize, sensitive: [usize; 2], sections: &str) -> String {
    let contents = &manifest.contents;
    let facts = format!(
        "{}, {}, {}: {}. Intensity: {}. {}{}{}.{}",
        counted(contents.walls.len(), "wall"),
        counted(contents.records.len(), "record"),
        counted(contents.models.len(), "damping model"),
        counted(runs, "run"),
        measure_words(manifest),
        match contents.polarity {
            Polarity::AsRecorded => "",
            Polarity::Reversed => "Records are reversed. ",
            Polarity::Both => "Each record is run as it is and reversed, as two records. ",
            Polarity::Worst => "At each level the sign of a record counts that demands more. ",
        },
        if contents.collapse_is == Collapse::Falls {
            "A wall has overturned if it ends beyond u<sub>ins</sub>; one that comes back has not"
        } else {
            "A run stops when the wall overturns, |u| &gt; u<sub>ins</sub>"
        },
        match contents.layout {
            Layout::Curves => "; the lowest level at which it does is the collapse",
            Layout::Cloud | Layout::Stripes => "",
        },
        if sensitive[0] > 0 { format!(" {}.", sensitive_words(sensitive)) } else { String::new() },
    );
    template::page(
        include_str!("page.html"),
        &[
            ("title", &escaped(&manifest.title)),
            ("facts", &facts),
            ("reading", &reading(manifest)),
            ("key", &key(manifest)),
            ("models", &spelled_out(manifest)),
            ("program", &escaped(&contents.program)),
            ("sections", sections),
        ],
    )
}

/// Says how many collapses are sensitive, and what that means.
pub(crate) fn sensitive_words([collapses, above]: [usize; 2]) -> String {
    let count =
        format!("Sensitivity above {SENSITIVE_ABOVE:e}: {above} of {}", counted(collapses, "collapse"));
    if above == 0 {
        return count;
    }
    count
        + "; the level of such a collapse is not a property of the wall and the record, since it depends on \
           digits that no record has"
}

/// The intensity measure in words, with its periods.
fn measure_words(manifest: &Manifest) -> String {
    let contents = &manifest.contents;
    if let Some([periods, _]) = &contents.spectrum {
        let periods: Vec<_> = periods.iter().map(f64::to_string).collect();
        return format!(
            "a<sub>g</sub>, the ground acceleration of the site’s spectrum that a record is worth: the \
             geometric mean of its 5&nbsp;%-damped Sa over that spectrum’s S<sub>e</sub>/a<sub>g</sub>, at \
             {}&nbsp;s",
            periods.join(", ")
        );
    }
    match contents.measure_details.split_once(" over ") {
        Some((measure, periods)) => {
            format!("{}, the geometric mean of 5&nbsp;%-damped Sa at {}", escaped(measure), escaped(periods))
        }
        None => escaped(&contents.measure),
    }
}

/// Explains medians, fits and intervals.
fn reading(manifest: &Manifest) -> String {
    let report = &manifest.report;
    if manifest.contents.layout == Layout::Cloud {
        return format!(
            "Each record is run once, at its own level; points at the right edge are walls that overturned. \
             The lines are the regressions ln(u<sub>max</sub>/u<sub>ins</sub>) = a + b ln IM, by maximum \
             likelihood, with walls that overturned censored at 1 (Tobin 1958). The fragilities follow from \
             them: θ = exp((ln d − a)/b), β = σ/b. Intervals, 95&nbsp;%, are those of {} studentised \
             resamples of the records, drawn with all their results, so that ratios are paired. Ratios are \
             to {}. “censored” counts the walls that overturned.",
            report.resamples,
            escaped(&report.reference)
        );
    }
    let (drawn, observed) = match report.collapse {
        Crossing::Fraction => (
            "marks are the fractions of the records that exceed the limit state at each level",
            "the numbers of exceedances at each level, taken as runs of their own (Baker 2015, Eq. 11)",
        ),
        Crossing::First | Crossing::Last => (
            "steps are the records",
            "the two levels around each record’s exceedance; those that stood at the highest level count as \
             censored (Baker 2015, Eq. 8)",
        ),
    };
    let counted = match report.collapse {
        Crossing::First => "Where a wall stands again above its first exceedance, the first counts.",
        Crossing::Last => "Where a wall stands again above an exceedance, the last counts.",
        Crossing::Fraction => "",
    };
    let stripes = manifest.contents.grid.is_some();
    let runs =
        if stripes { " Each point of a stripe is a run; those at the right edge overturned." } else { "" };
    let dispersions = match report.beta {
        Dispersion::Own => {
            "Each limit state has its own β; † marks curves that cross that of the next limit state by more \
             than 0.01 of P."
        }
        Dispersion::Common => {
            "All limit states of a wall and model share one β, so that their curves do not cross (Shinozuka \
             et al. 2003). * marks a β that the limit states contradict (ratio of likelihoods, 5&nbsp;%)."
        }
        Dispersion::Ordered => {
            "Each limit state has its own β; curves that would cross are the likeliest that do not."
        }
    };
    format!(
        "Fragilities: the {drawn}. The lines are lognormal curves, fitted by maximum likelihood to \
         {observed}. {counted} {dispersions} Misfit is the largest distance of a curve from the fractions of \
         the records. Intervals, 95&nbsp;%, are those of {} resamples of the records, drawn with all their \
         results, so that ratios are paired: of medians by percentiles, of θ and β studentised. \
         Ratios are to {}. “open” marks a number that the levels leave \
         open, with its bound. Fractiles of IDA curves are those of the intensity at which a record first \
         exceeds a demand (Vamvatsikos and Cornell 2004).{runs}",
        report.resamples,
        escaped(&report.reference)
    )
}

/// Makes the section of a wall. If the study has many runs, only every nth record is drawn.
pub(crate) fn section(manifest: &Manifest, wall: usize, results: &WallResults, runs: usize) -> String {
    let shown = Shown { manifest, wall, results };
    let every = runs.div_ceil(MOST_POINTS).max(1);
    let contents = &manifest.contents;
    let note = &contents.walls[wall];
    let top_of_collapses = manifest.report.rising().pop().map_or(1.0, |last| top(shown, last));
    let mut html = format!(
        "<section><h2>Wall {}</h2><p class=\"subtitle\">{}; e = {:.3}</p><div class=\"row pair\">",
        escaped(&note.name),
        escaped(&shape(&note.parameters)),
        note.restitution
    );
    let fractions = &manifest.report.fractions;
    if let Some(collapse) = fractions.iter().position(|fraction| *fraction == 1.0) {
        let _ = write!(
            html,
            "<figure><figcaption>Collapse fragility</figcaption>{}</figure>{SCROLLS}{}{}</div>",
            fragility(shown, collapse, top_of_collapses),
            table(shown, collapse),
            collapses(shown)
        );
    }
    let drawn = match (contents.layout, contents.grid.is_some()) {
        (Layout::Stripes, _) => "Stripes, each of its own records",
        (Layout::Cloud, _) => "Clouds, with their regressions",
        (Layout::Curves, true) => "Stripes, with their 16, 50 and 84 % fractiles",
        (Layout::Curves, false) => "IDA curves, with their 16, 50 and 84 % fractiles",
    };
    let _ = write!(html, "</div><h3>{drawn}</h3><div class=\"row\">");
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
            fragility(shown, place, top(shown, place))
        );
    }
    html.push_str("</div></section>\n");
    html
}

/// Shape, loads and force law of a wall, as a study file states them.
fn shape(parameters: &str) -> String {
    // a sample has all its digits
    let short = |text: &str| {
        text.parse().map_or_else(|_| text.trim_matches('"').replace('_', " "), |x: f64| number(x, 4))
    };
    let lines = parameters.lines().take_while(|line| *line != "[damping]");
    let stated = lines.filter_map(|line| line.split_once(" = ")).filter(|(key, _)| SHOWN.contains(key));
    let texts: Vec<_> = stated.map(|(key, value)| format!("{key} = {}", short(value))).collect();
    texts.join(", ")
}

/// Lists the collapse of each record with each model, unless there are too many records for a page.
fn collapses(shown: Shown<'_>) -> String {
    let Contents { records, models, unit, .. } = &shown.manifest.contents;
    if records.len() > MOST_LISTED || shown.manifest.contents.layout != Layout::Curves {
        return String::new();
    }
    let columns = models.iter().map(|model| Column::number("", model.name.clone(), OF_INTENSITY));
    let mut table = Table::new([Column::text("", "record")].into_iter().chain(columns));
    for (index, record) in records.iter().enumerate() {
        let collapse = |model| match shown.results.curves(model)[index].collapse() {
            Exceedance::Above(top) => Cell::Between([unit.of(top), f64::INFINITY]),
            exceedance => Cell::Number(unit.of(exceedance.bounds()[1])),
        };
        table.row([record.name.clone().into()].into_iter().chain((0..models.len()).map(collapse)));
    }
    format!(
        "<details><summary>Collapse of each record, {}</summary>{}</details>",
        escaped(&shown.manifest.contents.axis()),
        table.html()
    )
}

/// Medians, dispersions and ratios.
fn table(shown: Shown<'_>, collapse: usize) -> String {
    let Shown { manifest, wall, results } = shown;
    let (contents, report) = (&manifest.contents, &manifest.report);
    let (unit, reference) = (contents.unit, &report.reference);
    let ratio = |model: usize, of: &Interval| {
        if contents.models[model].name == *reference { "1".to_owned() } else { with_ends(of, 1.0, OF_RATIO) }
    };
    let sign_of_doubt = |model: usize| {
        let mut summaries = (0..report.fractions.len()).map(|state| results.summary(state, model));
        match report.beta {
            Dispersion::Common if results.is_contradicted(model) => " *",
            Dispersion::Own if summaries.any(|one| one.crossing.is_some_and(|one| one.matters())) => " †",
            _ => "",
        }
    };
    let beta = |model: usize, summary: &Summary| match summary.fitted {
        Ok(_) => with_ends(&summary.beta, 1.0, Digits::Decimals(2)) + sign_of_doubt(model),
        Err(error) => error.to_string(),
    };
    let xi = Column::number("", "ξ\n[%]", Digits::Decimals(2)).shown(100.0);
    let table = Table::over(results.states(collapse).iter().enumerate())
        .text("", "model", |(model, _)| contents.models[*model].name.clone())
        .column(xi, |(model, _)| Some(contents.walls[wall].xi[*model]).filter(|xi| *xi > 0.0))
        .number("", format!("median\n[{}]", unit.name()), OF_INTENSITY, |(_, one)| {
            with_ends(&one.summary.median, unit.size(), OF_INTENSITY)
        })
        .number("", format!("θ\n[{}]", unit.name()), OF_INTENSITY, |(_, one)| {
            with_ends(&one.summary.theta, unit.size(), OF_INTENSITY)
        })
        .number("", "β", OF_RATIO, |(model, one)| beta(*model, &one.summary))
        .number("", format!("median /\n{reference}"), OF_RATIO, |(model, one)| {
            ratio(*model, &one.summary.median_ratio)
        })
        .number("", format!("θ /\n{reference}"), OF_RATIO, |(model, one)| {
            ratio(*model, &one.summary.theta_ratio)
        });
    if contents.layout == Layout::Cloud {
        return table.number("", "overturned", OF_RATIO, |(_, one)| one.summary.censored).done().html();
    }
    let again = |model: usize| results.curves(model).iter().filter(|curve| curve.resurrections() > 0).count();
    table
        .number("", "censored", OF_RATIO, |(_, one)| one.summary.censored)
        .number("", "stands\nagain", OF_RATIO, |(model, _)| again(*model))
        .number("", "misfit", Digits::Decimals(2), |(_, one)| one.summary.misfit)
        .number(
            "",
            format!("θ of the first,\nlast, fraction [{}]", unit.name()),
            OF_INTENSITY,
            |(_, one)| {
                let theta = |curve: &Lognormal| OF_INTENSITY.of(unit.of(curve.median));
                let thetas = one.by_crossing.each_ref().map(|curve| curve.as_ref().map_or("–".into(), theta));
                thetas.join(", ")
            },
        )
        .done()
        .html()
}
