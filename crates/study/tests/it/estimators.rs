//! Fits of fragilities against maxima that are searched for without derivatives.

use fragility::{
    Bootstrap, Dispersion, Estimator, Lognormal, Sample, Summary, TAIL, compare, cumulative, fit,
};
use study::codes::NoCodes;
use study::document::StudyFile;
use study::ida::{Crossing, Curve, Exceedance, Run};
use study::results::Fitting;

/// An exceedance, and how many runs have it.
type Counted = (Exceedance, u32);

/// The runs of stripes, each with its intensity and how many of the runs exceed.
fn counted(runs: u32, stripes: &[(f64, u32)]) -> Vec<Counted> {
    let of_stripe = |&(intensity, exceeded): &(f64, u32)| {
        [(Exceedance::Between([0.0, intensity]), exceeded), (Exceedance::Above(intensity), runs - exceeded)]
    };
    stripes.iter().flat_map(of_stripe).collect()
}

/// The sample of records whose runs have these counts at the levels.
pub(crate) fn stripes(runs: u32, stripes: &[(f64, u32)]) -> Sample {
    let curve = |record: u32| {
        let run = |&(intensity, exceeded): &(f64, u32)| {
            let overturning = (record < exceeded).then_some(1.0);
            Run { intensity, demand: 1.0, overturning, ..Run::default() }
        };
        Curve::new(stripes.iter().map(run).collect())
    };
    let curves: Vec<_> = (0..runs).map(curve).collect();
    let levels: Vec<_> = stripes.iter().map(|(intensity, _)| *intensity).collect();
    Sample::of_curves(&curves, 1.0, Crossing::Fraction, Some(&levels))
}

/// The median of each resample of some exceedances.
pub(crate) fn medians(bootstrap: &Bootstrap, exceedances: &[Exceedance]) -> Vec<f64> {
    let sample = Sample::of_records(exceedances.to_vec());
    bootstrap.medians(&[sample]).remove(0).samples.into_iter().map(|[_, most]| most).collect()
}

/// ln L of a curve, term by term, from Φ and φ alone.
fn log_likelihood(runs: &[Counted], median: f64, dispersion: f64) -> f64 {
    let z = |x: f64| (x / median).ln() / dispersion;
    let term = |(exceedance, count): &Counted| {
        let one = match *exceedance {
            Exceedance::At(x) => -0.5 * z(x).powi(2) - dispersion.ln(),
            Exceedance::Between([from, to]) => (cumulative(z(to)) - cumulative(z(from))).ln(),
            Exceedance::Above(x) => cumulative(-z(x)).ln(),
        };
        // 0 ln 0 is 0
        if *count == 0 { 0.0 } else { f64::from(*count) * one }
    };
    runs.iter().map(term).sum()
}

/// Place and value of the maximum of a function with one, by golden sections.
///
/// A search by values finds the place to about the root of a rounding, 1e-8 of the range.
fn golden([mut low, mut high]: [f64; 2], value: &dyn Fn(f64) -> f64) -> [f64; 2] {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let inner = |low: f64, high: f64| [high - ratio * (high - low), low + ratio * (high - low)];
    // 0.618⁶⁰ is 3e-13
    for _ in 0..60 {
        let [a, b] = inner(low, high);
        if value(a) > value(b) { high = b } else { low = a }
    }
    let place = 0.5 * (low + high);
    [place, value(place)]
}

/// The likeliest curve, with θ from 0.05 to 20 and β from 0.02 to 5.
fn likeliest(runs: &[Counted]) -> Lognormal {
    let of_median = |logarithm: f64| {
        golden([0.02_f64.ln(), 5.0_f64.ln()], &|beta| log_likelihood(runs, logarithm.exp(), beta.exp()))
    };
    let [median, _] = golden([0.05_f64.ln(), 20.0_f64.ln()], &|logarithm| of_median(logarithm)[1]);
    Lognormal { median: median.exp(), dispersion: of_median(median)[0].exp() }
}

