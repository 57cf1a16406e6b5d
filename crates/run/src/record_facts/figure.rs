//! Accelerograms above their response spectra, as a picture.
//!
//! ```
//! use ground_motion::{GroundMotion, Spectrum};
//! use run::record_facts::figure::{Drawn, picture};
//!
//! let motion = GroundMotion::new(0.01, vec![0.0, 0.2, -0.1])?;
//! let drawn = Drawn::new("a.AT2".into(), &motion, &Spectrum::default())?;
//! assert!(picture(&[drawn], 0.05).contains("Sa (g) at 5 % damping"));
//! # Ok::<(), ground_motion::GroundMotionError>(())
//! ```

use ground_motion::{GroundMotion, GroundMotionError, Spectrum};
use report::palette::{BLACK, PALE, SERIES};
use report::plot::{Axis, Plot, Series, stacked};
use report::points::decimated;
use report::{counted, number};

use super::in_g;
use crate::sample::sample_median;

/// Size \[px\].
const WIDTH: f64 = 820.0;
const HISTORY: f64 = 180.0;
const SPECTRA: f64 = 420.0;

/// Periods of the spectra: up to 4 s, denser where they are short.
const PERIODS: u32 = 200;
const SHORTEST: f64 = 0.01;
const LONGEST: f64 = 4.0;

/// The most records that have a history and a colour each; more are drawn as pale spectra with their median.
const MOST: usize = SERIES.len();

/// A record to draw.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Its name.
    pub name: String,
    /// Acceleration (g) over time (s).
    history: Vec<(f64, f64)>,
    /// Sa (g) over the period (s), from the peak acceleration at 0 on.
    spectrum: Vec<(f64, f64)>,
    /// Whether the record is vertical: the median is that of the others.
    pub is_vertical: bool,
}

impl Drawn {
    /// Computes the history and the spectrum of a horizontal motion.
    ///
    /// # Errors
    /// [`GroundMotionError`] for a step that is too long for the spectrum.
    pub fn new(name: String, motion: &GroundMotion, of: &Spectrum) -> Result<Self, GroundMotionError> {
        let samples = motion.samples().iter().enumerate();
        let history = samples.map(|(index, a)| (index as f64 * motion.step(), in_g(*a))).collect();
        let mut spectrum = vec![(0.0, in_g(motion.peak()))];
        for index in 0..=PERIODS {
            let part = f64::from(index) / f64::from(PERIODS);
            let period = SHORTEST + (LONGEST - SHORTEST) * part * part;
            spectrum.push((period, in_g(of.acceleration(motion, period)?)));
        }
        Ok(Self { name, history, spectrum, is_vertical: false })
    }
}

/// Draws the histories of up to some records, and the spectra of all below them.
pub fn picture(records: &[Drawn], damping: f64) -> String {
    let end = |points: &[(f64, f64)]| points.last().map_or(0.0, |point| point.0);
    let longest = records.iter().map(|record| end(&record.history)).fold(0.0, f64::max);
    let mut panels = Vec::new();
    let mut spectra = Vec::new();
    if records.len() <= MOST {
        for (Drawn { name, history, spectrum, .. }, (color, _)) in records.iter().zip(SERIES) {
            let line = Series::stroke(color, 0.9, decimated(history, end(history)));
            let axes = [Axis::over("time (s)", [0.0, longest]), Axis::new("a (g)")];
            panels.push(Plot { title: name.clone(), ..Plot::new([WIDTH, HISTORY], axes, vec![line]) });
            spectra.push(Series { name: name.clone(), ..Series::stroke(color, 1.6, spectrum.clone()) });
        }
    } else {
        spectra.extend(records.iter().map(|record| Series::stroke(PALE, 0.8, record.spectrum.clone())));
        let mut level: Vec<&Drawn> = records.iter().filter(|record| !record.is_vertical).collect();
        let which = if level.is_empty() || level.len() == records.len() { "" } else { "horizontal " };
        if level.is_empty() {
            level.extend(records);
        }
        let name = format!("median of {}", counted(level.len(), &format!("{which}record")));
        spectra.push(Series { name, ..Series::stroke(BLACK, 2.2, median(&level)) });
    }
    let longest = records.iter().map(|record| end(&record.spectrum)).fold(0.0, f64::max);
    let label = format!("Sa (g) at {} % damping", number(100.0 * damping, 6));
    let axes = [Axis::over("period T (s)", [0.0, longest]), Axis { label, range: None }];
    panels.push(Plot::new([WIDTH, SPECTRA], axes, spectra));
    stacked(&panels)
}

/// The median of the spectra.
fn median(records: &[&Drawn]) -> Vec<(f64, f64)> {
    let Some(first) = records.first() else { return Vec::new() };
    let at = |index: usize| {
        let mut values: Vec<f64> = records.iter().map(|record| record.spectrum[index].1).collect();
        sample_median(&mut values)
    };
    first.spectrum.iter().enumerate().map(|(index, &(period, _))| (period, at(index))).collect()
}
