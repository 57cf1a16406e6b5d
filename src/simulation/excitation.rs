//! Recorded motion of the supports.

use ground_motion::{GroundMotion, GroundMotionError, Warning};

use crate::solver::Segment;
use crate::wall::{Body, Support};

/// Recorded motion of the supports: one record for both, or one for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Excitation {
    bottom: GroundMotion,
    top: Option<GroundMotion>,
    /// Drift between the supports \[m\].
    drift: Option<GroundMotion>,
    held: bool,
}

impl Excitation {
    /// Makes one motion for both supports; `top`, if given, moves the top support of a wall in an upper
    /// storey.
    pub fn new(bottom: GroundMotion, top: Option<GroundMotion>) -> Self {
        Self { bottom, top, drift: None, held: false }
    }

    /// Adds the drift between the supports, whose samples are displacements `x_top` − `x_bottom` \[m\].
    pub fn with_drift(self, drift: GroundMotion) -> Self {
        Self { drift: Some(drift), ..self }
    }

    /// Returns the motion with the signs of its accelerations and of its drift reversed.
    ///
    /// # Errors
    /// [`GroundMotionError`] if a sample is not finite.
    pub fn reversed(&self) -> Result<Self, GroundMotionError> {
        let reversed = |motion: &GroundMotion| motion.checked_scaled(-1.0);
        Ok(Self {
            bottom: reversed(&self.bottom)?,
            top: self.top.as_ref().map(reversed).transpose()?,
            drift: self.drift.as_ref().map(reversed).transpose()?,
            held: self.held,
        })
    }

    /// Holds each sample until the next, as most importers do with an input, instead of interpolating
    /// linearly.
    pub fn held(self) -> Self {
        Self { held: true, ..self }
    }

    /// Returns whether each sample is held until the next.
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Returns the motion of the bottom support, or of both.
    pub fn bottom(&self) -> &GroundMotion {
        &self.bottom
    }

    /// Returns the motion of the top support where it has its own.
    pub fn top(&self) -> Option<&GroundMotion> {
        self.top.as_ref()
    }

    /// Returns the shortest step of its records \[s\].
    pub fn step(&self) -> f64 {
        self.records().map(GroundMotion::step).fold(f64::INFINITY, f64::min)
    }

    /// Returns the effective acceleration of the supports, sampled at [`step`](Self::step): given to both
    /// supports, it forces a wall as this motion does.
    ///
    /// # Errors
    /// [`GroundMotionError`] if a sample is not finite.
    pub fn effective(&self, body: &Body) -> Result<GroundMotion, GroundMotionError> {
        let step = self.step();
        let unit = body.forcing(Support::rigid(1.0));
        let at = |index: usize| body.forcing(self.segment(index as f64 * step, 0.0).from) / unit;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "samples of a record")]
        let count = (self.duration() / step).round() as usize;
        GroundMotion::new(step, (0..=count).map(at).collect())
    }

    /// Returns a warning about accelerations larger than those of any record.
    pub fn warning(&self) -> Option<Warning> {
        let stronger = self.top.as_ref().filter(|top| top.peak() > self.bottom.peak());
        stronger.unwrap_or(&self.bottom).warning()
    }

    /// Returns the number of the sample at a time after the start \[s\], and the accelerations of both
    /// supports from there on; `None` between samples, beyond the last, and for a motion that is not one
    /// record, interpolated.
    pub(crate) fn samples_from(&self, elapsed: f64) -> Option<(usize, &[f64])> {
        if self.top.is_some() || self.drift.is_some() || self.held {
            return None;
        }
        let Place { steps, before, .. } = Place::of(&self.bottom, elapsed);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 0 it is 0")]
        let first = before as usize;
        let samples = self.bottom.samples().get(first..)?;
        // a time is the product of a number and the step, or a sum of few such
        let is_at_sample = (steps - first as f64).abs() <= 16.0 * f64::EPSILON * steps;
        (is_at_sample && !samples.is_empty()).then_some((first, samples))
    }

    /// Returns the motion of the bottom support or of both, that of the top where it has its own, and the
    /// drift.
    pub(crate) fn records_of_supports(&self) -> [Option<GroundMotion>; 3] {
        [Some(self.bottom.clone()), self.top.clone(), self.drift.clone()]
    }

    fn records(&self) -> impl Iterator<Item = &GroundMotion> {
        [Some(&self.bottom), self.top.as_ref(), self.drift.as_ref()].into_iter().flatten()
    }

    /// Returns the length of the longest record \[s\].
    pub fn duration(&self) -> f64 {
        self.records().map(GroundMotion::duration).fold(0.0, f64::max)
    }

    /// Returns the segment that begins `elapsed` seconds after the start, and lasts `remaining` \[s\] or to
    /// the next sample.
    pub fn segment(&self, elapsed: f64, remaining: f64) -> Segment {
        let at = |record| Place::of(record, elapsed);
        let bottom = at(&self.bottom);
        let (top, drift) = (self.top.as_ref().map(at), self.drift.as_ref().map(at));
        let mut duration = remaining;
        for place in [Some(&bottom), top.as_ref(), drift.as_ref()].into_iter().flatten() {
            duration = duration.min(place.to_next().unwrap_or(duration));
        }
        let ends = |place: Place<'_>| if self.held { [place.held(); 2] } else { place.ends(duration) };
        let [from, to] = ends(bottom);
        let [from_top, to_top] = top.map_or([from, to], ends);
        let [drift, drift_to] = drift.map_or([0.0; 2], ends);
        Segment {
            duration,
            from: Support { bottom: from, top: from_top, drift },
            to: Support { bottom: to, top: to_top, drift: drift_to },
        }
    }
}

