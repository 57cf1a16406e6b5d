//! A part of a study as Parquet: its curves, run by run, for this program and for others that read Parquet.
//!
//! The same curves give the same bytes. The footer holds the fingerprint of the study, the number of the part
//! and a checksum of the whole file.

use std::sync::Arc;

use crate::ida::{Curve, Run, TieDemand};
use bytes::Bytes;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};
use scene::fingerprint;

use super::contents::Contents;
use super::error::FolderError;

/// The column of intensities; its name ends with their SI unit.
const INTENSITY: &str = "intensity";
/// Columns with their types, and whether a run may lack a value: a wall that did not overturn has no time of
/// overturning, and only a collapse has a sensitivity. The intensity has the SI unit of the study, so that it
/// is read back to the last bit.
const COLUMNS: [(&str, Physical, Repetition); 12] = [
    ("case", Physical::INT64, Repetition::REQUIRED),
    ("wall", Physical::BYTE_ARRAY, Repetition::REQUIRED),
    ("model", Physical::BYTE_ARRAY, Repetition::REQUIRED),
    ("record", Physical::BYTE_ARRAY, Repetition::REQUIRED),
    (INTENSITY, Physical::DOUBLE, Repetition::REQUIRED),
    ("u_max_over_u_ins", Physical::DOUBLE, Repetition::REQUIRED),
    ("overturned", Physical::BOOLEAN, Repetition::REQUIRED),
    ("overturn_time_s", Physical::DOUBLE, Repetition::OPTIONAL),
    ("sensitivity", Physical::DOUBLE, Repetition::OPTIONAL),
    ("tie_force_n", Physical::DOUBLE, Repetition::OPTIONAL),
    ("tie_elongation_m", Physical::DOUBLE, Repetition::OPTIONAL),
    ("tie_broken", Physical::BOOLEAN, Repetition::OPTIONAL),
];
/// Number of the last columns, of a study with ties that may yield.
const OF_TIES: usize = 3;
/// Key of our entry in the footer.
const KEY: &str = "rocking-wall";
/// The word before the checksum, which is zero while it is computed.
const CHECKSUM: &str = "checksum ";
const NO_CHECKSUM: &[u8; 32] = &[b'0'; 32];

/// Writes the curves of a part, in the order of their numbers. `study` is the fingerprint of the contents.
///
/// # Errors
/// [`FolderError::Parquet`].
///
/// # Panics
/// If there is not one curve for each combination of the part.
pub fn encode(
    contents: &Contents,
    study: &str,
    part: usize,
    curves: &[Curve],
) -> Result<Vec<u8>, FolderError> {
    assert_eq!(curves.len(), contents.part(part).len(), "one curve for each combination");
    let written = write(contents, study, part, curves);
    let mut bytes = written.map_err(|source| FolderError::Parquet { part, source: source.into() })?;
    let at = place_of_checksum(&bytes).unwrap_or_else(|| unreachable!("the footer has been written"));
    let checksum = fingerprint(&bytes);
    bytes[at..at + NO_CHECKSUM.len()].copy_from_slice(checksum.as_bytes());
    Ok(bytes)
}

/// Reads the curves of a part; `None` if it is damaged or that of another study or number.
pub fn decode(contents: &Contents, study: &str, part: usize, mut bytes: Vec<u8>) -> Option<Vec<Curve>> {
    let at = place_of_checksum(&bytes)?;
    let stated = bytes.get(at..at + NO_CHECKSUM.len())?.to_vec();
    bytes[at..at + NO_CHECKSUM.len()].copy_from_slice(NO_CHECKSUM);
    if fingerprint(&bytes).as_bytes() != stated {
        return None;
    }
    let reader = SerializedFileReader::new(Bytes::from(bytes)).ok()?;
    let footer = reader.metadata().file_metadata().key_value_metadata()?;
    let entry = footer.iter().find(|entry| entry.key == KEY)?.value.as_deref()?;
    if !entry.starts_with(&head(study, part)) {
        return None;
    }
    read(contents, part, &reader).ok().flatten()
}

/// Finds where the checksum stands in the footer, which is at the end.
fn place_of_checksum(bytes: &[u8]) -> Option<usize> {
    let word = CHECKSUM.as_bytes();
    bytes.windows(word.len()).rposition(|window| window == word).map(|at| at + word.len())
}

fn head(study: &str, part: usize) -> String {
    format!("study {study} part {part} ")
}

fn write(contents: &Contents, study: &str, part: usize, curves: &[Curve]) -> Result<Vec<u8>, ParquetError> {
    let count = COLUMNS.len() - if contents.has_yielding_ties() { 0 } else { OF_TIES };
    let intensity = format!("{INTENSITY}{}", contents.unit.si_ending());
    let columns = COLUMNS[..count].iter().map(|&(name, physical, repetition)| {
        (if name == INTENSITY { &*intensity } else { name }, physical, repetition)
    });
    let field = |(name, physical, repetition): (&str, Physical, Repetition)| {
        let text = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        let builder = Type::primitive_type_builder(name, physical);
        Ok(Arc::new(builder.with_repetition(repetition).with_logical_type(text).build()?))
    };
    let fields = columns.clone().map(field).collect::<Result<_, ParquetError>>()?;
    let schema = Arc::new(Type::group_type_builder("runs").with_fields(fields).build()?);
    let zero = String::from_utf8_lossy(NO_CHECKSUM);
    let entry = KeyValue::new(KEY.to_owned(), format!("{}{CHECKSUM}{zero}", head(study, part)));
    let mut properties = WriterProperties::builder()
        .set_created_by(contents.program.clone())
        .set_key_value_metadata(Some(vec![entry]))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true);
    for (name, ..) in columns.filter(|(_, physical, _)| *physical == Physical::DOUBLE) {
        // these numbers hardly repeat, so that a dictionary would not help
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(name), false);
    }
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties.build()))?;
    let mut group = writer.next_row_group()?;
    rows(contents, part, curves, &mut group)?;
    group.close()?;
    writer.into_inner()
}

