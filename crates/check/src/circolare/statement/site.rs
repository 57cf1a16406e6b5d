//! What limit states take from the site on a grid of the hazard: the table `[check.site]`.

use files::FileError;
use std::path::{Path, PathBuf};

use rocking_wall::wall::Usual;

use crate::error::CheckError;
use crate::file::lines_of_grid;
use crate::file::site::{no_place, return_period};
use crate::words::names::LimitState;
use crate::words::{Sentence, at_most, say};

use super::table::{CheckTable, SiteTable};
use crate::ntc::grid::{Grid, SiteHazard};

/// The file that was read, `None` where its lines are in the table, and what is to be said of the numbers.
pub(crate) struct FromGrid {
    pub(crate) file: Option<PathBuf>,
    pub(crate) notes: Vec<Sentence>,
    /// Where `a_g` is not that of a site in its unit.
    pub(crate) warning: Option<String>,
}

/// Usual `a_g` of `T_R` = 475 years: the hazard of Italy has 0.04 to 0.28 g.
const AG: Usual = Usual {
    name: "a_g of the grid at T_R = 475 years",
    unit: "g",
    range: [0.03, 0.35],
    others: &[("in g/10 or m/s2", 0.1), ("in g and not in g/10", 10.0)],
};

/// Fills in `ag`, F0 and TC of the limit states that leave them out; a spectrum needs `ag` alone. Files are
/// beside the one of the table.
pub(crate) fn fill(table: &mut CheckTable, folder: &Path) -> Result<Option<FromGrid>, CheckError> {
    let Some(site) = table.site.clone() else { return Ok(None) };
    let file = (!site.grid.contains('\n')).then(|| folder.join(&site.grid));
    let hazard = read(&site, folder, file.as_deref())?;
    let [first, last] = hazard.periods();
    let mut notes = Vec::new();
    for (state, given) in LimitState::ALL.into_iter().zip([&mut table.sld, &mut table.slv, &mut table.slc]) {
        let Some(given) = given.as_mut().filter(|given| given.ag.is_none()) else { continue };
        if given.f0.is_some() || given.tc.is_some() {
            let message = format!("{state}: the site's grid gives ag, F0 and TC together; state all or none");
            return Err(CheckError::value(&[state.key(), "ag"], message));
        }
        let years = return_period(site.nominal_life * site.use_coefficient, state.exceeded());
        let found = hazard.hazard(years);
        given.ag = Some(found.ag);
        if given.spectrum.is_none() {
            (given.f0, given.tc) = (Some(found.f0), Some(found.tc));
        }
        let limited = if (first..=last).contains(&years) {
            Sentence::default()
        } else {
            say! {
                ", taken as {nearest}, the nearest of the grid",
                ", assunto {nearest}, il più vicino del reticolo",
                nearest = at_most(years.clamp(first, last), 4)
            }
        };
        notes.push(say! {
            "{state}: T_R = {years} years{limited}: a_g = {ag} g, F0 = {f0}, T_C* = {tc} s.",
            "{state}: T_R = {years} anni{limited}: a_g = {ag} g, F0 = {f0}, T_C* = {tc} s.",
            state, years = at_most(years, 4), limited, ag = at_most(found.ag, 4), f0 = at_most(found.f0, 4),
            tc = at_most(found.tc, 4)
        });
    }
    if notes.is_empty() {
        let message = "no limit state takes its numbers from the grid; leave out ag, F0 and TC, or site";
        return Err(CheckError::value(&["site"], message));
    }
    let [latitude, longitude] = site.coordinates;
    let named = |file: &PathBuf| file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
    let source = file.as_ref().map_or_else(|| "[check.site]".to_owned(), named);
    let how = if hazard.is_node() {
        say! {
            "the numbers of the node that it is",
            "valori del nodo coincidente con il sito, interpolati linearmente"
        }
    } else {
        say! {
            "the mean of its four nodes by the inverse of their distances",
            "media dei quattro nodi pesata con l'inverso delle distanze, lineare"
        }
    };
    notes.push(say! {
        "Site at latitude {latitude}°, longitude {longitude}° on the grid of {source}: {how}, straight over \
         log T_R, as NTC 2008, Annex A, is known in the field; its text was not seen. Compare the numbers \
         with those of the ministry.",
        "Sito a latitudine {latitude}°, longitudine {longitude}° sul reticolo di {source}: {how} in log T_R, \
         come è noto dall'Allegato A delle NTC 2008; il testo non è stato visto. Confrontare i numeri con \
         quelli del ministero.", latitude, longitude, source, how
    });
    let warning = AG.warning(hazard.hazard(475.0).ag).map(|warning| format!("{warning}; state ag_unit"));
    Ok(Some(FromGrid { file, notes, warning }))
}

fn read(site: &SiteTable, folder: &Path, file: Option<&Path>) -> Result<SiteHazard, CheckError> {
    let refused = |key, message: String| Err(CheckError::value(&["site", key], format!("site: {message}")));
    let SiteTable { ag_unit, coordinates, .. } = site;
    if let Some(message) = no_place(*coordinates) {
        return refused("coordinates", message);
    }
    let text = lines_of_grid(&site.grid, folder)?;
    let grid = Grid::read(&text, ag_unit.in_g()).map_err(|(line, message)| {
        let file = file.map_or_else(|| "grid of [check.site]".to_owned(), |file| file.display().to_string());
        FileError::on_line(file, line, message)
    })?;
    let found = grid.at(*coordinates);
    found.or_else(|message| refused("coordinates", message))
}
