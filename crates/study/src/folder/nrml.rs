//! Fragility functions as NRML 0.5, the format of risk engines. Intensities are in the unit that `OpenQuake`
//! has for the measure, which is that of all results.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use fragility::{FragilityFunction, TAIL};
use report::escaped;
use run::file::{Draft, FileError};

use crate::ida::IntensityUnit;

use super::contents::Manifest;

/// What risk engines refuse in the name of a function.
const REFUSED: [char; 3] = ['#', '\'', '"'];

/// Returns the name of a limit state.
pub(crate) fn state_name(fraction: f64) -> String {
    format!("u_ins_{fraction}").replace('.', "_")
}

/// Returns the name in NRML of an intensity measure, as `OpenQuake` has it: `PGA`, `PGV`, `PGD`, `SA(T)`,
/// `IA`, `CAV`, or `AvgSA`, whose periods NRML leaves to the description; `None` for the others.
pub(crate) fn measure(name: &str) -> Option<String> {
    let known = ["PGA", "PGV", "PGD", "CAV", "AvgSA"];
    match name {
        "Arias" => Some("IA".into()),
        _ if known.contains(&name) => Some(name.into()),
        _ => period(name).map(|period| format!("SA({period})")),
    }
}

/// Returns the period of the measure Sa, as its name states it.
pub(crate) fn period(name: &str) -> Option<&str> {
    name.strip_prefix("Sa(")?.strip_suffix(" s)")
}

/// Names of functions, each of which occurs once.
pub(crate) struct Names {
    pub(crate) has_models: bool,
    ids: BTreeSet<String>,
}

impl Names {
    pub(crate) fn of(manifest: &Manifest) -> Self {
        Self { has_models: manifest.contents.models.len() > 1, ids: BTreeSet::new() }
    }

    /// Makes the name of a wall or class with a model that no other function has.
    pub(crate) fn id(&mut self, name: &str, model: &str) -> String {
        let id = if self.has_models { format!("{name} ({model})") } else { name.to_owned() };
        self.unique(id.replace(REFUSED, "_"))
    }

    /// Makes a name that no other function has.
    pub(crate) fn unique(&mut self, mut id: String) -> String {
        while !self.ids.insert(id.clone()) {
            id.push('_');
        }
        id
    }
}

/// A file of functions under construction.
pub(crate) struct Nrml {
    draft: Draft,
    model: &'static str,
    pub(crate) measure: String,
    names: Names,
}

impl Nrml {
    /// Begins a file with a kind of model, and more than its description; `None` if NRML cannot state the
    /// study's measure.
    pub(crate) fn new(
        path: &Path,
        manifest: &Manifest,
        model: &'static str,
        more: &str,
    ) -> Result<Option<Self>, FileError> {
        let contents = &manifest.contents;
        let Some(measure) = measure(&contents.measure) else { return Ok(None) };
        let periods = match &contents.measure[..] {
            "AvgSA" => format!("; {}", contents.measure_details),
            _ => String::new(),
        };
        let head = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
             <{model} id=\"rocking_walls\" assetCategory=\"buildings\" lossCategory=\"structural\">\n    \
             <description>{}: {more}; intensities in {}{}</description>\n",
            escaped(&manifest.title),
            contents.unit.name(),
            escaped(&periods)
        );
        let draft = Draft::new(path, head.as_bytes())?;
        Ok(Some(Self { draft, model, measure, names: Names::of(manifest) }))
    }

    /// Writes text.
    pub(crate) fn write(&mut self, text: &str) -> Result<(), FileError> {
        self.draft.write(|file| file.write_all(text.as_bytes()))
    }

    /// Makes the name of a wall or class with a model that no other function has.
    pub(crate) fn id(&mut self, name: &str, model: &str) -> String {
        self.names.id(name, model)
    }

    /// Completes the file, and returns its path.
    pub(crate) fn finish(mut self) -> Result<PathBuf, FileError> {
        self.write(&format!("  </{}>\n</nrml>\n", self.model))?;
        self.draft.commit(true)
    }
}

