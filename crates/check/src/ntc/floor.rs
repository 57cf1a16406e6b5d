//! Spectra at the height of a wall, C7.2.3.

use std::f64::consts::TAU;

use rocking_wall::wall::Body;
use scene::{Floors, SceneError};

use super::ground::{GroundSpectrum, damping_factor};

/// a and b of C7.2.3: the spectrum has its largest value from a `T_k` to b `T_k`.
const A: f64 = 0.8;
const B: f64 = 1.1;

files::tables! {
    /// A mode of the building at the place of a wall.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Mode {
        /// `T_k` \[s\].
        #[key(exclusiveMinimum = 0)]
        pub period: f64,
        /// `γ_k` `ψ_k(z)`: participation times shape there (-).
        pub participation: f64,
    }
}

impl Mode {
    /// Makes the mode of uniform storeys whose shape is a straight line, γ₁ = 3n/(2n + 1) [C7.2.10] and
    /// ψ₁ = z/H.
    pub fn of_storeys(storeys: u32, period: f64, height_ratio: f64) -> Self {
        let n = f64::from(storeys);
        Self { period, participation: 3.0 * n / (2.0 * n + 1.0) * height_ratio }
    }
}

/// The modes of the storeys of a scene, `γ_k` `ψ_k` by the weights of the wall's supports. Their periods are
/// in proportion where a first one is stated \[s\].
pub(crate) fn modes_of_storeys(
    floors: Option<&Floors>,
    first_period: Option<f64>,
    body: &Body,
) -> Result<Vec<Mode>, SceneError> {
    let Some(floors) = floors else { return Ok(Vec::new()) };
    let (bottom, top) = floors.supports(body.mechanism)?;
    let [at_bottom, at_top] = body.support_weights;
    let chain = floors.storeys();
    let shape = |floor: usize, mode: usize| if floor == 0 { 0.0 } else { chain.participation(mode, floor) };
    let periods = chain.periods();
    let stretch = first_period.map_or(1.0, |period| period / periods[0]);
    let mode = |(index, period): (usize, &f64)| Mode {
        period: period * stretch,
        participation: at_bottom * shape(bottom, index) + top.map_or(0.0, |top| at_top * shape(top, index)),
    };
    let modes: Vec<Mode> = periods.iter().enumerate().map(mode).collect();
    // supports on the ground move with it
    Ok(if modes.iter().all(|mode| mode.participation == 0.0) { Vec::new() } else { modes })
}

/// The spectrum of a limit state at the height of a wall.
///
/// ```
/// use check::circolare::{FloorSpectrum, GroundSpectrum, Hazard, Mode, Soil};
///
/// let hazard = Hazard { ag: 0.15, f0: 2.45, tc: 0.32 };
/// let ground = GroundSpectrum::new(hazard, Soil::B, 1.0);
/// let roof = FloorSpectrum::new(ground, vec![Mode::of_storeys(3, 0.3, 1.0)], 0.10);
/// assert!((roof.acceleration(0.0, 0.08) - 4.63152).abs() < 5e-6);
/// assert!((roof.acceleration(0.3, 0.08) - 14.1301).abs() < 5e-5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FloorSpectrum {
    ground: GroundSpectrum,
    modes: Vec<Mode>,
    xi: f64,
    /// `a_Z`,k of the modes \[m/s²\].
    accelerations: Vec<f64>,
    /// The least acceleration up to T₁ \[m/s²\].
    least: f64,
}

impl FloorSpectrum {
    /// a and b of C7.2.3.
    pub(crate) const PLATEAU: (f64, f64) = (A, B);

