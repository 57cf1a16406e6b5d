//! What noise in the records does to collapses and fragilities: the samples of every record of a study times
//! 1 + ε r, with r at random and of variance 1, beside the study without noise. The collapses that move are
//! about as many as those with a sensitivity of at least 1/ε.
//!
//! ```text
//! cargo run --release -p rocking-study --example record_noise studies/table_5.toml
//! ```

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::error::Error;
use std::path::Path;

use fragility::{Lognormal, Sample, fit};
use ground_motion::GroundMotion;
use run::records::NamedRecord;
use run::sample::Pcg;
use study::codes::NoCodes;
use study::ida::{Crossing, Curve, Exceedance, Study};
use study::loaded::LoadedStudy;

const THREADS: usize = 2;
/// Collapse intensities that differ by more than the resolution of the hunt have moved.
const MOVED: f64 = 0.01;

/// Collapse of each curve and, where it is known, its sensitivity; and the curve fitted to those of each wall
/// and model.
type Outcome = (Vec<f64>, Vec<f64>, Vec<Lognormal>);

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "studies/table_5.toml".to_owned());
    let LoadedStudy { study, .. } = LoadedStudy::read(Path::new(&path), &NoCodes)?;
    let (collapses, sensitivities, fits) = outcome(&study)?;
    println!("noise   collapses that move  most  S >= 1/noise  theta: rms   most  beta: rms   most");
    for epsilon in [1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3] {
        let (noisy, _, noisy_fits) = outcome(&with_noise(&study, epsilon)?)?;
        let moves: Vec<f64> = noisy.iter().zip(&collapses).map(|(a, b)| (a / b - 1.0).abs()).collect();
        let moved = moves.iter().filter(|part| **part > MOVED).count();
        let change = |of: fn(&Lognormal) -> f64| {
            let changes: Vec<f64> = noisy_fits.iter().zip(&fits).map(|(a, b)| of(a) / of(b) - 1.0).collect();
            let squares: f64 = changes.iter().map(|change| change * change).sum();
            [(squares / changes.len() as f64).sqrt(), largest(&changes)].map(|part| 100.0 * part)
        };
        let ([theta, most_theta], [beta, most_beta]) = (change(|f| f.median), change(|f| f.dispersion));
        println!(
            "{epsilon:<6e} {moved:>9} of {:<4} {:>9.0} % {:>13} {theta:>9.2} % {most_theta:>4.1} % \
             {beta:>7.1} % {most_beta:>4.0} %",
            moves.len(),
            100.0 * largest(&moves),
            sensitivities.iter().filter(|sensitivity| **sensitivity >= 1.0 / epsilon).count()
        );
    }
    Ok(())
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Runs a study whose walls all collapse.
fn outcome(study: &Study) -> Result<Outcome, Box<dyn Error>> {
    let curves = study.run(THREADS)?;
    let intensity = |exceedance: Exceedance| exceedance.or_infinity();
    let collapses = curves.iter().map(|curve| intensity(curve.exceedance(1.0, Crossing::First, false)));
    let of_fit = |curves| fit(&Sample::of_curves(curves, 1.0, Crossing::First, None));
    let sensitivities = curves.iter().filter_map(Curve::sensitivity).collect();
    let fits = curves.chunks(study.records().len()).map(of_fit).collect::<Result<_, _>>()?;
    Ok((collapses.collect(), sensitivities, fits))
}

/// Returns a study with noise in the samples of its records.
fn with_noise(study: &Study, epsilon: f64) -> Result<Study, Box<dyn Error>> {
    let mut random = Pcg::new(1);
    // uniform from −√3 to √3
    let mut noise = || 3.0_f64.sqrt() * (random.below(2_000_001) as f64 / 1e6 - 1.0);
    let record = |record: &NamedRecord| {
        let samples = record.motion.samples().iter().map(|sample| sample * (1.0 + epsilon * noise()));
        let motion = GroundMotion::new(record.motion.step(), samples.collect())?;
        Ok::<_, Box<dyn Error>>(NamedRecord::new(record.name.clone(), motion))
    };
    let records = study.records().iter().map(record).collect::<Result<_, _>>()?;
    let (walls, models) = (study.walls().to_vec(), study.models().to_vec());
    Ok(Study::new(walls, records, models, study.measure().clone(), study.levels().clone())?)
}
