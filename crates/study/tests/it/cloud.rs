//! Clouds: their runs, their regression, and what is refused.

use fragility::{Bootstrap, Cloud, FitError, compare_clouds, cumulative, quantile};
use ground_motion::SyntheticMotion;
use rocking_wall::wall::Parameters;
use run::model::{EnergyLoss, Model};
use run::records::NamedRecord;
use run::sample::Pcg;
use run::walls::NamedWall;
use study::codes::NoCodes;
use study::document::StudyFile;
use study::ida::{Curve, IntensityMeasure, Levels, Run, Study};

/// A run of a record at an intensity, with its demand; the wall overturns at 1.
fn curve(intensity: f64, demand: f64) -> Curve {
    let overturning = (demand >= 1.0).then_some(3.0);
    Curve::new(vec![Run { intensity, demand: demand.min(1.0), overturning, ..Run::default() }])
}

/// Runs about ln D = a + b ln IM with the standard deviation σ, a part of them above 1.
fn drawn(count: u32, [a, b, sigma]: [f64; 3]) -> Vec<Curve> {
    let mut random = Pcg::new(5);
    let mut uniform = || (random.below(1 << 30) as f64 + 0.5) / f64::from(1 << 30);
    let run = |_| {
        let x = 0.5 + 4.0 * uniform();
        curve(x, (a + b * x.ln() + sigma * quantile(uniform())).exp())
    };
    (0..count).map(run).collect()
}

/// The likelihood has its maximum where the runs come from, to four standard errors; with collapses taken as
/// demands of 1 the slope comes out too low.
#[test]
fn a_regression_finds_what_the_runs_were_drawn_from() {
    let [a, b, sigma] = [-2.0, 1.8, 0.5];
    let count = 20_000;
    let curves = drawn(count, [a, b, sigma]);
    let cloud = Cloud::of_curves(&curves);
    let share = cloud.collapsed() as f64 / f64::from(count);
    assert!((0.2..0.6).contains(&share), "{share}");
    let fit = cloud.fit().unwrap();
    let error = sigma / f64::from(count).sqrt();
    // ln x has a standard deviation of about a half, and the censored runs tell less
    for (found, expected) in [(fit.intercept, a), (fit.slope, b), (fit.deviation, sigma)] {
        assert!((found - expected).abs() < 4.0 * 3.0 * error, "{found}, not {expected}");
    }
    let naive = |one: &Curve| curve(one.runs()[0].intensity, one.runs()[0].demand.min(0.999_999));
    let naive: Vec<Curve> = curves.iter().map(naive).collect();
    assert!(Cloud::of_curves(&naive).fit().unwrap().slope < b - 0.3);
    // all limit states have the β of the regression, and θ on its line
    let summaries = compare_clouds(&[cloud], &[0.1, 1.0], 0, &Bootstrap::new(count as usize, 1, 1));
    for (fraction, summary) in [0.1, 1.0].into_iter().zip(&summaries) {
        let curve = summary[0].fitted.unwrap();
        assert!((curve.dispersion - fit.deviation / fit.slope).abs() < 1e-15);
        assert!((fit.demand(curve.median) / fraction - 1.0_f64).abs() < 1e-12);
    }
}

