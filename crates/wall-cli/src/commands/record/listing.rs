//! The files of a folder, one row each: `wall record FOLDER`.

use std::fmt::Write;

use super::Row;

/// Shows a row for each file, and names those that could not be read with the reason.
pub(super) fn table(rows: &[Row], unread: &[String]) -> String {
    let files: Vec<&[Row]> = rows.chunk_by(|a, b| a.path == b.path).collect();
    let width = files.iter().map(|channels| channels[0].file.chars().count());
    let width = width.max().unwrap_or(0).max("file".len());
    let mut text = format!(
        "{:width$}  {:13}  {:>8}  {:>7}  {:>8}  {:>8}  findings\n",
        "file", "format", "channels", "points", "step [s]", "PGA [g]"
    );
    for channels in &files {
        let motions = || channels.iter().map(|row| &row.record.motion);
        let points = motions().map(|motion| motion.samples().len()).max().unwrap_or(0);
        let step = motions().map(ground_motion::GroundMotion::step).fold(0.0, f64::max);
        let peak = channels.iter().map(Row::peak).fold(0.0, f64::max);
        let row = format!(
            "{:width$}  {:13}  {:>8}  {points:>7}  {:>8}  {peak:>8.5}  {}",
            channels[0].file,
            channels[0].record.format.description(),
            channels.len(),
            report::number(step, 6),
            findings(channels)
        );
        // writing to a String cannot fail
        let _ = writeln!(text, "{}", row.trim_end());
    }
    for reason in unread {
        let _ = writeln!(text, "not read  {reason}");
    }
    text
}

/// The subjects of the findings, each once, with the number of channels where these are several.
fn findings(channels: &[Row]) -> String {
    let mut subjects: Vec<(String, usize)> = Vec::new();
    for warning in channels.iter().flat_map(|row| &row.check.warnings) {
        let text = warning.to_string();
        let subject = text.split(": ").next().unwrap_or(&text);
        match subjects.iter_mut().find(|(known, _)| known == subject) {
            Some((_, count)) => *count += 1,
            None => subjects.push((subject.to_owned(), 1)),
        }
    }
    let shown = subjects.into_iter().map(|(subject, count)| match (count, channels.len()) {
        (_, 1) => subject,
        (count, _) => format!("{subject} ({count})"),
    });
    shown.collect::<Vec<_>>().join(", ")
}
