//! The results of a study, wall by wall: its curves, and the fragilities that follow from them.

use fragility::{
    Bootstrap, Cloud, Dispersion, Estimator, FitError, Lognormal, Sample, Summary, Weights, compare,
    compare_clouds, fit,
};

use crate::document::ReportOptions;
use crate::ida::{Crossing, Curve, Exceedance, Layout, Polarity};

/// Makes the results of each wall of a study.
#[derive(Clone, Debug)]
pub struct Fitting {
    records: usize,
    signs: usize,
    models: usize,
    reference: usize,
    fractions: Vec<f64>,
    /// Levels that all records share, in SI units.
    grid: Option<Vec<f64>>,
    crossing: Crossing,
    dispersion: Dispersion,
    layout: Layout,
    bootstrap: Bootstrap,
    /// β of modelling \[-\].
    modelling: f64,
    weights: Weights,
}

/// Curves of one wall with every model and record, and a fragility of every model and limit state.
#[derive(Clone, Debug)]
pub struct WallResults {
    records: usize,
    curves: Vec<Curve>,
    /// Limit state by limit state, model by model.
    states: Vec<Vec<StateResults>>,
    clouds: Vec<Cloud>,
}

/// Results of one model at one limit state.
#[derive(Clone, Debug)]
pub struct StateResults {
    /// The fragility.
    pub summary: Summary,
    /// What it was fitted to.
    pub sample: Sample,
    /// Curves of this limit state alone for each choice of the exceedance, in the order of [`Crossing::ALL`].
    pub by_crossing: [Result<Lognormal, FitError>; 3],
}

impl Fitting {
    /// Prepares the fits of a study from the names of its records and damping models. `grid` holds the levels
    /// that all records share, if they share them.
    pub fn new(records: usize, models: &[&str], grid: Option<Vec<f64>>, report: &ReportOptions) -> Self {
        Self {
            records,
            signs: 1,
            models: models.len(),
            reference: models.iter().position(|name| *name == report.reference).unwrap_or(0),
            fractions: report.fractions.clone(),
            grid,
            crossing: report.collapse,
            layout: Layout::Curves,
            dispersion: report.beta,
            bootstrap: Bootstrap::new(records, report.resamples as usize, report.seed)
                .weighted(&report.weights)
                .corrected(report.small_sample),
            modelling: report.modelling_uncertainty,
            weights: report.weights.clone(),
        }
    }

    /// Takes the curves as a cloud, of one run each, or as stripes of their own records.
    #[must_use]
    pub fn with_layout(self, layout: Layout) -> Self {
        Self { layout, ..self }
    }

    /// Takes records of both signs as pairs, which the bootstrap draws together.
    #[must_use]
    pub fn with_polarity(self, polarity: Polarity) -> Self {
        let signs = polarity.signs();
        Self { signs, bootstrap: self.bootstrap.in_groups(signs), ..self }
    }

    /// Returns how many of the records follow each other as signs of one.
    pub fn signs(&self) -> usize {
        self.signs
    }

    /// Returns the β of modelling, with which [`Summary::widened`] makes probabilities of a fit.
    pub fn modelling(&self) -> f64 {
        self.modelling
    }

    /// Returns the probability below which a number says nothing, by the number of records.
    pub fn least_probability(&self) -> f64 {
        self.bootstrap.least_probability()
    }

    /// Fits the fragilities of a wall. `curves` has models outermost, records innermost.
    ///
    /// # Panics
    /// If there is not one curve for each model and record.
    pub fn results(&self, curves: Vec<Curve>) -> WallResults {
        let all = Crossing::ALL.map(|(_, crossing)| self.samples(&curves, &self.fractions, crossing));
        let chosen =
            &all[Crossing::ALL.iter().position(|(_, crossing)| *crossing == self.crossing).unwrap_or(0)];
        let summaries = self.summaries(&curves, &self.fractions);
        let state = |(state, summaries): (usize, Vec<Summary>)| {
            let of_model = |(model, summary): (usize, Summary)| {
                let fit = |samples: &Vec<Vec<Sample>>| {
                    fit(&samples[model][state]).map(|curve| self.bootstrap.correct(curve))
                };
                let [a, b, c] = &all;
                // the single run of a record in a cloud tells no crossing
                let none = [Err(FitError::Cloud); 3];
                let by_crossing = if self.layout == Layout::Cloud { none } else { [fit(a), fit(b), fit(c)] };
                StateResults { summary, sample: chosen[model][state].clone(), by_crossing }
            };
            summaries.into_iter().enumerate().map(of_model).collect()
        };
        let states = summaries.into_iter().enumerate().map(state).collect();
        WallResults { records: self.records, clouds: self.clouds(&curves), curves, states }
    }

