//! Records by their names: the table `[records]` of a study or a check, with files, folders, patterns and
//! lists.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use files::{FileError, Place, tables};
use ground_motion::{
    DEFAULT_PAUSE, Format, GroundMotion, GroundMotionError, Record, RecordOptions, SyntheticMotion, Unit,
    escapes, file_name, is_listed, read,
};
use scene::{LONGEST_TAIL, RecordTable, SceneError, Shocks};
use toml::Spanned;

pub use crate::record_warning::{Reason, RecordWarning};
use crate::selection::{self, ListedFile};
pub use crate::selection::{Listed, Selection};

/// Most synthetic records of a study.
const MOST_RECORDS: u64 = 10_000;

/// A record of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedRecord {
    /// Name in tables and messages.
    pub name: String,
    /// Motion: of a list, with its factor.
    pub motion: GroundMotion,
    /// What a list says of it.
    pub listed: Listed,
}

impl NamedRecord {
    /// Takes a record of which no list says anything: `name` is for tables and messages.
    pub fn new(name: impl Into<String>, motion: GroundMotion) -> Self {
        Self { name: name.into(), motion, listed: Listed::default() }
    }
}

/// Records of a study.
#[derive(Clone, Debug, Default)]
pub struct RecordsEntry {
    /// Files, folders and patterns with `*` and `?`, relative to the study file, each with its line.
    pub files: Vec<(String, usize)>,
    /// Lists of records: one, or one of each stripe.
    pub selections: Vec<Selection>,
    /// Which of the two components of a list is taken, 1 or 2; both where `None`.
    pub component: Option<u64>,
    /// Options for reading them.
    pub options: RecordOptions,
    /// Sequences of records after them, each with its line.
    pub sequences: Vec<(Shocks, usize)>,
    /// Time between the records of a sequence \[s\].
    pub pause: f64,
    /// Synthetic records after them.
    pub synthetic: Vec<SyntheticMotion>,
}

tables! {
    /// Records from files, and synthetic ones after them.
    #[derive(Clone, Debug)]
    pub struct RecordsTable {
        /// Files, folders and patterns with * and ?, relative to the study file.
        #[serde(default)]
        files: Vec<Spanned<String>>,
        /// Sequences of records that follow each other, such as a main shock and an aftershock: each a list
        /// of files, or of tables with options of their own. A list of one is a single record among them.
        #[serde(default)]
        sequences: Vec<Spanned<Shocks>>,
        /// Time between the records of a sequence \[s\].
        #[key(minimum = 0, maximum = LONGEST_TAIL, default = DEFAULT_PAUSE)]
        pause: Option<Spanned<f64>>,
        /// A list of records with scale factors and weights, as selectors write it: a table, or its folder.
        selection: Option<Spanned<String>>,
        /// Which of the two horizontal components of a list is taken; by default both, as two records.
        #[key(minimum = 1, maximum = 2)]
        component: Option<Spanned<u64>>,
        /// Unit: m/s2, cm/s2, mm/s2 or g, for files that do not state theirs.
        unit: Option<Unit>,
        /// Time between samples \[s\], likewise.
        step: Option<f64>,
        /// Column of tables (CSV or text).
        column: Option<String>,
        /// Channel of records with several, by its number.
        channel: Option<String>,
        /// Format of the files, if their content does not tell.
        format: Option<Format>,
        /// Synthetic motions.
        synthetic: Option<SyntheticRecords>,
    }

    /// The project's synthetic motions, of consecutive seeds.
    #[derive(Clone, Copy, Debug)]
    struct SyntheticRecords {
        /// Number of records.
        #[key(minimum = 1, maximum = MOST_RECORDS.cast_signed())]
        count: u64,
        /// Seed of the first one.
        seed: Option<u64>,
        /// Length \[s\].
        duration: Option<f64>,
        /// Step \[s\].
        step: Option<f64>,
    }
}

