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
use rocking_wall::scene::fingerprint;

use super::contents::Contents;
use super::error::FolderError;

/// The column of intensities; its name ends with their SI unit.
const INTENSITY: &str = "intensity";
/// Columns with their types. The intensity has the SI unit of the study, so that it is read back to the last
/// bit. A wall that did not overturn has no time of overturning, and only a collapse has a sensitivity.
const COLUMNS: [(&str, Physical); 9] = [
    ("case", Physical::INT64),
    ("wall", Physical::BYTE_ARRAY),
    ("model", Physical::BYTE_ARRAY),
    ("record", Physical::BYTE_ARRAY),
    (INTENSITY, Physical::DOUBLE),
    ("u_max_over_u_ins", Physical::DOUBLE),
    ("overturned", Physical::BOOLEAN),
    ("overturn_time_s", Physical::DOUBLE),
    ("sensitivity", Physical::DOUBLE),
];
/// Further columns of a study with ties that may yield. Runs of its other walls have no values there.
const TIE_COLUMNS: [(&str, Physical); 3] = [
    ("tie_force_n", Physical::DOUBLE),
    ("tie_elongation_m", Physical::DOUBLE),
    ("tie_broken", Physical::BOOLEAN),
];
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
    let column = |&(name, physical): &(&str, Physical)| {
        let text = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        let is_optional = ["overturn_time_s", "sensitivity"].contains(&name) || name.starts_with("tie_");
        let repetition = if is_optional { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let builder = Type::primitive_type_builder(name, physical);
        Ok(Arc::new(builder.with_repetition(repetition).with_logical_type(text).build()?))
    };
    let ties = if contents.has_yielding_ties() { &TIE_COLUMNS[..] } else { &[] };
    let intensity = format!("{INTENSITY}{}", contents.unit.si_ending());
    let named = |&(name, physical)| (if name == INTENSITY { intensity.as_str() } else { name }, physical);
    let columns: Vec<(&str, Physical)> = COLUMNS.iter().chain(ties).map(named).collect();
    let fields = columns.iter().map(column).collect::<Result<_, ParquetError>>()?;
    let schema = Arc::new(Type::group_type_builder("runs").with_fields(fields).build()?);
    let zero = String::from_utf8_lossy(NO_CHECKSUM);
    let entry = KeyValue::new(KEY.to_owned(), format!("{}{CHECKSUM}{zero}", head(study, part)));
    let mut properties = WriterProperties::builder()
        .set_created_by(contents.program.clone())
        .set_key_value_metadata(Some(vec![entry]))
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true);
    for (name, _) in columns.iter().filter(|(_, physical)| *physical == Physical::DOUBLE) {
        // these numbers hardly repeat, so that a dictionary would not help
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(*name), false);
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
    let runs: Vec<(usize, &Run)> = contents
        .part(part)
        .zip(curves)
        .flat_map(|(index, curve)| curve.runs().iter().map(move |run| (index, run)))
        .collect();
    let cases: Vec<i64> = runs.iter().map(|&(index, _)| index.try_into().unwrap_or(i64::MAX)).collect();
    column::<Int64Type>(group, &cases, None)?;
    let names: [fn(&Contents, usize) -> &str; 3] = [
        |contents, index| &contents.walls[contents.case(index).wall].name,
        |contents, index| &contents.models[contents.case(index).model].name,
        |contents, index| &contents.records[contents.case(index).record].name,
    ];
    for name in names {
        // all runs of a curve have the same text
        let texts: Vec<_> = contents
            .part(part)
            .zip(curves)
            .flat_map(|(index, curve)| {
                std::iter::repeat_n(ByteArray::from(name(contents, index)), curve.runs().len())
            })
            .collect();
        column::<ByteArrayType>(group, &texts, None)?;
    }
    let numbers = |number: fn(&Run) -> f64| runs.iter().map(|(_, run)| number(run)).collect::<Vec<_>>();
    column::<DoubleType>(group, &numbers(|run| run.intensity), None)?;
    column::<DoubleType>(group, &numbers(|run| run.demand), None)?;
    let overturned: Vec<bool> = runs.iter().map(|(_, run)| run.overturning.is_some()).collect();
    column::<BoolType>(group, &overturned, None)?;
    for number in [|run: &Run| run.overturning, |run: &Run| run.sensitivity] {
        let numbers: Vec<Option<f64>> = runs.iter().map(|(_, run)| number(run)).collect();
        let present: Vec<i16> = numbers.iter().map(|number| i16::from(number.is_some())).collect();
        column::<DoubleType>(group, &numbers.into_iter().flatten().collect::<Vec<_>>(), Some(&present))?;
    }
    if !contents.has_yielding_ties() {
        return Ok(());
    }
    let ties: Vec<TieDemand> = runs.iter().filter_map(|(_, run)| run.tie).collect();
    let present: Vec<i16> = runs.iter().map(|(_, run)| i16::from(run.tie.is_some())).collect();
    for number in [|tie: &TieDemand| tie.force, |tie: &TieDemand| tie.elongation] {
        column::<DoubleType>(group, &ties.iter().map(number).collect::<Vec<_>>(), Some(&present))?;
    }
    column::<BoolType>(group, &ties.iter().map(|tie| tie.broken).collect::<Vec<_>>(), Some(&present))
}