fn rows(
    contents: &Contents,
    part: usize,
    curves: &[Curve],
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
) -> Result<(), ParquetError> {
    let curves = contents.part(part).zip(curves);
    let runs: Vec<(usize, &Run)> = curves
        .flat_map(|(index, curve)| {
            curve.before().into_iter().chain(curve.runs()).map(move |run| (index, run))
        })
        .collect();
    column::<Int64Type>(group, runs.iter().map(|(index, _)| i64::try_from(*index).ok()))?;
    let names: [fn(&Contents, usize) -> &str; 3] = [
        |contents, index| &contents.walls[contents.case(index).wall].name,
        |contents, index| &contents.models[contents.case(index).model].name,
        |contents, index| &contents.records[contents.case(index).record].name,
    ];
    for name in names {
        let texts = runs.iter().map(|(index, _)| Some(ByteArray::from(name(contents, *index))));
        column::<ByteArrayType>(group, texts)?;
    }
    column::<DoubleType>(group, runs.iter().map(|(_, run)| Some(run.intensity)))?;
    column::<DoubleType>(group, runs.iter().map(|(_, run)| Some(run.demand)))?;
    column::<BoolType>(group, runs.iter().map(|(_, run)| Some(run.overturning.is_some())))?;
    column::<DoubleType>(group, runs.iter().map(|(_, run)| run.overturning))?;
    column::<DoubleType>(group, runs.iter().map(|(_, run)| run.sensitivity))?;
    if contents.has_yielding_ties() {
        column::<DoubleType>(group, runs.iter().map(|(_, run)| Some(run.tie?.force)))?;
        column::<DoubleType>(group, runs.iter().map(|(_, run)| Some(run.tie?.elongation)))?;
        column::<BoolType>(group, runs.iter().map(|(_, run)| Some(run.tie?.broken)))?;
    }
    Ok(())
}

/// Writes the next column.
fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let values: Vec<Option<T::T>> = values.collect();
    let present: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    if let Some(mut column) = group.next_column()? {
        let known: Vec<T::T> = values.into_iter().flatten().collect();
        column.typed::<T>().write_batch(&known, Some(&present), None)?;
        column.close()?;
    }
    Ok(())
}

/// Reads the curves; `None` where they are not those of the part.
fn read(
    contents: &Contents,
    part: usize,
    reader: &SerializedFileReader<Bytes>,
) -> Result<Option<Vec<Curve>>, ParquetError> {
    let group = reader.get_row_group(0)?;
    let cases = values::<Int64Type>(&*group, 0)?;
    let [intensities, demands, times, sensitivities] =
        [4, 5, 7, 8].map(|column| values::<DoubleType>(&*group, column));
    let numbers = intensities?.into_iter().zip(demands?).zip(times?.into_iter().zip(sensitivities?));
    let mut ties = if contents.has_yielding_ties() { ties(&*group)? } else { Vec::new() }.into_iter();
    let range = contents.part(part);
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); range.len()];
    for (case, ((intensity, demand), (overturning, sensitivity))) in cases.into_iter().zip(numbers) {
        let place = case.and_then(|case| usize::try_from(case).ok()?.checked_sub(range.start));
        let (Some(intensity), Some(demand), Some(runs)) =
            (intensity, demand, place.and_then(|place| runs.get_mut(place)))
        else {
            return Ok(None);
        };
        let run = Run { intensity, demand, overturning, tie: ties.next().flatten(), sensitivity };
        if !is_possible(&run) {
            return Ok(None);
        }
        runs.push(run);
    }
    let is_complete = runs.iter().all(|runs| !runs.is_empty());
    Ok(is_complete.then(|| runs.into_iter().map(Curve::new).collect()))
}

/// Reads the demands on ties, row by row.
fn ties(group: &dyn RowGroupReader) -> Result<Vec<Option<TieDemand>>, ParquetError> {
    let first = COLUMNS.len() - OF_TIES;
    let forces = values::<DoubleType>(group, first)?.into_iter();
    let demands =
        forces.zip(values::<DoubleType>(group, first + 1)?).zip(values::<BoolType>(group, first + 2)?);
    let demand = |((force, elongation), broken): ((Option<f64>, Option<f64>), Option<bool>)| {
        Some(TieDemand { force: force?, elongation: elongation?, broken: broken? })
    };
    Ok(demands.map(demand).collect())
}

/// Reads a column, row by row.
fn values<T: DataType>(group: &dyn RowGroupReader, column: usize) -> Result<Vec<Option<T::T>>, ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    let mut reader = get_typed_column_reader::<T>(group.get_column_reader(column)?);
    let (mut values, mut present) = (Vec::with_capacity(rows), Vec::new());
    reader.read_records(rows, Some(&mut present), None, &mut values)?;
    if COLUMNS[column].2 == Repetition::REQUIRED {
        return Ok(values.into_iter().map(Some).collect());
    }
    let mut values = values.into_iter();
    Ok(present.into_iter().map(|present| if present > 0 { values.next() } else { None }).collect())
}

fn is_possible(run: &Run) -> bool {
    let is_measure = |number: f64| number.is_finite() && number >= 0.0;
    let tie = run.tie.iter().flat_map(|tie| [tie.force, tie.elongation]);
    let measures =
        [run.intensity, run.demand].into_iter().chain(run.overturning).chain(run.sensitivity).chain(tie);
    measures.into_iter().all(is_measure)
}
