//! Times of samples, which have a uniform step.

use crate::error::Fault;

/// Largest deviation of a time from the uniform grid, in steps. Times are often written with few digits.
const TIME_TOLERANCE: f64 = 0.01;

/// Times (s), and the lines that have them.
#[derive(Default)]
pub(crate) struct Times(pub(crate) Vec<(usize, f64)>);

impl Times {
    /// Takes the next time; its distance from the last must be the first step.
    pub(crate) fn push(&mut self, time: f64, line: usize) -> Result<(), Fault> {
        if let Some(&(_, last)) = self.0.last() {
            if time <= last {
                let expected = format!("a time after {last} s");
                let remedy = "times, in the first column, must increase";
                return Err(Fault::new(line, expected, format!("{time} s"), remedy));
            }
            let step = time - last;
            let first_step = self.0.get(1).map_or(step, |(_, second)| second - self.0[0].1);
            if !(step.is_finite() && (step - first_step).abs() <= TIME_TOLERANCE * first_step) {
                let expected = format!("the first step of {} s", rounded(first_step));
                let remedy = "resample the record to a uniform step, or write the times with more digits";
                return Err(Fault::new(line, expected, format!("a step of {} s", rounded(step)), remedy));
            }
        }
        self.0.push((line, time));
        Ok(())
    }

    /// Computes the first time and the mean step. Refuses steps that change slowly: they leave the uniform
    /// grid.
    pub(crate) fn uniform(&self) -> Result<Option<(f64, f64)>, Fault> {
        let [(_, first), .., (_, last)] = self.0[..] else { return Ok(None) };
        let step = rounded((last - first) / (self.0.len() - 1) as f64);
        for (index, &(line, time)) in self.0.iter().enumerate() {
            let due = first + index as f64 * step;
            if (time - due).abs() > TIME_TOLERANCE * step {
                let expected = format!("{} s, at the mean step of {step} s", rounded(due));
                let remedy = "resample the record to a uniform step";
                return Err(Fault::new(line, expected, format!("{time} s"), remedy));
            }
        }
        Ok(Some((first, step)))
    }
}

/// Rounds to twelve digits. Steps are decimal fractions, but a quotient of their sums is one only up to
/// rounding.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}