/// Reads the table `[records]`.
///
/// # Errors
/// [`FileError`] with file, line, value and remedy.
pub fn records(
    table: &Spanned<RecordsTable>,
    stripes: Vec<Selection>,
    place: &Place<'_>,
) -> Result<RecordsEntry, FileError> {
    let spec = table.get_ref();
    let is_empty = spec.files.is_empty()
        && spec.selection.is_none()
        && spec.sequences.is_empty()
        && spec.synthetic.is_none();
    if !(stripes.is_empty() || is_empty) {
        let message = "the records of stripes stand in the lists of [[levels.stripe]]; leave files, \
                       selection, sequences and synthetic out of [records]";
        return Err(place.error(table.span(), message));
    }
    if is_empty && stripes.is_empty() {
        let message = "[records] needs files = [...], selection = \"…\", sequences = [[...], ...] or \
                       synthetic = { count = ... }";
        return Err(place.error(table.span(), message));
    }
    if let (Some(component), None, []) = (&spec.component, &spec.selection, &stripes[..]) {
        let message = "component is that of a list; name one by selection = \"…\", or leave component out";
        return Err(place.error(component.span(), message));
    }
    // beside sequences, a single record keeps its place among them
    let has_sequence = spec.sequences.iter().any(|shocks| shocks.get_ref().0.len() > 1);
    let single = spec.sequences.first().filter(|_| !has_sequence).map(Spanned::span);
    let unused = spec.pause.as_ref().filter(|_| spec.sequences.is_empty()).map(Spanned::span);
    if let Some(span) = single.or(unused) {
        let message = "a sequence is a list of two records or more, between which is the pause; put a single \
                       record in files, and leave pause out where there is no sequence";
        return Err(place.error(span, message));
    }
    let sequences =
        spec.sequences.iter().map(|one| (one.get_ref().clone(), place.line(one.span()))).collect();
    let pause = spec.pause.as_ref().map_or(DEFAULT_PAUSE, |pause| *pause.get_ref());
    let RecordsTable { unit, step, format, .. } = *spec;
    let (column, channel) = (spec.column.clone(), spec.channel.clone());
    let options = RecordOptions { unit, step, column, channel, format };
    let files = spec.files.iter().map(|file| (file.get_ref().clone(), place.line(file.span()))).collect();
    let mut synthetic = Vec::new();
    if let Some(recipe) = &spec.synthetic {
        let SyntheticRecords { count, seed, duration, step } = *recipe;
        let default = SyntheticMotion::default();
        let first = seed.unwrap_or(default.seed);
        synthetic.extend((0..count).map(|k| SyntheticMotion {
            seed: first.wrapping_add(k),
            duration: duration.unwrap_or(default.duration),
            step: step.unwrap_or(default.step),
            ..default
        }));
    }
    let list = |list: &Spanned<String>| {
        let (path, line) = (list.get_ref().clone(), place.line(list.span()));
        Selection { path, line, stripe: None }
    };
    let selections = spec.selection.iter().map(list).chain(stripes).collect();
    let component = spec.component.as_ref().map(|component| *component.get_ref());
    Ok(RecordsEntry { files, selections, component, options, sequences, pause, synthetic })
}

/// A record file of a study.
pub struct RecordFile {
    /// Path.
    pub path: PathBuf,
    /// Whether the study names the file itself, and not its folder, a pattern or a list.
    is_named: bool,
    /// Of a list, what that states.
    listed: Option<ListedFile>,
}

/// Returns the files that records are read from, their lists among them.
pub fn inputs(entry: &RecordsEntry, files: Vec<RecordFile>, folder: &Path) -> Vec<PathBuf> {
    let lists = entry.selections.iter().map(|list| selection::list_of(&folder.join(&list.path)));
    let files = lists.flatten().chain(files.into_iter().map(|file| file.path));
    files.chain(entry.sequence_files(folder)).collect()
}

