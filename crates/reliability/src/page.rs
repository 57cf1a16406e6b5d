//! The page of a study of reliability.

use std::fmt::Write;

use check::circolare::BAND;
use ground_motion::STANDARD_GRAVITY;
use report::page::Page;
use report::palette::{BLUE, GREY, PALE, RED, SERIES, sign};
use report::plot::{Axis, Look, Plot, Series};
use report::table::{Digits, Table};
use report::{counted, escaped};

use crate::class::{Class, Found, QUANTITIES};
use crate::{Reliability, table};
use study::folder::Manifest;
use study::ida::Misfit;

/// Walls that the page names as the worst.
const WORST: usize = 3;
/// Size of a drawing \[px\].
const SIZE: [f64; 2] = [460.0, 320.0];

/// Makes the page; `shown` holds the tables of single walls.
pub(crate) fn page(manifest: &Manifest, reliability: &Reliability, class: &Class, shown: &[Table]) -> String {
    let contents = &manifest.contents;
    let models: Vec<_> = contents.models.iter().map(|model| model.name.as_str()).collect();
    let target = reliability.target;
    let code = reliability.codes.shared().entry().title;
    let told = table::words(class, &models, target);
    let told: Vec<_> = told.lines().map(|line| format!("<li>{}</li>", escaped(line))).collect();
    let told = told.concat();
    let mut page = Page::new(&format!("{}: how safe is a wall that passes?", reliability.title))
        .text(&format!(
            "<p>{}, {}, {}. A wall just passes {} at the ground acceleration a<sub>g,code</sub> = ζ \
             a<sub>g</sub>. There the probability P of an event is read from its fragility over the \
             a<sub>g</sub> that a record is worth: the geometric mean of its 5&nbsp;% spectrum over \
             S<sub>e</sub>/a<sub>g</sub> of the site. θ/a<sub>g,code</sub> is the margin of the median. \
             Intervals are those of {} resamples of the records, 95&nbsp;%, \
             studentised.</p><ul>{told}</ul>",
            counted(contents.walls.len(), "wall"),
            counted(contents.records.len(), "record"),
            counted(contents.models.len(), "damping model"),
            escaped(code),
            manifest.report.resamples,
        ))
        .section("All walls", &table::summary(class, &models, target).html())
        .section("The fall, where the check that governs has ζ = 1", &drawings(manifest, class, target));
    if class.members.len() > WORST {
        page = page.section("The worst walls", &worst(class, &models).html());
    }
    page = page.section(
        "Numbers of the code that would give the target",
        &format!(
            "<p>One number is changed at a time, so far that the wall just passes where P(fall) is {target}. \
             “walls” counts those for which such a number exists.</p>{}",
            table::rule_summary(class, &models, target).html()
        ),
    );
    if let Some(records) = records(manifest) {
        page = page.section("Records beside the spectrum of the site", &records);
    }
    if !shown.is_empty() {
        let all: String = shown.iter().map(Table::html).collect();
        page = page.section("Walls", &all);
    }
    if !class.refused.is_empty() {
        let table = Table::over(&class.refused)
            .text("", "wall", |(name, _)| name.clone())
            .text("", "not checked", |(_, reason)| reason.clone())
            .done();
        page = page.section("Walls without a check", &table.html());
    }
    page.html()
}