/// Fraction of a sample interval within which a time counts as that of the sample. Sums of rounded steps come
/// this close.
const SAMPLE_ROUNDING: f64 = 1e-6;

/// A time in a record.
#[derive(Clone, Copy)]
struct Place<'a> {
    record: &'a GroundMotion,
    /// The time \[s\], and over the step of the record \[-\].
    elapsed: f64,
    steps: f64,
    /// Number of the sample at or before the time.
    before: f64,
}

impl<'a> Place<'a> {
    /// Returns the place of a time in a record. A time that falls short of a sample by rounding counts as the
    /// time of that sample.
    #[inline]
    fn of(record: &'a GroundMotion, elapsed: f64) -> Self {
        let steps = elapsed / record.step();
        Self { record, elapsed, steps, before: (steps + SAMPLE_ROUNDING).floor() }
    }

    /// Returns the time to the next sample \[s\]; `None` after the last.
    #[inline]
    fn to_next(self) -> Option<f64> {
        let next = self.before + 1.0;
        (next < self.record.samples().len() as f64).then(|| next * self.record.step() - self.elapsed)
    }

    /// Returns the sample with a number; `None` outside the record.
    #[inline]
    fn sample(&self, number: f64) -> Option<f64> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "out of range stays so")]
        (number >= 0.0).then(|| self.record.samples().get(number as usize).copied()).flatten()
    }

    /// Returns the sample at or before the time, before the record the first; zero after the record.
    fn held(&self) -> f64 {
        self.sample(self.before.max(0.0)).unwrap_or(0.0)
    }

    /// Returns the accelerations at both ends of a segment within one sample interval; zero after the record.
    #[inline]
    fn ends(&self, duration: f64) -> [f64; 2] {
        let Self { record, elapsed, steps, before } = *self;
        let (Some(low), Some(high)) = (self.sample(before), self.sample(before + 1.0)) else {
            return [0.0, 0.0];
        };
        let value = |steps: f64| {
            let fraction = (steps - before).clamp(0.0, 1.0);
            if fraction > 1.0 - SAMPLE_ROUNDING { high } else { low + (high - low) * fraction }
        };
        // most segments end at the next sample
        let ends_there = duration >= (before + 1.0) * record.step() - elapsed;
        [value(steps), if ends_there { high } else { value((elapsed + duration) / record.step()) }]
    }
}

