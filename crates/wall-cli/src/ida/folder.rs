//! The folder of a study: its contents, and one file for each finished wall, model and record.
//!
//! A run's file appears complete, by renaming, so that the program can be killed at any moment. A damaged
//! file counts as missing. The final results are made from these files alone, so their bytes do not depend on
//! which process computed what.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use rocking_wall::scene::{Scene, fingerprint, to_toml};
use serde::{Deserialize, Serialize};
use study::document::ReportOptions;
use study::ida::{Case, Curve, Run, Study};

use crate::{csv, output};

const STUDY: &str = "study.json";
const RUNS: &str = "runs";

/// What the runs of a study depend on: two studies with equal contents have the same runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Contents {
    pub(crate) program: String,
    pub(crate) measure: String,
    pub(crate) measure_details: String,
    pub(crate) levels: String,
    /// Levels \[m/s²\] where all records share them.
    pub(crate) grid: Option<Vec<f64>>,
    pub(crate) tail_s: f64,
    pub(crate) walls: Vec<WallNote>,
    pub(crate) models: Vec<ModelNote>,
    pub(crate) records: Vec<RecordNote>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WallNote {
    pub(crate) name: String,
    pub(crate) parameters: Vec<String>,
    pub(crate) restitution: f64,
    /// Damping ratio with each model.
    pub(crate) xi: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ModelNote {
    pub(crate) name: String,
    pub(crate) damping: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RecordNote {
    pub(crate) name: String,
    pub(crate) fingerprint: String,
    pub(crate) points: usize,
    pub(crate) step_s: f64,
    /// \[m/s²\].
    pub(crate) intensity: f64,
}

/// A study in a folder.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Manifest {
    pub(crate) title: String,
    pub(crate) report: ReportOptions,
    pub(crate) contents: Contents,
}

impl Contents {
    fn of(study: &Study) -> Self {
        let models = study.models();
        let walls = study.walls().iter().enumerate().map(|(index, wall)| {
            let scene = Scene { parameters: wall.parameters.clone(), ..Scene::default() };
            let text = to_toml(&scene, "");
            WallNote {
                name: wall.name.clone(),
                parameters: text
                    .lines()
                    .skip_while(|line| !line.starts_with("[geometry]"))
                    .filter(|line| line.contains(" = "))
                    .map(str::to_owned)
                    .collect(),
                restitution: study.wall(index, 0).restitution(),
                xi: (0..models.len()).map(|model| study.wall(index, model).damping_ratio()).collect(),
            }
        });
        let records = study.records().iter().enumerate().map(|(index, record)| {
            let samples = record.motion.samples();
            let bytes: Vec<u8> = samples.iter().flat_map(|sample| sample.to_bits().to_le_bytes()).collect();
            RecordNote {
                name: record.name.clone(),
                fingerprint: fingerprint(&bytes),
                points: samples.len(),
                step_s: record.motion.step(),
                intensity: study.intensity(index),
            }
        });
        Self {
            program: format!("rocking-wall {}", env!("CARGO_PKG_VERSION")),
            measure: study.measure().name(),
            measure_details: format!("{:?}", study.measure()),
            levels: format!("{:?}", study.levels()),
            grid: study.levels().shared(),
            tail_s: study.tail(),
            walls: walls.collect(),
            models: models
                .iter()
                .map(|model| ModelNote { name: model.name.clone(), damping: format!("{:?}", model.damping) })
                .collect(),
            records: records.collect(),
        }
    }

    /// Number of combinations.
    pub(crate) fn count(&self) -> usize {
        self.walls.len() * self.models.len() * self.records.len()
    }

    /// The combination of a number, as [`Study::case`] counts.
    pub(crate) fn case(&self, index: usize) -> Case {
        let (records, models) = (self.records.len(), self.models.len());
        Case { wall: index / (records * models), model: index / records % models, record: index % records }
    }

    fn text(&self) -> Result<String> {
        Ok(serde_json::to_string_pretty(self)?)
    }

    /// Describes the first line in which two contents differ.
    fn difference(&self, other: &Self) -> Result<String> {
        let (mine, theirs) = (self.text()?, other.text()?);
        let pair = mine.lines().zip(theirs.lines()).find(|(mine, theirs)| mine != theirs);
        Ok(pair.map_or_else(
            || "one has more lines than the other".to_owned(),
            |(mine, theirs)| format!("found {}, expected {}", trimmed(mine), trimmed(theirs)),
        ))
    }
}

/// A line of JSON, short.
fn trimmed(line: &str) -> String {
    const LONGEST: usize = 160;
    line.trim().trim_end_matches(',').chars().take(LONGEST).collect()
}

/// A folder that holds one study.
pub(crate) struct Folder {
    path: PathBuf,
    pub(crate) manifest: Manifest,
    fingerprint: String,
}

impl Folder {
    /// Opens or makes the folder of a study.
    pub(super) fn of_study(path: &Path, title: &str, study: &Study, report: &ReportOptions) -> Result<Self> {
        let contents = Contents::of(study);
        if path.join(STUDY).exists() {
            let other = Self::open(path)?;
            if other.manifest.contents != contents {
                bail!(
                    "{}: holds results of another study ({}); give another folder with -o, or remove \
                     this one",
                    path.display(),
                    other.manifest.contents.difference(&contents)?
                );
            }
        }
        Self::create(path, Manifest { title: title.to_owned(), report: report.clone(), contents })
    }

    /// Opens or makes the folder that a study is merged into.
    pub(super) fn like(path: &Path, manifest: &Manifest) -> Result<Self> {
        if path.join(STUDY).exists() {
            Self::open(path)?.expect(&manifest.contents)?;
        }
        Self::create(path, manifest.clone())
    }

    fn create(path: &Path, manifest: Manifest) -> Result<Self> {
        let runs = path.join(RUNS);
        std::fs::create_dir_all(&runs).with_context(|| format!("{}: cannot be made", runs.display()))?;
        output::to_file(&path.join(STUDY), (serde_json::to_string_pretty(&manifest)? + "\n").as_bytes())?;
        let fingerprint = fingerprint(manifest.contents.text()?.as_bytes());
        Ok(Self { path: path.to_owned(), manifest, fingerprint })
    }

    /// Opens a folder that holds a study.
    pub(super) fn open(path: &Path) -> Result<Self> {
        let file = path.join(STUDY);
        let name = file.display();
        // to open a pipe in its place would wait for its writer
        let found = std::fs::metadata(&file).and_then(|found| {
            let refusal = || Err(std::io::Error::other("not a regular file"));
            if found.is_file() { std::fs::read_to_string(&file) } else { refusal() }
        });
        let text = found
            .with_context(|| format!("{name}: cannot be read; expected a folder that `wall ida` has made"))?;
        let manifest: Manifest = serde_json::from_str(&text).with_context(|| {
            format!(
                "{name}: not the description of a study by this version; remove the folder or give another"
            )
        })?;
        let fingerprint = fingerprint(manifest.contents.text()?.as_bytes());
        Ok(Self { path: path.to_owned(), manifest, fingerprint })
    }

    /// Checks that the folder holds the study of these contents.
    pub(super) fn expect(&self, contents: &Contents) -> Result<()> {
        if self.manifest.contents == *contents {
            return Ok(());
        }
        bail!(
            "{}: holds another study than the first folder ({}); merge folders of one study only",
            self.path.display(),
            self.manifest.contents.difference(contents)?
        );
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    fn run_file(&self, index: usize) -> PathBuf {
        // a thousand files to a folder: large folders are slow
        self.path.join(RUNS).join(format!("{:04}", index / 1000)).join(format!("{index:07}.csv"))
    }

    /// Reads the curve of a combination, if its file is complete.
    pub(super) fn curve(&self, index: usize) -> Option<Curve> {
        let text = std::fs::read_to_string(self.run_file(index)).ok()?;
        let mut lines = text.lines();
        let count: usize =
            lines.next()?.strip_prefix(&format!("{} {index} ", self.fingerprint))?.parse().ok()?;
        let mut levels = Vec::new();
        for _ in 0..count {
            let mut cells = lines.next()?.split(',');
            let (intensity, demand) = (cells.next()?.parse().ok()?, cells.next()?.parse().ok()?);
            let overturning = match cells.next()? {
                "" => None,
                time => Some(time.parse().ok()?),
            };
            levels.push(Run { intensity, demand, overturning });
        }
        // an incomplete file lacks this line
        (lines.next() == Some("end") && text.ends_with("end\n")).then(|| Curve::new(levels))
    }

    /// Writes the curve of a combination.
    pub(super) fn keep(&self, index: usize, curve: &Curve) -> Result<()> {
        let mut text = format!("{} {index} {}\n", self.fingerprint, curve.runs().len());
        for run in curve.runs() {
            let Run { intensity, demand, overturning } = run;
            let _ = writeln!(text, "{intensity:?},{demand:?},{}", csv::optional(*overturning));
        }
        text.push_str("end\n");
        let file = self.run_file(index);
        if let Some(folder) = file.parent() {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("{}: cannot be made", folder.display()))?;
        }
        output::to_file(&file, text.as_bytes())
    }

    /// Removes the incomplete files of killed runs; nobody else may still be writing.
    pub(super) fn sweep(&self) {
        let entries = |path: &Path| std::fs::read_dir(path).into_iter().flatten().flatten();
        let folders = entries(&self.path.join(RUNS)).map(|entry| entry.path());
        for folder in folders.chain([self.path.clone()]) {
            for entry in entries(&folder) {
                let name = entry.file_name().to_string_lossy().into_owned();
                if name.starts_with('.') && name.strip_suffix(".part").is_some() {
                    // another process may have removed it
                    let _ = std::fs::remove_file(entry.path());
                }
            }
        }
    }
}