/// What is drawn of a fall: its name, its value, and a limit.
type Drawn = (&'static str, fn(&Found) -> f64, f64);

/// The probability of the fall and the margin of each wall over what varies among them.
fn drawings(manifest: &Manifest, class: &Class, target: f64) -> String {
    let models = manifest.contents.models.iter().enumerate();
    let mut html = String::from("<p>");
    for (index, model) in models {
        let (color, mark) = SERIES[index % SERIES.len()];
        // writing to a String cannot fail
        let _ = write!(html, "{} {} ", sign(color, mark), escaped(&model.name));
    }
    html.push_str("</p><div class=\"figures\">");
    for (place, name) in QUANTITIES.into_iter().enumerate() {
        let values = class.members.iter().map(|member| member.quantities[place]);
        let first = class.members.first().map(|member| member.quantities[place]);
        if values.clone().all(|value| Some(value) == first || value.is_nan()) {
            continue;
        }
        let drawn: [Drawn; 2] = [
            ("P(fall)", |found| found.probability, target),
            ("θ/a_g,code of the fall", |found| found.margin, 1.0),
        ];
        for (label, of, limit) in drawn {
            let series = (0..manifest.contents.models.len()).map(|model| {
                let falls = class.falls(model);
                let points = falls.map(|(member, found)| (member.quantities[place], of(found))).collect();
                Series::marks(&manifest.contents.models[model].name, model, points)
            });
            let series: Vec<Series> = series.collect();
            let all = series.iter().flat_map(|series| &series.points).map(|point| point.1);
            let top = 1.06 * all.fold(limit, f64::max);
            let mut plot = Plot::new(SIZE, [Axis::new(name), Axis::over(label, [0.0, top])], series);
            plot.limits.push((limit, GREY));
            let _ = write!(
                html,
                "<figure>{}<figcaption>{} over {name}; dashed: {limit}</figcaption></figure>",
                plot.svg(),
                escaped(label)
            );
        }
    }
    html + "</div>"
}

/// The walls that fall most likely, with each model.
fn worst(class: &Class, models: &[&str]) -> Table {
    let rows = (0..models.len()).flat_map(|model| {
        let mut falls: Vec<_> = class.falls(model).collect();
        falls.sort_by(|a, b| b.1.probability.total_cmp(&a.1.probability));
        falls.truncate(WORST);
        falls.into_iter().map(move |(member, found)| (model, member, found))
    });
    let (three, least) = (Digits::Significant(3), class.least);
    let mut table = Table::over(rows)
        .text("", "model", |(model, ..)| models[*model].to_owned())
        .text("", "wall", |(_, member, _)| member.name.clone())
        .text("", "check", |(.., found)| found.check)
        .number("", "P(fall)", three, |(.., found)| table::probability(found.probability, least))
        .number("", "θ/a_g,code", three, |(.., found)| found.margin);
    for (place, name) in QUANTITIES.into_iter().enumerate() {
        table = table.number("", name, Digits::AtMost(3), move |(_, member, _)| member.quantities[place]);
    }
    table.done()
}

/// The records with their misfit to the spectrum, and their spectra over it.
fn records(manifest: &Manifest) -> Option<String> {
    let contents = &manifest.contents;
    let [periods, shape] = contents.spectrum.as_ref()?;
    let three = Digits::Significant(3);
    let misfit = |ratios: &[f64]| Misfit::of(ratios);
    let table = Table::over(&contents.records)
        .text("", "record", |record| record.name.clone())
        .number("", "worth a_g\n[g]", three, |record| record.intensity / STANDARD_GRAVITY)
        .number("", "rms of ln ratio", three, |record| misfit(&record.ratios).rms)
        .number("", "least ratio", three, |record| misfit(&record.ratios).least)
        .number("", "largest ratio", three, |record| misfit(&record.ratios).largest)
        .done();
    let count = contents.records.len() as f64;
    let mean = |place: usize| contents.records.iter().map(|record| record.ratios[place]).sum::<f64>() / count;
    let means: Vec<f64> = (0..periods.len()).map(mean).collect();
    let over = |ratio: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..periods.len()).map(|place| (periods[place], ratio(place) * shape[place])).collect()
    };
    let mut series: Vec<Series> = contents
        .records
        .iter()
        .map(|record| Series::stroke(PALE, 1.0, over(&|place| record.ratios[place])))
        .collect();
    series.extend(
        BAND.map(|bound| Series { look: Look::Dashed, ..Series::stroke(GREY, 1.0, over(&|_| bound)) }),
    );
    series.push(Series::stroke(BLUE, 2.0, over(&|place| means[place])));
    series.push(Series::stroke(RED, 2.0, over(&|_| 1.0)));
    let plot = Plot::new(SIZE, [Axis::new("T (s)"), Axis::new("S_a/a_g")], series);
    let Misfit { least, largest, .. } = misfit(&means);
    let within = if least >= BAND[0] && largest <= BAND[1] { "within" } else { "not within" };
    Some(format!(
        "<p>Each record is scaled to a<sub>g</sub> of the site’s spectrum. Their mean is {least:.2} to \
         {largest:.2} of it, {within} the {} to {} of NTC 3.2.3.6.</p><div class=\"figures\"><figure>{}\
         <figcaption>Records (grey), their mean (blue), S<sub>e</sub>/a<sub>g</sub> (red), and {} and {} of \
         it (dashed)</figcaption></figure></div>{}",
        BAND[0],
        BAND[1],
        plot.svg(),
        BAND[0],
        BAND[1],
        table.html()
    ))
}
