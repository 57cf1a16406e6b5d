//! Medians and fractiles of a sample, and random numbers that are the same on every machine.

const MULTIPLIER: u64 = 6_364_136_223_846_793_005;
const INCREMENT: u64 = 1_442_695_040_888_963_407;

/// The generator `PCG-XSH-RR` 64/32 (O'Neill: PCG, a family of simple fast space-efficient statistically good
/// algorithms for random number generation. Harvey Mudd College, 2014).
#[derive(Clone, Debug)]
pub struct Pcg {
    state: u64,
}

impl Pcg {
    /// Starts the generator from a seed.
    pub fn new(seed: u64) -> Self {
        let mut pcg = Self { state: seed.wrapping_add(INCREMENT) };
        pcg.next();
        pcg
    }

    #[allow(clippy::cast_possible_truncation, reason = "the generator takes 32 bits, and rotates by 5")]
    fn next(&mut self) -> u32 {
        let state = self.state;
        self.state = state.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
        ((((state >> 18) ^ state) >> 27) as u32).rotate_right((state >> 59) as u32)
    }

    /// Draws a whole number from 0 to below `count`, each with the same probability to within `count`/2³².
    #[allow(clippy::cast_possible_truncation, reason = "below `count`")]
    pub fn below(&mut self, count: usize) -> usize {
        ((u64::from(self.next()) * count as u64) >> 32) as usize
    }

    /// Draws a number between 0 and 1, neither of them: one of 2⁵² that are equally far apart.
    pub fn part(&mut self) -> f64 {
        let [high, low] = [self.next(), self.next()].map(|bits| u64::from(bits >> 6));
        ((high << 26 | low) as f64 + 0.5) / (1_u64 << 52) as f64
    }
}

/// Returns a sample in rising order.
pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Returns a fractile of a sorted sample: its smallest value that at least a fraction `part` of it does not
/// exceed.
pub fn fractile(sorted: &[f64], part: f64) -> Option<f64> {
    sorted.get(place(sorted.len(), part)).copied()
}

/// Returns the [`fractile`] of a sample in any order, which it changes.
pub fn unsorted_fractile(values: &mut [f64], part: f64) -> Option<f64> {
    let place = place(values.len(), part);
    (place < values.len()).then(|| *values.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// Returns the place of a fractile among so many sorted values.
fn place(count: usize, part: f64) -> usize {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to the count")]
    let number = (part * count as f64 - 1e-9).ceil().max(1.0) as usize;
    number - 1
}

/// Returns the middle value, or the mean of the two in the middle; NaN of an empty sample.
pub fn sample_median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if !even {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (lower + upper)
}
