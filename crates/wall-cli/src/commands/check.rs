//! `wall check`: a wall, or the walls of a study, against a code.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use check::CheckError;
use check::code::{Code, Document, Given, Subject, Verdict, in_table, read};
use check::find::{Sought, find, over_parameter};
use check::fractions::{FractionsTable, SpectrumTable};
use check::walls::Walls;
use clap::Args;
use ground_motion::RecordOptions;
use rocking_wall::scene::{Place, Scene, read_text};
use run::parallel;
use run::records::NamedRecord;
use serde_json::Value;

use crate::args::{SceneArguments, read_records, record_files, refuse};
use crate::output::{self, Console};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    fractions: FractionsArguments,
    /// Find the smallest thickness, tie strength or stiffness, or the largest height, that passes
    #[arg(long, value_name = "PARAMETER", value_parser = sought)]
    find: Option<Sought>,
    /// With --find: write `zeta_E` over the parameter as a chart (SVG)
    #[arg(long, value_name = "FILE", requires = "find")]
    plot: Option<PathBuf>,
    /// With a study: write one row for each wall, the worst first, as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// With a study: write a page of its walls
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the report for a calculation file as a page
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// With --report: the date to print in it, in any form
    #[arg(long, value_name = "TEXT", requires = "report")]
    date: Option<String>,
}

/// The code `fractions` for a scene without a table `[check]`.
#[derive(Debug, Args)]
struct FractionsArguments {
    /// Without `[check]`: a response spectrum as CSV or text, T in s and Sa, from T = 0 on; of the ground or
    /// of a floor
    #[arg(long, value_name = "FILE", conflicts_with = "records")]
    spectrum: Option<PathBuf>,
    /// Without `[check]`: the median spectrum of these records, felt on the floor of a scene with storeys
    #[arg(long, value_name = "FILE", num_args = 1..)]
    records: Vec<PathBuf>,
    /// Unit of a spectrum or of records that do not state theirs: m/s2, cm/s2, mm/s2 or g
    #[arg(long)]
    unit: Option<String>,
    /// Name of the column with Sa, for a spectrum with several
    #[arg(long, value_name = "NAME", requires = "spectrum")]
    column: Option<String>,
    /// Damping ratio of the spectrum [default: that of the column's name, `Sa (5 %)`, or 0.05]
    #[arg(long, value_name = "RATIO")]
    damping: Option<f64>,
    /// Displacement capacity over the displacement at which the force of the wall vanishes [default: 0.4]
    #[arg(long, value_name = "FRACTION")]
    displacement_fraction: Option<f64>,
    /// Displacement of the secant period over the displacement capacity [default: 0.4]
    #[arg(long, value_name = "FRACTION")]
    secant_fraction: Option<f64>,
}

/// Largest file that is looked into for its tables.
const MAX_FILE_BYTES: u64 = 4 << 20;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let path = arguments.scene.scene.as_deref();
    let (name, text) = match path {
        Some(path) => (path.display().to_string(), read_text(path, "a scene file (TOML)", MAX_FILE_BYTES)?),
        None => ("the default wall".to_owned(), String::new()),
    };
    let is_study = text.parse::<toml::Table>().is_ok_and(|keys| keys.contains_key("walls"));
    match path.filter(|_| is_study) {
        Some(path) => arguments.check_walls(console, path, &text),
        None => arguments.check_wall(console, &Place::new(&name, &text)),
    }
}

impl Arguments {
    fn check_walls(&self, console: &Console<'_>, path: &Path, text: &str) -> Result<()> {
        let name = path.display().to_string();
        self.fractions.refuse(&name)?;
        if self.find.is_some() || self.report.is_some() || !self.scene.set.is_empty() {
            bail!("{name}: --find, --report and --set take one wall; give a scene");
        }
        let walls = Walls::parse(path, text)?;
        let outputs = || self.html.iter().chain(&self.csv);
        console.check_distinct(&walls.inputs, outputs())?;
        let verdicts = walls.check(parallel::threads(None).get());
        console.save(self.csv.as_ref(), || verdicts.table().csv())?;
        console.save(self.html.as_ref(), || verdicts.page(&name))?;
        walls.warnings.iter().for_each(|warning| console.warn(warning));
        if self.json {
            console.json(&verdicts.json())?;
        } else {
            console.report_all(verdicts.warnings());
            console.print(&(verdicts.table().text() + &output::written("written  ", outputs())))?;
        }
        match verdicts.refused() {
            0 => Ok(()),
            refused => {
                bail!("{refused} of {} walls could not be checked; the first rows say why", walls.walls.len())
            }
        }
    }

