//! Storeys above the ground: a linear chain, and the motion of its floors under a record.
//!
//! ```text
//! M ẍ + C ẋ + K x = −M 1 a_g,   x = Σ Γₙ φₙ qₙ,   q̈ₙ + 2 ξₙ ωₙ q̇ₙ + ωₙ² qₙ = −a_g
//! ```
//!
//! Each mode is solved in closed form for a ground acceleration that is linear between its samples. The
//! damping ratio of a mode is the mean of those of the storeys, weighted by the strain energy of their
//! springs in that mode.
//!
//! # Sampling
//! Between the samples of the record, the acceleration of a floor is no straight line. It is therefore
//! resampled with the nodes aᵢ − (Δt²/12) a″(tᵢ) of [`Pulse`](crate::Pulse), whose relative error is
//! (ωΔt)⁴/240. At a sample of the record, a″ jumps where the floor is damped; there the node takes the mean
//! of both sides.

use nalgebra::{DMatrix, SymmetricEigen};
use oscillator::Oscillator;

use crate::error::{GroundMotionError, check_parameter, check_positive};
use crate::motion::{GroundMotion, floor_index};

/// Largest ωΔt of the fastest mode: the relative error is then 3e-8.
const LARGEST_PHASE: f64 = 0.05;
/// Longest step (s).
const LONGEST_STEP: f64 = 2e-3;
/// Most numbers computed at once (80 MB).
const MOST_NUMBERS: usize = 10_000_000;
/// Most storeys of a chain.
const MOST_STOREYS: usize = 200;

/// A storey: a floor, and the spring between it and what is below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Storey {
    /// Mass of the floor (kg).
    pub mass: f64,
    /// Lateral stiffness of the storey (N/m).
    pub stiffness: f64,
    /// Damping ratio (-).
    pub damping_ratio: f64,
}

/// A chain of storeys on the ground, by its modes.
///
/// ```
/// use ground_motion::{Storey, Storeys, SyntheticMotion};
///
/// // one storey of 0.3 s: its largest acceleration is close to Sa(0.3 s)
/// let stiffness = 1e4 * (std::f64::consts::TAU / 0.3_f64).powi(2);
/// let storeys = Storeys::new(&[Storey { mass: 1e4, stiffness, damping_ratio: 0.05 }])?;
/// assert!((storeys.periods()[0] - 0.3).abs() < 1e-12);
/// let ground = SyntheticMotion::default().motion()?;
/// let roof = storeys.floor(&ground, ground.duration() + 5.0, 1)?;
/// let sa = ground_motion::Spectrum::default().acceleration(&ground, 0.3)?;
/// assert!((roof.acceleration.peak() / sa - 1.0).abs() < 0.02);
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Storeys {
    storeys: Vec<Storey>,
    modes: Vec<Mode>,
}

/// A mode of vibration.
#[derive(Clone, Debug, PartialEq)]
struct Mode {
    /// ω (rad/s).
    frequency: f64,
    /// ξ (-).
    damping_ratio: f64,
    /// Γ φ of each floor, from the lowest up (-).
    shape: Vec<f64>,
}

/// Motion of a floor at a uniform step: nodes between which straight lines reproduce the true curve.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorMotion {
    /// Absolute acceleration (m/s²).
    pub acceleration: GroundMotion,
    /// Displacement relative to the ground (m), one number for each sample of the acceleration.
    pub displacement: Vec<f64>,
}

impl Storeys {
    /// Makes the chain of the storeys given, the lowest first.
    ///
    /// # Errors
    /// If there is no storey or more than 200, if a mass or stiffness is not positive, or if a damping ratio
    /// is not from 0 to below 1.
    pub fn new(storeys: &[Storey]) -> Result<Self, GroundMotionError> {
        let count = storeys.len();
        let holds = (1..=MOST_STOREYS).contains(&count);
        check_parameter(holds, "number of storeys", count as f64, "from 1 to 200")?;
        for &Storey { mass, stiffness, damping_ratio } in storeys {
            check_positive("mass of a storey in kg", mass)?;
            check_positive("stiffness of a storey in N/m", stiffness)?;
            let holds = (0.0..1.0).contains(&damping_ratio);
            check_parameter(holds, "damping ratio of a storey", damping_ratio, "from 0 to below 1")?;
        }
        Ok(Self { storeys: storeys.to_vec(), modes: modes(storeys)? })
    }

    /// Returns the storeys, the lowest first.
    pub fn storeys(&self) -> &[Storey] {
        &self.storeys
    }

    /// Returns the periods of the modes (s), the longest first.
    pub fn periods(&self) -> Vec<f64> {
        self.modes.iter().map(|mode| std::f64::consts::TAU / mode.frequency).collect()
    }

    /// Returns the damping ratios of the modes (-), in the same order.
    pub fn damping_ratios(&self) -> Vec<f64> {
        self.modes.iter().map(|mode| mode.damping_ratio).collect()
    }

    /// Returns Γ φ of a mode at a floor (-): modes in the order of [`periods`](Self::periods), floors counted
    /// from 1.
    ///
    /// # Panics
    /// If there is no such mode or floor.
    pub fn participation(&self, mode: usize, floor: usize) -> f64 {
        self.modes[mode].shape[floor - 1]
    }