/// Returns what a fragility function holds, but `None` with a number that would be 0 or infinite. `states`
/// are the fractions of the limit states. Below `minIML` and `noDamageLimit` each limit state has a
/// probability of less than 1e-4, above `maxIML` of more than 1 − 1e-4.
pub(crate) fn fragility(
    function: &FragilityFunction,
    states: impl Iterator<Item = f64>,
    measure: &str,
    unit: IntensityUnit,
) -> Option<String> {
    let curves = function.states.iter().enumerate();
    let curves: Vec<_> = curves.map(|(k, curve)| (unit.of(curve.median), function.dispersion(k))).collect();
    let end = |sign: f64| curves.iter().map(move |(median, beta)| median * libm::exp(sign * TAIL * beta));
    let (least, most) = (end(-1.0).fold(f64::INFINITY, f64::min), end(1.0).fold(0.0, f64::max));
    let params: Vec<_> = curves.iter().map(|(median, beta)| moments(*median, *beta)).collect();
    let mut numbers = params.iter().flatten().chain([&least, &most]);
    if !numbers.all(|number| number.is_finite() && *number > 0.0) {
        return None;
    }
    let imls = format!(
        "      <imls imt=\"{measure}\" noDamageLimit=\"{least:e}\" minIML=\"{least:e}\" \
         maxIML=\"{most:e}\"/>\n"
    );
    let of_state = |(fraction, [mean, deviation]): (f64, &[f64; 2])| {
        let name = state_name(fraction);
        format!("      <params ls=\"{name}\" mean=\"{mean:e}\" stddev=\"{deviation:e}\"/>\n")
    };
    Some(imls + &states.zip(&params).map(of_state).collect::<String>())
}

/// Returns the mean and the standard deviation of a lognormal variable, θ exp(β²/2) and mean √(exp β² − 1).
fn moments(median: f64, beta: f64) -> [f64; 2] {
    let square = beta * beta;
    let mean = median * libm::exp(0.5 * square);
    [mean, mean * libm::expm1(square).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_give_back_the_curve() {
        for beta in [0.05, 0.3, 0.7, 1.5] {
            let [mean, deviation] = moments(0.37, beta);
            // as risk engines do
            let square = libm::log1p((deviation / mean).powi(2));
            let theta = mean * libm::exp(-0.5 * square);
            assert!((theta / 0.37 - 1.0).abs() < 1e-14 && (square.sqrt() / beta - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_function_of_infinite_numbers_is_left_out() {
        for (beta, is_written) in [(0.5, true), (50.0, false)] {
            let curve = fragility::Lognormal { median: 3.0, dispersion: beta };
            let function = FragilityFunction::new(&[curve], 0.0);
            let text = fragility(&function, [1.0].into_iter(), "PGA", IntensityUnit::Gravity);
            assert_eq!(text.is_some_and(|text| text.contains("<params ls=\"u_ins_1\"")), is_written);
        }
    }

    #[test]
    fn names_are_unique_and_free_of_what_engines_refuse() {
        let mut names = Names { has_models: false, ids: BTreeSet::new() };
        let ids = ["a#1", "a'1", "a_1", "b"].map(|name| names.id(name, "CR"));
        assert_eq!(ids, ["a_1", "a_1_", "a_1__", "b"]);
        assert_eq!(Names { has_models: true, ..names }.id("b", "CR"), "b (CR)");
    }

    #[test]
    fn measures_have_the_names_of_nrml() {
        let names = ["PGA", "Sa(0.5 s)", "AvgSA", "Arias", "PGV"].map(measure);
        assert_eq!(names, ["PGA", "SA(0.5)", "AvgSA", "IA", "PGV"].map(|name| Some(name.into())));
        assert_eq!(["a_g", "Housner"].map(measure), [None, None]);
    }

    #[test]
    fn limit_states_rise_and_have_plain_names() {
        let report = crate::document::ReportOptions {
            fractions: vec![0.4, 0.1, 1.0, 0.4],
            reference: String::new(),
            beta: fragility::Dispersion::Own,
            collapse: crate::ida::Crossing::First,
            resamples: 1,
            seed: 1,
            small_sample: false,
            modelling_uncertainty: 0.0,
            classes: Vec::new(),
            hazard: None,
            loss_ratios: None,
            samples: None,
            compared: None,
            given: Vec::new(),
            weights: fragility::Weights::default(),
        };
        assert_eq!(report.rising(), [1, 0, 2]);
        let names = report.rising().into_iter().map(|place| state_name(report.fractions[place]));
        assert_eq!(names.collect::<Vec<_>>(), ["u_ins_0_1", "u_ins_0_4", "u_ins_1"]);
    }
}
