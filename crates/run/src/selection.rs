//! Lists of records as selectors write them: files, scale factors and weights.
//!
//! | list | files | factors |
//! |---|---|---|
//! | a table (CSV or text) with a column of files | beside it | applied |
//! | `_SearchResults.csv` of PEER NGA-West2 | beside it, "unscaled, as recorded" | applied |
//! | the folder of `EzGM`, with `GMR_names.txt` or `GMR_H1_names.txt` | in it, in g | in the samples |
//!
//! Layouts: a search report of PEER of 2022; `EzGM`, whose `write` multiplies each record by its factor, and
//! tells the factors in `GMR_sf_used.txt`.

use std::path::{Path, PathBuf};

use files::{FileError, read_text, suggestion};
use ground_motion::Unit;
use ground_motion::columns::{Columns, Fault, Name, Numbers};

/// Largest list that is read.
const MAX_FILE_BYTES: u64 = 64 << 20;
/// Most lines above the names of the columns: PEER writes its search criteria there.
const MOST_LINES_ABOVE: usize = 100;
/// Largest factor, weight and step \[s\].
const LARGEST: f64 = 1e5;
/// What a folder may have: the list of PEER, a table, names of `EzGM` with one and with two components.
const LISTS: [&str; 4] = ["_SearchResults.csv", "selection.csv", "GMR_names.txt", "GMR_H1_names.txt"];
/// Column of files of PEER, whose reports go on below the list with notes and spectra.
const FILES_OF_PEER: &str = "Horizontal-1 Acc. Filename";
const FORMS: &str = "a list of records: a line of names with `file`, and a row for each record";

/// What a list says of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listed {
    /// Factor by which its samples have been multiplied \[-\].
    pub factor: f64,
    /// Weight beside other records \[-\]: those of a list have a mean of 1.
    pub weight: f64,
    /// Place of the stripe whose list has it, in a study of stripes.
    pub stripe: Option<usize>,
}

/// A list of records that a file names.
#[derive(Clone, Debug)]
pub struct Selection {
    /// Table or folder, relative to the file.
    pub path: String,
    /// Line that names it.
    pub line: usize,
    /// Place of the stripe whose list it is.
    pub stripe: Option<usize>,
}

impl Default for Listed {
    fn default() -> Self {
        Self { factor: 1.0, weight: 1.0, stripe: None }
    }
}

/// A record of a list.
#[derive(Clone, Debug)]
pub(crate) struct ListedFile {
    pub(crate) path: PathBuf,
    /// List that has it.
    pub(crate) list: String,
    /// Line of the list, from 1.
    pub(crate) line: usize,
    pub(crate) listed: Listed,
    /// Step \[s\] and unit that the list states, for files without their own.
    pub(crate) step: Option<f64>,
    pub(crate) unit: Option<Unit>,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Files of the first, or only, and of the second horizontal component.
    File,
    Second,
    Factor,
    Weight,
    Step,
    Unit,
}

/// Names of columns in small letters, without blanks, marks and units.
const ROLES: [(Role, &str); 6] = [
    (Role::File, "file filename record file1 filename1 record1 h1 horizontal1accfilename"),
    (Role::Second, "file2 filename2 record2 h2 horizontal2accfilename"),
    (Role::Factor, "scalefactor factor sf scale scalingfactor"),
    (Role::Weight, "weight weights w"),
    (Role::Step, "dt step timestep"),
    (Role::Unit, "unit units"),
];
/// Names that a column may have been meant to have.
const MEANT: [&str; 6] = ["scale_factor", "factor", "weight", "step", "unit", "file"];

impl Role {
    fn of(name: &Name) -> Option<Self> {
        let plain = plain(name);
        let known = |(_, names): &&(Self, &str)| names.split(' ').any(|name| name == plain);
        ROLES.iter().find(known).map(|(role, _)| *role)
    }

    /// Returns what may stand as the unit in the name of a column, if its values have one unit alone.
    fn units(self) -> Option<&'static [&'static str]> {
        match self {
            Self::Factor | Self::Weight => Some(&["", "-", "1"]),
            Self::Step => Some(&["", "s", "sec"]),
            Self::File | Self::Second | Self::Unit => None,
        }
    }
}

/// Returns a name in small letters, without blanks, marks and its unit.
fn plain(name: &Name) -> String {
    name.text().chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_ascii_lowercase()
}