fn assert_near(found: &Lognormal, wanted: &Lognormal) {
    for (found, wanted) in [(found.median, wanted.median), (found.dispersion, wanted.dispersion)] {
        assert!((found / wanted - 1.0).abs() < 1e-6, "{found} is not {wanted}");
    }
}

/// Curves of 30 records that stand, fall, and some stand again; no two alike.
fn curves(levels: &[f64]) -> Vec<Curve> {
    let of_record = |record: u32| {
        let phase = 0.754_877_666 * f64::from(record + 1) % 1.0;
        let (falls, again) = (0.6 + 1.8 * phase, 0.569_840_291 * f64::from(record + 1) % 1.0);
        let run = |&intensity: &f64| {
            let stands_again = again < 0.4 && (1.1 * falls..1.3 * falls).contains(&intensity);
            let falls_here = intensity > falls && !stands_again;
            let demand = if falls_here { 1.0 } else { (0.8 * intensity / falls).min(0.99) };
            Run { intensity, demand, overturning: falls_here.then_some(2.0), ..Run::default() }
        };
        Curve::new(levels.iter().map(run).collect())
    };
    (0..30).map(of_record).collect()
}

fn levels() -> Vec<f64> {
    (1..=16).map(|k| 0.2 * f64::from(k)).collect()
}

/// Multiple stripes count, level by level, how many fall there; the first or last collapse of a record lies
/// between two levels.
#[test]
fn each_choice_of_the_collapse_has_the_likeliest_curve() {
    let (curves, levels) = (curves(&levels()), levels());
    let count =
        |holds: &dyn Fn(&Curve) -> bool| u32::try_from(curves.iter().filter(|c| holds(c)).count()).unwrap();
    let stripe =
        |(k, &intensity): (usize, &f64)| (intensity, count(&|curve| curve.runs()[k].overturning.is_some()));
    let stripes: Vec<_> = levels.iter().enumerate().map(stripe).collect();
    let bracket = |last: bool| -> Vec<Counted> {
        let of_curve = |curve: &Curve| {
            let falls: Vec<bool> = curve.runs().iter().map(|run| run.overturning.is_some()).collect();
            let upper = if last {
                falls.iter().rposition(|f| !f).unwrap() + 1
            } else {
                falls.iter().position(|f| *f).unwrap()
            };
            (Exceedance::Between([levels[upper - 1], levels[upper]]), 1)
        };
        curves.iter().map(of_curve).collect()
    };
    let found = [Crossing::First, Crossing::Last, Crossing::Fraction]
        .map(|crossing| fit(&Sample::of_curves(&curves, 1.0, crossing, Some(&levels))).unwrap());
    for (found, runs) in found.iter().zip([bracket(false), bracket(true), counted(30, &stripes)]) {
        assert_near(found, &likeliest(&runs));
    }
    // standing again raises θ
    let [first, last, fraction] = found.map(|curve| curve.median);
    assert!(1.03 * first < fraction && 1.03 * fraction < last, "{first} {fraction} {last}");
}

/// Narrow, wide and one-sided intervals, and brackets of all widths down to a rounding.
#[test]
fn intervals_have_the_likeliest_curve() {
    let lows = [0.4, 0.5, 0.62, 0.8, 0.85, 1.1, 1.4, 1.9];
    for width in [1e-9, 1e-4, 0.01, 0.05, 0.3, 1.0] {
        let mut all: Vec<_> =
            lows.iter().map(|low| Exceedance::Between([*low, low * (1.0 + width)])).collect();
        all.extend([Exceedance::Between([0.0, 0.3]), Exceedance::Above(1.5), Exceedance::At(0.9)]);
        // a difference of Φ would lose its digits; their middle is exact to the square of their width
        let known = |exceedance: &Exceedance| match *exceedance {
            Exceedance::Between([from, to]) if from > 0.0 && width <= 1e-3 => {
                (Exceedance::At((from * to).sqrt()), 1)
            }
            other => (other, 1),
        };
        let known: Vec<_> = all.iter().map(known).collect();
        assert_near(&fit(&Sample::of_records(all)).unwrap(), &likeliest(&known));
    }
}

