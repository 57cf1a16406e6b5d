//! Fragilities: fits, medians, bootstrap.

use proptest::prelude::*;

use fragility::{
    Bootstrap, Dispersion, Estimator, FitError, Interval, Lognormal, Sample, Summary, compare, cumulative,
    fit, fit_jointly, median,
};
use report::table::Digits;
use run::sample::{Pcg, sample_median};
use study::ida::{Crossing, Curve, Exceedance, Run};

use crate::configuration::mostly;
use crate::estimators::{medians, stripes};

const TRUTH: Lognormal = Lognormal { median: 0.62, dispersion: 0.45 };

/// Returns the z with Φ(z) = p, by bisection; infinite at 0 and 1, NaN outside.
fn quantile(p: f64) -> f64 {
    match p {
        0.0 => return f64::NEG_INFINITY,
        1.0 => return f64::INFINITY,
        p if !(p > 0.0 && p < 1.0) => return f64::NAN,
        _ => {}
    }
    let (mut low, mut high) = (-39.0, 39.0);
    // 78 · 2⁻⁶⁰ is below a rounding of z = 1
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if cumulative(middle) < p { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Intensities at the middles of `count` equally likely parts of the truth.
fn stratified(count: u32) -> Vec<f64> {
    let z = |k: u32| quantile((f64::from(k) + 0.5) / f64::from(count));
    (0..count).map(|k| TRUTH.median * libm::exp(TRUTH.dispersion * z(k))).collect()
}

fn of_records(exceedances: &[Exceedance]) -> Result<Lognormal, FitError> {
    fit(&Sample::of_records(exceedances.to_vec()))
}

fn near(found: f64, wanted: f64, allowed: f64) {
    assert!((found - wanted).abs() <= allowed, "{found} is not {wanted} to {allowed:e}");
}

#[test]
fn the_normal_distribution_has_its_textbook_values() {
    // Abramowitz and Stegun, table 26.1
    for (z, p) in [
        (0.0, 0.5),
        (1.0, 0.841_344_746_068_543),
        (-1.96, 0.024_997_895_148_220),
        (3.0, 0.998_650_101_968_370),
    ] {
        near(cumulative(z), p, 1e-14);
        // |dz/dp| is 226 at z = 3
        near(quantile(p), z, 1e-11);
    }
    assert!(quantile(0.0) == f64::NEG_INFINITY && quantile(1.0) == f64::INFINITY && quantile(1.5).is_nan());
}

/// For exact intensities, the maximum-likelihood θ is the geometric mean and β the standard deviation with
/// 1/n.
#[test]
fn exact_intensities_have_a_closed_form() {
    let intensities = [0.31, 0.44, 0.58, 0.61, 0.9, 1.7];
    let logarithms = intensities.map(f64::ln);
    let mean = logarithms.iter().sum::<f64>() / 6.0;
    let variance = logarithms.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / 6.0;
    let exact = intensities.map(Exceedance::At).to_vec();
    let found = of_records(&exact).unwrap();
    // sums of six terms
    near(found.median, mean.exp(), 1e-15);
    near(found.dispersion, variance.sqrt(), 1e-15);
    // a record censored 40 β below has no influence, but Newton's method finds the same values; its last step
    // leaves 1e-14
    let searched = of_records(&[&exact[..], &[Exceedance::Above(1e-9)]].concat()).unwrap();
    near(searched.median, found.median, 1e-13);
    near(searched.dispersion, found.dispersion, 1e-13);
}

#[test]
fn stripes_recover_the_truth() {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a probability of 1e5")]
    let counts = [0.2, 0.4, 0.6, 0.8, 1.2, 2.0].map(|x| (x, (1e5 * TRUTH.probability(x)).round() as u32));
    let found = fit(&stripes(100_000, &counts)).unwrap();
    // counts rounded to 5e-6 of the runs; θ and β follow within a few times that
    near(found.median, TRUTH.median, 5e-5);
    near(found.dispersion, TRUTH.dispersion, 5e-5);
}

/// A large sample censored at 0.7 still gives the true values; leaving out the censored records does not.
#[test]
fn censored_records_count() {
    let top = 0.7;
    let sample = stratified(4000);
    let censored: Vec<_> =
        sample.iter().map(|&x| if x <= top { Exceedance::At(x) } else { Exceedance::Above(top) }).collect();
    let found = of_records(&censored).unwrap();
    // the error of a stratified sample of n is O(1/n), that of a random one O(1/√n)
    near(found.median, TRUTH.median, 2e-3);
    near(found.dispersion, TRUTH.dispersion, 2e-3);
    let kept: Vec<_> = censored.iter().copied().filter(|o| matches!(o, Exceedance::At(_))).collect();
    assert!(of_records(&kept).unwrap().median < 0.8 * TRUTH.median);
}

/// With steps as wide as half of θ, a record is known only to lie between two levels. These give the true
/// values; taking the upper level as the record's intensity does not.
#[test]
fn wide_steps_leave_intervals() {
    let step = 0.31;
    let upper = |x: f64| (x / step).ceil() * step;
    let sample: Vec<_> =
        stratified(4000).into_iter().map(|x| Exceedance::Between([upper(x) - step, upper(x)])).collect();
    let found = of_records(&sample).unwrap();
    // counts are off by less than one in 4000
    near(found.median, TRUTH.median, 1e-3);
    near(found.dispersion, TRUTH.dispersion, 1e-3);
    let upper: Vec<_> = stratified(4000).into_iter().map(|x| Exceedance::At(upper(x))).collect();
    assert!(of_records(&upper).unwrap().median > 1.15 * TRUTH.median);
}

#[test]
fn what_gives_no_curve_is_refused() {
    use Exceedance::{Above, At, Between};
    for (records, error) in [
        (vec![], FitError::OneSided),
        (vec![Above(1.0), Above(1.0)], FitError::OneSided),
        (vec![At(0.5)], FitError::NoScatter),
        (vec![At(0.5), At(0.5), Above(0.4)], FitError::NoScatter),
        (vec![At(-1.0), At(1.0)], FitError::Exceedance),
        (vec![At(f64::NAN), At(1.0)], FitError::Exceedance),
        (vec![At(0.5), At(0.0)], FitError::Exceedance),
        (vec![At(0.5), Above(f64::INFINITY)], FitError::Exceedance),
        (vec![At(0.5), Between([2.0, 1.0])], FitError::Exceedance),
    ] {
        assert_eq!(of_records(&records), Err(error), "{records:?}");
    }
    for (counts, error) in [
        (vec![(1.0, 10), (2.0, 10)], FitError::OneSided),
        (vec![(0.5, 0), (1.0, 10)], FitError::NoScatter),
        (vec![(0.5, 0), (1.0, 4), (2.0, 10)], FitError::NoScatter),
        (vec![(0.5, 9), (1.0, 2)], FitError::Falling),
    ] {
        assert_eq!(fit(&stripes(10, &counts)), Err(error), "{counts:?}");
    }
    // far tails: likelihoods of e^-1000 and less are still distinguished
    let far = of_records(&[At(1e-6), At(1.1e-6), Above(1e-3), At(1e3)]).unwrap();
    assert!(far.median.is_finite() && far.dispersion > 5.0);
}

#[test]
fn medians_and_steps_count_censored_records() {
    use Exceedance::{Above, At, Between};
    assert_eq!(median(&[At(0.3), At(0.1), At(0.2)]), 0.2);
    assert_eq!(median(&[At(0.3), At(0.1), At(0.2), Above(1.0)]), 0.25);
    assert_eq!(median(&[At(0.3), Above(1.0), Above(1.0)]), f64::INFINITY);
    let sample = Sample::of_records(vec![At(0.3), Above(1.0), At(0.1), Above(1.0)]);
    assert_eq!(sample.steps(), [(0.1, 0.25), (0.3, 0.5)]);
    // the middle of two levels, by their ratio; the lowest level for an exceedance below it
    assert_eq!(median(&[At(0.3), Between([0.1, 0.4]), At(0.1)]), 0.2);
    assert_eq!(median(&[Between([0.0, 0.4])]), 0.4);
}

/// The interval of a median contains the true value in 95 % of 200 random samples, within four standard
/// errors of the count, √(200 · 0.95 · 0.05) = 3.1.
#[test]
fn bootstrap_intervals_cover_the_truth() {
    let population = stratified(5000);
    let mut covered = 0;
    for seed in 0..200 {
        // the draws of one bootstrap serve as random samples
        let sample: Vec<Exceedance> = draws(&population, 40, 1000 + seed);
        let bootstrap = Bootstrap::new(sample.len(), 400, seed);
        let interval = Interval::new(median(&sample), medians(&bootstrap, &sample), 0.95);
        covered += u32::from(interval.range[0] <= TRUTH.median && TRUTH.median <= interval.range[1]);
        assert!(interval.range[0] <= interval.estimate && interval.estimate <= interval.range[1]);
    }
    assert!((178..=200).contains(&covered), "{covered} of 200");
}

/// `count` members of a population, at random.
fn draws(population: &[f64], count: usize, seed: u64) -> Vec<Exceedance> {
    let all: Vec<Exceedance> = population.iter().copied().map(Exceedance::At).collect();
    // the median of a resample of one is a member drawn
    let one = |index: u64| {
        let mut state =
            seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(index.wrapping_mul(0xD1B5_4A32_D192_ED03));
        state ^= state >> 29;
        state = state.wrapping_mul(0xBF58_476D_1CE4_E5B9);
        state ^= state >> 32;
        all[usize::try_from(state % all.len() as u64).unwrap()]
    };
    (0..count as u64).map(one).collect()
}

/// The scatter of records cancels in the ratio of two models. A model whose collapse intensity is always 10 %
/// higher has a ratio of 1.1 with an interval of zero width.
#[test]
fn ratios_are_paired() {
    let one: Vec<Exceedance> = stratified(30).into_iter().map(Exceedance::At).collect();
    let other: Vec<Exceedance> = stratified(30).into_iter().map(|x| Exceedance::At(1.1 * x)).collect();
    let bootstrap = Bootstrap::new(30, 500, 7);
    for resampled in [medians, |b: &Bootstrap, o: &[Exceedance]| {
        let [theta, _] =
            b.fitted(&[Sample::of_records(o.to_vec())], &Estimator::new(Dispersion::Own, &[1.0])).remove(0);
        theta.samples.into_iter().map(|[_, most]| most).collect()
    }] {
        let (a, b): (Vec<f64>, Vec<f64>) = (resampled(&bootstrap, &one), resampled(&bootstrap, &other));
        assert!(a.iter().any(|median| (median / TRUTH.median - 1.0).abs() > 0.05), "resamples differ");
        let interval = Interval::new(1.1, b.iter().zip(&a).map(|(b, a)| b / a), 0.95);
        near(interval.range[0], 1.1, 1e-8);
        near(interval.range[1], 1.1, 1e-8);
    }
    let again = medians(&Bootstrap::new(30, 500, 7), &one);
    assert_eq!(again, medians(&bootstrap, &one), "the same seed draws the same");
}

/// On a grid of four stripes, separate fits place the median of the lower limit state above that of the
/// higher one. The joint fit keeps their order.
#[test]
fn curves_of_growing_limit_states_do_not_cross() {
    let states = [[3, 3, 4, 4], [0, 0, 4, 4]]
        .map(|counts| stripes(10, &[1.0, 2.0, 3.0, 4.0].into_iter().zip(counts).collect::<Vec<_>>()));
    let [lower, higher] = [0, 1].map(|state| fit(&states[state]).unwrap());
    assert!(lower.median > 1.5 * higher.median, "{lower:?} {higher:?}");
    let joint: Vec<Lognormal> = fit_jointly(&states).into_iter().map(Result::unwrap).collect();
    assert_eq!(joint[0].dispersion, joint[1].dispersion);
    assert!(joint[0].median < joint[1].median, "{joint:?}");
}

/// For exact intensities, θ are the geometric means, and β pools the squares of all limit states.
#[test]
fn exact_limit_states_pool_their_dispersion() {
    let states = [vec![1.0, 2.0, 4.0], vec![3.0, 9.0, 27.0]];
    let observed = states.map(|state| state.into_iter().map(Exceedance::At).collect::<Vec<_>>());
    let joint: Vec<Lognormal> =
        fit_jointly(&observed.clone().map(Sample::of_records)).into_iter().map(Result::unwrap).collect();
    let variance = (2.0_f64.ln().powi(2) + 3.0_f64.ln().powi(2)) / 3.0;
    for (found, median) in joint.iter().zip([2.0, 9.0]) {
        near(found.median, median, 1e-14 * median);
        near(found.dispersion, variance.sqrt(), 1e-14);
    }
    // Newton's method finds the same, and a limit state without a curve leaves the others alone
    let with_one = |state: &[Exceedance]| [state, &[Exceedance::Above(1e-9)]].concat();
    let censored = [with_one(&observed[0]), vec![Exceedance::Above(1.0)], with_one(&observed[1])];
    let searched = fit_jointly(&censored.map(Sample::of_records));
    assert_eq!(searched[1], Err(FitError::OneSided));
    for (found, exact) in [searched[0], searched[2]].into_iter().zip(joint) {
        near(found.unwrap().median, exact.median, 1e-12);
        near(found.unwrap().dispersion, exact.dispersion, 1e-13);
    }
}

/// A run that exceeds a limit state exceeds those below it: the medians of the joint fit rise.
#[test]
fn medians_rise_with_the_limit_states() {
    let records = prop::collection::vec([0.1..4.0_f64, 0.0..2.0, 0.0..2.0], 2..30);
    mostly(0.95, (records, any::<bool>()), |(records, striped)| {
        let step = 0.25;
        let state = |number: usize| -> Vec<Exceedance> {
            let reach = |increments: &[f64; 3]| increments[..=number].iter().sum::<f64>();
            let exceedance = |intensity: f64| match intensity {
                intensity if intensity > 5.0 => Exceedance::Above(5.0),
                intensity if striped => {
                    let upper = (intensity / step).ceil() * step;
                    Exceedance::Between([upper - step, upper])
                }
                intensity => Exceedance::At(intensity),
            };
            records.iter().map(reach).map(exceedance).collect()
        };
        let states: Vec<_> = (0..3).map(state).map(Sample::of_records).collect();
        let medians: Vec<f64> = fit_jointly(&states).into_iter().flatten().map(|fit| fit.median).collect();
        for pair in medians.windows(2) {
            // Newton's last step leaves 1e-14
            prop_assert!(pair[0] <= pair[1] * (1.0 + 1e-12), "{medians:?}");
        }
        Ok([medians.len().saturating_sub(1), states.len() - 1])
    });
}

/// Limit states whose own dispersions are 0.45 and 0.15 contradict a common one; equal ones do not.
#[test]
fn a_common_dispersion_can_be_contradicted() {
    let sample = stratified(40);
    let exceed = |intensity: &f64, power: f64| Exceedance::At(intensity.powf(power));
    let state = |power: f64| sample.iter().map(|x| exceed(x, power)).collect::<Vec<_>>();
    let bootstrap = Bootstrap::new(40, 100, 1);
    for (power, contradicted) in [(1.0 / 3.0, true), (1.0, false)] {
        let models = [[1.0, power].map(|power| Sample::of_records(state(power))).to_vec()];
        let estimator = Estimator::new(Dispersion::Common, &[0.4, 1.0]);
        for summaries in compare(&models, 0, &estimator, &bootstrap) {
            assert_eq!(summaries[0].contradicted, contradicted, "{summaries:?}");
        }
    }
}

/// Where the levels leave a number open, its bound is stated instead of ∞, and ratios have theirs.
#[test]
fn open_numbers_have_their_bounds() {
    use Exceedance::{Above, At};
    let known: Vec<Exceedance> = [1.0, 2.0, 3.0, 3.0, 4.0, 5.0].map(At).to_vec();
    let open = vec![At(2.0), At(2.0), Above(5.0), Above(5.0), Above(5.0), Above(5.0)];
    let never = vec![Above(5.0); 6];
    let bootstrap = Bootstrap::new(6, 200, 1);
    let compared = |models: &[Vec<Exceedance>], reference: usize| -> Vec<Summary> {
        let models: Vec<_> = models.iter().map(|model| vec![Sample::of_records(model.clone())]).collect();
        compare(&models, reference, &Estimator::new(Dispersion::Own, &[1.0]), &bootstrap).remove(0)
    };
    let models = [known, open, never];
    let summaries = compared(&models, 0);
    let texts = |interval: &Interval| interval.texts(1.0, Digits::Decimals(2));
    assert_eq!(texts(&summaries[0].median)[0], "3.00");
    assert_eq!(texts(&summaries[1].median), ["open >5.00", "2.00", "open >5.00"]);
    // 5 over the median 3 of the reference
    assert_eq!(texts(&summaries[1].median_ratio)[0], "open >1.67");
    assert_eq!(texts(&summaries[2].theta), ["open >5.00", "open >5.00", "open >5.00"]);
    assert_eq!(summaries[2].fitted, Err(FitError::OneSided));
    // over an open reference, a known median has an upper bound, and an open one none
    let summaries = compared(&models, 2);
    assert_eq!(texts(&summaries[0].median_ratio)[0], "open <0.60");
    assert_eq!(texts(&summaries[1].median_ratio)[0], "open");
    assert_eq!(texts(&summaries[2].median_ratio), ["1.00", "1.00", "1.00"]);
    // at the lowest level, a record exceeds anywhere up to it
    let lowest = Exceedance::Between([0.0, 3.0]);
    let next = Exceedance::Between([3.0, 4.0]);
    let summaries = compared(&[vec![lowest; 6], vec![lowest, lowest, next, next, next, next]], 0);
    for interval in [summaries[0].median, summaries[0].theta] {
        assert_eq!(texts(&interval), ["open <3.00", "open <3.00", "open <3.00"]);
    }
    assert_eq!(texts(&summaries[1].median), ["3.46", "open <3.00", "3.46"]);
    assert_eq!(texts(&summaries[1].theta), ["open 3.00 to 4.00", "open <3.00", "open 3.00 to 4.00"]);
}

/// One stripe does not determine a curve: its fraction says on which side of it θ lies.
#[test]
fn one_stripe_gives_a_bound() {
    let bootstrap = Bootstrap::new(10, 200, 1);
    for (fallen, text) in
        [(0, "open >3.00"), (3, "open >3.00"), (5, "3.00"), (7, "open <3.00"), (10, "open <3.00")]
    {
        let run = |record: u32| Run {
            intensity: 3.0,
            demand: 1.0,
            overturning: (record < fallen).then_some(1.0),
            ..Run::default()
        };
        let curves: Vec<_> = (0..10).map(|record| Curve::new(vec![run(record)])).collect();
        let sample = Sample::of_curves(&curves, 1.0, Crossing::Fraction, Some(&[3.0]));
        let estimator = Estimator::new(Dispersion::Own, &[1.0]);
        let summary = compare(&[vec![sample]], 0, &estimator, &bootstrap).remove(0).remove(0);
        assert!(summary.fitted.is_err() && summary.beta.estimate.is_nan());
        assert_eq!(summary.theta.texts(1.0, Digits::Decimals(2))[0], text, "{fallen} of 10");
    }
}

/// The median of a resample is that of the records that were drawn, whether their number is even or odd.
#[test]
fn medians_of_resamples_are_those_of_what_was_drawn() {
    for count in [4, 5] {
        let at = |record: usize| match record {
            2 => Exceedance::Above(3.0),
            1 => Exceedance::Between([1.0, 4.0]),
            _ => Exceedance::At(1.0 + record as f64),
        };
        let exceedances: Vec<_> = (0..count).map(at).collect();
        let mut random = Pcg::new(3);
        for found in medians(&Bootstrap::new(count, 60, 3), &exceedances) {
            let draw = |_| exceedances[random.below(count)].or_infinity();
            assert_eq!(found, sample_median(&mut (0..count).map(draw).collect::<Vec<_>>()));
        }
    }
}

/// Twice the same runs have the same maximum, since both fits go on until it is reached: to 1e-14
/// standard errors, which a rounding of ln L of 1e-14 would make 1e-7.
#[test]
fn fits_reach_the_maximum() {
    let mut random = Pcg::new(2);
    let mut compared = 0;
    for _ in 0..60 {
        let mut count = |k: u32| {
            let exceeded = (4 * k + u32::try_from(random.below(9)).unwrap()).min(30);
            (0.3 + 0.2 * f64::from(k), exceeded)
        };
        let once: Vec<_> = (0..8).map(&mut count).collect();
        let twice: Vec<_> = once.iter().map(|(intensity, exceeded)| (*intensity, 2 * exceeded)).collect();
        let (Ok(one), Ok(two)) = (fit(&stripes(30, &once)), fit(&stripes(60, &twice))) else { continue };
        assert!((one.median / two.median - 1.0).abs() < 1e-13, "{one:?} {two:?}");
        assert!((one.dispersion / two.dispersion - 1.0).abs() < 1e-13, "{one:?} {two:?}");
        compared += 1;
    }
    assert!(compared > 50, "{compared}");
}