/// Returns the file that lists the records of a selection: a table, or one in a folder.
pub(crate) fn list_of(path: &Path) -> Result<PathBuf, String> {
    let known = LISTS.iter().map(|name| path.join(name));
    let found = [path.to_owned()].into_iter().chain(known).find(|path| path.is_file());
    found.ok_or_else(|| {
        let known = LISTS.join(", ");
        let remedy = "name a table of records, or a folder that has one of";
        let other = "records without a list go into files = [...]";
        format!("no such list; {remedy} {known}; {other}{}", ground_motion::escapes(path))
    })
}

/// Reads the records of a list; `component` is 1 or 2 where one of two is taken.
pub(crate) fn read(list: &Path, component: Option<u64>) -> Result<Vec<ListedFile>, FileError> {
    let (file, folder) = (list.display().to_string(), list.parent().unwrap_or(Path::new(".")));
    let is_ezgm = LISTS[2..].iter().any(|name| list.ends_with(name));
    let text = read_text(list, "a list of records", MAX_FILE_BYTES)?;
    let text = if is_ezgm { of_ezgm(list, &text)? } else { table(text.trim_start_matches('\u{feff}')) };
    let in_file = |fault: Fault| FileError::on_line(&file, fault.line(), fault.to_string());
    let columns = Columns::of_texts(&text, FORMS).map_err(in_file)?;
    let roles: Vec<_> = columns.names().iter().map(Role::of).collect();
    check(&columns, &roles).map_err(|reason| FileError::on_line(&file, columns.line(), reason))?;
    let place = |role| roles.iter().position(|own| *own == Some(role));
    let (mut numbers, mut files) = (Numbers::new(&columns), Vec::new());
    for row in columns.rows() {
        let row = row.map_err(in_file)?;
        // the names of the columns stand above those of EzGM
        let line = row.line - usize::from(is_ezgm);
        let refuse = |reason: String| FileError::on_line(&file, line, reason);
        let cells: Vec<_> = row.cells().collect();
        let mut number = |role: Role| {
            let Some(place) = place(role) else { return Ok(None) };
            let of = |reason: String| refuse(format!("{}: {reason}", columns.names()[place].written()));
            let value = numbers.real(&cells[place], row.line).map_err(|fault| of(fault.to_string()))?;
            let range = || of(format!("{value} must be above 0, at most 1e5"));
            Some(value).filter(|value| *value > 0.0 && *value <= LARGEST).ok_or_else(range).map(Some)
        };
        let listed = Listed {
            factor: number(Role::Factor)?.unwrap_or(1.0),
            weight: number(Role::Weight)?.unwrap_or(1.0),
            stripe: None,
        };
        let step = number(Role::Step)?;
        let unit = match place(Role::Unit) {
            Some(place) => Some(cells[place].parse().map_err(|error| refuse(format!("unit: {error}")))?),
            None => is_ezgm.then_some(Unit::StandardGravity),
        };
        let is_taken = |(_, number): &(usize, u64)| component.is_none_or(|taken| taken == *number);
        let components = [Role::File, Role::Second].into_iter().filter_map(place).zip(1..);
        for (place, number) in components.filter(is_taken) {
            // PEER writes dashes where there is no component
            let is_missing = cells[place].trim_matches(['-', ' ']).is_empty();
            if is_missing && number == 2 && component.is_none() {
                continue;
            }
            if is_missing {
                let name = columns.names()[place].written();
                let reason = "the row has no such component; name its file, or delete the row";
                return Err(refuse(format!("{name}: {reason}")));
            }
            let path = folder.join(cells[place].replace('\\', "/"));
            if !path.is_file() {
                let remedy = "put the file there, or correct the row";
                return Err(refuse(format!("{} does not exist; {remedy}", path.display())));
            }
            files.push(ListedFile { path, list: file.clone(), line, listed, step, unit });
        }
    }
    if files.is_empty() {
        let reason = match component {
            Some(2) => {
                "lists no second component; write its file in a column `file2`, or leave component out"
            }
            _ => "lists no record; write a row for each",
        };
        return Err(FileError::whole(file, reason));
    }
    let mean = files.iter().map(|file| file.listed.weight).sum::<f64>() / files.len() as f64;
    let weighed = |file: ListedFile| {
        let listed = Listed { weight: file.listed.weight / mean, ..file.listed };
        ListedFile { listed, ..file }
    };
    Ok(files.into_iter().map(weighed).collect())
}