/// Writes the next column; `present` says which rows have a value.
fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[T::T],
    present: Option<&[i16]>,
) -> Result<(), ParquetError> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(values, present, None)?;
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
    let (cases, _) = values::<Int64Type>(&*group, 0)?;
    let (intensities, _) = values::<DoubleType>(&*group, 4)?;
    let (demands, _) = values::<DoubleType>(&*group, 5)?;
    let times = optional::<DoubleType>(&*group, 7)?;
    let sensitivities = optional::<DoubleType>(&*group, 8)?;
    let mut ties = if contents.has_yielding_ties() { ties(&*group)? } else { Vec::new() }.into_iter();
    let range = contents.part(part);
    let mut runs: Vec<Vec<Run>> = vec![Vec::new(); range.len()];
    let rows = cases.into_iter().zip(intensities).zip(demands).zip(times).zip(sensitivities);
    for ((((case, intensity), demand), overturning), sensitivity) in rows {
        let run = Run { intensity, demand, overturning, tie: ties.next().flatten(), sensitivity };
        let place = usize::try_from(case).ok().and_then(|case| case.checked_sub(range.start));
        let Some(runs) = place.and_then(|place| runs.get_mut(place)).filter(|_| is_possible(&run)) else {
            return Ok(None);
        };
        runs.push(run);
    }
    let is_complete = runs.iter().all(|runs| !runs.is_empty());
    Ok(is_complete.then(|| runs.into_iter().map(Curve::new).collect()))
}

/// Reads the demands on ties, row by row.
fn ties(group: &dyn RowGroupReader) -> Result<Vec<Option<TieDemand>>, ParquetError> {
    let forces = optional::<DoubleType>(group, COLUMNS.len())?;
    let elongations = optional::<DoubleType>(group, COLUMNS.len() + 1)?;
    let broken = optional::<BoolType>(group, COLUMNS.len() + 2)?;
    let demands = forces.into_iter().zip(elongations).zip(broken);
    let demand = |((force, elongation), broken): ((Option<f64>, Option<f64>), Option<bool>)| {
        Some(TieDemand { force: force?, elongation: elongation?, broken: broken? })
    };
    Ok(demands.map(demand).collect())
}

/// Reads a column in which rows may have no value.
fn optional<T: DataType>(
    group: &dyn RowGroupReader,
    column: usize,
) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (values, present) = values::<T>(group, column)?;
    let mut values = values.into_iter();
    Ok(present.into_iter().map(|present| if present > 0 { values.next() } else { None }).collect())
}

/// Reads a column: its values, and which rows have one.
fn values<T: DataType>(
    group: &dyn RowGroupReader,
    column: usize,
) -> Result<(Vec<T::T>, Vec<i16>), ParquetError> {
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    let mut reader = get_typed_column_reader::<T>(group.get_column_reader(column)?);
    let (mut values, mut present) = (Vec::with_capacity(rows), Vec::new());
    reader.read_records(rows, Some(&mut present), None, &mut values)?;
    Ok((values, present))
}

fn is_possible(run: &Run) -> bool {
    let is_measure = |number: f64| number.is_finite() && number >= 0.0;
    let tie = run.tie.iter().flat_map(|tie| [tie.force, tie.elongation]);
    let measures =
        [run.intensity, run.demand].into_iter().chain(run.overturning).chain(run.sensitivity).chain(tie);
    run.intensity > 0.0 && measures.into_iter().all(is_measure)
}