/// Two limit states whose own curves cross: with the ordered fit they touch at one end of the range, and the
/// common z there is the likeliest.
#[test]
fn ordered_curves_are_the_likeliest_that_do_not_cross() {
    let counts = [[0, 6, 15, 19, 20], [1, 5, 8, 12, 16]]
        .map(|counts| [0.4, 0.6, 0.9, 1.3, 2.0].into_iter().zip(counts).collect::<Vec<_>>());
    let states = counts.each_ref().map(|counts| counted(20, counts));
    let samples: Vec<_> = counts.iter().map(|counts| stripes(20, counts)).collect();
    for ((level, [runs, exceeded]), wanted) in samples[0].counts().into_iter().zip(&counts[0]) {
        assert_eq!((level, exceeded, runs), (wanted.0, f64::from(wanted.1), 20.0));
    }
    let summaries = |dispersion| -> [Summary; 2] {
        let estimator = Estimator::new(dispersion, &[0.4, 1.0]);
        let all = compare(std::slice::from_ref(&samples), 0, &estimator, &Bootstrap::new(20, 100, 1));
        [0, 1].map(|state| all[state][0].clone())
    };
    let own = summaries(Dispersion::Own);
    let curves = [0, 1].map(|state| own[state].fitted.unwrap());
    for (curve, state) in curves.iter().zip(&states) {
        assert_near(curve, &likeliest(state));
    }
    let found = own[0].crossing.unwrap();
    let crossing = found.intensity;
    let [p, q] = curves.map(|curve| curve.probability(crossing));
    assert!((p - q).abs() < 1e-12 && p > 1e-4 && p < 1.0 - 1e-4, "{p} {q}");
    // the most by which the later curve is above the earlier one, tried at 4000 intensities: a step of 2e-3
    // misses at most its square times the second derivative, below 1
    let tried = (-4000..4000).map(|k| (2e-3 * f64::from(k)).exp());
    let most = tried.map(|x| curves[1].probability(x) - curves[0].probability(x)).fold(0.0, f64::max);
    assert!(
        (found.excess - most).abs() < 4e-6 && found.excess >= most && found.matters(),
        "{found:?} {most}"
    );

    let ordered = summaries(Dispersion::Ordered).map(|summary| {
        assert_eq!(summary.crossing, None);
        summary.fitted.unwrap()
    });
    // the later curve is flatter, so that the bound at the lower end holds it
    let end = curves.map(|curve| curve.median.ln() - TAIL * curve.dispersion);
    let end = end[0].min(end[1]).exp();
    // with z there, β follows from θ: ln θ = ln end − β z
    let given = |state: usize, z: f64| {
        golden([0.02_f64.ln(), 5.0_f64.ln()], &|beta| {
            log_likelihood(&states[state], end * (-beta.exp() * z).exp(), beta.exp())
        })
    };
    let [z, _] = golden([-8.0, -0.5], &|z| given(0, z)[1] + given(1, z)[1]);
    for (state, found) in ordered.iter().enumerate() {
        let beta = given(state, z)[0].exp();
        assert_near(found, &Lognormal { median: end * (-beta * z).exp(), dispersion: beta });
    }
    // it costs less likelihood than one β for both
    let common = summaries(Dispersion::Common).map(|summary| summary.fitted.unwrap());
    let value = |curves: &[Lognormal; 2]| -> f64 {
        curves.iter().zip(&states).map(|(c, state)| log_likelihood(state, c.median, c.dispersion)).sum()
    };
    assert!(value(&common) < value(&ordered) && value(&ordered) < value(&curves));
}

