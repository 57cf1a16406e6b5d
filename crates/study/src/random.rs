//! Random numbers that are the same on every machine.

/// `PCG-XSH-RR` 64/32 (O'Neill: PCG, a family of simple fast space-efficient statistically good algorithms for random
/// number generation. Harvey Mudd College, 2014).
#[derive(Clone, Debug)]
pub(super) struct Pcg {
    state: u64,
}

const MULTIPLIER: u64 = 6_364_136_223_846_793_005;
const INCREMENT: u64 = 1_442_695_040_888_963_407;

impl Pcg {
    pub(super) fn new(seed: u64) -> Self {
        let mut pcg = Self { state: seed.wrapping_add(INCREMENT) };
        pcg.next();
        pcg
    }

    fn next(&mut self) -> u32 {
        let state = self.state;
        self.state = state.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
        #[allow(clippy::cast_possible_truncation, reason = "the generator takes these 32 bits")]
        let folded = (((state >> 18) ^ state) >> 27) as u32;
        #[allow(clippy::cast_possible_truncation, reason = "five bits are left")]
        let turn = (state >> 59) as u32;
        folded.rotate_right(turn)
    }

    /// A whole number from 0 to below `count`, each as likely as any other to within `count`/2³².
    pub(super) fn below(&mut self, count: usize) -> usize {
        #[allow(clippy::cast_possible_truncation, reason = "below `count`")]
        let index = ((u64::from(self.next()) * count as u64) >> 32) as usize;
        index
    }
}
