//! Published tests as data: a TOML file beside a CSV of measured points.

use std::path::{Path, PathBuf};

use toml::Spanned;

use files::{FileError, TomlFile, read_text, tables};
use rocking_wall::wall::Parameters;
use scene::{Group, apply_group, check_limits, variable};

use super::decay::Decay;
use super::push::Push;

/// Largest file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// A published test.
#[derive(Clone, Debug)]
pub struct PublishedTest {
    /// Title.
    pub title: String,
    /// Where it is published.
    pub source: String,
    /// The wall.
    pub parameters: Parameters,
    /// What was measured.
    pub test: Test,
    /// Files that it was read from.
    pub inputs: [PathBuf; 2],
}

/// Kind of a test.
#[derive(Clone, Debug)]
pub enum Test {
    /// A slow push.
    Push(Push),
    /// A release.
    Decay(Decay),
}

tables! {
    /// The file of a published test.
    struct TestDocument {
        /// Title.
        title: String,
        /// Where it is published.
        source: String,
        /// CSV of the measured points.
        points: PathBuf,
        /// Shape, mass and loads.
        geometry: Group,
        /// A slow push.
        push: Option<Spanned<Push>>,
        /// A release.
        decay: Option<Spanned<Decay>>,
    }
}

impl PublishedTest {
    /// Reads a test and the points that it names, which lie beside it.
    ///
    /// # Errors
    /// [`FileError`] with file, line and what was expected.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let (name, text) = (path.display().to_string(), text(path)?);
        let file = TomlFile::new(&name, &text)?;
        let document: TestDocument = file.read()?;
        let mut parameters = Parameters::default();
        apply_group(&mut parameters, "geometry", &document.geometry, &file)?;
        let points_path = path.with_file_name(&document.points);
        let points = points(&points_path)?;
        let (span, test) = match (document.push, document.decay) {
            (Some(table), None) => (table.span(), Test::Push(Push { points, ..table.into_inner() })),
            (None, Some(table)) => (table.span(), Test::Decay(Decay { points, ..table.into_inner() })),
            _ => {
                return Err(FileError::whole(&name, "expected one table, [push] or [decay]"));
            }
        };
        test.check().map_err(|message| file.place().error(span, message))?;
        let inputs = [path.to_owned(), points_path];
        Ok(Self { title: document.title, source: document.source, parameters, test, inputs })
    }
}

impl Test {
    /// Checks the numbers of a test: those of the force law by the limits of the model description.
    fn check(&self) -> Result<(), String> {
        let within = |name, value| variable(name).map_or(Ok(()), |known| check_limits(known, value));
        match self {
            Self::Push(Push { points, a1, d1, fit_from }) => {
                within("a1", *a1)?;
                within("d1", *d1)?;
                let count = points.iter().filter(|[displacement, _]| displacement >= fit_from).count();
                if count < 2 {
                    return Err(format!("fit_from = {fit_from}: fewer than two points from there on"));
                }
            }
            Self::Decay(Decay { points, start, a1, .. }) => {
                within("a1", *a1)?;
                if points.iter().filter(|[time, d]| time >= start && *d != 0.0).count() < 2 {
                    return Err(format!("start = {start} s: fewer than two peaks from there on"));
                }
            }
        }
        Ok(())
    }
}

fn text(path: &Path) -> Result<String, FileError> {
    read_text(path, "a published test", MAX_FILE_BYTES)
}

/// Reads two columns of numbers that rise in the first one; the first line is their header.
fn points(path: &Path) -> Result<Vec<[f64; 2]>, FileError> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (index, line) in text(path)?.lines().enumerate().skip(1) {
        let numbers: Vec<f64> = line.split(',').filter_map(|field| field.trim().parse().ok()).collect();
        match numbers[..] {
            [x, y] if x.is_finite() && y.is_finite() && points.last().is_none_or(|last| x > last[0]) => {
                points.push([x, y]);
            }
            _ => {
                let reason = "expected two numbers, the first above that of the line before";
                return Err(FileError::on_line(path.display().to_string(), index + 1, reason));
            }
        }
    }
    if points.len() < 3 {
        let reason = "expected at least three points after a header";
        return Err(FileError::whole(path.display().to_string(), reason));
    }
    Ok(points)
}