/// Lists the record files of a study, in the order of its patterns.
///
/// # Errors
/// [`FileError`] of a pattern that matches no file.
pub fn record_files(entry: &RecordsEntry, folder: &Path, study: &str) -> Result<Vec<RecordFile>, FileError> {
    let mut listed: Vec<RecordFile> = Vec::new();
    for (pattern, line) in &entry.files {
        let place = folder.join(pattern);
        let is_named = place.is_file();
        let found = files(folder, pattern).map_err(|reason| {
            let reason = format!("{pattern:?}: {reason}{}", escapes(pattern.as_ref()));
            FileError::on_line(study, *line, reason)
        })?;
        for path in found {
            // a file that two patterns match is one record
            match listed.iter_mut().find(|file| file.path == path) {
                Some(file) => file.is_named |= is_named,
                None => listed.push(RecordFile { path, is_named, listed: None }),
            }
        }
    }
    for Selection { path, line, stripe } in &entry.selections {
        let in_study = |reason| FileError::on_line(study, *line, format!("selection = {path:?}: {reason}"));
        let list = selection::list_of(&folder.join(path)).map_err(in_study)?;
        for mut file in selection::read(&list, entry.component)? {
            file.listed.stripe = *stripe;
            let is_again = |other: &RecordFile| {
                let own = other.listed.as_ref().and_then(|listed| listed.listed.stripe);
                other.path == file.path && own == *stripe
            };
            if listed.iter().any(is_again) {
                let path = file.path.display();
                let reason =
                    format!("{path} is named above this line too, or by `files`; delete one of them");
                return Err(FileError::on_line(file.list, file.line, reason));
            }
            listed.push(RecordFile { path: file.path.clone(), is_named: false, listed: Some(file) });
        }
    }
    Ok(listed)
}

impl RecordsEntry {
    /// Returns the files of the sequences.
    pub fn sequence_files(&self, folder: &Path) -> Vec<PathBuf> {
        let records = self.sequences.iter().flat_map(|(shocks, _)| &shocks.0);
        records.map(|record| folder.join(&record.record)).collect()
    }
}

