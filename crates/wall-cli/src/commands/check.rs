//! `wall check`: walls against a building code.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use check::{
    CheckFile, Code, Language, Origin, ReportTable, Sentence, Sought, Subject, WallCodes, baseline,
    baselines, check_walls, find, how_to_write, page, page_of_walls, read, with_assignments,
};
use clap::Args;
use run::parallel;
use scene::Scene;
use study::document::StudyFile;

use crate::args::{SceneArguments, apply_set, refuse, svg_file};
use crate::output::{Console, progress, written};

#[derive(Debug, Args)]
#[command(mut_arg("scene", |scene| scene.help("Scene, or file of walls, with a table [check] (TOML)")))]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Find the smallest thickness or tie, or the largest height, thrust or load, that passes
    #[arg(long, value_name = "PARAMETER", value_parser = sought)]
    find: Option<Sought>,
    /// With --find: write capacity over demand over the parameter as a chart (SVG)
    #[arg(long, value_name = "FILE", requires = "find", value_parser = svg_file())]
    plot: Option<PathBuf>,
    /// Ratio from which on a check passes, in place of target of [check], such as 0.6
    #[arg(long, value_name = "RATIO")]
    target: Option<f64>,
    /// Write the rows as CSV: one for each check, or for each wall of a file of walls, the worst first
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// With a file of walls: write its table as a page
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the report for a calculation file as a page
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// With --report: the date to print in it, in any form
    #[arg(long, value_name = "TEXT", requires = "report")]
    date: Option<String>,
    /// Language of all that is printed and written, en or it; Italian CSV has semicolons and decimal commas.
    /// A report has that of [report] without it
    #[arg(long, value_name = "LANGUAGE", value_parser = language)]
    lang: Option<Language>,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let Some(path) = &arguments.scene.scene else {
        bail!("there is no file; give a scene or walls with a table [check]; {}", how_to_write());
    };
    let (name, text) = (path.display().to_string(), Scene::text(path)?);
    let (of_check, of_wall): (Vec<String>, Vec<String>) =
        arguments.scene.set.iter().cloned().partition(|set| set.trim_start().starts_with("check."));
    let of_check =
        of_check.into_iter().chain(arguments.target.map(|target| format!("check.target={target}")));
    let of_check: Vec<_> = of_check.collect();
    let extended = with_assignments(&text, &of_check).map_err(|message| anyhow!("--set {message}"))?;
    let file = CheckFile::parse_with(&name, &extended, text.len())?;
    let code = || read(&file).map_err(|error| file.located(error));
    if file.has_walls() {
        let one_wall = [("--find", arguments.find.is_some()), ("--set of a parameter", !of_wall.is_empty())];
        refuse(one_wall, "takes one wall; give a scene").context(name.clone())?;
        return walls(console, arguments, &file);
    }
    let many_walls = [("--html", arguments.html.is_some())];
    refuse(many_walls, "lists the walls of a file; a scene has one, and --report is its page")
        .context(name.clone())?;
    let mut scene = file.scene()?;
    apply_set(&of_wall, &mut scene)?;
    let Arguments { plot, csv, report, .. } = arguments;
    let outputs = || plot.iter().chain(csv).chain(report);
    // before records are read, and after
    let before = file.baseline();
    console.check_distinct(arguments.scene.inputs(&scene).chain(&before), outputs())?;
    let code = code()?;
    console.check_distinct(&code.records().files, outputs())?;
    console.warn(scene.doubts());
    warn(console, &code.records().warnings, arguments.language());
    one(console, arguments, &file, &*code, &scene)
}

/// Checks the wall of a scene.
fn one(
    console: &Console<'_>,
    arguments: &Arguments,
    file: &CheckFile<'_>,
    code: &dyn Code,
    scene: &Scene,
) -> Result<()> {
    let Arguments { plot, csv, report, .. } = arguments;
    let language = arguments.language();
    let assumed = file.assumed(&arguments.scene.set);
    let subject = Subject { assumed: &assumed, ..scene.into() };
    if let Some(sought) = arguments.find {
        let of_the_wall = [("--report", report.is_some()), ("--csv", csv.is_some())];
        refuse(of_the_wall, "covers the wall as given; leave out --find").context(file.name().to_owned())?;
        let found = progress::shown(|| find(code, subject, sought))?.map_err(|error| file.located(error))?;
        console.save(plot.as_ref(), || found.plot(language).picture())?;
        if arguments.json {
            return console.json(&found.json());
        }
        return console.print(&(found.text(language) + &written(arguments.label(), plot)));
    }
    let mut verdict = code.check(subject).map_err(|error| file.located(error))?;
    let mut inputs = Vec::new();
    verdict.before = baseline(file, code, &mut inputs)?;
    console.check_distinct(&inputs, csv.iter().chain(report))?;
    if let Some(path) = report {
        let report = project(arguments, file)?;
        let origin = Origin::new(&scene.title, file, code.records(), &report, super::VERSION);
        let origin = Origin { set: &arguments.scene.set, ..origin };
        console.write(path, page(&verdict, &origin)?.as_bytes())?;
    }
    console.save(csv.as_ref(), || verdict.csv(language))?;
    if arguments.json {
        return console.json(&verdict.json());
    }
    warn(console, &verdict.warnings, language);
    let label = format!("\n{}", arguments.label());
    console.print(&(verdict.text(&scene.title, language) + &written(&label, csv.iter().chain(report))))
}

