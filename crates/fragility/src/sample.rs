//! Samples to which a fragility is fitted, with the weights of their records; medians and steps.

use run::sample::sample_median;

use crate::curve::{Crossing, Curve, Exceedance};
use crate::term::Term;
use crate::weights::Weights;

/// What the records show of one limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    exceedances: Vec<Exceedance>,
    stripes: Vec<Stripe>,
    weights: Weights,
    /// Whether each level has its own records.
    is_apart: bool,
}

/// A level, and whether each record exceeds there; `None` of one that was not run there.
#[derive(Clone, Debug, PartialEq)]
struct Stripe {
    intensity: f64,
    exceeded: Vec<Option<bool>>,
}

/// Intensities at which records without common levels are read to count fractions.
const READ: u32 = 50;

impl Sample {
    /// Takes one exceedance of each record.
    pub fn of_records(exceedances: Vec<Exceedance>) -> Self {
        Self { exceedances, stripes: Vec::new(), weights: Weights::default(), is_apart: false }
    }

    /// Takes what the single runs of some records, at levels of their own, show of a `fraction` of `u_ins`.
    pub fn of_stripes(curves: &[Curve], fraction: f64, levels: &[f64]) -> Self {
        let stripe = |&intensity: &f64| {
            let at = |curve: &Curve| curve.runs().iter().find(|run| run.intensity == intensity).copied();
            let exceeds = |curve| at(curve).map(|run| run.exceeds(fraction));
            Stripe { intensity, exceeded: curves.iter().map(exceeds).collect() }
        };
        let first = |curve: &Curve| curve.exceedance(fraction, Crossing::First, true);
        let sample = Self::of_records(curves.iter().map(first).collect());
        Self { stripes: levels.iter().map(stripe).collect(), is_apart: true, ..sample }
    }

    /// Returns whether each level has its own records, so that none tells where it exceeds first.
    pub fn is_apart(&self) -> bool {
        self.is_apart
    }

    /// Weighs the records.
    #[must_use]
    pub fn weighted(self, weights: &Weights) -> Self {
        Self { weights: weights.clone(), ..self }
    }

    /// Takes what the curves of some records show of a `fraction` of `u_ins`: one exceedance of each, or with
    /// [`Crossing::Fraction`] how many exceed at each level. `shared` holds the levels of all records, if
    /// they share them, of which those above the highest run do not count; if not, the curves are read at 50
    /// intensities, equally spaced by their logarithms between the lowest first and the highest last
    /// exceedance.
    pub fn of_curves(curves: &[Curve], fraction: f64, crossing: Crossing, shared: Option<&[f64]>) -> Self {
        let exceedances = |crossing| -> Vec<Exceedance> {
            curves.iter().map(|curve| curve.exceedance(fraction, crossing, shared.is_some())).collect()
        };
        let sample = Self::of_records(exceedances(crossing));
        if crossing != Crossing::Fraction {
            return sample;
        }
        let stripe = |intensity: f64| {
            let exceeded = curves.iter().map(|curve| curve.exceeds(fraction, intensity)).collect();
            Stripe { intensity, exceeded }
        };
        let stripes = if let Some(levels) = shared {
            let highest = curves.iter().map(Curve::top).fold(0.0, f64::max);
            levels.iter().copied().filter(|level| *level <= highest).map(stripe).collect()
        } else {
            let ends = |exceedances: Vec<Exceedance>| exceedances.into_iter().map(|one| one.bounds()[0]);
            let low =
                ends(exceedances(Crossing::First)).filter(|end| *end > 0.0).fold(f64::INFINITY, f64::min);
            let high = ends(exceedances(Crossing::Last)).fold(low, f64::max);
            let at = |k: u32| low * libm::exp(libm::log(high / low) * f64::from(k) / f64::from(READ - 1));
            if low < high { (0..READ).map(at).map(stripe).collect() } else { Vec::new() }
        };
        Self { stripes, ..sample }
    }

    /// Returns the weights of the records.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// Returns the exceedance of each record.
    pub fn exceedances(&self) -> &[Exceedance] {
        &self.exceedances
    }

    /// Returns the levels at which the fit counts, with the sums of the weights of all runs and of those that
    /// exceed: their numbers where all weights are 1. None where it takes the records one by one.
    pub fn counts(&self) -> Vec<(f64, [f64; 2])> {
        let ones = vec![1; self.exceedances.len()];
        let count = |stripe: &Stripe| (stripe.intensity, stripe.count(self.weights.times(&ones)));
        self.stripes.iter().map(count).collect()
    }

    /// Returns the terms of the likelihood of all records.
    pub(crate) fn terms(&self) -> Vec<Term> {
        let mut terms = Vec::new();
        self.prepared().terms(&vec![1; self.exceedances.len()], &mut terms);
        terms
    }