/// The distance of Kolmogorov and Smirnov, and of stripes that at their levels.
#[test]
fn the_misfit_is_the_largest_distance() {
    use study::ida::Exceedance::{Above, At, Between};
    let curve = |x: f64| (x / 4.0).min(1.0);
    let records = |all: Vec<study::ida::Exceedance>| Sample::of_records(all).misfit(curve);
    // fractions 1/3 from 1, 2/3 from 1.5, 1 from 2: the last one is 1/2 above the curve
    assert_eq!(records(vec![At(1.0), At(1.5), At(2.0)]), 0.5);
    // before 3.6 only one half exceeds, where the curve has 0.9
    assert!(
        (records(vec![At(2.0), At(3.6)]) - 0.5).abs() < 1e-15 && records(vec![At(2.0), Above(3.6)]) > 0.399
    );
    // any place within a bracket is possible
    assert_eq!(records(vec![Between([0.0, 2.0]), Between([2.0, 4.0])]), 0.0);
    let curves: Vec<_> = curves(&levels());
    let sample = Sample::of_curves(&curves, 1.0, Crossing::Fraction, Some(&levels()));
    let distance = |(level, [runs, exceeded]): (f64, [f64; 2])| (curve(level) - exceeded / runs).abs();
    let expected = sample.counts().into_iter().map(distance).fold(0.0, f64::max);
    assert_eq!(sample.misfit(curve), expected);
}

/// Levels that steps to the first overturning have not reached with any record do not count.
#[test]
fn levels_above_all_runs_do_not_count() {
    let run = |level: u32, last: u32| {
        let overturning = (level == last).then_some(1.0);
        Run { intensity: f64::from(level), overturning, ..Run::default() }
    };
    let curves = [2, 4].map(|last| Curve::new((1..=last).map(|level| run(level, last)).collect()));
    let levels: Vec<_> = (1..=50).map(f64::from).collect();
    let sample = Sample::of_curves(&curves, 1.0, Crossing::Fraction, Some(&levels));
    assert_eq!(sample.counts(), [(1.0, [2.0, 0.0]), (2.0, [2.0, 1.0]), (3.0, [2.0, 1.0]), (4.0, [2.0, 2.0])]);
}

/// The covariance of (ln θ, β), and the interval of β, are those of the resamples; of exact intensities they
/// are near the closed forms β²/n and β²/2n.
#[test]
fn resamples_have_the_covariance_of_the_fit() {
    let count = 200;
    let x = |k: u32| ((f64::from(k) + 0.5) / f64::from(count) * 1.4).exp();
    let exceedances = (0..count).map(|k| study::ida::Exceedance::At(x(k))).collect();
    let estimator = Estimator::new(Dispersion::Own, &[1.0]);
    let samples = [vec![Sample::of_records(exceedances)]];
    let summary = compare(&samples, 0, &estimator, &Bootstrap::new(200, 4000, 3)).remove(0).remove(0);
    let beta = summary.fitted.unwrap().dispersion;
    let [theta, both, dispersion] = summary.covariance().unwrap();
    // uniform logarithms have β²/n and (9/5 − 1) β²/4n; 4000 resamples have them to √(2/4000) = 2.2 %
    let one = beta * beta / f64::from(count);
    assert!(
        (theta / one - 1.0).abs() < 0.1 && (dispersion / (0.2 * one) - 1.0).abs() < 0.1,
        "{theta} {dispersion}"
    );
    assert!(both.abs() < 0.1 * (theta * dispersion).sqrt(), "{both}");
    let [low, high] = summary.beta.range;
    assert!(low < beta && beta < high && ((high - low) / (2.0 * 1.96 * dispersion.sqrt()) - 1.0).abs() < 0.1);
}

