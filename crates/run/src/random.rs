//! Random numbers that are the same on every machine.

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
}
