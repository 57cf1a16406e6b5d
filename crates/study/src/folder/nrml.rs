//! Fragility functions as NRML 0.5, the format of risk engines. Intensities are in the unit that `OpenQuake`
//! has for the measure, which is that of all results.

use std::collections::BTreeSet;
use std::io::{self, Write};

use crate::document::ReportOptions;
use crate::fragility::{FragilityFunction, TAIL};
use crate::ida::IntensityUnit;
use report::escaped;

use super::contents::Manifest;

/// What risk engines refuse in the name of a function.
const REFUSED: [char; 3] = ['#', '\'', '"'];

/// Returns the limit states from the first to be exceeded to the last: place in the report, and name.
pub(crate) fn limit_states(report: &ReportOptions) -> Vec<(usize, String)> {
    let mut states: Vec<_> = report.fractions.iter().copied().enumerate().collect();
    states.sort_by(|a, b| a.1.total_cmp(&b.1));
    states.dedup_by_key(|(_, fraction)| *fraction);
    let named = |(place, fraction): (usize, f64)| (place, format!("u_ins_{fraction}").replace('.', "_"));
    states.into_iter().map(named).collect()
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

/// What precedes the functions of a model: the kind of model, more than its description, and its end.
fn head(manifest: &Manifest, model: &str, more: &str) -> String {
    let periods = match &manifest.contents.measure[..] {
        "AvgSA" => format!("; {}", manifest.contents.measure_details),
        _ => String::new(),
    };
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  \
         <{model} id=\"rocking_walls\" assetCategory=\"buildings\" lossCategory=\"structural\">\n    \
         <description>{}: {more}; intensities in {}{}</description>\n",
        escaped(&manifest.title),
        manifest.contents.unit.name(),
        escaped(&periods)
    )
}

/// Returns what precedes vulnerability functions, and their names; `None` if NRML has no name for the
/// study's measure.
pub(crate) fn vulnerability(manifest: &Manifest) -> Option<(Names, String)> {
    measure(&manifest.contents.measure)?;
    let more = "loss ratios of limit states, which are fractions of the static instability displacement";
    Some((Names::of(manifest), head(manifest, "vulnerabilityModel", more)))
}

/// What follows vulnerability functions.
pub(crate) const VULNERABILITY_END: &str = "  </vulnerabilityModel>\n</nrml>\n";

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

/// Writes the functions of a study one by one.
pub(crate) struct Writer {
    measure: String,
    unit: IntensityUnit,
    states: Vec<(usize, String)>,
    names: Names,
}

impl Writer {
    /// Writes what precedes the functions; `None` if NRML cannot state the study's measure.
    pub(crate) fn new(manifest: &Manifest) -> Option<(Self, String)> {
        let measure = measure(&manifest.contents.measure)?;
        let states = limit_states(&manifest.report);
        let names: Vec<_> = states.iter().map(|(_, name)| name.as_str()).collect();
        let more = "a limit state is named by its fraction of the static instability displacement";
        let head = head(manifest, "fragilityModel", more);
        let text = format!("{head}    <limitStates>{}</limitStates>\n", names.join(" "));
        let unit = manifest.contents.unit;
        Some((Self { measure, unit, states, names: Names::of(manifest) }, text))
    }

    /// Writes a function, but none with a number that would be 0 or infinite; returns whether it did. Below
    /// `minIML` and `noDamageLimit` each limit state has a probability of less than 1e-4, above `maxIML` of
    /// more than 1 − 1e-4.
    pub(crate) fn function(
        &mut self,
        out: &mut dyn Write,
        [name, model]: [&str; 2],
        function: &FragilityFunction,
    ) -> io::Result<bool> {
        let curves = function.states.iter().enumerate();
        let curves: Vec<_> =
            curves.map(|(k, curve)| (self.unit.of(curve.median), function.dispersion(k))).collect();
        let end = |sign: f64| curves.iter().map(move |(median, beta)| median * libm::exp(sign * TAIL * beta));
        let (least, most) = (end(-1.0).fold(f64::INFINITY, f64::min), end(1.0).fold(0.0, f64::max));
        let params: Vec<_> = curves.iter().map(|(median, beta)| moments(*median, *beta)).collect();
        let mut numbers = params.iter().flatten().chain([&least, &most]);
        if !numbers.all(|number| number.is_finite() && *number > 0.0) {
            return Ok(false);
        }
        writeln!(
            out,
            "    <fragilityFunction id=\"{}\" format=\"continuous\" shape=\"logncdf\">\n      \
             <imls imt=\"{}\" noDamageLimit=\"{least:e}\" minIML=\"{least:e}\" maxIML=\"{most:e}\"/>",
            escaped(&self.names.id(name, model)),
            self.measure
        )?;
        for ((_, state), [mean, deviation]) in self.states.iter().zip(&params) {
            writeln!(out, "      <params ls=\"{state}\" mean=\"{mean:e}\" stddev=\"{deviation:e}\"/>")?;
        }
        writeln!(out, "    </fragilityFunction>")?;
        Ok(true)
    }

    /// Writes in a comment what is known of a function that is not written.
    pub(crate) fn note(
        &self,
        out: &mut dyn Write,
        name: &str,
        thetas: &[(String, String)],
    ) -> io::Result<()> {
        let thetas: Vec<_> = thetas.iter().map(|(state, theta)| format!("{state} {theta}")).collect();
        // a comment must not have two dashes
        let text =
            format!("{name}: theta in {} of {}", self.unit.name(), thetas.join(", ")).replace("--", "- -");
        writeln!(out, "    <!-- no function of {} -->", escaped(&text))
    }

    /// Writes what follows the functions.
    pub(crate) fn finish(out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "  </fragilityModel>\n</nrml>")
    }
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
        let states = vec![(0, "u_ins_1".to_owned())];
        let names = Names { has_models: false, ids: BTreeSet::new() };
        let mut writer = Writer { measure: "PGA".into(), unit: IntensityUnit::Gravity, states, names };
        for (beta, is_written) in [(0.5, true), (50.0, false)] {
            let curve = crate::fragility::Lognormal { median: 3.0, dispersion: beta };
            let (function, mut out) = (FragilityFunction::new(&[curve], 0.0), Vec::new());
            assert_eq!(writer.function(&mut out, ["wall", "CR"], &function).unwrap(), is_written);
            assert_eq!(out.is_empty(), !is_written);
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
        let report = ReportOptions {
            fractions: vec![0.4, 0.1, 1.0, 0.4],
            reference: String::new(),
            beta: crate::fragility::Dispersion::Own,
            collapse: crate::ida::Crossing::First,
            resamples: 1,
            seed: 1,
            modelling_uncertainty: 0.0,
            classes: Vec::new(),
            hazard: None,
            loss_ratios: None,
            samples: None,
        };
        let expected = [(1, "u_ins_0_1"), (0, "u_ins_0_4"), (2, "u_ins_1")];
        assert_eq!(limit_states(&report), expected.map(|(place, name)| (place, name.to_owned())));
    }
}
