//! Fragilities as components of pelicun (NHERI `SimCenter`), in the form of its damage and loss library: a
//! row for each wall or class with a model, and JSON that says what its limit states are.

use std::io::Write;
use std::path::{Path, PathBuf};

use fragility::FragilityFunction;
use report::table::Table;
use run::file::Draft;
use serde_json::{Map, json};

use super::contents::Manifest;
use super::error::FolderError;
use super::nrml::{self, Names};
use super::rows::Rows;

/// Names of the files.
const FILES: [&str; 2] = ["pelicun.csv", "pelicun.json"];

/// Returns the demand of pelicun that an intensity measure is, and pelicun's name of the unit of results;
/// `None` for those it does not know.
fn demand(measure: &str) -> Option<(String, &'static str)> {
    if let Some(period) = nrml::period(measure) {
        return Some((format!("Spectral Acceleration|{period}"), "g"));
    }
    match measure {
        "PGA" => Some(("Peak Ground Acceleration".to_owned(), "g")),
        "PGV" => Some(("Peak Ground Velocity".to_owned(), "cmps")),
        _ => None,
    }
}

/// Says why there are no files by a measure, and the remedy.
pub(crate) fn refusal(measure: &str) -> String {
    let other = if measure == "PGD" { ": its own PGD is a permanent deformation of the ground" } else { "" };
    let [table, described] = FILES;
    format!(
        "no {table} and {described}: pelicun knows PGA, PGV and Sa(T), and not {measure}{other}; run the \
         study with intensity = {{ measure = \"PGA\" }} to have them\n"
    )
}

/// The files under construction.
pub(crate) struct Pelicun<'a> {
    manifest: &'a Manifest,
    demand: (String, &'static str),
    rows: Rows,
    described: Draft,
    names: Names,
}

impl<'a> Pelicun<'a> {
    /// Begins the files in a folder; `None` for a study whose measure pelicun does not know.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest) -> Result<Option<Self>, FolderError> {
        let paths = FILES.map(|name| folder.join(name));
        let Some(demand) = demand(&manifest.contents.measure) else { return Ok(None) };
        let about = json!({
            "ShortName": manifest.title,
            "Description": "Out-of-plane rocking of masonry walls; a limit state is a fraction of the static \
                            instability displacement",
            "Version": "1.0",
        });
        let [rows, described] = paths;
        let rows = Rows::new(&rows)?;
        let described = Draft::new(&described, format!("{{\n\"_GeneralInformation\": {about}").as_bytes())?;
        Ok(Some(Self { manifest, demand, rows, described, names: Names::of(manifest) }))
    }

    /// Adds a wall or a class with a model.
    pub(crate) fn add(
        &mut self,
        [name, model]: [&str; 2],
        function: &FragilityFunction,
    ) -> Result<(), FolderError> {
        let id = self.id(name, model);
        let (demand, unit) = &self.demand;
        let mut table = Table::over([()])
            .text("ID", "", |()| id.clone())
            .value("Incomplete", |()| 0)
            .text("Demand-Type", "", |()| demand.clone())
            .text("Demand-Unit", "", |()| *unit)
            .value("Demand-Offset", |()| 0)
            // a wall rocks in one direction
            .value("Demand-Directional", |()| 1);
        let mut states = Map::new();
        let report = &self.manifest.report;
        for (k, (curve, place)) in function.states.iter().zip(report.rising()).enumerate() {
            let key = format!("LS{}", k + 1);
            let fraction = report.fractions[place];
            let about =
                format!("The displacement exceeds {fraction} of the static instability displacement.");
            states.insert(key.clone(), json!({ format!("DS{}", k + 1): { "Description": about } }));
            let (theta, beta) = (self.manifest.contents.unit.of(curve.median), function.dispersion(k));
            table = table
                .text(format!("{key}-Family"), "", |()| "lognormal")
                .value(format!("{key}-Theta_0"), move |()| theta)
                .value(format!("{key}-Theta_1"), move |()| beta)
                .text(format!("{key}-DamageStateWeights"), "", |()| "");
        }
        self.rows.add(&table.done())?;
        let about = json!({
            "Description": format!("{name}, {model}"),
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "LimitStates": states,
        });
        Ok(self.described.write(|file| write!(file, ",\n{}: {about}", json!(id)))?)
    }

    /// Completes the files, and returns their paths.
    pub(crate) fn finish(mut self) -> Result<[PathBuf; 2], FolderError> {
        self.described.write(|file| file.write_all(b"\n}\n"))?;
        Ok([self.rows.commit()?, self.described.commit(true)?])
    }

    /// Makes the name of a component, which no other has. A dash would part it from its place.
    fn id(&mut self, name: &str, model: &str) -> String {
        let text = if self.names.has_models { format!("{name}.{model}") } else { name.to_owned() };
        let kept = |c: char| if c.is_alphanumeric() || c == '.' { c } else { '_' };
        self.names.unique(text.chars().map(kept).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::{demand, refusal};

    /// The peak displacement of the ground is not what pelicun calls PGD, although the names are alike.
    #[test]
    fn measures_that_pelicun_lacks_are_named_with_the_remedy() {
        for (measure, is_known) in
            [("PGA", true), ("PGV", true), ("Sa(0.5 s)", true), ("PGD", false), ("AvgSA", false)]
        {
            assert_eq!(demand(measure).is_some(), is_known, "{measure}");
        }
        let told = refusal("PGD");
        for words in ["no pelicun.csv", "and not PGD: its own PGD is a permanent", "measure = \"PGA\""] {
            assert!(told.contains(words), "{told}");
        }
        assert!(!refusal("AvgSA").contains("PGD"));
    }
}
