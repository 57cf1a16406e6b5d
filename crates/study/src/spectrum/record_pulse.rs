//! The pulses in a record, and those with which a wall has the peak that it has under the record.
//!
//! The pulse of a form that fits the accelerations a of a record best, by least squares over its period T,
//! its centre and its amplitude, has the largest normalised inner product with them:
//!
//! ```text
//! index = |Σ a s| / √(Σ a² Σ s²)        fitted amplitude = Σ a s/Σ s²        misfit = 1 − index²
//! ```
//!
//! with the pulse s of the amplitude 1 at the samples. The misfit is the share of Σ a² that the pulse leaves.
//! This is the match of Vassiliou and Makris (Estimating time scales and length scales in pulselike
//! earthquake acceleration records with wavelet analysis, Bulletin of the Seismological Society of America
//! 101, 2011), who give wavelets further phases and cycles. Period and sign are those of the record. With the
//! amplitude of the wall the pulse takes it as far as the record does, or just overturns it where the record
//! does; of several such amplitudes it is the one nearest to the fitted one.

use ground_motion::GroundMotion;
use report::palette::GREY;
use report::plot::{Axis, Plot, Series};
use report::table::{Digits, Table};
use rocking_wall::wall::Parameters;
use run::bisection::first_true;
use run::parallel;

use super::{Point, Prepared, PulseForm, SpectrumError, upright};

/// Shortest period that is searched, over the step of the record.
const SHORTEST: f64 = 10.0;
/// Factor between periods, and steps between centres over the period, of the search.
const PERIOD_FACTOR: f64 = 1.06;
const CENTRES: f64 = 16.0;
/// Halvings of both steps once the best place is found.
const REFINEMENTS: u32 = 16;
/// Factor between amplitudes that are tried, and how often it is taken to each side of the fitted one.
const AMPLITUDE_FACTOR: f64 = 1.05;
const AMPLITUDES: usize = 130;
/// Halvings between two of them: rounding is left.
const HALVINGS: u32 = 48;

/// The forms that are searched.
const FORMS: [PulseForm; 3] = [PulseForm::SineCycle, PulseForm::CosineCycle, PulseForm::Ricker];

/// The pulse of a form in a record, and that of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordPulse {
    /// Its form.
    pub form: PulseForm,
    /// Its period \[s\].
    pub period: f64,
    /// The time of its centre in the record \[s\].
    pub centre: f64,
    /// The amplitude that fits the record, with its sign \[m/s²\].
    pub fitted: f64,
    /// The matching index, from 0 to 1 \[-\].
    pub index: f64,
    /// The amplitude with which the wall has the same peak \[m/s²\]; `None` where none near the fitted one
    /// has.
    pub amplitude: Option<f64>,
}

/// The pulses of a record, the one that fits best first.
#[derive(Clone, Debug)]
pub struct RecordPulses {
    /// The record.
    pub motion: GroundMotion,
    /// What the wall does under it.
    pub point: Point,
    /// A pulse of each form.
    pub pulses: Vec<RecordPulse>,
}