/// A resample follows from the regression of the records that were drawn, each as often as it was: that of
/// the same draws to the rounding of a sum in another order, some 1e-15 times the condition of the fit.
#[test]
fn resamples_are_regressions_of_what_was_drawn() {
    let curves = drawn(15, [-1.5, 1.8, 0.5]);
    let cloud = Cloud::of_curves(&curves);
    assert!((3..12).contains(&cloud.collapsed()) && cloud.records() == 15 && cloud.still() == 0);
    let all = cloud.fit().unwrap().fragility(0.5);
    let [summaries] = &compare_clouds(&[cloud], &[0.5], 0, &Bootstrap::new(15, 50, 9))[..] else { panic!() };
    // (15 · 16/(14 · 13))^½
    let power = 1.148_338_5_f64;
    let mut random = Pcg::new(9);
    let mut compared = 0;
    for [theta, beta] in &summaries[0].resamples {
        let drawn: Vec<Curve> = (0..15).map(|_| curves[random.below(15)].clone()).collect();
        let Ok(fit) = Cloud::of_curves(&drawn).fit() else {
            assert!(theta.is_nan() && beta.is_nan());
            continue;
        };
        // studentised: as far below all records as those drawn are above them, in units of β
        let own = fit.fragility(0.5);
        let z = (own.median / all.median).ln() / own.dispersion;
        let expected = all.median * (-all.dispersion * z).exp();
        assert!((theta / expected - 1.0).abs() < 1e-10, "{theta} {expected}");
        let expected = all.dispersion * (all.dispersion / own.dispersion).powf(power);
        assert!((beta / expected - 1.0).abs() < 1e-6, "{beta} {expected}");
        compared += 1;
    }
    assert!(compared > 40, "{compared}");
}

/// The maximum is found from afar, where whole steps of Newton's method lead beyond it: nearly all walls
/// overturned, so that the line of those that stand says little. There the likelihood is flat: its slopes
/// along a and σ, by differences of a ten-thousandth, are below the third derivatives times 1e-8.
#[test]
fn the_maximum_is_found_where_few_walls_stand() {
    let points = [(0.5, 0.9), (1.0, 0.05), (1.2, 0.3), (1.5, 2.0), (2.0, 2.0), (2.5, 2.0), (3.0, 2.0)];
    let fit = Cloud::of_curves(&points.map(|(x, y)| curve(x, y))).fit().unwrap();
    let value = |[a, b, sigma]: [f64; 3]| -> f64 {
        let of = |(x, y): (f64, f64)| {
            let line = a + b * x.ln();
            let z = (y.ln() - line) / sigma;
            if y < 1.0 { -sigma.ln() - 0.5 * z * z } else { cumulative(line / sigma).ln() }
        };
        points.into_iter().map(of).sum()
    };
    let at = [fit.intercept, fit.slope, fit.deviation];
    for place in 0..3 {
        let moved = |by: f64| {
            let mut there = at;
            there[place] += by;
            value(there)
        };
        let slope = (moved(1e-4) - moved(-1e-4)) / 2e-4;
        assert!(slope.abs() < 1e-6, "{place}: {slope} at {at:?}");
    }
}

/// Where no wall overturns the regression is that of least squares, with σ² the mean of the squares.
#[test]
fn without_collapses_it_is_least_squares() {
    let points = [(1.0_f64, 0.1_f64), (2.0, 0.15), (3.0, 0.4), (4.0, 0.35), (5.0, 0.8)];
    let fit = Cloud::of_curves(&points.map(|(x, y)| curve(x, y))).fit().unwrap();
    let logarithms = points.map(|(x, y)| (x.ln(), y.ln()));
    let residuals = logarithms.map(|(x, y)| y - fit.intercept - fit.slope * x);
    let sums =
        [residuals.iter().sum::<f64>(), residuals.iter().zip(logarithms).map(|(r, (x, _))| r * x).sum()];
    assert!(sums.iter().all(|sum: &f64| sum.abs() < 1e-12), "{sums:?}");
    let variance = residuals.iter().map(|residual| residual * residual).sum::<f64>() / 5.0;
    assert!((fit.deviation / variance.sqrt() - 1.0).abs() < 1e-12);
}