    /// Prepares terms for many fits, with the logarithms of all intensities.
    pub(crate) fn prepared(&self) -> Prepared<'_> {
        let term = |one: &Exceedance| Term::new(one.bounds().map(libm::log), 1.0);
        let stripe = |stripe: &Stripe| (libm::log(stripe.intensity), stripe.clone());
        Prepared {
            records: self.exceedances.iter().map(term).collect(),
            stripes: self.stripes.iter().map(stripe).collect(),
            weights: &self.weights,
        }
    }

    /// Bounds of the θ that the sample leaves open, by how often each record was drawn: no more than half of
    /// the records exceed below the lower one, at least half up to the upper one. Where the fractions fall
    /// with the intensity, nothing is known.
    pub(crate) fn open_bounds(&self, drawn: &[u32]) -> [f64; 2] {
        let [mut least, mut most] = [0.0, f64::INFINITY];
        for stripe in &self.stripes {
            let [runs, exceeded] = stripe.count(self.weights.times(drawn));
            if 2.0 * exceeded <= runs {
                least = f64::max(least, stripe.intensity);
            }
            if 2.0 * exceeded >= runs {
                most = f64::min(most, stripe.intensity);
            }
        }
        if self.stripes.is_empty() {
            [least, most] = [0, 1].map(|side| {
                let end = |(one, weight): (&Exceedance, f64)| (one.bounds()[side], weight);
                let mut ends: Vec<_> =
                    self.exceedances.iter().zip(self.weights.times(drawn)).map(end).collect();
                ends.sort_by(|a, b| a.0.total_cmp(&b.0));
                let all: f64 = self.weights.times(drawn).sum();
                let mut below = 0.0;
                let half = ends.iter().find(|(_, weight)| {
                    below += weight;
                    2.0 * below > all || (side == 1 && 2.0 * below == all)
                });
                half.map_or(f64::INFINITY, |end| end.0)
            });
        }
        if least <= most { [least, most] } else { [0.0, f64::INFINITY] }
    }

    /// Returns the largest distance between a curve and the fractions of the records that exceed, as the test
    /// of Kolmogorov and Smirnov takes it; of stripes, that at their levels. Where only two levels around an
    /// exceedance are known, it is the least distance that is possible.
    pub fn misfit(&self, probability: impl Fn(f64) -> f64) -> f64 {
        let counts = self.counts();
        let of_stripe = |(intensity, [runs, exceeded]): &(f64, [f64; 2])| {
            (probability(*intensity) - exceeded / runs).abs()
        };
        if !counts.is_empty() {
            return counts.iter().filter(|(_, [runs, _])| *runs > 0.0).map(of_stripe).fold(0.0, f64::max);
        }
        let [starts, ends] = [0, 1].map(|side| self.shares(|one| one.bounds()[side]));
        let before = |&(y, [below, _]): &(f64, [f64; 2])| probability(y) - below;
        let after = |&(y, [_, up_to]): &(f64, [f64; 2])| up_to - probability(y);
        let known = starts.iter().filter(|(start, _)| *start > 0.0).map(before);
        known.chain(ends.iter().filter(|(end, _)| end.is_finite()).map(after)).fold(0.0, f64::max)
    }

    /// Returns a number of each exceedance, in rising order, with the shares of the records before it and up
    /// to it.
    fn shares(&self, of: impl Fn(&Exceedance) -> f64) -> Vec<(f64, [f64; 2])> {
        let ones = vec![1; self.exceedances.len()];
        let mut numbers: Vec<_> = self.exceedances.iter().map(of).zip(self.weights.times(&ones)).collect();
        numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all: f64 = self.weights.times(&ones).sum();
        let mut up_to = 0.0;
        let share = |(number, weight)| {
            let below = up_to;
            up_to += weight;
            (number, [below / all, up_to / all])
        };
        numbers.into_iter().map(share).collect()
    }

    /// Returns a fractile: the lowest intensity up to which at least a `part` of the records exceed.
    pub fn fractile(&self, part: f64) -> Option<f64> {
        let (mut shares, all) =
            (self.shares(|one| one.or_infinity()).into_iter(), self.exceedances.len() as f64);
        shares.find(|(_, [_, up_to])| up_to * all >= part * all - 1e-9).map(|(intensity, _)| intensity)
    }

    /// Returns the steps of the empirical fragility: intensities in rising order, each with the fraction of
    /// the records that exceed the limit state from there on. Censored records count among all records.
    pub fn steps(&self) -> Vec<(f64, f64)> {
        let steps = self.shares(|exceedance| exceedance.or_infinity()).into_iter();
        steps.filter(|(x, _)| x.is_finite()).map(|(x, [_, up_to])| (x, up_to)).collect()
    }
}

impl Stripe {
    /// Sums the weights of the runs and of those that exceed, by the weight of each record.
    fn count(&self, weights: impl Iterator<Item = f64>) -> [f64; 2] {
        let mut counts = [0.0; 2];
        for (exceeded, weight) in self.exceeded.iter().zip(weights) {
            counts[0] += if exceeded.is_some() { weight } else { 0.0 };
            counts[1] += if *exceeded == Some(true) { weight } else { 0.0 };
        }
        counts
    }
}

/// A sample with the logarithms of its intensities.
pub(crate) struct Prepared<'a> {
    records: Vec<Term>,
    stripes: Vec<(f64, Stripe)>,
    weights: &'a Weights,
}

impl Prepared<'_> {
    /// Puts the terms of the likelihood in place of others, by how often each record was drawn.
    pub(crate) fn terms(&self, drawn: &[u32], terms: &mut Vec<Term>) {
        terms.clear();
        for (y, stripe) in &self.stripes {
            let [runs, exceeded] = stripe.count(self.weights.times(drawn));
            let below = Term::new([f64::NEG_INFINITY, *y], exceeded);
            let above = Term::new([*y, f64::INFINITY], runs - exceeded);
            terms.extend([below, above].into_iter().filter(|term| term.runs > 0.0));
        }
        let records = self.records.iter().zip(self.weights.times(drawn)).filter(|(_, runs)| *runs > 0.0);
        let records = records.filter(|_| self.stripes.is_empty());
        terms.extend(records.map(|(term, runs)| term.of_runs(runs)));
    }
}

/// Returns the median exceedance: the intensity that half of the records need, infinite where it is above the
/// levels.
pub fn median(exceedances: &[Exceedance]) -> f64 {
    let mut intensities: Vec<f64> = exceedances.iter().map(|exceedance| exceedance.or_infinity()).collect();
    sample_median(&mut intensities)
}