/// Reads the records of a study, in `folder`. Vertical ones of a folder or a pattern are left out, with a
/// warning.
///
/// # Errors
/// [`SceneError`] of a record that cannot be read, or if all are vertical.
pub fn all_records(
    entry: &RecordsEntry,
    files: &[RecordFile],
    folder: &Path,
    study: &str,
    warnings: &mut Vec<RecordWarning>,
) -> Result<Vec<NamedRecord>, SceneError> {
    let mut uses: BTreeMap<String, BTreeSet<&Path>> = BTreeMap::new();
    for RecordFile { path, .. } in files {
        uses.entry(file_name(path)).or_default().insert(path);
    }
    let mut records = Vec::with_capacity(files.len() + entry.synthetic.len());
    for RecordFile { path, is_named, listed } in files {
        let refused = |error: GroundMotionError| SceneError::Value { message: error.to_string() };
        let (mut options, mut own) = (entry.options.clone(), Listed::default());
        if let Some(file) = listed {
            (options.step, options.unit) = (file.step.or(options.step), file.unit.or(options.unit));
            own = file.listed;
        }
        let record = read(path, &options).map_err(refused)?;
        if record.is_vertical && !is_named {
            warnings.push(RecordWarning { path: path.clone(), reason: Reason::LeftOut });
            continue;
        }
        warnings.extend(RecordWarning::all(path, record.check().warnings));
        let motion = match listed {
            Some(file) if own.factor != 1.0 => record.motion.checked_scaled(own.factor).map_err(|error| {
                FileError::on_line(&file.list, file.line, format!("{}: {error}", path.display()))
            })?,
            _ => record.motion,
        };
        let name = file_name(path);
        // files with equal names go by their whole paths
        let name = if uses[&name].len() > 1 { path.display().to_string() } else { name };
        let name = own.stripe.map_or(name.clone(), |stripe| format!("{name} (stripe {})", stripe + 1));
        records.push(NamedRecord { listed: own, ..NamedRecord::new(name, motion) });
    }
    let names = sequence_names(entry, folder);
    for ((shocks, line), name) in entry.sequences.iter().zip(names) {
        let warn = |table: &RecordTable, record: &Record| {
            let file = folder.join(&table.record);
            for warning in RecordWarning::all(&file, record.check().warnings) {
                if !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
        };
        let motion = shocks.read(&entry.options, entry.pause, folder, warn);
        let motion = motion.map_err(|problem| FileError::on_line(study, *line, problem.to_string()))?;
        records.push(NamedRecord::new(name, motion));
    }
    if records.is_empty() && !files.is_empty() && entry.synthetic.is_empty() {
        let reason = "records: all are vertical, and records shake walls sideways; name horizontal ones";
        return Err(FileError::whole(study, reason).into());
    }
    for recipe in &entry.synthetic {
        let refused = |error| FileError::whole(study, format!("synthetic records: {error}"));
        let motion = recipe.motion().map_err(refused)?;
        records.push(NamedRecord::new(format!("synthetic {}", recipe.seed), motion));
    }
    Ok(records)
}

/// Names the sequences by their files: those with equal names by what their tables state beside the file,
/// and else by their whole paths.
fn sequence_names(entry: &RecordsEntry, folder: &Path) -> Vec<String> {
    let all = |name: &dyn Fn(&RecordTable) -> String| -> Vec<String> {
        let joined = |shocks: &Shocks| shocks.0.iter().map(name).collect::<Vec<_>>().join(" + ");
        entry.sequences.iter().map(|(shocks, _)| joined(shocks)).collect()
    };
    let short = |table: &RecordTable| file_name(&table.record);
    let whole = |table: &RecordTable| folder.join(&table.record).display().to_string();
    let ways = [
        all(&short),
        all(&|table| short(table) + &table.options()),
        all(&|table| whole(table) + &table.options()),
    ];
    let name = |place: usize| {
        let is_alone = |names: &&Vec<_>| names.iter().filter(|other| **other == names[place]).count() == 1;
        ways.iter().find(is_alone).unwrap_or(&ways[2])[place].clone()
    };
    (0..entry.sequences.len()).map(name).collect()
}

/// Groups the records that are one motion: their steps and samples are equal.
pub fn motions(records: &[NamedRecord]) -> Vec<Vec<&NamedRecord>> {
    let mut groups: Vec<Vec<&NamedRecord>> = Vec::new();
    for record in records {
        match groups.iter_mut().find(|group| group[0].motion == record.motion) {
            Some(group) => group.push(record),
            None => groups.push(vec![record]),
        }
    }
    groups
}

/// Warns of records that are one motion: a copy of a file, or a file that is named in two ways.
pub fn copies(records: &[NamedRecord]) -> Vec<String> {
    let copies = motions(records).into_iter().filter(|group| group.len() > 1);
    let warning = |group: Vec<&NamedRecord>| {
        let names: Vec<_> = group.iter().map(|record| format!("{:?}", record.name)).collect();
        format!(
            "records {} are the same motion, which counts {} times; keep one of them",
            names.join(", "),
            names.len()
        )
    };
    copies.map(warning).collect()
}

/// Lists the files of a folder in the order of their names, but for hidden ones and the times beside records.
///
/// # Errors
/// If the folder cannot be read.
pub fn folder_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let files = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    Ok(listed(files.collect::<std::io::Result<_>>()?))
}

fn listed(mut files: Vec<PathBuf>) -> Vec<PathBuf> {
    files.retain(|path| is_listed(path));
    files.sort();
    files
}

/// Lists the files of a folder, of a pattern, or the one file, in order of their names. Only `*` and `?` of
/// the pattern itself are marks, and nothing in the name of the study's folder.
fn files(folder: &Path, pattern: &str) -> Result<Vec<PathBuf>, Box<dyn std::error::Error>> {
    let path = folder.join(pattern);
    let found: Vec<PathBuf> = if path.is_dir() {
        folder_files(&path)?
    } else if path.is_file() {
        return Ok(vec![path]);
    } else {
        let folder = glob::Pattern::escape(folder.to_str().ok_or("expected a name in UTF-8")?);
        let pattern: String =
            pattern.chars().map(|c| if "[]".contains(c) { format!("[{c}]") } else { c.into() }).collect();
        let path = Path::new(&folder).join(pattern);
        listed(glob::glob(path.to_str().unwrap_or_default())?.collect::<Result<_, _>>()?)
    };
    if found.is_empty() {
        return Err(
            "no such file, no match, or a folder without files; name records beside the study file, \
                    such as records/*.AT2"
                .into(),
        );
    }
    Ok(found)
}

#[cfg(test)]
mod tests;
