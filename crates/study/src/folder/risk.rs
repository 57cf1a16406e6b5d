//! Fragilities for risk engines: `fragilities.xml`, and `fragility_curves.csv` with one curve in a row, of
//! every wall and of every class of walls; and what follows from them.

use std::collections::BTreeMap;
use std::path::Path;

use fragility::{CONFIDENCE, ClassResamples, FragilityFunction, Lognormal};

use crate::document::WallClass;
use crate::ida::Layout;
use crate::results::WallResults;

use super::contents::Manifest;
use super::error::FolderError;
use super::finished::Finished;
use super::losses::Losses;
use super::nrml::{self, Nrml, state_name};
use super::pelicun::{self, Pelicun};
use super::plots::POINTS;
use super::rates::Rates;
use super::rows::Rows;
use super::shown::Shown;
use super::subject::{Fragilities, State, Subject};
use super::tables::OF_INTENSITY;
use report::table::{Cell, Digits, Table};
use report::{counted, escaped};

/// Name of the file for `OpenQuake`.
const NRML: &str = "fragilities.xml";

/// The files under construction.
pub(crate) struct Risk<'a> {
    manifest: &'a Manifest,
    table: Rows,
    /// Keys of the geometry of walls, each a column.
    geometry: Vec<&'a str>,
    xml: Option<Nrml>,
    pelicun: Option<Pelicun<'a>>,
    /// Classes with the numbers of their walls.
    classes: Vec<(&'a WallClass, Vec<usize>)>,
    /// The classes of each wall, with its share of them.
    shares: Vec<Vec<(usize, f64)>>,
    /// Functions of walls in classes, one for each model where it has all curves.
    members: BTreeMap<usize, Vec<Option<FragilityFunction>>>,
    /// Resamples of each class, of each model and limit state, studentised and as fitted.
    resamples: Vec<Vec<Vec<[ClassResamples; 2]>>>,
    /// Classes, and the curves of their last limit state.
    shown: Shown<'a>,
    rates: Option<Rates<'a>>,
    losses: Option<Losses<'a>>,
    /// Number of functions without all curves, or with numbers that NRML cannot hold.
    left_out: usize,
}

