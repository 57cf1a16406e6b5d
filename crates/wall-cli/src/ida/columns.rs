//! Every run as Parquet: the columns of `levels.csv`.

use std::sync::Arc;

use anyhow::Result;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use study::ida::Curve;

use super::results::{Results, in_g};

/// The table in bytes; the same results give the same bytes.
pub(super) fn levels(results: &Results) -> Result<Vec<u8>> {
    let column = |name: &str, physical: Physical| {
        let text = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
        let repetition = if name == "overturn_time_s" { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let builder = Type::primitive_type_builder(name, physical);
        Ok(Arc::new(builder.with_repetition(repetition).with_logical_type(text).build()?))
    };
    let columns = [
        ("wall", Physical::BYTE_ARRAY),
        ("model", Physical::BYTE_ARRAY),
        ("record", Physical::BYTE_ARRAY),
        ("intensity_g", Physical::DOUBLE),
        ("u_max_over_u_ins", Physical::DOUBLE),
        ("overturned", Physical::BOOLEAN),
        ("overturn_time_s", Physical::DOUBLE),
    ];
    let fields = columns.into_iter().map(|(name, physical)| column(name, physical)).collect::<Result<_>>()?;
    let schema = Arc::new(Type::group_type_builder("levels").with_fields(fields).build()?);
    let properties = WriterProperties::builder().set_created_by(results.contents().program.clone()).build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))?;
    let contents = results.contents();
    // one group of rows for each wall and model
    for wall in 0..contents.walls.len() {
        for model in 0..contents.models.len() {
            let mut group = writer.next_row_group()?;
            rows(results, [wall, model], &mut group)?;
            group.close()?;
        }
    }
    Ok(writer.into_inner()?)
}

fn rows(
    results: &Results,
    [wall, model]: [usize; 2],
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
) -> Result<()> {
    let contents = results.contents();
    let curves = results.data.curves(wall, model);
    let levels: Vec<_> = curves.iter().flat_map(Curve::levels).collect();
    let alike = |name: &str| vec![ByteArray::from(name); levels.len()];
    let records = curves.iter().zip(&contents.records).flat_map(|(curve, record)| {
        std::iter::repeat_n(ByteArray::from(record.name.as_str()), curve.runs().len())
    });
    text(group, &alike(&contents.walls[wall].name))?;
    text(group, &alike(&contents.models[model].name))?;
    text(group, &records.collect::<Vec<_>>())?;
    let intensities: Vec<f64> = levels.iter().map(|level| in_g(level.intensity)).collect();
    numbers(group, &intensities, None)?;
    let demands: Vec<f64> = levels.iter().map(|level| level.demand).collect();
    numbers(group, &demands, None)?;
    let overturned: Vec<bool> = levels.iter().map(|level| level.overturning.is_some()).collect();
    if let Some(mut column) = group.next_column()? {
        column.typed::<BoolType>().write_batch(&overturned, None, None)?;
        column.close()?;
    }
    let times: Vec<f64> = levels.iter().filter_map(|level| level.overturning).collect();
    let present: Vec<i16> = overturned.iter().map(|&there| i16::from(there)).collect();
    numbers(group, &times, Some(&present))
}

fn text(group: &mut SerializedRowGroupWriter<'_, Vec<u8>>, values: &[ByteArray]) -> Result<()> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<ByteArrayType>().write_batch(values, None, None)?;
        column.close()?;
    }
    Ok(())
}

/// A column of numbers; `present` tells where there is one.
fn numbers(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: &[f64],
    present: Option<&[i16]>,
) -> Result<()> {
    if let Some(mut column) = group.next_column()? {
        column.typed::<DoubleType>().write_batch(values, present, None)?;
        column.close()?;
    }
    Ok(())
}
