//! What limit states take from the site on a grid of the hazard: the table `[check.site]`.

use files::FileError;
use std::path::{Path, PathBuf};

use rocking_wall::wall::Usual;

use crate::error::CheckError;
use crate::file::site::{no_place, return_period};
use crate::file::{HAS_FILES, lines_of_grid};
use crate::words::names::LimitState;
use crate::words::others::improbable;
use crate::words::{Sentence, at_most, joined, say};

use super::table::{CheckTable, SiteTable};
use crate::ntc::grid::{Grid, SiteHazard};
use crate::ntc::ground::Hazard;

/// The file that was read, `None` where its lines are in the table, and what is to be said of the numbers.
pub(crate) struct FromGrid {
    pub(crate) file: Option<PathBuf>,
    pub(crate) notes: Vec<Sentence>,
    /// The nodes with their numbers.
    pub(crate) nodes: Vec<Sentence>,
    /// Where `a_g` is not that of a site in its unit, or another one is stated.
    pub(crate) warnings: Vec<Sentence>,
}

/// Usual `a_g` of `T_R` = 475 years: the hazard of Italy has 0.04 to 0.28 g.
const AG: Usual = Usual {
    name: "a_g of the grid at T_R = 475 years",
    unit: "g",
    range: [0.03, 0.35],
    others: &[("in g/10 or m/s2", 0.1), ("in g and not in g/10", 10.0)],
};
/// Usual `a_g` of `T_R` = 30 years: the hazard of Italy has up to 0.08 g. Where a quiet zone is read in
/// another unit, 475 years alone do not show it.
const AG_30: Usual = Usual {
    name: "a_g of the grid at T_R = 30 years",
    range: [0.002, 0.09],
    others: &[("in g/10 or m/s2", 0.1)],
    ..AG
};
/// Share by which a stated `a_g` is another one than that of the grid \[-\].
const OTHER: f64 = 0.02;

/// Fills in `ag`, F0 and TC of the limit states that leave them out; a spectrum needs `ag` alone. Files are
/// beside the one of the table. There is nothing without a site.
pub(crate) fn fill(table: &mut CheckTable, folder: &Path) -> Result<Option<FromGrid>, CheckError> {
    match table.site.clone() {
        None => Ok(None),
        Some(_) if !HAS_FILES => {
            let message = "the playground reads no grid; state ag, F0 and TC of each limit state";
            Err(CheckError::value(&["site"], message))
        }
        Some(site) => from_grid(table, &site, folder).map(Some),
    }
}

fn from_grid(table: &mut CheckTable, site: &SiteTable, folder: &Path) -> Result<FromGrid, CheckError> {
    let file = (!site.grid.contains('\n')).then(|| folder.join(&site.grid));
    let hazard = read(site, folder, file.as_deref())?;
    let [first, last] = hazard.periods();
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    for (state, given) in LimitState::ALL.into_iter().zip([&mut table.sld, &mut table.slv, &mut table.slc]) {
        let Some(given) = given.as_mut() else { continue };
        let years = return_period(site.nominal_life * site.use_coefficient, state.exceeded());
        let found = hazard.hazard(years);
        if let Some(ag) = given.ag {
            warnings.extend(other_ag(state, ag, found.ag, years));
            continue;
        }
        if given.f0.is_some() || given.tc.is_some() {
            let message = format!("{state}: the site's grid gives ag, F0 and TC together; state all or none");
            return Err(CheckError::value(&[state.key(), "ag"], message));
        }
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
    let of_file = |file| say!(" of {file}", " di {file}", file = named(file));
    let source = file.as_ref().map_or_else(|| say!(" in the file", " allegato ai dati"), of_file);
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
        "Site at latitude {latitude}°, longitude {longitude}° on the grid{source}: {how}, straight over \
         log T_R (NTC 2008, Annex A).",
        "Sito a latitudine {latitude}°, longitudine {longitude}° sul reticolo{source}: {how} in log T_R \
         (NTC 2008, Allegato A).", latitude, longitude, source, how
    });
    let of_grid = |usual: Usual, years: f64| usual.warning(hazard.hazard(years).ag);
    let short = || of_grid(AG_30, 30.0).filter(|_| first <= 30.0);
    warnings.extend(of_grid(AG, 475.0).or_else(short).map(|warning| {
        let warning = improbable(&warning);
        say!("{warning}; state ag_unit", "{warning}; dichiarare ag_unit", warning)
    }));
    let nodes = nodes(&hazard, site.nominal_life * site.use_coefficient);
    Ok(FromGrid { file, notes, nodes, warnings })
}

/// The nodes around the site, with their weights and numbers of each limit state; `reference` is `V_R`
/// \[years\].
fn nodes(hazard: &SiteHazard, reference: f64) -> Vec<Sentence> {
    let one = |([longitude, latitude], share, node): ([f64; 2], f64, SiteHazard)| {
        let states = LimitState::ALL.map(|state| {
            let Hazard { ag, f0, tc } = node.hazard(return_period(reference, state.exceeded()));
            say! {
                "{state}: {ag} g, {f0}, {tc} s", "{state}: {ag} g; {f0}; {tc} s", state,
                ag = at_most(ag, 4), f0 = at_most(f0, 4), tc = at_most(tc, 4)
            }
        });
        say! {
            "Node at longitude {longitude}°, latitude {latitude}°, weight {share}; a_g, `F0`, `T_C*` of \
             {states}.",
            "Nodo a longitudine {longitude}°, latitudine {latitude}°, peso {share}; a_g, `F0`, `T_C*` allo \
             {states}.",
            longitude, latitude, share = at_most(share, 4), states = joined(&states, "; ")
        }
    };
    hazard.nodes().map(one).collect()
}

/// Says that an `a_g` is stated beside the site whose grid has another one for the return period.
fn other_ag(state: LimitState, stated: f64, of_grid: f64, years: f64) -> Option<Sentence> {
    ((stated / of_grid - 1.0).abs() > OTHER).then(|| {
        let [stated, of_grid, years] = [stated, of_grid, years].map(|value| at_most(value, 4));
        say! {
            "{state}: a_g = {stated} g is stated; for T_R = {years} years of V_N and C_U the grid has \
             {of_grid} g",
            "{state}: è dichiarata a_g = {stated} g; per T_R = {years} anni di V_N e C_U il reticolo ha \
             {of_grid} g", state, stated, years, of_grid
        }
    })
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
