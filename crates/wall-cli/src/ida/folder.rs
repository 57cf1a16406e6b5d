//! The folder of a study: its contents, and one file for each finished wall, model and record.
//!
//! A run's file appears complete, by renaming, so that the program can be killed at any moment. It holds a
//! checksum, and a damaged file counts as missing. Several processes can work on one folder. The final
//! results are made from these files alone, so their bytes do not depend on which process computed what.

use std::fmt::Write;
use std::fs::File;
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
    /// The sources of the program, see [`study::SOURCES`].
    pub(crate) sources: String,
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
    /// Fingerprint of the rest.
    checksum: String,
}

impl Manifest {
    fn new(title: String, report: ReportOptions, contents: Contents) -> Result<Self> {
        let mut manifest = Self { title, report, contents, checksum: String::new() };
        manifest.checksum = manifest.fingerprint()?;
        Ok(manifest)
    }

    /// The fingerprint of all but the checksum.
    fn fingerprint(&self) -> Result<String> {
        let text = serde_json::to_string(&(&self.title, &self.report, &self.contents))?;
        Ok(fingerprint(text.as_bytes()))
    }
}

impl Contents {
    fn of(study: &Study) -> Self {
        let models = study.models();
        let walls = study.walls().iter().enumerate().map(|(index, wall)| {
            let (parameters, floors) = (wall.parameters.clone(), wall.floors.clone());
            let scene = Scene { parameters, floors, ..Scene::default() };
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
            sources: study::SOURCES.to_owned(),
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
    /// The folder of the runs, locked as long as this process works on it: shared with others, or alone to
    /// remove what is incomplete. Systems that cannot lock a folder keep that.
    lock: Option<File>,
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
        Self::create(path, Manifest::new(title.to_owned(), report.clone(), contents)?)
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
        Self::locked(path, manifest)
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
        if manifest.checksum != manifest.fingerprint()? {
            bail!("{name}: is damaged; remove it, and `wall ida` writes it again and keeps the runs");
        }
        Self::locked(path, manifest)
    }

    fn locked(path: &Path, manifest: Manifest) -> Result<Self> {
        let fingerprint = fingerprint(manifest.contents.text()?.as_bytes());
        let lock = File::open(path.join(RUNS)).ok().filter(|lock| lock.lock_shared().is_ok());
        Ok(Self { path: path.to_owned(), manifest, fingerprint, lock })
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

    /// Reads the curve of a combination, if its file is there and not damaged.
    pub(super) fn curve(&self, index: usize) -> Option<Curve> {
        let text = std::fs::read_to_string(self.run_file(index)).ok()?;
        let (_, levels) = text.split_once('\n')?;
        let runs: Option<Vec<Run>> = levels.strip_suffix("end\n")?.lines().map(run).collect();
        let curve = Curve::new(runs?);
        // the same study, number, checksum and order
        (self.text(index, &curve) == text).then_some(curve)
    }

    /// Writes the curve of a combination.
    pub(super) fn keep(&self, index: usize, curve: &Curve) -> Result<()> {
        let file = self.run_file(index);
        if let Some(folder) = file.parent() {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("{}: cannot be made", folder.display()))?;
        }
        // a file that a power failure damages is computed again
        output::to_file_unsynced(&file, self.text(index, curve).as_bytes())
    }

    /// The content of a run's file: a line with the fingerprint of the study, the number of the combination,
    /// the number of levels and the checksum of both this and the levels; the levels; `end`.
    fn text(&self, index: usize, curve: &Curve) -> String {
        let mut levels = String::new();
        for Run { intensity, demand, overturning } in curve.runs() {
            // writing to a String cannot fail
            let _ = writeln!(levels, "{intensity:?},{demand:?},{}", csv::optional(*overturning));
        }
        let head = format!("{} {index} {}", self.fingerprint, curve.runs().len());
        let checksum = fingerprint(format!("{head}\n{levels}").as_bytes());
        format!("{head} {checksum}\n{levels}end\n")
    }

    /// Warns of files that are there although their combinations are missing.
    pub(super) fn warn_of_damage(&self, missing: &[usize]) {
        let files: Vec<_> =
            missing.iter().map(|&index| self.run_file(index)).filter(|f| f.exists()).collect();
        if let Some(first) = files.first() {
            output::warn(&format!(
                "{} of {} run files are damaged or of another study and count as missing; the first is {}",
                files.len(),
                self.manifest.contents.count(),
                first.display()
            ));
        }
    }

    /// Removes the incomplete files of killed processes, unless another process works on the folder.
    pub(super) fn sweep(&self) {
        let Some(lock) = &self.lock else { return };
        if lock.try_lock().is_ok() {
            self.remove_parts();
        }
        // an attempt that fails may lose the shared lock too
        let _ = lock.lock_shared();
    }

    fn remove_parts(&self) {
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

/// Reads a line of a run's file: an intensity, a demand and, of a wall that overturned, the time.
fn run(line: &str) -> Option<Run> {
    let mut cells = line.split(',');
    let mut number =
        || cells.next()?.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    let (intensity, demand) = (number().filter(|intensity| *intensity > 0.0)?, number()?);
    let overturning = if line.ends_with(',') { None } else { Some(number()?) };
    Some(Run { intensity, demand, overturning })
}
