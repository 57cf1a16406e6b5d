//! Tables of the earthquakes that records are of: magnitude and distance, row by row.

use files::{FileError, Place};
use ground_motion::columns::{Columns, Fault, Name, Numbers};

const FORMS: &str = "a table of records: a line of names with `record`, and `magnitude`, `distance_km` or \
                     both, and a row for each record";
/// The column of the records' names.
const RECORD: &str = "record";
/// Columns, the names of what they hold, and the most that there is.
const COLUMNS: [(&str, &str, f64); 2] =
    [("magnitude", "magnitude", 10.0), ("distance_km", "distance", 20_000.0)];

/// Other names of these columns, in small letters: the first as a whole, the others as beginnings of names.
const MEANT: [[&str; 4]; 2] = [["m", "mag", "mw", "ml"], ["r", "dist", "rjb", "rrup"]];

/// Magnitudes and distances of records.
#[derive(Clone, Debug, PartialEq)]
pub struct Events {
    file: String,
    names: Vec<&'static str>,
    /// The record and its values, in the order of the names.
    rows: Vec<(String, Vec<f64>)>,
}

impl Events {
    /// Reads a table with a column `record` and `magnitude`, `distance_km` \[km\] or both. Other columns are
    /// passed over.
    ///
    /// # Errors
    /// [`FileError`] with line, value and remedy: a column is missing, a cell is no number or outside its
    /// limits, a record stands there twice.
    pub fn read(file: &Place<'_>) -> Result<Self, FileError> {
        let in_file = |fault: Fault| file.error_on(fault.line(), fault.to_string());
        let columns =
            Columns::of_texts(file.text().trim_start_matches('\u{feff}'), FORMS).map_err(in_file)?;
        let place = |wanted: &str| columns.names().iter().position(|name| name.written() == wanted);
        let missing = |what: &str| {
            let found: Vec<_> = columns.names().iter().map(Name::written).collect();
            let message = format!("no column {what}; expected {FORMS}, found {}", found.join(", "));
            file.error_on(columns.line(), message)
        };
        let record = place(RECORD).ok_or_else(|| missing("`record`"))?;
        let given: Vec<_> = COLUMNS.iter().filter_map(|column| Some((column, place(column.0)?))).collect();
        if given.is_empty() {
            return Err(missing("`magnitude` or `distance_km`"));
        }
        for (wanted, [initial, starts @ ..]) in COLUMNS.iter().map(|column| column.0).zip(MEANT) {
            let is_meant = |name: &&str| {
                let name = name.to_lowercase();
                name == initial || starts.iter().any(|start| name.starts_with(start))
            };
            let found = columns.names().iter().map(Name::written).find(is_meant);
            if let Some(name) = found.filter(|_| place(wanted).is_none()) {
                let message =
                    format!("unknown column {name:?} (did you mean {wanted:?}?); rename or delete it");
                return Err(file.error_on(columns.line(), message));
            }
        }
        let mut numbers = Numbers::new(&columns);
        let mut rows: Vec<(String, Vec<f64>)> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for row in columns.rows() {
            let row = row.map_err(in_file)?;
            let cells: Vec<_> = row.cells().collect();
            let name = cells.get(record).map_or_else(String::new, |cell| cell.trim().to_owned());
            let refuse = |message: String| file.error_on(row.line, message);
            if !seen.insert(name.clone()) {
                return Err(refuse(format!("the record {name:?} is listed twice; delete one row")));
            }
            let mut values = Vec::with_capacity(given.len());
            for &(&(column, _, most), place) in &given {
                let cell = cells.get(place).map_or("", |cell| cell.trim());
                let of = |message: String| refuse(format!("{column} of the record {name:?}: {message}"));
                if cell.is_empty() {
                    return Err(of("the cell is empty; write the value, or delete the row".to_owned()));
                }
                let value = numbers.real(cell, row.line).map_err(|fault| of(fault.to_string()))?;
                if !(0.0..=most).contains(&value) {
                    return Err(of(format!("{value} must be from 0 to {most}")));
                }
                values.push(value);
            }
            rows.push((name, values));
        }
        Ok(Self {
            file: file.name().to_owned(),
            names: given.iter().map(|(column, _)| column.1).collect(),
            rows,
        })
    }

    /// Returns the features of some records: names, and the value of each record.
    ///
    /// # Errors
    /// The reason: the table does not have a record.
    pub(super) fn of(&self, records: &[&str]) -> Result<Vec<(String, Vec<f64>)>, String> {
        let row = |record: &&str| {
            let found = self.rows.iter().find(|(name, _)| name == record).map(|(_, values)| values);
            found.ok_or_else(|| {
                format!("{} has no record {record:?}; add a row with this name, that of its file", self.file)
            })
        };
        let rows = records.iter().map(row).collect::<Result<Vec<_>, _>>()?;
        let column = |(place, name): (usize, &&str)| {
            ((*name).to_owned(), rows.iter().map(|values| values[place]).collect())
        };
        Ok(self.names.iter().enumerate().map(column).collect())
    }
}