/// Checks the names of the columns.
fn check(columns: &Columns<'_>, roles: &[Option<Role>]) -> Result<(), String> {
    let names: Vec<_> = columns.names().iter().map(Name::written).collect();
    if names.iter().any(|name| name.starts_with("gmv_")) {
        let reason = "ground-motion fields of OpenQuake are intensities of events at sites, not \
                      accelerograms; select records for them, and list these";
        return Err(reason.to_owned());
    }
    if !roles.contains(&Some(Role::File)) {
        let found = names.join(", ");
        return Err(format!(
            "no column of files; name one `file`, beside `scale_factor` and `weight`; found {found}"
        ));
    }
    for (place, column) in columns.names().iter().enumerate() {
        let name = names[place];
        let Some(role) = roles[place] else {
            check_unknown(column, roles)?;
            continue;
        };
        if let Some(twin) = (0..place).find(|twin| roles[*twin] == Some(role)) {
            return Err(format!("{:?} and {name:?} state the same; delete one column", names[twin]));
        }
        let unit = column.unit().unwrap_or(if name.ends_with('%') { "%" } else { "" });
        if let Some(units) = role.units().filter(|units| !units.contains(&unit)) {
            let remedy = "convert the values, and name the column without a unit";
            let expected = if units.contains(&"s") { "s" } else { "plain numbers" };
            return Err(format!("{name:?} is in {unit:?}, but its values are read as {expected}; {remedy}"));
        }
    }
    Ok(())
}

/// Refuses the name of an unknown column that may be meant to be a factor, a weight or another known one.
fn check_unknown(name: &Name, roles: &[Option<Role>]) -> Result<(), String> {
    let plain = plain(name);
    // numbered columns, such as file_3, are other components
    let is_word = plain.len() > 3 && !plain.contains(|c: char| c.is_ascii_digit());
    let slip = suggestion(&plain, MEANT.into_iter().filter(|_| is_word));
    let says = |words: &[&str]| words.iter().any(|word| plain.contains(word));
    let meant = if !slip.is_empty() {
        slip
    } else if says(&["weight"]) && !roles.contains(&Some(Role::Weight)) {
        " (did you mean \"weight\"?)".to_owned()
    } else if says(&["factor", "scal", "multipl"]) && !roles.contains(&Some(Role::Factor)) {
        " (did you mean \"scale_factor\"?)".to_owned()
    } else {
        return Ok(());
    };
    Err(format!("unknown column {:?}{meant}; rename or delete it", name.written()))
}

/// Makes a table of the names and steps of `EzGM`, which stand line by line in files of their own.
fn of_ezgm(list: &Path, names: &str) -> Result<String, FileError> {
    let other = |name: &str| read_text(&list.with_file_name(name), "a list of EzGM", MAX_FILE_BYTES);
    let second = if list.ends_with(LISTS[3]) { Some(other("GMR_H2_names.txt")?) } else { None };
    let steps = other("GMR_dts.txt")?;
    let columns = [("file", Some(names)), ("file2", second.as_deref()), ("dt", Some(&steps))];
    let column = |(name, text): (_, Option<_>)| Some([name].into_iter().chain(str::lines(text?)).collect());
    let columns: Vec<Vec<&str>> = columns.into_iter().filter_map(column).collect();
    if columns.iter().any(|column| column.len() != columns[0].len()) {
        let counts: Vec<_> =
            columns.iter().map(|column| format!("{} of {}", column.len() - 1, column[0])).collect();
        let reason = format!("{} beside each other; write a line for each record", counts.join(", "));
        return Err(FileError::whole(list.display().to_string(), reason));
    }
    let row = |place: usize| columns.iter().map(|column| column[place]).collect::<Vec<_>>().join(";");
    Ok((0..columns[0].len()).map(row).collect::<Vec<_>>().join("\n"))
}

/// Cuts the table out of a report with text above it, and that of PEER out of the text below it, too; blank
/// lines keep the numbers of its lines. A text without a column of files stays as it is.
fn table(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_heading = |line: &&str| {
        let columns = Columns::of_texts(line, FORMS);
        columns.is_ok_and(|columns| columns.names().iter().any(|name| Role::of(name) == Some(Role::File)))
    };
    let is_blank = |line: &&str| line.chars().all(|c| c.is_whitespace() || ",;".contains(c));
    let is_text = |line: &&str| !(is_blank(line) || line.starts_with(['#', '%']));
    let start = lines.iter().take(MOST_LINES_ABOVE).position(is_heading).unwrap_or(0);
    if !lines[..start].iter().any(is_text) {
        return text.to_owned();
    }
    let is_of_peer = lines[start].contains(FILES_OF_PEER);
    let rows: Vec<_> =
        lines[start..].iter().take_while(|line| !(is_of_peer && is_blank(line))).copied().collect();
    "\n".repeat(start) + &rows.join("\n")
}