/// The correction for few records multiplies each β by 4n/(4n − 3), and leaves θ and all intervals. With 20
/// records it is what the mean of the standard deviation of 20 normal numbers lacks, √(20/2) Γ(19/2)/Γ(10) =
/// 1.0396, to the order of 1/n².
#[test]
fn few_records_are_corrected_for() {
    let exceedances = (0..20).map(|k| Exceedance::At((0.1 * f64::from(k)).exp())).collect();
    let samples = [vec![Sample::of_records(exceedances)]];
    let estimator = Estimator::new(Dispersion::Own, &[1.0]);
    let summary = |corrects: bool| {
        let bootstrap = Bootstrap::new(20, 200, 3).corrected(corrects);
        compare(&samples, 0, &estimator, &bootstrap).remove(0).remove(0)
    };
    let [plain, corrected] = [false, true].map(summary);
    let factor = corrected.fitted.unwrap().dispersion / plain.fitted.unwrap().dispersion;
    assert!((factor - 80.0 / 77.0).abs() < 1e-15 && (factor - 1.0396).abs() < 1.0 / 400.0, "{factor}");
    assert_eq!(corrected.beta.estimate, corrected.fitted.unwrap().dispersion);
    assert_eq!(corrected.alone, corrected.fitted);
    assert_eq!((corrected.theta, corrected.beta.range), (plain.theta, plain.beta.range));
    assert_eq!(corrected.resamples, plain.resamples);
}

/// Of five records, or ten that are five with both signs, no interval of a curve is determined; of six it is.
#[test]
fn few_records_have_no_studentised_intervals() {
    let ends = |count: u32, group: u32| {
        let samples = (0..count).map(|k| Exceedance::At(1.0 + f64::from(k / group))).collect();
        let bootstrap = Bootstrap::new(count as usize, 200, 3).in_groups(group as usize);
        let estimator = Estimator::new(Dispersion::Own, &[1.0]);
        let found =
            compare(&[vec![Sample::of_records(samples)]], 0, &estimator, &bootstrap).remove(0).remove(0);
        assert!(found.fitted.is_ok() && found.median.range.iter().all(|end| end.is_finite()));
        [found.theta.range, found.beta.range].concat()
    };
    for few in [ends(5, 1), ends(10, 2)] {
        assert!(few.iter().all(|end| end.is_nan()), "{few:?}");
    }
    assert!(ends(6, 1).iter().all(|end| end.is_finite()));
}

/// A study's report states what is counted; on a grid, by default, the fractions at its levels.
#[test]
fn a_study_file_states_the_estimator() {
    let file = |levels: &str, report: &str| {
        let text = format!(
            "models = [\"CR\"]\nlevels = {{ {levels} }}\nrecords = {{ synthetic = {{ count = 2 }} }}\n\
             report = {{ fractions = [1]{report} }}\n\
             walls = [{{ name = \"a\", geometry = {{ height = 2 }} }}]\n"
        );
        StudyFile::parse("study.toml", &text, &NoCodes)
    };
    let (grid, step) = ("method = \"grid\", values = [0.1]", "method = \"step\", step = 0.1, top = 1");
    let report = |levels, report| file(levels, report).unwrap().report;
    assert_eq!((report(grid, "").collapse, report(step, "").collapse), (Crossing::Fraction, Crossing::First));
    assert_eq!(report(grid, ", collapse = \"last\"").collapse, Crossing::Last);
    assert_eq!(
        [report(grid, "").beta, report(grid, ", beta = \"common\"").beta],
        [Dispersion::Own, Dispersion::Common]
    );
    let error = file(grid, ", beta = \"none\"").unwrap_err().to_string();
    assert!(
        error.contains("line 4")
            && error.contains("beta = \"none\" is not one of \"own\", \"common\", \"ordered\""),
        "{error}"
    );
    // what is chosen is fitted
    let (levels, report) = (levels(), report(grid, ", collapse = \"last\""));
    let results = Fitting::new(30, &["CR"], Some(levels.clone()), &report).results(curves(&levels));
    let state = &results.states(0)[0];
    assert_eq!(state.summary.fitted, state.by_crossing[1]);
    assert_ne!(state.summary.fitted, state.by_crossing[0]);
}
