//! What a report says of the project: the table `[report]`.

use ::report::number;
use files::{Described, Schema, Tables, choices, tables};
use serde::Deserialize;

use super::site::{no_place, return_period};
use crate::words::markup::{as_written, table};
use crate::words::names::LimitState;
use crate::words::{Language, Sentence, Written, at_most, fixed, say};

tables! {
    /// What the report of a check says of the project. What is left out is left out of the report.
    #[derive(Clone, Debug, Default)]
    pub struct ReportTable {
        /// Language of the report.
        #[serde(default)]
        #[key(default = "en")]
        pub language: Language,
        /// Project.
        pub project: Option<String>,
        /// Client.
        pub client: Option<String>,
        /// Owner.
        pub owner: Option<String>,
        /// Designer.
        pub designer: Option<String>,
        /// Place.
        pub place: Option<String>,
        /// Municipality.
        pub municipality: Option<String>,
        /// Entry in the land register.
        pub cadastral: Option<String>,
        /// Latitude and longitude \[°\].
        pub coordinates: Option<[f64; 2]>,
        /// Date, in any form; `--date` replaces it.
        pub date: Option<String>,
        /// Revision.
        pub revision: Option<String>,
        /// Nominal life `V_N` \[years\], NTC 2.4.1.
        #[key(exclusiveMinimum = 0)]
        pub nominal_life: Option<f64>,
        /// Use coefficient `C_U` (-), NTC 2.4.3.
        #[key(exclusiveMinimum = 0)]
        pub use_coefficient: Option<f64>,
        /// Source of the hazard.
        pub hazard_source: Option<String>,
        /// Notes.
        pub notes: Option<String>,
        /// Kind of the intervention, such as an improvement (NTC 8.4.2).
        pub intervention: Option<String>,
        /// Why these mechanisms are checked: cracks, connections, what holds the wall.
        pub mechanism: Option<String>,
        /// Sources of loads and thrusts.
        pub loads: Option<String>,
        /// Materials, tests, and what the level of knowledge rests on.
        pub materials: Option<String>,
        /// Whether the section is monolithic.
        pub monolithic: Option<bool>,
        /// Whether the quality of the masonry excludes that it disintegrates.
        pub masonry_quality: Option<bool>,
        /// Whether the connections are as the mechanism takes them.
        pub connections: Option<bool>,
        /// Plans, elevations and photographs beside the file (SVG, PNG, JPEG).
        #[serde(default)]
        #[key(default = Vec::<String>::new())]
        pub figures: Vec<String>,
    }
}

choices!(Language);

/// Describes the table for a JSON schema; it refers to no other.
pub fn report_schema() -> Schema {
    let mut tables = Tables::default();
    let described = ReportTable::describe("report", &mut tables);
    match tables.schemas.remove("ReportTable") {
        Some(toml::Value::Table(table)) => table,
        _ => described,
    }
}

/// What the site on a grid of the hazard, `[check.site]`, has of the project, too.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct SiteOfProject {
    coordinates: Option<[f64; 2]>,
    nominal_life: Option<f64>,
    use_coefficient: Option<f64>,
}

impl ReportTable {
    /// What is known of the project without a table.
    pub(crate) fn of_site(site: &SiteOfProject) -> Self {
        let SiteOfProject { coordinates, nominal_life, use_coefficient } = *site;
        Self { coordinates, nominal_life, use_coefficient, ..Self::default() }
    }

    /// Takes from the site what is not given here.
    ///
    /// # Errors
    /// The key of coordinates that are no place, or of what differs from the site, and why that cannot be.
    pub(crate) fn complete(&mut self, site: &SiteOfProject) -> Result<(), (&'static str, String)> {
        if let Some(message) = self.coordinates.and_then(no_place) {
            return Err(("coordinates", message));
        }
        taken("coordinates", &mut self.coordinates, site.coordinates)?;
        taken("nominal_life", &mut self.nominal_life, site.nominal_life)?;
        taken("use_coefficient", &mut self.use_coefficient, site.use_coefficient)
    }

    /// The data of the project as a table, without those that are not given; empty without any.
    pub(crate) fn project_data(&self) -> String {
        let language = self.language;
        let texts = [
            (say!("Project", "Commessa"), &self.project),
            (say!("Client", "Committente"), &self.client),
            (say!("Owner", "Proprietà"), &self.owner),
            (say!("Designer", "Progettista"), &self.designer),
            (say!("Place", "Ubicazione"), &self.place),
            (say!("Municipality", "Comune"), &self.municipality),
            (say!("Land register", "Dati catastali"), &self.cadastral),
            (say!("Revision", "Revisione"), &self.revision),
            (say!("Intervention", "Tipo di intervento"), &self.intervention),
            (say!("Source of the hazard", "Fonte dei dati di pericolosità"), &self.hazard_source),
            (say!("Notes", "Note"), &self.notes),
        ];
        let texts = texts.into_iter().filter_map(|(name, text)| Some((name, as_written(text.as_ref()?))));
        let mut rows: Vec<(Sentence, String)> = texts.collect();
        if let Some([latitude, longitude]) = self.coordinates {
            let name =
                say!("Coordinates (latitude, longitude)", "Coordinate geografiche (latitudine, longitudine)");
            let [latitude, longitude] = [latitude, longitude].map(|angle| at_most(angle, 8));
            let place = say!("{latitude}°, {longitude}°", "{latitude}°; {longitude}°", latitude, longitude);
            rows.push((name, place.of(language).to_owned()));
        }
        let years = |value: Written| say!("{value} years", "{value} anni", value).of(language).to_owned();
        rows.extend(
            self.nominal_life
                .map(|life| (say!("Nominal life V_N", "Vita nominale V_N"), years(at_most(life, 4)))),
        );
        rows.extend(self.use_coefficient.map(|factor| {
            let name = say!("Use coefficient C_U", "Coefficiente d'uso C_U");
            (name, language.decimal(&decimal(factor)))
        }));
        if let (Some(life), Some(factor)) = (self.nominal_life, self.use_coefficient) {
            let reference = life * factor;
            let name = say!("Reference period V_R = V_N C_U", "Periodo di riferimento V_R = V_N C_U");
            rows.push((name, years(at_most(reference, 4))));
            rows.extend(LimitState::ALL.map(|state| {
                let name = say! {
                    "Return period T_R of {state} (probability of exceedance {share} %)",
                    "Periodo di ritorno T_R dello {state} (probabilità di superamento {share} %)",
                    share = at_most(100.0 * state.exceeded(), 3), state
                };
                // the code prints 50, 475 and 975
                (name, years(fixed(return_period(reference, state.exceeded()), 0)))
            }));
        }
        let rows: Vec<_> = rows.into_iter().map(|(name, text)| [name.markup(language), text]).collect();
        if rows.is_empty() { String::new() } else { table(&[], &rows) }
    }
}

/// Takes a value of the site where there is none; refuses two that differ.
fn taken<T: PartialEq + std::fmt::Debug>(
    key: &'static str,
    own: &mut Option<T>,
    of_site: Option<T>,
) -> Result<(), (&'static str, String)> {
    match (own.take(), of_site) {
        (Some(given), Some(of_site)) if given != of_site => {
            let message = format!(
                "{key} = {given:?} differs from {of_site:?} of [check.site]; leave it out here, or make both \
                 equal"
            );
            Err((key, message))
        }
        (given, of_site) => {
            *own = given.or(of_site);
            Ok(())
        }
    }
}

/// A coefficient with at least one decimal.
fn decimal(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value:.1}") } else { number(value, 4) }
}