/// Runs without a regression say so; those that did not move are left out.
#[test]
fn few_or_straight_runs_have_no_regression() {
    let fit = |points: &[(f64, f64)]| {
        Cloud::of_curves(&points.iter().map(|(x, y)| curve(*x, *y)).collect::<Vec<_>>()).fit()
    };
    for (points, error) in [
        (vec![], FitError::Cloud),
        (vec![(1.0, 2.0), (2.0, 2.0), (3.0, 2.0)], FitError::Cloud),
        (vec![(1.0, 0.1), (2.0, 0.2), (3.0, 2.0)], FitError::Cloud),
        (vec![(1.0, 0.1), (2.0, 0.2), (4.0, 0.4)], FitError::Cloud),
        (vec![(1.0, 0.1), (1.0, 0.2), (1.0, 0.4)], FitError::Cloud),
        (vec![(1.0, 0.4), (2.0, 0.3), (4.0, 0.1)], FitError::Falling),
    ] {
        assert_eq!(fit(&points), Err(error), "{points:?}");
    }
    let points = [(1.0, 0.1), (2.0, 0.2), (3.0, 0.5), (4.0, 3.0)];
    let own = fit(&points).unwrap();
    assert_eq!(fit(&[&points[..], &[(0.5, 0.0)]].concat()), Ok(own));
    let all = Cloud::of_curves(&[(0.5, 0.0), (1.0, 0.1), (4.0, 3.0)].map(|(x, y)| curve(x, y)));
    assert_eq!((all.records(), all.still(), all.collapsed()), (3, 1, 1));
}

/// A record is run once, at its own intensity times the scale; of Arias intensity times its square.
#[test]
fn each_record_is_run_at_its_own_level() {
    let record = |seed| {
        NamedRecord::new(
            format!("seed {seed}"),
            SyntheticMotion { seed, duration: 12.0, step: 0.01, peak: 2.0 }.motion().unwrap(),
        )
    };
    let records: Vec<_> = (1..=3).map(record).collect();
    let wall = NamedWall::new("wall", Parameters { height: 3.0, thickness: 0.3, ..Parameters::default() });
    let of = |measure: IntensityMeasure, levels: Levels| {
        let models = vec![Model::new(EnergyLoss::Restitution)];
        Study::new(vec![wall.clone()], records.clone(), models, measure, levels).unwrap()
    };
    // a power of two leaves no rounding in the scale
    let cloud = of(IntensityMeasure::Arias, Levels::Cloud { scale: 0.5 });
    let curves = cloud.run(1).unwrap();
    let grid = of(IntensityMeasure::Pga, Levels::Grid(vec![1.0])).run(1).unwrap();
    for (index, (curve, grid)) in curves.iter().zip(&grid).enumerate() {
        let [run] = curve.runs() else { panic!("{curve:?}") };
        assert_eq!(run.intensity, 0.25 * cloud.intensity(index));
        // the records have peaks of 2 m/s² to a rounding, of which the demand is that of 1 m/s²
        assert!((run.demand / grid.runs()[0].demand - 1.0).abs() < 1e-9);
    }
    let levels = Levels::Cloud { scale: 0.0 };
    let models = vec![Model::new(EnergyLoss::Restitution)];
    let told = Study::new(vec![wall.clone()], records.clone(), models, IntensityMeasure::Pga, levels);
    assert!(told.unwrap_err().to_string().starts_with("scale of the levels is 0"));
}

#[test]
fn keys_without_a_part_in_a_cloud_are_refused() {
    let read = |more: &str| {
        let text = format!("models = [\"CR\"]\nlevels = {{ method = \"cloud\" }}\n{more}\n");
        StudyFile::parse("study.toml", &text, &NoCodes)
    };
    assert_eq!(read("").unwrap().levels, Levels::Cloud { scale: 1.0 });
    for (more, words) in [
        ("report = { beta = \"own\" }", "beta has no part in a cloud"),
        ("report = { collapse = \"last\" }", "collapse has no part in a cloud"),
        ("collapse_is = \"falls\"", "as a collapse; leave it out, or give levels of another method"),
    ] {
        let told = read(more).unwrap_err().to_string();
        assert!(told.contains("line 3") && told.contains(words), "{told}");
    }
    for (levels, words) in [
        ("method = \"cloud\", top = 3", "top has no part in method = \"cloud\", which takes scale"),
        ("method = \"cloud\", unit = \"g\"", "unit has no part"),
        ("method = \"step\", step = 1, top = 3, scale = 2", "scale has no part"),
    ] {
        let text = format!("models = [\"CR\"]\nlevels = {{ {levels} }}\n");
        let told = StudyFile::parse("study.toml", &text, &NoCodes).unwrap_err().to_string();
        assert!(told.contains(words), "{told}");
    }
}
