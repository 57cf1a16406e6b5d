//! The fragility of a wall under twenty synthetic motions.

use fragility::{Bootstrap, Dispersion, Estimator, Sample, Summary, compare};
use ground_motion::{STANDARD_GRAVITY, SyntheticMotion};
use report::number;
use report::plot::{Axis, Plot, Series};
use report::table::{Digits, Table};
use rocking_wall::variables::{DampingModel, Impact};
use rocking_wall::wall::{Damping, Parameters};
use run::model::{EnergyLoss, Model};
use run::records::NamedRecord;
use run::walls::NamedWall;
use serde_json::{Value, json};
use study::ida::{Crossing, Curve, IntensityMeasure, Levels, Study};

/// Synthetic motions, with the seeds 1, 2, …
const MOTIONS: u32 = 20;
/// Their length and step \[s\].
const DURATION: f64 = 20.0;
const STEP: f64 = 0.01;
/// Limit states as fractions of `u_ins`, and their names.
const STATES: [(f64, &str); 2] = [(0.4, "moderate damage, 0.4 u_ins"), (1.0, "collapse")];
/// Resamples of the bootstrap, and its seed.
const RESAMPLES: usize = 400;
const SEED: u64 = 1;

/// A fragility that is computed motion by motion, so that the page can show the progress.
#[derive(Debug)]
pub(crate) struct Fragility {
    study: Study,
    curves: Vec<Curve>,
    /// Peak acceleration of the motion that the page shows \[m/s²\].
    peak: Option<f64>,
}

impl Fragility {
    /// Prepares the fragility of a wall.
    pub(crate) fn new(parameters: Parameters, peak: Option<f64>) -> Result<Self, String> {
        let model = Model::new(energy_loss(&parameters)?);
        let walls = vec![NamedWall::new("the wall", parameters)];
        let record = |seed: u32| {
            let recipe = SyntheticMotion { seed: seed.into(), duration: DURATION, step: STEP, peak: 1.0 };
            recipe.motion().map(|motion| NamedRecord::new(format!("synthetic {seed}"), motion))
        };
        let records: Result<Vec<_>, _> = (1..=MOTIONS).map(record).collect();
        let records = records.map_err(|error| error.to_string())?;
        let levels = Levels::HuntAndFill {
            first: 0.05 * STANDARD_GRAVITY,
            increase: 0.05 * STANDARD_GRAVITY,
            top: 10.0 * STANDARD_GRAVITY,
            resolution: 0.02,
            gap: 0.25,
        };
        let study = Study::new(walls, records, vec![model], IntensityMeasure::Pga, levels);
        let study = study.map_err(|error| error.to_string())?;
        Ok(Self { study, curves: Vec::new(), peak })
    }

    /// Runs the next motion. Returns how many are done, and after the last one the result too.
    pub(crate) fn next(&mut self) -> Result<Value, String> {
        let done = self.curves.len();
        if done < self.study.count() {
            let curve = self.study.curve(self.study.case(done)).map_err(|error| error.to_string())?;
            self.curves.push(curve);
        }
        let (done, count) = (self.curves.len(), self.study.count());
        let result = (done == count).then(|| self.result());
        Ok(json!({ "done": done, "count": count, "result": result }))
    }

    fn result(&self) -> Value {
        let fractions = STATES.map(|(fraction, _)| fraction);
        let sample = |fraction| Sample::of_curves(&self.curves, fraction, Crossing::First, None);
        let states: Vec<Sample> = fractions.into_iter().map(sample).collect();
        let bootstrap = Bootstrap::new(self.curves.len(), RESAMPLES, SEED);
        let estimator = Estimator::new(Dispersion::Own, &fractions);
        let summaries = compare(std::slice::from_ref(&states), 0, &estimator, &bootstrap);
        let summaries: Vec<&Summary> = summaries.iter().filter_map(|state| state.first()).collect();
        let rows = summaries.iter().zip(STATES).map(|(summary, (_, name))| {
            let [median, low, high] = summary.theta.texts(STANDARD_GRAVITY, Digits::Decimals(2));
            let dispersion = summary.fitted.map(|curve| number(curve.dispersion, 2));
            let dispersion = dispersion.unwrap_or_else(|error| error.to_string());
            (name, [median, format!("{low} to {high}"), dispersion])
        });
        let table = Table::over(rows)
            .text("", "limit state", |(name, _)| *name)
            .text("", "median PGA (g)", |(_, cells)| cells[0].clone())
            .text("", "95 % interval,\nstudentised", |(_, cells)| cells[1].clone())
            .text("", "dispersion β", |(_, cells)| cells[2].clone())
            .done();
        json!({ "table": table.html(), "figure": self.chart(&states, &summaries).figure() })
    }

    fn chart(&self, states: &[Sample], summaries: &[&Summary]) -> Plot {
        let in_g = |intensity: f64| intensity / STANDARD_GRAVITY;
        let empirical = states.iter().map(|state| {
            let steps = state.steps().into_iter().filter(|step| step.0.is_finite());
            steps.map(|(intensity, part)| (in_g(intensity), part)).collect::<Vec<_>>()
        });
        let empirical: Vec<_> = empirical.collect();
        let largest = empirical.iter().flatten().map(|point| point.0).fold(0.1, f64::max);
        let right = 1.1 * largest.max(self.peak.map_or(0.0, in_g).min(2.0 * largest));
        let mut series = Vec::new();
        for (color, ((marks, summary), (_, name))) in
            empirical.into_iter().zip(summaries).zip(STATES).enumerate()
        {
            if let Ok(curve) = summary.fitted {
                let at = |k: u32| 0.005 * f64::from(k) * right;
                let point = |x: f64| (x, curve.probability(x * STANDARD_GRAVITY));
                series.push(Series::line(name, color, (1..=200).map(at).map(point).collect()));
            }
            series.push(Series::marks("", color, marks));
        }
        if let Some(peak) = self.peak.map(in_g).filter(|peak| *peak <= right) {
            series.push(Series::dashed("the motion above", 5, vec![(peak, 0.0), (peak, 1.0)]));
        }
        let (x, y) = (
            Axis::over("peak ground acceleration (g)", [0.0, right]),
            Axis::over("probability", [0.0, 1.02]),
        );
        let title = "Probability over peak ground acceleration: lognormal fit, and one dot for each motion";
        Plot::titled(title, x, y, series)
    }
}

/// The energy loss of a wall as a study knows it.
fn energy_loss(parameters: &Parameters) -> Result<EnergyLoss, String> {
    match (parameters.damping(), parameters.impact) {
        (damping, Impact::None) => Ok(EnergyLoss::Viscous(damping)),
        (Damping { model: DampingModel::None, .. }, Impact::Restitution) => Ok(EnergyLoss::Restitution),
        (_, Impact::Restitution) => Err("a fragility has viscous damping or restitution at impacts, not \
                                         both; set damping_model = none or impact = none"
            .to_owned()),
    }
}