    /// Fits the fragilities of a wall at some fractions of `u_ins`: fraction by fraction, model by model,
    /// with their resamples.
    ///
    /// # Panics
    /// As [`results`](Self::results).
    pub fn summaries(&self, curves: &[Curve], fractions: &[f64]) -> Vec<Vec<Summary>> {
        if self.layout == Layout::Cloud {
            return compare_clouds(&self.clouds(curves), fractions, self.reference, &self.bootstrap);
        }
        let samples = self.samples(curves, fractions, self.crossing);
        compare(&samples, self.reference, &Estimator::new(self.dispersion, fractions), &self.bootstrap)
    }

    /// Takes the clouds of the models; none of other studies.
    fn clouds(&self, curves: &[Curve]) -> Vec<Cloud> {
        let curves = if self.layout == Layout::Cloud { curves } else { &[] };
        curves.chunks(self.records).map(|curves| Cloud::of_curves(curves).weighted(&self.weights)).collect()
    }

    /// Counts the records.
    pub fn records(&self) -> usize {
        self.records
    }

    /// Takes what the curves show of some fractions of `u_ins`, model by model.
    fn samples(&self, curves: &[Curve], fractions: &[f64], crossing: Crossing) -> Vec<Vec<Sample>> {
        assert_eq!(curves.len(), self.models * self.records, "one curve for each model and record");
        let of_model = |curves: &[Curve]| {
            // a cloud has no demands between the origin and its runs
            let levels = if self.layout == Layout::Cloud { Some(&[][..]) } else { self.grid.as_deref() };
            let of_state = |fraction| {
                let sample = match levels {
                    Some(levels) if self.layout == Layout::Stripes => {
                        Sample::of_stripes(curves, fraction, levels)
                    }
                    _ => Sample::of_curves(curves, fraction, crossing, levels),
                };
                sample.weighted(&self.weights)
            };
            fractions.iter().copied().map(of_state).collect()
        };
        curves.chunks(self.records).map(of_model).collect()
    }
}

impl WallResults {
    /// Returns all curves, models outermost, records innermost.
    pub fn all_curves(&self) -> &[Curve] {
        &self.curves
    }

    /// Returns the curves of a model, record by record.
    pub fn curves(&self, model: usize) -> &[Curve] {
        &self.curves[model * self.records..(model + 1) * self.records]
    }

    /// Returns the cloud of each model; empty for other studies.
    pub fn clouds(&self) -> &[Cloud] {
        &self.clouds
    }

    /// Returns where each record exceeds a limit state, given by its index.
    pub fn exceedances(&self, state: usize, model: usize) -> &[Exceedance] {
        self.states[state][model].sample.exceedances()
    }

    /// Returns the results at a limit state, given by its index: one for each model.
    pub fn states(&self, state: usize) -> &[StateResults] {
        &self.states[state]
    }

    /// Returns the fragilities at a limit state, given by its index: one for each model.
    pub fn summaries(&self, state: usize) -> impl ExactSizeIterator<Item = &Summary> {
        self.states[state].iter().map(|results| &results.summary)
    }

    /// Returns the fragility of a model at a limit state.
    pub fn summary(&self, state: usize, model: usize) -> &Summary {
        &self.states[state][model].summary
    }

    /// Returns whether the limit states of a model contradict a common β.
    pub fn is_contradicted(&self, model: usize) -> bool {
        self.states.first().is_some_and(|models| models[model].summary.contradicted)
    }
}
