//! Fragilities for risk engines: `fragilities.xml`, and `fragility_curves.csv` with one curve in a row, of
//! every wall and of every class of walls.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::document::{ReportOptions, WallClass};
use crate::fragility::{CONFIDENCE, ClassResamples, FragilityFunction, Interval, Summary, covariance};
use crate::results::WallResults;
use crate::tables::OF_INTENSITY;

use run::file::{self, Draft};

use super::classes::Classes;
use super::contents::Manifest;
use super::error::FolderError;
use super::losses::Losses;
use super::nrml;
use super::pelicun::{self, Pelicun};
use super::rates::{Fitted, Rates};
use super::rows::Rows;
use report::counted;
use report::table::{Cell, Table};

/// Names of the files.
const FILES: [&str; 2] = ["fragility_curves.csv", "fragilities.xml"];

/// The files under construction.
pub(crate) struct Risk<'a> {
    manifest: &'a Manifest,
    states: Vec<(usize, String)>,
    table: Rows,
    /// Keys of the geometry of walls, each a column.
    geometry: Vec<String>,
    xml: Option<(Draft, nrml::Writer)>,
    pelicun: Option<Pelicun<'a>>,
    /// Numbers of the walls of each class.
    classes: Vec<(&'a WallClass, Vec<usize>)>,
    /// The classes of each wall, with its share of them.
    shares: Vec<Vec<(usize, f64)>>,
    /// Functions of walls in classes, one for each model where it has all curves.
    members: BTreeMap<usize, Vec<Option<FragilityFunction>>>,
    /// Resamples of each class, of each model and limit state.
    resamples: Vec<Vec<Vec<ClassResamples>>>,
    rates: Option<Rates<'a>>,
    losses: Option<Losses<'a>>,
    /// Number of functions without a curve, and of those that NRML cannot hold.
    left_out: [usize; 2],
}

