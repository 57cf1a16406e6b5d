//! The report of the walls of a file: a cover with the wall that governs, and a sheet for each wall.

use std::fmt::Write as _;

use run::walls::NamedWall;

use super::{Origin, begun, declared, end, finished, footer, head, sections, sheet_head};
use crate::code::verdict::{Section, Verdict};
use crate::error::CheckError;
use crate::walls::{WallCodes, WallVerdicts};
use crate::words::markup::{as_written, cards};
use crate::words::{Language, Sentence, say};

/// Makes the page of a report of walls, the worst first. Walls that could not be checked stand on the cover
/// with the reason, and have no sheet.
///
/// # Errors
/// [`CheckError`] of a demand, of a file that cannot be read again, or where no wall could be checked.
pub fn page_of_walls(
    verdicts: &WallVerdicts<'_>,
    walls: &[NamedWall],
    codes: &WallCodes,
    origin: &Origin<'_>,
) -> Result<String, CheckError> {
    let checked =
        || verdicts.walls.iter().filter_map(|(name, verdict)| Some((*name, verdict.as_ref().ok()?)));
    let Some((governing, worst)) = checked().next() else {
        let reason = verdicts.walls.iter().find_map(|(name, verdict)| Some((name, verdict.as_ref().err()?)));
        let reason = reason.map_or_else(String::new, |(name, error)| format!("; wall {name:?}: {error}"));
        return Err(CheckError::wall(format!("no wall could be checked{reason}")));
    };
    let language = origin.report.language;
    let all = verdicts.walls.len();
    let passed = checked().filter(|(_, verdict)| verdict.passed).count();
    let of = |said: Sentence| said.markup(language);
    let said = of(say! {
        "{passed} of {all} walls pass", "Pareti che soddisfano la verifica: {passed} su {all}", passed, all
    });
    let mut cover = format!("<p class=\"verdict\">{said}</p>\n");
    let refused = verdicts.refused();
    if refused > 0 {
        let said = of(say! {
            "{refused} of {all} walls could not be checked",
            "Pareti non verificabili: {refused} su {all}", refused, all
        });
        // writing to a String cannot fail
        let _ = write!(cover, "<p class=\"fails\">{said}</p>");
    }
    let _ = write!(
        cover,
        "<p>{}: {}</p>{}<p>{}</p><div class=\"checks walls\">{}</div>{}",
        of(say!("Governing wall", "Parete determinante")),
        as_written(governing),
        head(worst, Some(governing), language),
        of(say!("The walls stand in rising order of zeta_E.", "Le pareti sono in ordine di ζ_E crescente.")),
        verdicts.markup(language),
        data(checked(), language)
    );
    let title = origin.report.project.as_deref().unwrap_or(origin.title);
    let summary = Section::new(say!("Summary of the walls", "Riepilogo delle pareti"), cover);
    let page = sections(begun(title, worst, "", origin), vec![summary], language);
    let page = sections(page, declared::sections(origin)?, language);
    let mut page = sections(page, worst.details.site(language)?, language);
    for (index, (name, verdict)) in checked().enumerate() {
        let Some(wall) = walls.iter().find(|wall| wall.name == name) else { continue };
        let text = origin.file.with_row(wall)?;
        let row = text.as_ref().map(|text| origin.file.of_row(text, Vec::new())).transpose()?;
        let file = row.as_ref().unwrap_or(origin.file);
        let own = file.of_wall(wall.entry, codes.shared().entry().of_wall)?;
        let own = Origin { title: name, file: own.as_ref().unwrap_or(file), wall: Some(wall), ..*origin };
        let foot = format!("wall{index}");
        page = page.styled(&footer(&foot, &origin.footer(Some(name))));
        page = page.text(&format!(
            "<div class=\"sheet\" style=\"page: {foot}\"><h1>{}</h1>{}",
            as_written(name),
            head(verdict, None, language)
        ));
        page = sections(sheet_head(page, verdict, &own), verdict.details.sections(&own)?, language)
            .text("</div>");
    }
    let mut readings: Vec<Sentence> = Vec::new();
    for reading in checked().flat_map(|(_, verdict)| verdict.details.readings()) {
        if !readings.contains(&reading) {
            readings.push(reading);
        }
    }
    let page = end(page, &worst.details.symbols(language), &readings, origin)?;
    Ok(finished(&page, title, origin))
}

/// The data of the walls and the numbers of their governing sides: a row a wall.
fn data<'a>(walls: impl Iterator<Item = (&'a str, &'a Verdict<'a>)>, language: Language) -> String {
    let mut heads = vec![say!("wall", "parete").markup(language)];
    let mut rows = Vec::new();
    for (name, verdict) in walls {
        let (own, cells): (Vec<_>, Vec<_>) = verdict.details.overview(language).into_iter().unzip();
        if rows.is_empty() {
            heads.extend(own);
        }
        rows.push(("", [vec![as_written(name)], cells].concat()));
    }
    format!("<div class=\"data\">{}</div>", cards(&heads, &rows))
}
