//! Weighted records, against maximum likelihood by SciPy 1.17.1: `scipy.optimize.minimize` (Nelder-Mead,
//! xatol 1e-13) of −Σ w ln L, with `scipy.stats.norm`.

use fragility::{Bootstrap, Cloud, Dispersion, Estimator, Lognormal, Sample, Weights, compare, fit};
use study::ida::Exceedance::{self, Above, At, Between};
use study::ida::{Crossing, Curve, Run};

const WEIGHTS: [f64; 8] = [0.5, 2.0, 1.0, 1.5, 0.25, 3.0, 1.0, 0.75];

fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-6, "{found}, {expected}");
}

fn exceedances() -> Vec<Exceedance> {
    let known = [At(1.1), Between([1.0, 1.4]), Above(2.0), At(0.7), Between([0.0, 0.6]), Between([1.5, 1.8])];
    known.into_iter().chain([At(2.3), Above(1.2)]).collect()
}

#[test]
fn weighted_likelihoods_are_those_of_scipy() {
    let weights = Weights::of(&WEIGHTS);
    let of_records = fit(&Sample::of_records(exceedances()).weighted(&weights)).unwrap();
    near(of_records.median, 1.405_399_371_712_810_6);
    near(of_records.dispersion, 0.440_445_653_951_149_4);
    // of stripes at 0.5, 1, 1.5 and 2; the third record stands again at 1.5
    let levels = [0.5, 1.0, 1.5, 2.0];
    let exceeded = [
        [0, 0, 1, 1],
        [0, 1, 1, 1],
        [0, 1, 0, 1],
        [0, 0, 0, 0],
        [1, 1, 1, 1],
        [0, 0, 0, 1],
        [0, 0, 1, 1],
        [0; 4],
    ];
    let curve = |exceeded: [i32; 4]| {
        let run = |(intensity, exceeds): (f64, i32)| Run {
            intensity,
            demand: 0.5,
            overturning: (exceeds == 1).then_some(1.0),
            ..Run::default()
        };
        Curve::new(levels.into_iter().zip(exceeded).map(run).collect())
    };
    let curves = exceeded.map(curve);
    let sample = Sample::of_curves(&curves, 1.0, Crossing::Fraction, Some(&levels)).weighted(&weights);
    let of_stripes = fit(&sample).unwrap();
    near(of_stripes.median, 1.466_892_610_860_141_7);
    near(of_stripes.dispersion, 0.576_987_223_581_161_8);
    let (level, [all, exceeded]) = sample.counts()[1];
    assert_eq!(level, 1.0);
    near(all, 8.0);
    near(exceeded, 8.0 * (2.0 + 1.0 + 0.25) / 10.0);
    // a cloud whose sixth and eighth wall overturned
    let runs =
        [(0.5, 0.1), (0.8, 0.22), (1.1, 0.2), (1.6, 0.5), (2.0, 0.45), (2.4, -1.0), (3.0, 0.9), (3.5, -1.0)];
    let run = |(intensity, demand): (f64, f64)| {
        let overturning = (demand < 0.0).then_some(1.0);
        Curve::new(vec![Run { intensity, demand: demand.abs(), overturning, ..Run::default() }])
    };
    let cloud = Cloud::of_curves(&runs.map(run)).weighted(&weights).fit().unwrap();
    near(cloud.intercept, -1.320_184_797_789_165_2);
    near(cloud.slope, 1.458_066_839_341_514_6);
    near(cloud.deviation, 0.270_605_675_229_672_3);
}

/// A weight of k is k records: in the fit, the median, the distance from the curve, steps and fractiles. The
/// fit ends within 1e-12; sums of other orders differ in roundings.
#[test]
fn whole_weights_repeat_records() {
    let times = [1, 3, 2, 1, 2, 4, 1, 2];
    let weights = Weights::of(&times.map(|count| count as f64));
    let repeated = exceedances().into_iter().zip(times).flat_map(|(one, count)| vec![one; count]);
    let (all, weighted) =
        (Sample::of_records(repeated.collect()), Sample::of_records(exceedances()).weighted(&weights));
    let [own, other] = [&all, &weighted].map(|sample| fit(sample).unwrap());
    assert!(
        (own.median / other.median - 1.0).abs() < 1e-11
            && (own.dispersion / other.dispersion - 1.0).abs() < 1e-11
    );
    let probability = |sample: &Sample| sample.misfit(|x| own.probability(x));
    assert!((probability(&all) - probability(&weighted)).abs() < 1e-12);
    assert_eq!(all.steps().last().map(|step| step.0), weighted.steps().last().map(|step| step.0));
    for part in [0.16, 0.5, 0.84] {
        assert_eq!(all.fractile(part), weighted.fractile(part));
    }
    let estimator = Estimator::new(Dispersion::Own, &[1.0]);
    let summary = |sample: &Sample, weights: &Weights| {
        let bootstrap = Bootstrap::new(sample.exceedances().len(), 10, 1).weighted(weights);
        compare(&[vec![sample.clone()]], 0, &estimator, &bootstrap)[0][0].clone()
    };
    let medians =
        [summary(&all, &Weights::default()), summary(&weighted, &weights)].map(|one| one.median.estimate);
    assert_eq!(medians[0], medians[1]);
}

/// Of exact intensities y = ln x, ln θ is the weighted mean. Over resamples that draw records alike, the
/// variance of that ratio of sums is Σ w² (y − ln θ)²/(Σ w)² to the order of 1/n: 1/40 of it, and the
/// variance of 4000 resamples is known to √(2/4000) = 2 %. Weights that were left out would give a third of
/// it.
#[test]
fn resamples_draw_weighted_records() {
    let records = 40;
    let given: Vec<f64> = (0..records).map(|k| if k % 8 == 0 { 10.0 } else { 1.0 }).collect();
    let weights = Weights::of(&given);
    let ys: Vec<f64> = (0..records).map(|k| f64::sin(f64::from(7 * k + 1))).collect();
    let sample = Sample::of_records(ys.iter().map(|y| At(y.exp())).collect()).weighted(&weights);
    let bootstrap = Bootstrap::new(40, 4000, 1).weighted(&weights);
    let summary = &compare(&[vec![sample]], 0, &Estimator::new(Dispersion::Own, &[1.0]), &bootstrap)[0][0];
    let all: f64 = given.iter().sum();
    let mean = given.iter().zip(&ys).map(|(weight, y)| weight * y).sum::<f64>() / all;
    let Lognormal { median, .. } = summary.fitted.unwrap();
    assert!((median.ln() - mean).abs() < 1e-12);
    let squares = given.iter().zip(&ys).map(|(weight, y)| (weight * (y - mean)).powi(2)).sum::<f64>();
    let expected = squares / (all * all);
    let [variance, ..] = summary.covariance().unwrap();
    assert!((variance / expected - 1.0).abs() < 0.1, "{variance}, {expected}");
    // as many as 13.5 records of equal weights
    let squared: f64 = given.iter().map(|weight| weight * weight).sum();
    assert!((weights.effective(40) - all * all / squared).abs() < 1e-12);
}