    fn check_wall(&self, console: &Console<'_>, place: &Place<'_>) -> Result<()> {
        let name = place.name();
        refuse(
            [("--csv", self.csv.is_some()), ("--html", self.html.is_some())],
            "shows the walls of a study",
        )
        .with_context(|| name.to_owned())?;
        if self.find.is_some() && self.report.is_some() {
            bail!("{name}: --report covers the wall as given; leave out --find");
        }
        let folder = self.scene.scene.as_deref().and_then(Path::parent).unwrap_or(Path::new("."));
        let mut scene = Scene::parse(name, place.text(), folder)?;
        self.scene.apply(&mut scene)?;
        let located = |error: CheckError| in_table(error, place);
        let code = match read(place, Given { folder, records: Vec::new() }).map_err(located)? {
            Some(code) => {
                self.fractions.refuse(name)?;
                code
            }
            None => self.fractions.code(console).with_context(|| name.to_owned())?,
        };
        code.warnings().iter().for_each(|warning| console.warn(warning));
        let records = record_files(&self.fractions.records)?;
        let inputs = self.scene.inputs(&scene).chain(code.files()).chain(&records);
        console.check_distinct(inputs, self.plot.iter().chain(&self.report))?;
        let subject = Subject::from(&scene);
        if let Some(sought) = self.find {
            let found = find(&*code, &subject, sought).map_err(located)?;
            console.picture(self.plot.as_ref(), || Ok(over_parameter(&found, sought).picture()))?;
            let values = serde_json::to_value(&found)?;
            let text = || found.text(sought) + &output::written("written  ", &self.plot);
            return self.told(console, &values, text);
        }
        let verdict = code.check(&subject).map_err(located)?;
        if let Some(path) = &self.report {
            let (file, set) = ((name, place.text()), &*self.scene.set);
            let document = Document { file, set, date: self.date.as_deref() };
            console.write(path, code.report(&subject, &document).map_err(located)?.as_bytes())?;
        }
        if !self.json {
            verdict.warnings.iter().for_each(|warning| console.warn(warning));
        }
        self.told(console, &verdict.values, || {
            text(&scene.title, &verdict) + &output::written("\nwritten ", &self.report)
        })
    }

    /// Prints a result as JSON or as text.
    fn told(&self, console: &Console<'_>, values: &Value, text: impl FnOnce() -> String) -> Result<()> {
        if self.json { console.json(values) } else { console.print(&text()) }
    }
}

fn text(title: &str, verdict: &Verdict) -> String {
    let (headline, numbers, notes) = (&verdict.headline, verdict.numbers.text(), verdict.notes.join("\n"));
    format!("{title}\n{headline}\n\n{numbers}\n{notes}\n")
}

impl FractionsArguments {
    /// Refuses these options beside a table `[check]`, which has its own.
    fn refuse(&self, name: &str) -> Result<()> {
        let given = [
            ("--spectrum", self.spectrum.is_some()),
            ("--records", !self.records.is_empty()),
            ("--unit", self.unit.is_some()),
            ("--column", self.column.is_some()),
            ("--damping", self.damping.is_some()),
            ("--displacement-fraction", self.displacement_fraction.is_some()),
            ("--secant-fraction", self.secant_fraction.is_some()),
        ];
        let why = "is for a scene without a table [check]; leave it out";
        refuse(given, why).with_context(|| name.to_owned())
    }

    /// Makes the code of the options.
    fn code(&self, console: &Console<'_>) -> Result<Box<dyn Code>> {
        if self.spectrum.is_none() && self.records.is_empty() {
            bail!(
                "there is no demand; give the scene a table [check] with a code, such as code = \
                 \"circolare-2019\", or give --spectrum or --records"
            );
        }
        let unit = self.unit.as_deref().map(str::parse).transpose()?;
        let table = FractionsTable {
            displacement_fraction: self.displacement_fraction,
            secant_fraction: self.secant_fraction,
            spectrum: self.spectrum.clone().map(SpectrumTable::File),
            unit,
            column: self.column.clone(),
            damping: self.damping,
            ..FractionsTable::default()
        };
        let options = RecordOptions { unit, ..RecordOptions::default() };
        let records = read_records(console, &self.records, &options)?
            .into_iter()
            .map(|record| NamedRecord { name: record.channel.unwrap_or_default(), motion: record.motion });
        let records = records.collect();
        Ok(table.code(&Place::new("", ""), Given { folder: Path::new(""), records })?)
    }
}

fn sought(name: &str) -> Result<Sought, String> {
    Sought::ALL
        .into_iter()
        .find(|sought| sought.name() == name)
        .ok_or_else(|| format!("expected {}", Sought::ALL.map(Sought::name).join(", ")))
}
