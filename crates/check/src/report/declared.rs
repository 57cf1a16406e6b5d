//! What the engineer declares in a report beside the numbers: the choice of the mechanism, the hypotheses,
//! and figures.

use std::path::Path;

use files::FileError;

use crate::code::verdict::Section;
use crate::file::project::ReportTable;
use crate::sections::origin::Origin;
use crate::words::markup::{as_paragraph, as_written, heads, paragraph, table};
use crate::words::{Language, Sentence, said, say};

/// Largest figure that is taken into a report.
const MAX_FIGURE_BYTES: u64 = 16 << 20;

/// The choice of the mechanism, the hypotheses and the figures.
pub(super) fn sections(origin: &Origin<'_>) -> Result<Vec<Section>, FileError> {
    let (report, language) = (origin.report, origin.report.language);
    let mut all = vec![
        Section::new(say!("Choice of the mechanism", "Scelta del meccanismo"), choice(report, language)),
        Section::new(say!("Hypotheses", "Conformità alle ipotesi"), hypotheses(report, language)),
    ];
    if !report.figures.is_empty() {
        let figures = report.figures.iter().map(|name| figure(origin.file.folder(), name));
        let figures = figures.collect::<Result<Vec<_>, _>>()?.concat();
        all.push(Section::new(say!("Plan and elevation", "Pianta e prospetto"), figures));
    }
    Ok(all)
}

/// Text of the engineer; where there is none, the report says that it is open.
pub(super) fn own_text(text: Option<&String>, language: Language) -> String {
    if let Some(text) = text {
        return as_paragraph(text);
    }
    let open = say! {
        "Open: the designer has not stated it.", "Aperto: il progettista non lo ha dichiarato."
    };
    format!("<p class=\"open\">{}</p>\n", open.markup(language))
}

fn choice(report: &ReportTable, language: Language) -> String {
    let text = say! {
        "C8.7.1.2.1: the mechanisms that matter follow from the behaviour of similar buildings, cracks, the \
         quality of connections and masonry, ties, and what interacts with the wall. The check is of the \
         mechanism that the figure of the wall shows.",
        "C8.7.1.2.1: i meccanismi significativi si individuano dal comportamento di strutture simili, dallo \
         stato fessurativo, dalla qualità dei collegamenti e della muratura, dalle catene e dalle \
         interazioni con altri elementi. La verifica riguarda il meccanismo illustrato nella figura della \
         parete."
    };
    own_text(report.mechanism.as_ref(), language) + &paragraph(&text, language)
}

/// What the analysis takes for granted, and whether the engineer states it.
fn hypotheses(report: &ReportTable, language: Language) -> String {
    let all = [
        (
            say! {
                "The section is monolithic: the leaves act together (C8.7.1.2.1).",
                "La sezione muraria è monolitica: i paramenti sono efficacemente collegati (C8.7.1.2.1)."
            },
            report.monolithic,
        ),
        (
            say! {
                "The quality of the masonry excludes that it disintegrates before the mechanism forms.",
                "La qualità della muratura esclude la disgregazione prima della formazione del meccanismo."
            },
            report.masonry_quality,
        ),
        (
            say! {
                "The connections to transverse walls, floors and roof are as the mechanism takes them.",
                "I collegamenti a pareti trasversali, solai e copertura sono quelli assunti dal meccanismo."
            },
            report.connections,
        ),
    ];
    let rows = all.map(|(hypothesis, stated)| {
        let stated = match stated {
            Some(stated) => said(stated).markup(language),
            None => {
                format!("<span class=\"open\">{}</span>", say!("open", "non dichiarato").markup(language))
            }
        };
        [hypothesis.markup(language), stated]
    });
    let parts: [Sentence; 2] = [
        say!("hypothesis", "ipotesi"),
        say!("fulfilled, by statement of the designer", "soddisfatta, per dichiarazione del progettista"),
    ];
    table(&heads(parts, language), &rows)
}

/// A figure of the user, as it is in its file.
fn figure(folder: &Path, name: &str) -> Result<String, FileError> {
    let path = folder.join(name);
    let kind = match path.extension().and_then(|end| end.to_str()).unwrap_or_default() {
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        _ => {
            let reason = "a figure of [report] is an SVG, PNG or JPEG file";
            return Err(FileError::whole(path.display().to_string(), reason.to_owned()));
        }
    };
    let unread = |error| FileError::whole(path.display().to_string(), format!("cannot be read: {error}"));
    let bytes =
        ground_motion::read_file(&path, "a figure of the report", MAX_FIGURE_BYTES).map_err(unread)?;
    let (name, data) = (as_written(name), base64(&bytes));
    Ok(format!(
        "<figure><figcaption>{name}</figcaption><img alt=\"\" src=\"data:{kind};base64,{data}\"></figure>\n"
    ))
}

/// Bytes in the alphabet of RFC 4648, 4.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let all =
            three.iter().fold(0_u32, |all, byte| all << 8 | u32::from(*byte)) << (8 * (3 - three.len()));
        for place in 0..4 {
            let letter = LETTERS[(all >> (18 - 6 * place) & 63) as usize];
            text.push(if place > three.len() { '=' } else { char::from(letter) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    /// The examples of RFC 4648, 10.
    #[test]
    fn bytes_are_written_as_the_standard_has_them() {
        for (bytes, text) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }
}