impl<'a> Risk<'a> {
    /// Begins the files in a folder.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest) -> Result<Self, FolderError> {
        let (report, walls) = (&manifest.report, &manifest.contents.walls);
        let more = "a limit state is named by its fraction of the static instability displacement";
        let mut xml = Nrml::new(&folder.join(NRML), manifest, "fragilityModel", more)?;
        let names: Vec<_> =
            report.rising().iter().map(|&place| state_name(report.fractions[place])).collect();
        if let Some(xml) = &mut xml {
            xml.write(&format!("    <limitStates>{}</limitStates>\n", names.join(" ")))?;
        }
        let numbers: BTreeMap<_, _> = walls.iter().enumerate().map(|(k, wall)| (&wall.name, k)).collect();
        let classes = report.classes.iter().map(|class| {
            let named: Vec<_> = class.walls.iter().filter_map(|name| numbers.get(name).copied()).collect();
            (class, if class.walls.is_empty() { (0..walls.len()).collect() } else { named })
        });
        let classes: Vec<_> = classes.collect();
        let mut shares = vec![Vec::new(); walls.len()];
        for (number, (class, members)) in classes.iter().enumerate() {
            for (&wall, share) in members.iter().zip(class.shares(members.len())) {
                shares[wall].push((number, share));
            }
        }
        let mut geometry: Vec<&str> = Vec::new();
        for (key, _) in walls.iter().flat_map(|wall| self::geometry(&wall.parameters)) {
            if !geometry.contains(&key) {
                geometry.push(key);
            }
        }
        let of_class = vec![vec![Default::default(); names.len()]; manifest.contents.models.len()];
        let rates = report.hazard.as_ref().map(|hazard| Rates::new(folder, manifest, hazard));
        let losses = report.loss_ratios.as_ref().map(|ratios| Losses::new(folder, manifest, ratios));
        Ok(Self {
            manifest,
            table: Rows::new(&folder.join("fragility_curves.csv"))?,
            geometry,
            xml,
            pelicun: Pelicun::new(folder, manifest)?,
            members: classes.iter().flat_map(|(_, walls)| walls).map(|&wall| (wall, Vec::new())).collect(),
            resamples: vec![of_class; classes.len()],
            classes,
            shares,
            shown: Shown::new(manifest, "probability"),
            rates: rates.transpose()?,
            losses: losses.transpose()?,
            left_out: 0,
        })
    }

    /// Adds a wall.
    pub(crate) fn add(&mut self, wall: usize, results: &WallResults) -> Result<(), FolderError> {
        let subject = Subject::of_wall(self.manifest, wall, results);
        self.write(&subject)?;
        for &(class, share) in &self.shares[wall] {
            for (model, resamples) in self.resamples[class].iter_mut().enumerate() {
                for (resamples, place) in resamples.iter_mut().zip(self.manifest.report.rising()) {
                    let summary = results.summary(place, model);
                    for (own, of) in resamples.iter_mut().zip([&summary.resamples, &summary.drawn]) {
                        own.add(share, summary.theta.estimate, of);
                    }
                }
            }
        }
        if let Some(functions) = self.members.get_mut(&wall) {
            *functions = subject.models.into_iter().map(|model| model.function).collect();
        }
        Ok(())
    }

    /// Adds the classes, and completes the files.
    pub(crate) fn finish(mut self) -> Result<Finished, FolderError> {
        let mut words = String::new();
        let all = std::mem::take(&mut self.classes).into_iter().zip(std::mem::take(&mut self.resamples));
        for ((class, walls), resamples) in all {
            let mut models = Vec::new();
            for (model, resamples) in resamples.iter().enumerate() {
                let is_without = |wall: &&usize| self.members[*wall][model].is_none();
                let without: Vec<usize> = walls.iter().filter(is_without).copied().collect();
                if !without.is_empty() {
                    words.push_str(&self.without_curve(class, model, &without));
                }
                let members = walls.iter().map(|wall| self.members[wall][model].clone());
                let members: Option<Vec<_>> = members.collect();
                models.push(Fragilities::of_class(
                    self.manifest,
                    class.shares(walls.len()),
                    members,
                    resamples,
                ));
            }
            let (name, parameters) = (&*class.name, "");
            self.write(&Subject { name, class: Some(walls.len()), parameters, models })?;
        }
        let table = self.shown.table();
        let mut html = self.section(&table);
        if !table.rows.is_empty() {
            words =
                format!("{words}curves of classes of walls, and the parts of their beta\n{}", table.text());
        }
        words.push_str(&self.words());
        let mut files = vec![self.table.commit()?];
        files.extend(self.xml.map(Nrml::finish).transpose()?);
        files.extend(self.pelicun.map(Pelicun::finish).transpose()?.into_iter().flatten());
        let rates = self.rates.map(Rates::finish).transpose()?;
        let losses = self.losses.map(Losses::finish).transpose()?;
        for part in rates.into_iter().chain(losses) {
            files.extend(part.files);
            words.push_str(&part.words);
            html.push_str(&part.html);
        }
        Ok(Finished { files, words, html })
    }

    /// Says what the annual rates leave out.
    pub(crate) fn warnings(&self) -> Vec<String> {
        self.rates.as_ref().map(Rates::warnings).unwrap_or_default()
    }

    /// Writes a wall or a class, and what follows from its curves where the study asks for it.
    fn write(&mut self, subject: &Subject<'_>) -> Result<(), FolderError> {
        let Manifest { contents, report, .. } = self.manifest;
        let table = self.curves(subject);
        self.table.add(&table)?;
        for (of_model, model) in subject.models.iter().zip(&contents.models) {
            let names = [subject.name, &model.name];
            if let Some((pelicun, function)) = self.pelicun.as_mut().zip(of_model.function.as_ref()) {
                pelicun.add(names, function)?;
            }
            let Some(xml) = &mut self.xml else { continue };
            let states = report.rising().into_iter().map(|place| report.fractions[place]);
            let function = of_model.function.as_ref();
            let text =
                function.and_then(|function| nrml::fragility(function, states, &xml.measure, contents.unit));
            self.left_out += usize::from(text.is_none());
            if let Some(text) = text {
                let id = escaped(&xml.id(subject.name, &model.name));
                xml.write(&format!(
                    "    <fragilityFunction id=\"{id}\" format=\"continuous\" shape=\"logncdf\">\n{text}    \
                     </fragilityFunction>\n"
                ))?;
            } else if function.is_none() {
                xml.write(&no_function(self.manifest, names, &of_model.states))?;
            }
        }
        if subject.class.is_some() {
            let last = |of_model: &Fragilities| {
                let [median, dispersion] = of_model.function.as_ref().and(of_model.states.last()?.curve)?;
                Some(Lognormal { median: contents.unit.of(median), dispersion })
            };
            let curves: Vec<_> = subject.models.iter().map(last).collect();
            let ends = curves.iter().flatten().map(|curve| curve.median * libm::exp(2.5 * curve.dispersion));
            let end = ends.fold(0.0, f64::max);
            let at = |k: u32| end * f64::from(k) / f64::from(POINTS);
            let line = |curve: &Option<Lognormal>| {
                let point =
                    |curve: &Lognormal| (1..=POINTS).map(|k| (at(k), curve.probability(at(k)))).collect();
                curve.as_ref().map_or_else(Vec::new, point)
            };
            self.shown.add(subject, table, [0.0, end], curves.iter().map(line).collect());
        }
        if let Some(rates) = &mut self.rates {
            rates.add(subject)?;
        }
        if let Some(losses) = &mut self.losses {
            losses.add(subject)?;
        }
        Ok(())
    }

    /// The curves of a wall or a class, for files in every digit.
    fn curves(&self, subject: &Subject<'_>) -> Table {
        let contents = &self.manifest.contents;
        let unit = contents.unit;
        let rows = subject.models.iter().zip(&contents.models).flat_map(|(of_model, model)| {
            let function = of_model.function.as_ref();
            of_model.states.iter().enumerate().map(move |(k, state)| {
                let curve = function.map(|function| (function.states[k], function.dispersion(k)));
                (&model.name, state, curve)
            })
        });
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let theta = |state: &State, part: usize| Cell::Between(state.theta.bounds(unit.size())[part]);
        let moment = |state: &State, part: usize| state.covariance.map(|moments| moments[part]);
        let interval = |[_, low, high]: [String; 3]| format!("{low} … {high}");
        let modelling = self.manifest.report.modelling_uncertainty;
        let mut table = Table::over(rows)
            .text("wall", "class", |_| subject.name.to_owned())
            .value("walls", |_| subject.class.unwrap_or(1))
            .text("model", "model", |(model, ..)| (*model).clone())
            .text("measure", "", |_| contents.measure.clone())
            .text("unit", "", |_| unit.name())
            .text("limit_state", "", |(_, state, _)| state_name(state.fraction))
            .number("u_max_over_u_ins", "u_max/u_ins", Digits::AtMost(6), |(_, state, _)| state.fraction)
            .number("theta", format!("θ\n[{}]", unit.name()), OF_INTENSITY, |(_, state, curve)| match curve {
                Some((curve, _)) => Cell::Number(unit.of(curve.median)),
                None => theta(state, 0),
            })
            .value("theta_low", |(_, state, _)| theta(state, 1))
            .value("theta_high", |(_, state, _)| theta(state, 2))
            .number("", "interval", OF_INTENSITY, |(_, state, _)| {
                interval(state.theta.texts(unit.size(), OF_INTENSITY))
            })
            // the square root of the sum of the squares of those after it
            .number("beta", "β", OF_INTENSITY, |(.., curve)| curve.map(|(_, beta)| beta))
            .number("", "interval", OF_INTENSITY, |(_, state, _)| {
                interval(state.beta.texts(1.0, OF_INTENSITY))
            })
            .number("beta_records", "β of\nrecords", OF_INTENSITY, |(.., curve)| {
                curve.map(|(curve, _)| curve.beta_records)
            })
            .number("beta_walls", "β of\nwalls", OF_INTENSITY, |(.., curve)| {
                curve.map(|(curve, _)| curve.beta_walls)
            })
            .number("beta_modelling", "β of\nmodelling", OF_INTENSITY, |(.., curve)| {
                curve.map(|_| modelling)
            })
            .value("beta_low", |(_, state, _)| finite(state.beta.range[0]))
            .value("beta_high", |(_, state, _)| finite(state.beta.range[1]))
            .value("var_ln_theta", |(_, state, _)| moment(state, 0))
            .value("cov_ln_theta_beta", |(_, state, _)| moment(state, 1))
            .value("var_beta", |(_, state, _)| moment(state, 2))
            .value("misfit", |(_, state, _)| state.misfit);
        for key in &self.geometry {
            let value = geometry(subject.parameters).find(|(own, _)| own == key).map(|(_, value)| value);
            let cell = value.map_or(Cell::Empty, |value| match value.parse() {
                Ok(number) => Cell::Number(number),
                Err(_) => value.trim_matches('"').to_owned().into(),
            });
            table = table.value((*key).to_owned(), move |_| cell.clone());
        }
        table.done()
    }

    /// Returns the section of a page about the classes; empty without classes.
    fn section(&self, table: &Table) -> String {
        let report = &self.manifest.report;
        if table.rows.is_empty() {
            return String::new();
        }
        let highest = report.rising().last().map_or(1.0, |place| report.fractions[*place]);
        format!(
            "<section><h2>Classes of walls</h2><p class=\"subtitle\">β² is the sum of the squares of its \
             parts; intervals are those of the records, {:.0} %, studentised.</p>{}\
             <h3>P(u<sub>max</sub>/u<sub>ins</sub> &gt; {highest})</h3>{}</section>\n",
            100.0 * CONFIDENCE,
            table.html(),
            self.shown.plots()
        )
    }

    /// Describes what the files for risk engines lack, and the remedy.
    fn words(&self) -> String {
        let file = NRML;
        let measure = &self.manifest.contents.measure;
        let pelicun = if self.pelicun.is_some() { String::new() } else { pelicun::refusal(measure) };
        if self.xml.is_none() {
            return format!(
                "no {file}: OpenQuake knows PGA, PGV, PGD, Sa(T), AvgSA, IA and CAV, and not {measure}; \
                 for it run the study with intensity = {{ measure = \"AvgSA\" }}\n{pelicun}"
            );
        }
        if self.left_out == 0 {
            return pelicun;
        }
        let remedy = if self.manifest.contents.layout == Layout::Cloud {
            "change the scale, or add records"
        } else {
            "add levels below or above, or records, or drop its fraction"
        };
        format!(
            "{file} lacks {}, of walls and classes with a limit state that has no curve, or one so flat that \
             a number of NRML would be 0 or infinite; {remedy}\n{pelicun}",
            counted(self.left_out, "function")
        )
    }

    /// Says that a class has no curve, as some of its walls have none.
    fn without_curve(&self, class: &WallClass, model: usize, without: &[usize]) -> String {
        let contents = &self.manifest.contents;
        let first = &contents.walls[without[0]].name;
        format!(
            "class {:?} with {}: no curve, as {} of it, such as {first:?}, {} no curve\n",
            class.name,
            contents.models[model].name,
            counted(without.len(), "wall"),
            if without.len() == 1 { "has" } else { "have" },
        )
    }
}

/// Says in a comment of NRML what is known of a function that is not written.
fn no_function(manifest: &Manifest, [name, model]: [&str; 2], states: &[State]) -> String {
    let unit = manifest.contents.unit;
    let id = if manifest.contents.models.len() == 1 { name.to_owned() } else { format!("{name} ({model})") };
    let theta = |state: &State| {
        let [theta, ..] = state.theta.texts(unit.size(), OF_INTENSITY);
        format!("{} {theta}", state_name(state.fraction))
    };
    let thetas: Vec<_> = states.iter().map(theta).collect();
    // a comment must not have two dashes
    let text = format!("{id}: theta in {} of {}", unit.name(), thetas.join(", "));
    let text = text.replace("--", "- -").replace("--", "- -");
    format!("    <!-- no function of {} -->\n", escaped(&text))
}

/// Lists the geometry among the parameters of a wall: keys and values.
fn geometry(parameters: &str) -> impl Iterator<Item = (&str, &str)> {
    let lines = parameters.lines().skip_while(|line| *line != "[geometry]").skip(1);
    lines.take_while(|line| !line.starts_with('[')).filter_map(|line| line.split_once(" = "))
}
