//! Fragilities for risk engines: `fragilities.xml`, and `fragility_curves.csv` with one curve in a row, of
//! every wall and of every class of walls.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::document::WallClass;
use crate::fragility::{FragilityFunction, Interval};
use crate::results::WallResults;
use crate::tables::in_g;
use ground_motion::STANDARD_GRAVITY;

use run::file::{self, Draft};

use super::contents::Manifest;
use super::error::FolderError;
use super::nrml;
use report::table::Table;

/// Names of the files.
const FILES: [&str; 2] = ["fragility_curves.csv", "fragilities.xml"];

/// The files under construction.
pub(crate) struct Risk<'a> {
    manifest: &'a Manifest,
    states: Vec<(usize, String)>,
    table: Draft,
    /// Whether the table has its line of names.
    is_begun: bool,
    xml: Option<(Draft, nrml::Writer)>,
    /// Numbers of the walls of each class.
    classes: Vec<(&'a WallClass, Vec<usize>)>,
    /// Functions of walls in classes, one for each model where it has all curves.
    members: BTreeMap<usize, Vec<Option<FragilityFunction>>>,
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
        Ok(Self {
            manifest,
            states: nrml::limit_states(&manifest.report),
            table: Draft::new(&table, b"")?,
            is_begun: false,
            xml,
            members: classes.iter().flat_map(|(_, walls)| walls).map(|&wall| (wall, Vec::new())).collect(),
            classes,
            left_out: [0; 2],
        })
    }

    /// Adds a wall.
    pub(crate) fn add(&mut self, wall: usize, results: &WallResults) -> Result<(), FolderError> {
        let Manifest { contents, report, .. } = self.manifest;
        let note = &contents.walls[wall];
        for model in 0..contents.models.len() {
            let summaries: Vec<_> =
                self.states.iter().map(|(place, _)| &results.summaries(*place)[model]).collect();
            let curves: Option<Vec<_>> = summaries.iter().map(|summary| summary.fitted.ok()).collect();
            let function = curves.map(|curves| FragilityFunction::new(&curves, report.modelling_uncertainty));
            let thetas: Vec<_> = summaries.iter().map(|summary| known(&summary.theta)).collect();
            self.write([&note.name, &geometry(&note.parameters)], model, function.as_ref(), &thetas)?;
            if let Some(functions) = self.members.get_mut(&wall) {
                functions.push(function);
            }
        }
        Ok(())
    }

    /// Adds the classes, and completes the files; returns their paths and what is to be said of them.
    pub(crate) fn finish(mut self) -> Result<(Vec<PathBuf>, String), FolderError> {
        let contents = &self.manifest.contents;
        let mut told = String::new();
        for (class, walls) in std::mem::take(&mut self.classes) {
            let shares = class.shares(walls.len());
            let named = |(share, &wall): (&f64, &usize)| format!("{share} {}", contents.walls[wall].name);
            let stated: Vec<_> = shares.iter().zip(&walls).map(named).collect();
            for model in 0..contents.models.len() {
                let members = walls.iter().map(|wall| self.members[wall][model].clone());
                let members: Option<Vec<_>> = members.collect();
                let function = members.map(|members| FragilityFunction::of_class(&shares, &members));
                self.write([&class.name, &stated.join("; ")], model, function.as_ref(), &[])?;
                told.extend(function.map(|function| self.line(class, model, &function)));
            }
        }
        told.push_str(&self.words());
        let mut drafts = vec![self.table];
        if let Some((mut draft, _)) = self.xml {
            draft.write(|file| nrml::Writer::finish(file))?;
            drafts.push(draft);
        }
        let paths = drafts.into_iter().map(|draft| draft.commit(true));
        Ok((paths.collect::<Result<_, _>>()?, told))
    }

    /// Writes the function of a wall or a class, by its name and what it consists of, with one model.
    /// `intervals` are those of θ \[g\], limit state by limit state; a class has none.
    fn write(
        &mut self,
        [name, geometry]: [&str; 2],
        model: usize,
        function: Option<&FragilityFunction>,
        intervals: &[[f64; 2]],
    ) -> Result<(), FolderError> {
        let Manifest { contents, report, .. } = self.manifest;
        let model = &contents.models[model].name;
        let known = |value: Option<f64>| value.filter(|value| value.is_finite());
        let end = |k: usize, end: usize| known(intervals.get(k).map(|ends| ends[end]));
        let theta = |k: usize| known(function.map(|function| in_g(function.medians[k])));
        let table = Table::over(self.states.iter().enumerate())
            .text("wall", "", |_| name.to_owned())
            .text("geometry", "", |_| geometry.to_owned())
            .text("model", "", |_| model.clone())
            .text("measure", "", |_| contents.measure.clone())
            .text("unit", "", |_| "g")
            .text("limit_state", "", |(_, (_, state))| state.clone())
            .value("u_max_over_u_ins", |(_, (place, _))| report.fractions[*place])
            .value("theta", |(k, _)| theta(*k))
            .value("theta_low", |(k, _)| end(*k, 0))
            .value("theta_high", |(k, _)| end(*k, 1))
            // the square root of the sum of the squares of those after it
            .value("beta", |_| function.map(FragilityFunction::dispersion))
            .value("beta_records", |_| function.map(|function| function.beta_records))
            .value("beta_walls", |_| function.map(|function| function.beta_walls))
            .value("beta_modelling", |_| function.map(|function| function.beta_modelling))
            .done();
        let text = if self.is_begun { table.csv_rows() } else { table.csv() };
        self.is_begun = true;
        self.table.write(|file| file.write_all(text.as_bytes()))?;
        let Some(function) = function else {
            self.left_out[0] += 1;
            return Ok(());
        };
        let Some((draft, writer)) = &mut self.xml else { return Ok(()) };
        let id = if contents.models.len() == 1 { name.to_owned() } else { format!("{name} ({model})") };
        let is_written = draft.write(|file| writer.function(file, &id, function))?;
        self.left_out[1] += usize::from(!is_written);
        Ok(())
    }

    /// Describes what the NRML file lacks, and the remedy.
    fn words(&self) -> String {
        let [_, file] = FILES;
        let measure = &self.manifest.contents.measure;
        if self.xml.is_none() {
            return format!(
                "no {file}: it is written for PGA and Sa(T) only, because NRML cannot state the periods of \
                 {measure}; for it run the study with intensity = {{ measure = \"PGA\" }} or \
                 {{ measure = \"Sa\", period = T }}\n"
            );
        }
        let lack = |(count, reason): (usize, &str)| match count {
            0 => String::new(),
            1 => format!("{file} lacks 1 function, of a wall or class {reason}\n"),
            _ => format!("{file} lacks {count} functions, of walls or classes {reason}\n"),
        };
        let without_curve = "with a limit state that has no curve: it is exceeded by no run or by all, \
             or its records do not scatter; add levels below or above, or drop its fraction";
        let without_numbers =
            "with a beta so large that a number of NRML would be 0 or infinite; add records or levels";
        [(self.left_out[0], without_curve), (self.left_out[1], without_numbers)].map(lack).concat()
    }

    /// Describes the result of a class.
    fn line(&self, class: &WallClass, model: usize, function: &FragilityFunction) -> String {
        let Manifest { contents, report, .. } = self.manifest;
        let theta = |((place, _), theta): (&(usize, String), &f64)| {
            format!("{:.3} g to exceed {} u_ins", in_g(*theta), report.fractions[*place])
        };
        let thetas: Vec<_> = self.states.iter().zip(&function.medians).map(theta).collect();
        format!(
            "class {:?} with {}: theta {}; beta {:.3} (records {:.3}, walls {:.3}, modelling {})\n",
            class.name,
            contents.models[model].name,
            thetas.join(", "),
            function.dispersion(),
            function.beta_records,
            function.beta_walls,
            function.beta_modelling
        )
    }
}

/// Returns the ends of an interval \[g\], NaN where the levels leave one open.
fn known(theta: &Interval) -> [f64; 2] {
    let [_, low, high] = theta.bounds(STANDARD_GRAVITY);
    [low, high].map(|[least, most]| if least == most { most } else { f64::NAN })
}

/// Returns the geometry among the parameters of a wall, in one line.
fn geometry(parameters: &str) -> String {
    let lines = parameters.lines().skip_while(|line| *line != "[geometry]").skip(1);
    let lines: Vec<_> = lines.take_while(|line| !line.starts_with('[')).collect();
    lines.join("; ").replace(" = ", "=").replace('"', "")
}