/// Prints warnings in a language.
fn warn(console: &Console<'_>, warnings: &[Sentence], language: Language) {
    match language {
        Language::En => console.warn(warnings),
        Language::It => {
            for said in warnings {
                console.report(&format!("avvertenza: {}", said.of(language)));
            }
        }
    }
}

impl Arguments {
    fn language(&self) -> Language {
        self.lang.unwrap_or_default()
    }

    /// What stands before the name of a file that was written.
    fn label(&self) -> &'static str {
        match self.language() {
            Language::En => "written  ",
            Language::It => "scritto  ",
        }
    }
}

/// What the report says of the project.
fn project(arguments: &Arguments, file: &CheckFile<'_>) -> Result<ReportTable> {
    let mut report = file.report()?;
    report.date = arguments.date.clone().or(report.date);
    report.language = arguments.lang.unwrap_or(report.language);
    Ok(report)
}

/// Checks the walls of a file.
fn walls(console: &Console<'_>, arguments: &Arguments, file: &CheckFile<'_>) -> Result<()> {
    let (mut inputs, mut warnings) = (Vec::new(), Vec::new());
    // a study is one of walls, too
    let walls = file.walls(StudyFile::keys(), &mut inputs, &mut warnings)?;
    let codes = WallCodes::read(file, &walls)?;
    let code = codes.shared();
    let Arguments { csv, html, report, .. } = arguments;
    let outputs = || html.iter().chain(csv).chain(report);
    console.check_distinct(inputs.iter().chain(&code.records().files), outputs())?;
    let mut verdicts = check_walls(&codes, &walls, parallel::threads(None).get());
    baselines(file, &codes, &walls, &mut verdicts, &mut inputs, &mut warnings)?;
    // the files of the baseline are known now
    console.check_distinct(&inputs, outputs())?;
    let language = arguments.language();
    console.save(csv.as_ref(), || verdicts.csv(language))?;
    console.save(html.as_ref(), || verdicts.page(file.name(), language))?;
    if let Some(path) = report {
        let report = project(arguments, file)?;
        let title = Path::new(file.name()).file_stem().unwrap_or_default().to_string_lossy();
        let origin = Origin::new(&title, file, code.records(), &report, super::VERSION);
        let origin = Origin { set: &arguments.scene.set, ..origin };
        console.write(path, page_of_walls(&verdicts, &walls, &codes, &origin)?.as_bytes())?;
    }
    console.warn(&warnings);
    warn(console, &code.records().warnings, language);
    if arguments.json {
        console.json(&verdicts.json())?;
    } else {
        console.report_all(verdicts.warnings(language));
        console.print(&(verdicts.table_in(language).text() + &written(arguments.label(), outputs())))?;
    }
    match verdicts.refused() {
        0 => Ok(()),
        refused => {
            bail!("{refused} of {} walls could not be checked; the first rows say why", walls.len())
        }
    }
}

fn language(name: &str) -> Result<Language, String> {
    let found = Language::ALL.into_iter().find(|language| language.name() == name);
    found.ok_or_else(|| format!("expected {}", Language::ALL.map(Language::name).join(" or ")))
}

fn sought(name: &str) -> Result<Sought, String> {
    let found = Sought::ALL.into_iter().find(|sought| sought.name() == name);
    found.ok_or_else(|| format!("expected {}", Sought::ALL.map(Sought::name).join(", ")))
}

#[cfg(test)]
mod tests {
    use super::{Language, language};

    #[test]
    fn languages_go_by_their_names() {
        assert_eq!(language("it"), Ok(Language::It));
        assert_eq!(language("de"), Err("expected en or it".to_owned()));
    }
}