impl RecordPulse {
    /// Finds the pulse of a form that fits a record best.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places in a record")]
    fn fitted(form: PulseForm, motion: &GroundMotion) -> Result<Self, SpectrumError> {
        let (samples, step, shape) = (motion.samples(), motion.step(), form.motion(1.0)?);
        let energy: f64 = samples.iter().map(|a| a * a).sum();
        let fit = |period: f64, centre: f64| {
            let start = centre - 0.5 * shape.duration() * period;
            let (first, last) = ((start / step).ceil(), (start + shape.duration() * period) / step);
            let (mut product, mut square) = (0.0, 0.0);
            for index in first as i64..=last.floor() as i64 {
                let s = shape.at((index as f64 * step - start) / period);
                square += s * s;
                product += s * usize::try_from(index).ok().and_then(|i| samples.get(i)).unwrap_or(&0.0);
            }
            let index = product.abs() / (energy * square).sqrt();
            Self { form, period, centre, fitted: product / square, index, amplitude: None }
        };
        let better = |a: Self, b: Self| if b.index > a.index { b } else { a };
        let shortest = SHORTEST * step;
        let longest = motion.duration().max(shortest);
        let mut period = shortest;
        let mut best = fit(period, 0.0);
        while period <= motion.duration() {
            let shift = (period / CENTRES).max(step);
            let centres = (0..=(motion.duration() / shift) as u32).map(|n| fit(period, f64::from(n) * shift));
            best = centres.fold(best, better);
            period *= PERIOD_FACTOR;
        }
        let mut steps = [PERIOD_FACTOR.ln(), 1.0 / CENTRES];
        for _ in 0..REFINEMENTS {
            let Self { period, centre, .. } = best;
            for [a, b] in [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]] {
                let tried = (period * (a * steps[0]).exp()).clamp(shortest, longest);
                best = better(best, fit(tried, centre + b * steps[1] * period));
            }
            if best.period == period && best.centre == centre {
                steps = steps.map(|step| 0.5 * step);
            }
        }
        Ok(best)
    }

    /// Finds the amplitude next to the fitted one with which a wall goes as far as it does under the record.
    fn matched(self, wall: &Prepared, target: Point) -> Result<Self, SpectrumError> {
        let motion = self.form.motion(1.0 / self.period)?;
        let factor = -wall.participation() * self.fitted;
        let reaches = |point: &Point| match target.overturning {
            Some(_) => point.overturning.is_some(),
            None => point.ratio >= target.ratio,
        };
        let middle = AMPLITUDES as f64;
        let scale = |n: usize| libm::pow(AMPLITUDE_FACTOR, n as f64 - middle);
        let scales: Vec<f64> = (0..=2 * AMPLITUDES).map(scale).collect();
        let factors: Vec<f64> = scales.iter().map(|scale| factor * scale).collect();
        let reached: Vec<bool> = wall.points(&factors, &motion)?.iter().map(reaches).collect();
        let changes = (1..reached.len()).filter(|at| reached[at - 1] != reached[*at]);
        let Some(at) = changes.min_by_key(|at| at.abs_diff(AMPLITUDES)) else { return Ok(self) };
        let ends = if reached[at] { [scales[at - 1], scales[at]] } else { [scales[at], scales[at - 1]] };
        let holds =
            |scale: f64| Ok::<_, SpectrumError>(reaches(&wall.points(&[factor * scale], &motion)?[0]));
        let scale = first_true(ends, HALVINGS, holds)?;
        Ok(Self { amplitude: Some(self.fitted * scale), ..self })
    }
}

impl RecordPulses {
    /// Finds the pulses of a record for a wall.
    ///
    /// # Errors
    /// [`SpectrumError`] of a wall that does not move under the record, of an invalid wall, or of a run.
    pub fn new(parameters: &Parameters, motion: GroundMotion, threads: usize) -> Result<Self, SpectrumError> {
        let wall = Prepared::new(&upright(parameters))?;
        let point = wall.points(&[-wall.participation()], &motion)?[0];
        if point.ratio == 0.0 {
            return Err(SpectrumError::AtRest);
        }
        let found = |form: usize| RecordPulse::fitted(FORMS[form], &motion)?.matched(&wall, point);
        let mut pulses = parallel::map(FORMS.len(), threads, found)?;
        pulses.sort_by(|a, b| b.index.total_cmp(&a.index));
        Ok(Self { motion, point, pulses })
    }

    /// Returns a row for each pulse.
    pub fn table(&self) -> Table {
        let digits = Digits::Significant(4);
        Table::over(&self.pulses)
            .text("pulse", "pulse", |pulse| pulse.form.name())
            .number("period_s", "T [s]", digits, |pulse| pulse.period)
            .number("centre_s", "centre [s]", digits, |pulse| pulse.centre)
            .number("index", "index", digits, |pulse| pulse.index)
            .number("misfit", "misfit", digits, |pulse| 1.0 - pulse.index * pulse.index)
            .number("fitted_m_s2", "fitted [m/s2]", digits, |pulse| pulse.fitted)
            .number("amplitude_m_s2", "amplitude [m/s2]", digits, |pulse| pulse.amplitude)
            .number("amplitude_ratio", "of fitted", digits, |pulse| Some(pulse.amplitude? / pulse.fitted))
            .done()
    }

    /// Draws the record, and over it each pulse with the amplitude of the wall.
    pub fn plot(&self) -> Plot {
        let step = self.motion.step();
        let record = self.motion.samples().iter().enumerate().map(|(i, a)| (i as f64 * step, *a));
        let of = |(number, pulse): (usize, &RecordPulse)| {
            let (amplitude, shape) = (pulse.amplitude?, pulse.form.motion(1.0 / pulse.period).ok()?);
            let start = pulse.centre - 0.5 * shape.duration();
            let at = |(i, s): (usize, &f64)| (start + i as f64 * shape.step(), amplitude * s);
            let points = shape.samples().iter().enumerate().map(at).collect();
            let name = format!("{}, T = {:.3} s, index {:.2}", pulse.form.name(), pulse.period, pulse.index);
            Some(Series::line(&name, number, points))
        };
        let mut series = vec![Series::stroke(GREY, 0.8, record.collect())];
        series.extend(self.pulses.iter().enumerate().filter_map(of));
        Plot::new([820.0, 360.0], [Axis::new("time (s)"), Axis::new("acceleration (m/s²)")], series)
    }
}