    /// Makes the spectrum of a building with modes, the first first, all of the damping `xi`, `ξ_k` \[-\].
    ///
    /// # Panics
    /// Without a mode.
    pub fn new(ground: GroundSpectrum, modes: Vec<Mode>, xi: f64) -> Self {
        assert!(!modes.is_empty(), "a building has a mode");
        let of_mode = |mode: &Mode| {
            // [C7.2.7], with 0.0004 ξ%² = 4 ξ²
            ground.acceleration(mode.period, xi) * mode.participation.abs() * (1.0 + 4.0 * xi * xi).sqrt()
        };
        let accelerations = modes.iter().map(of_mode).collect();
        Self { ground, modes, xi, accelerations, least: 0.0 }
    }

    /// Bounds accelerations up to T₁ by that of the ground, `a_g` S: the foot of the building moves with it,
    /// which its modes leave out.
    #[must_use]
    pub fn not_below_ground(self) -> Self {
        Self { least: self.ground.acceleration(0.0, self.xi), ..self }
    }

    /// The spectrum of the ground.
    pub fn ground(&self) -> &GroundSpectrum {
        &self.ground
    }

    /// The modes.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// `ξ_k`, the damping of the building \[-\].
    pub fn damping(&self) -> f64 {
        self.xi
    }

    /// T₁, the period of the first mode \[s\].
    pub fn first_period(&self) -> f64 {
        self.modes[0].period
    }

    /// `A_k` of [C7.2.9] for the damping ξ of the mechanism; `ξ_k`^−0.5 takes `ξ_k` as a fraction \[-\].
    pub fn amplification(&self, xi: f64) -> f64 {
        1.1 / self.xi.sqrt() * damping_factor(xi)
    }

    /// `a_Z` of [C7.2.8], as printed \[m/s²\].
    pub fn printed_peak(&self) -> f64 {
        root_of_squares(self.accelerations.iter().copied())
    }

    /// The largest acceleration of the place: `a_Z`, or `a_g` S if that bounds it \[m/s²\].
    pub fn peak_acceleration(&self) -> f64 {
        self.printed_peak().max(self.least)
    }

    /// Whether `a_g` S, not the modes, gives the acceleration at a period.
    pub(crate) fn ground_governs(&self, period: f64, xi: f64) -> bool {
        period <= self.first_period() && self.amplified(period, xi) < self.least
    }

    /// `S_eZ`(T, ξ, z) of [C7.2.5] \[m/s²\].
    pub fn acceleration(&self, period: f64, xi: f64) -> f64 {
        let amplified = self.amplified(period, xi);
        if period > self.first_period() {
            amplified.max(self.ground.pseudo_acceleration(period, xi))
        } else {
            amplified.max(self.least)
        }
    }

    /// Both terms of `S_d` in [C8.7.1.12] \[m\]: `S_eZ` T²/(4π²), and behind b T₁ the value that it does not
    /// fall below, `S_eZ`(T₁) b² T₁²/(4π²).
    pub fn displacement(&self, period: f64, xi: f64) -> (f64, Option<f64>) {
        let at = |period: f64, reached: f64| self.acceleration(period, xi) * (reached / TAU).powi(2);
        let first = self.first_period();
        (at(period, period), (period > B * first).then(|| at(first, B * first)))
    }

    /// `a_Z`,k of the modes, [C7.2.7] \[m/s²\].
    pub fn mode_accelerations(&self) -> &[f64] {
        &self.accelerations
    }

    /// The root of the squares of `S_eZ`,k of [C7.2.6] \[m/s²\].
    fn amplified(&self, period: f64, xi: f64) -> f64 {
        let most = self.amplification(xi);
        let shape = |mode: &Mode| {
            let (from, to) = (A * mode.period, B * mode.period);
            let beside = if period < from {
                libm::pow(1.0 - period / from, 1.6)
            } else if period < to {
                0.0
            } else {
                libm::pow(period / to - 1.0, 1.2)
            };
            most / (1.0 + (most - 1.0) * beside)
        };
        root_of_squares(self.modes.iter().zip(&self.accelerations).map(|(mode, a_z)| shape(mode) * a_z))
    }
}

fn root_of_squares(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|value| value * value).sum::<f64>().sqrt()
}