/// Returns the segment of a motion that may be absent, as [`Excitation::segment`]; without one the supports
/// stand still.
pub fn segment_of(motion: Option<&Excitation>, elapsed: f64, remaining: f64) -> Segment {
    match motion {
        Some(motion) => motion.segment(elapsed, remaining),
        None => Segment { duration: remaining, from: Support::default(), to: Support::default() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::Mechanism;
    use crate::wall::{Parameters, Wall};

    /// At each sample the effective record forces the wall as the records of both supports and their drift
    /// do. From its last sample on an interpolated record is 0.
    #[test]
    fn the_effective_record_forces_the_wall_alike() {
        let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..Parameters::default() };
        let wall = Wall::new(&strip).unwrap();
        let samples = [[0.2, 0.3, -0.7, 0.0], [0.1, -0.4, 0.5, 0.0], [0.0, 1e-3, 3e-3, 0.0]];
        let [bottom, top, drift] = samples.map(|samples| GroundMotion::new(0.02, samples.into()).unwrap());
        let motion = Excitation::new(bottom, Some(top)).with_drift(drift);
        for motion in [motion.clone(), motion.held()] {
            let effective = motion.effective(wall.body()).unwrap();
            assert_eq!((effective.step(), effective.samples().len()), (0.02, 4));
            for (index, sample) in effective.samples().iter().enumerate() {
                let [bottom, top, drift] = samples.map(|samples| samples[index]);
                let wanted = wall.body().forcing(Support { bottom, top, drift });
                let found = wall.body().forcing(Support::rigid(*sample));
                // a few roundings of terms below 3 m/s²
                assert!((found - wanted).abs() <= 4e-15, "sample {index}: {found} for {wanted}");
            }
        }
    }

    /// The samples of one interpolated record are known from each of them on, with the rounding of a clock.
    #[test]
    fn samples_begin_at_samples() {
        let record = GroundMotion::new(0.02, vec![0.3, 0.7, -0.5, 0.1]).unwrap();
        let motion = Excitation::new(record.clone(), None);
        assert_eq!(motion.samples_from(0.0), Some((0, record.samples())));
        for rounded in [-1e-16, 0.0, 1e-16] {
            assert_eq!(motion.samples_from(0.04 + rounded), Some((2, &record.samples()[2..])));
        }
        assert_eq!(motion.samples_from(0.06), Some((3, &record.samples()[3..])));
        for between in [-0.02, 0.01, 0.039, 0.041, 0.08, 9.0] {
            assert_eq!(motion.samples_from(between), None, "{between}");
        }
        let others = [
            motion.clone().held(),
            motion.clone().with_drift(record.clone()),
            Excitation::new(record.clone(), Some(record)),
        ];
        assert!(others.iter().all(|other| other.samples_from(0.0).is_none()));
    }

    /// A reversed motion has all signs reversed, and lasts as long.
    #[test]
    fn a_reversed_motion_has_other_signs() {
        let record = |peak: f64| GroundMotion::new(0.02, vec![0.3, peak, -0.5 * peak, 0.0]).unwrap();
        let motion = Excitation::new(record(0.7), Some(record(-0.4))).with_drift(record(1e-3));
        let negative =
            |Support { bottom, top, drift }: Support| Support { bottom: -bottom, top: -top, drift: -drift };
        for motion in [motion.clone(), motion.held()] {
            let reversed = motion.reversed().unwrap();
            assert_eq!((reversed.duration(), reversed.is_held()), (motion.duration(), motion.is_held()));
            for elapsed in [0.0, 0.011, 0.02, 0.05] {
                let Segment { duration, from, to } = motion.segment(elapsed, 1.0);
                let expected = Segment { duration, from: negative(from), to: negative(to) };
                assert_eq!(reversed.segment(elapsed, 1.0), expected);
            }
        }
    }

    /// The stronger of two motions is warned of.
    #[test]
    fn the_stronger_support_is_warned_of() {
        let motion = |peak: f64| GroundMotion::new(0.01, vec![0.0, peak, -0.5 * peak]).unwrap();
        let warned =
            |bottom: f64, top: Option<f64>| Excitation::new(motion(bottom), top.map(motion)).warning();
        assert_eq!(warned(3.0, None), None);
        assert_eq!(warned(3.0, Some(2.0)), None);
        for (bottom, top) in [(3e3, None), (3e3, Some(2e3)), (2e3, Some(3e3)), (3.0, Some(3e3))] {
            assert_eq!(warned(bottom, top), Warning::of_peak(3e3), "{bottom}, {top:?}");
        }
        assert!(Warning::of_peak(3e3).is_some());
    }
}