    /// Computes the motion of a floor, counted from 1, for `duration` (s) from the start of `ground`. Storeys
    /// start at rest; after the record the ground stands still.
    ///
    /// # Errors
    /// If the motion takes too many samples.
    ///
    /// # Panics
    /// If there is no such floor.
    pub fn floor(
        &self,
        ground: &GroundMotion,
        duration: f64,
        floor: usize,
    ) -> Result<FloorMotion, GroundMotionError> {
        assert!((1..=self.storeys.len()).contains(&floor), "a floor of this chain");
        let fastest = self.modes.iter().fold(0.0_f64, |most, mode| most.max(mode.frequency));
        let parts = (ground.step() / LONGEST_STEP.min(LARGEST_PHASE / fastest)).ceil().max(1.0);
        let intervals = (duration / ground.step()).ceil().max(1.0);
        if intervals * parts >= MOST_NUMBERS as f64 {
            let limit = MOST_NUMBERS;
            return Err(GroundMotionError::TooManySamples { found: intervals * parts, limit });
        }
        let (parts, intervals) = (floor_index(parts), floor_index(intervals));
        let mut accelerations = vec![0.0; intervals * parts + 1];
        let mut displacement = accelerations.clone();
        for mode in &self.modes {
            let nodes = [&mut accelerations[..], &mut displacement];
            mode.add(ground, [intervals, parts], mode.shape[floor - 1], nodes);
        }
        let acceleration = GroundMotion::new(ground.step() / parts as f64, accelerations)?;
        Ok(FloorMotion { acceleration, displacement })
    }
}

/// Solves K φ = ω² M φ of a chain, slowest mode first.
fn modes(storeys: &[Storey]) -> Result<Vec<Mode>, GroundMotionError> {
    let count = storeys.len();
    // M^{-1/2} K M^{-1/2}, with K tridiagonal
    let mut matrix = DMatrix::zeros(count, count);
    for (i, storey) in storeys.iter().enumerate() {
        let above = storeys.get(i + 1).map_or(0.0, |above| above.stiffness);
        matrix[(i, i)] = (storey.stiffness + above) / storey.mass;
        if let Some(next) = storeys.get(i + 1) {
            let coupling = -next.stiffness / (storey.mass.sqrt() * next.mass.sqrt());
            (matrix[(i, i + 1)], matrix[(i + 1, i)]) = (coupling, coupling);
        }
    }
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(matrix);
    let mut modes = Vec::with_capacity(count);
    for (n, &square) in eigenvalues.iter().enumerate() {
        let limit = "of usual magnitude, beside those of the other storeys";
        check_parameter(square > 0.0 && square.is_finite(), "stiffness of a storey", square, limit)?;
        // φ = M^{-1/2} y with yᵀ y = 1, so Γ = φᵀ M 1 = Σ √m y
        let phi: Vec<_> = (0..count).map(|i| eigenvectors[(i, n)] / storeys[i].mass.sqrt()).collect();
        let factor: f64 = storeys.iter().zip(&phi).map(|(storey, phi)| storey.mass * phi).sum();
        // strain energy of each spring
        let (mut energy, mut damped, mut below) = (0.0, 0.0, 0.0);
        for (storey, phi) in storeys.iter().zip(&phi) {
            let part = storey.stiffness * (phi - below) * (phi - below);
            energy += part;
            damped += storey.damping_ratio * part;
            below = *phi;
        }
        let shape = phi.iter().map(|phi| factor * phi).collect();
        modes.push(Mode { frequency: square.sqrt(), damping_ratio: damped / energy, shape });
    }
    modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Ok(modes)
}

impl Mode {
    /// Adds the mode, multiplied by `factor`, to the acceleration and the displacement at each node, over
    /// `intervals` of the record in `parts` steps each.
    fn add(
        &self,
        ground: &GroundMotion,
        [intervals, parts]: [usize; 2],
        factor: f64,
        [accelerations, displacements]: [&mut [f64]; 2],
    ) {
        let step = ground.step() / parts as f64;
        let (c, k) = (2.0 * self.damping_ratio * self.frequency, self.frequency * self.frequency);
        let rows = Oscillator::new(c, k).propagator(step);
        let samples = ground.samples();
        // the ground stands still after its last sample
        let ends = |interval: usize| match samples.get(interval..interval + 2) {
            Some(ends) => [ends[0], ends[1]],
            None => [0.0; 2],
        };
        let slope = |[from, to]: [f64; 2]| (to - from) / ground.step();
        let (mut q, mut v) = (0.0, 0.0);
        let (mut rate_before, mut end_before) = (slope(ends(0)), samples[0]);
        for interval in 0..=intervals {
            let [from, to] = ends(interval);
            let rate = slope([from, to]);
            for part in 0..parts {
                let index = interval * parts + part;
                if index >= accelerations.len() {
                    return;
                }
                let now = from + rate * step * part as f64;
                let acceleration = -now - c * v - k * q;
                // at a sample of the record, the mean of both sides
                let (a, slope) = if part == 0 {
                    (-0.5 * (now + end_before) - c * v - k * q, 0.5 * (rate + rate_before))
                } else {
                    (acceleration, rate)
                };
                let jerk = -slope - c * a - k * v;
                // the absolute acceleration is −(c q̇ + k q)
                let correction = step * step / 12.0;
                accelerations[index] -= factor * (c * v + k * q - correction * (c * jerk + k * a));
                displacements[index] += factor * (q - correction * a);
                let [dq, next, _] =
                    rows.map(|[of_v, of_a, of_p]| of_v * v + of_a * acceleration - of_p * rate);
                (q, v) = (q + dq, next);
            }
            (rate_before, end_before) = (rate, to);
        }
    }
}