impl<'a> Risk<'a> {
    /// Begins the files in a folder.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest) -> Result<Self, FolderError> {
        let [table, xml] = FILES.map(|name| folder.join(name));
        let xml = if let Some((writer, text)) = nrml::Writer::new(manifest) {
            Some((Draft::new(&xml, text.as_bytes())?, writer))
        } else {
            // one that an earlier study has left
            file::remove(&xml)?;
            None
        };
        let walls = &manifest.contents.walls;
        let numbers: BTreeMap<_, _> = walls.iter().enumerate().map(|(k, wall)| (&wall.name, k)).collect();
        let classes = manifest.report.classes.iter().map(|class| {
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
        let states = nrml::limit_states(&manifest.report);
        let mut geometry: Vec<String> = Vec::new();
        for (key, _) in walls.iter().flat_map(|wall| self::geometry(&wall.parameters)) {
            if !geometry.iter().any(|own| own == key) {
                geometry.push(key.to_owned());
            }
        }
        let of_class = vec![vec![ClassResamples::default(); states.len()]; manifest.contents.models.len()];
        Ok(Self {
            manifest,
            rates: Rates::new(folder, manifest)?,
            losses: Losses::new(folder, manifest)?,
            resamples: vec![of_class; classes.len()],
            states,
            table: Rows::new(&table)?,
            geometry,
            xml,
            pelicun: Pelicun::new(folder, manifest)?,
            members: classes.iter().flat_map(|(_, walls)| walls).map(|&wall| (wall, Vec::new())).collect(),
            classes,
            shares,
            left_out: [0; 2],
        })
    }

    /// Adds a wall.
    pub(crate) fn add(&mut self, wall: usize, results: &WallResults) -> Result<(), FolderError> {
        let Manifest { contents, report, .. } = self.manifest;
        let note = &contents.walls[wall];
        for model in 0..contents.models.len() {
            let summaries = self.states.iter().map(|(place, _)| results.summary(*place, model));
            let summaries: Vec<&Summary> = summaries.collect();
            let curves: Option<Vec<_>> = summaries.iter().map(|summary| summary.fitted.ok()).collect();
            let function =
                curves.map(|curves| FragilityFunction::new(curves.as_slice(), report.modelling_uncertainty));
            let known: Vec<_> = summaries.iter().map(|summary| Known::of_wall(summary, report)).collect();
            self.write((&note.name, 1, &note.parameters), model, function.as_ref(), &known)?;
            let states = || summaries.iter().map(|summary| of_summary(summary, report)).collect();
            self.follow(&note.name, false, model, states)?;
            for &(class, share) in &self.shares[wall] {
                for (resamples, summary) in self.resamples[class][model].iter_mut().zip(&summaries) {
                    resamples.add(share, summary.theta.estimate, &summary.resamples);
                }
            }
            if let Some(functions) = self.members.get_mut(&wall) {
                functions.push(function);
            }
        }
        Ok(())
    }

    /// Adds the classes, and completes the files; returns their paths, what is to be said of them, and a
    /// section of the page.
    pub(crate) fn finish(mut self) -> Result<(Vec<PathBuf>, String, String), FolderError> {
        let contents = &self.manifest.contents;
        let mut told = String::new();
        let states = self.states.clone();
        let mut classes = Classes::new(self.manifest, &states);
        for (number, (class, walls)) in std::mem::take(&mut self.classes).into_iter().enumerate() {
            let shares = class.shares(walls.len());
            for model in 0..contents.models.len() {
                let of_wall = |wall: &usize| self.members[wall][model].clone();
                let members: Option<Vec<_>> = walls.iter().map(of_wall).collect();
                if members.is_none() {
                    let without = walls.iter().filter(|wall| self.members[wall][model].is_none());
                    told.push_str(&self.without_curve(class, model, &without.copied().collect::<Vec<_>>()));
                }
                let function = members.map(|members| FragilityFunction::of_class(&shares, &members));
                let known = |(k, resamples): (usize, &ClassResamples)| {
                    let beta_modelling = self.manifest.report.modelling_uncertainty;
                    Known::of_class(function.as_ref(), k, &resamples.curves(beta_modelling))
                };
                let known: Vec<_> = self.resamples[number][model].iter().enumerate().map(known).collect();
                self.write((&class.name, walls.len(), ""), model, function.as_ref(), &known)?;
                classes.add((&class.name, walls.len()), model, function.as_ref(), &known);
                let beta_modelling = self.manifest.report.modelling_uncertainty;
                let resamples = std::mem::take(&mut self.resamples[number][model]);
                let state = |(k, resamples): (usize, &ClassResamples)| {
                    let curve = function.as_ref().map(|f| [f.states[k].median, f.dispersion(k)]);
                    Fitted { curve, resamples: resamples.curves(beta_modelling) }
                };
                let states = || resamples.iter().enumerate().map(state).collect();
                self.follow(&class.name, true, model, states)?;
                told.extend(function.map(|function| self.line(class, model, &function)));
            }
        }
        told.push_str(&self.words());
        let mut paths = vec![self.table.commit()?];
        if let Some((mut draft, _)) = self.xml {
            draft.write(|file| nrml::Writer::finish(file))?;
            paths.push(draft.commit(true)?);
        }
        if let Some(pelicun) = self.pelicun {
            paths.extend(pelicun.finish()?);
        }
        let mut section = classes.section();
        let rates = self.rates.map(Rates::finish).transpose()?;
        let losses = self.losses.map(Losses::finish).transpose()?;
        for (files, words, html) in rates.into_iter().chain(losses) {
            paths.extend(files);
            told.push_str(&words);
            section.push_str(&html);
        }
        Ok((paths, told, section))
    }

    /// Says what the annual rates leave out.
    pub(crate) fn warning(&self) -> Option<String> {
        self.rates.as_ref()?.warning()
    }

    /// Adds what follows from the curves of a wall or a class with one model, where the study asks for it.
    fn follow(
        &mut self,
        name: &str,
        is_class: bool,
        model: usize,
        states: impl Fn() -> Vec<Fitted>,
    ) -> Result<(), FolderError> {
        if let Some(rates) = &mut self.rates {
            rates.add(name, is_class, model, &states())?;
        }
        if let Some(losses) = &mut self.losses {
            losses.add(name, is_class, model, &states())?;
        }
        Ok(())
    }

    /// Writes the function of a wall or a class, by its name, number of walls and parameters, with one model.
    /// `known` is what is known of each limit state beside its curve.
    fn write(
        &mut self,
        (name, walls, parameters): (&str, usize, &str),
        model: usize,
        function: Option<&FragilityFunction>,
        known: &[Known],
    ) -> Result<(), FolderError> {
        let Manifest { contents, report, .. } = self.manifest;
        let model = &contents.models[model].name;
        let unit = contents.unit;
        let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
        let bounds = |k: usize, part: usize| Cell::Between(known[k].theta.bounds(unit.size())[part]);
        let covariance = |k: usize, part: usize| known[k].covariance.map(|moments| moments[part]);
        let mut table = Table::over(self.states.iter().enumerate())
            .text("wall", "", |_| name.to_owned())
            .value("walls", |_| walls)
            .text("model", "", |_| model.clone())
            .text("measure", "", |_| contents.measure.clone())
            .text("unit", "", |_| unit.name())
            .text("limit_state", "", |(_, (_, state))| state.clone())
            .value("u_max_over_u_ins", |(_, (place, _))| report.fractions[*place])
            .value("theta", |(k, _)| match function {
                Some(function) => Cell::Number(unit.of(function.states[*k].median)),
                None => bounds(*k, 0),
            })
            .value("theta_low", |(k, _)| bounds(*k, 1))
            .value("theta_high", |(k, _)| bounds(*k, 2))
            // the square root of the sum of the squares of those after it
            .value("beta", |(k, _)| function.map(|function| function.dispersion(*k)))
            .value("beta_records", |(k, _)| function.map(|function| function.states[*k].beta_records))
            .value("beta_walls", |(k, _)| function.map(|function| function.states[*k].beta_walls))
            .value("beta_modelling", |_| function.map(|function| function.beta_modelling))
            .value("beta_low", |(k, _)| finite(Some(known[*k].beta.range[0])))
            .value("beta_high", |(k, _)| finite(Some(known[*k].beta.range[1])))
            .value("var_ln_theta", |(k, _)| covariance(*k, 0))
            .value("cov_ln_theta_beta", |(k, _)| covariance(*k, 1))
            .value("var_beta", |(k, _)| covariance(*k, 2))
            .value("misfit", |(k, _)| known[*k].misfit);
        for key in &self.geometry {
            let value = geometry(parameters).find(|(own, _)| own == key).map(|(_, value)| value);
            let cell = value.map_or(Cell::Empty, |value| match value.parse() {
                Ok(number) => Cell::Number(number),
                Err(_) => value.trim_matches('"').to_owned().into(),
            });
            table = table.value(key.clone(), move |_| cell.clone());
        }
        self.table.add(&table.done())?;
        self.left_out[0] += usize::from(function.is_none());
        if let Some((pelicun, function)) = self.pelicun.as_mut().zip(function) {
            pelicun.add([name, model], function)?;
        }
        let Some((draft, writer)) = &mut self.xml else { return Ok(()) };
        let Some(function) = function else {
            let id = if contents.models.len() == 1 { name.to_owned() } else { format!("{name} ({model})") };
            let theta = |((_, state), known): (&(usize, String), &Known)| {
                (state.clone(), known.theta.texts(unit.size(), OF_INTENSITY)[0].clone())
            };
            let thetas: Vec<_> = self.states.iter().zip(known).map(theta).collect();
            return Ok(draft.write(|file| writer.note(file, &id, &thetas))?);
        };
        let is_written = draft.write(|file| writer.function(file, [name, model], function))?;
        self.left_out[1] += usize::from(!is_written);
        Ok(())
    }

    /// Describes what the files for risk engines lack, and the remedy.
    fn words(&self) -> String {
        let [_, file] = FILES;
        let measure = &self.manifest.contents.measure;
        let pelicun = if self.pelicun.is_some() { String::new() } else { pelicun::refusal(measure) };
        if self.xml.is_none() {
            return format!(
                "no {file}: OpenQuake knows PGA, PGV, PGD, Sa(T), AvgSA, IA and CAV, and not {measure}; \
                 for it run the study with intensity = {{ measure = \"AvgSA\" }}\n{pelicun}"
            );
        }
        let lack = |(count, reason): (usize, &str)| match count {
            0 => String::new(),
            1 => format!("{file} lacks 1 function, of a wall or class {reason}\n"),
            _ => format!("{file} lacks {count} functions, of walls or classes {reason}\n"),
        };
        let without_curve = if self.manifest.contents.is_cloud {
            "without a regression; change the scale, or add records"
        } else {
            "with a limit state that has no curve: it is exceeded by no run or by all, or its records do not \
             scatter; add levels below or above, or drop its fraction"
        };
        let without_numbers =
            "with a beta so large that a number of NRML would be 0 or infinite; add records or levels";
        [(self.left_out[0], without_curve), (self.left_out[1], without_numbers)].map(lack).concat() + &pelicun
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

    /// Describes the result of a class.
    fn line(&self, class: &WallClass, model: usize, function: &FragilityFunction) -> String {
        let Manifest { contents, report, .. } = self.manifest;
        let unit = contents.unit;
        let state = |(k, (place, _)): (usize, &(usize, String))| {
            let curve = function.states[k];
            format!(
                "{} {} to exceed {} u_ins, beta {:.3} (records {:.3}, walls {:.3}, modelling {})",
                OF_INTENSITY.of(unit.of(curve.median)),
                unit.name(),
                report.fractions[*place],
                function.dispersion(k),
                curve.beta_records,
                curve.beta_walls,
                function.beta_modelling
            )
        };
        let states: Vec<_> = self.states.iter().enumerate().map(state).collect();
        let model = &contents.models[model].name;
        format!("class {:?} with {model}: theta {}\n", class.name, states.join("; "))
    }
}

/// What is known of a limit state of a wall or a class beside its curve.
pub(crate) struct Known {
    pub(crate) theta: Interval,
    /// With the β of the model.
    pub(crate) beta: Interval,
    /// Variance of ln θ, covariance of ln θ and β, variance of β.
    covariance: Option<[f64; 3]>,
    misfit: Option<f64>,
}

impl Known {
    fn of_wall(summary: &Summary, report: &ReportOptions) -> Self {
        let total = |beta: f64| beta.hypot(report.modelling_uncertainty);
        let Interval { estimate, range, least } = summary.beta;
        let beta = Interval { estimate: total(estimate), range: range.map(total), least: least.map(total) };
        Self { theta: summary.theta, beta, covariance: summary.covariance(), misfit: summary.misfit }
    }

    fn of_class(function: Option<&FragilityFunction>, state: usize, resamples: &[[f64; 2]]) -> Self {
        let [theta, beta] = function
            .map_or([f64::NAN; 2], |function| [function.states[state].median, function.dispersion(state)]);
        let resamples = if function.is_some() { resamples } else { &[] };
        let interval = |estimate: f64, part: usize| {
            Interval::new(estimate, resamples.iter().map(|pair| pair[part]), CONFIDENCE)
        };
        let covariance = covariance(resamples);
        Self { theta: interval(theta, 0), beta: interval(beta, 1), covariance, misfit: None }
    }
}

/// Returns the curve of a limit state of a wall and its resamples, with the β of the model.
fn of_summary(summary: &Summary, report: &ReportOptions) -> Fitted {
    let total = |theta: f64, beta: f64| [theta, beta.hypot(report.modelling_uncertainty)];
    Fitted {
        curve: summary.fitted.ok().map(|curve| total(curve.median, curve.dispersion)),
        resamples: summary.resamples.iter().map(|[theta, beta]| total(*theta, *beta)).collect(),
    }
}

/// Lists the geometry among the parameters of a wall: keys and values.
fn geometry(parameters: &str) -> impl Iterator<Item = (&str, &str)> {
    let lines = parameters.lines().skip_while(|line| *line != "[geometry]").skip(1);
    lines.take_while(|line| !line.starts_with('[')).filter_map(|line| line.split_once(" = "))
}
