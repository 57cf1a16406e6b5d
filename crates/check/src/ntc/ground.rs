//! Elastic spectra of the ground after NTC 2018, 3.2.3.2.

use std::f64::consts::TAU;

use files::{Described, Schema, Tables, with};
use serde::{Deserialize, Serialize};

/// g of NTC 3.2.3.2.1 \[m/s²\].
pub const G: f64 = 9.81;

/// `T_F` of Tab. 3.2.VII, for every soil \[s\].
const T_F: f64 = 10.0;

/// Soil of Tab. 3.2.II, for which the code has formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub enum Soil {
    /// Rock and very stiff soil.
    A,
    /// Soft rock, very dense soil.
    B,
    /// Dense soil.
    C,
    /// Loose or soft soil.
    D,
    /// C or D, at most 30 m thick.
    E,
}

/// What Tab. 3.2.IV and 3.2.VII have of a soil.
struct OfSoil {
    /// `S_S` = a − b F0 `a_g`/g from a least to a largest value: a, b, least, largest.
    amplification: [f64; 4],
    /// `C_C` = c `T_C`*^d: c, d.
    period_factor: [f64; 2],
    /// `T_E` \[s\].
    long_period: f64,
}

impl Soil {
    fn row(self) -> OfSoil {
        let row =
            |amplification, period_factor, long_period| OfSoil { amplification, period_factor, long_period };
        match self {
            Self::A => row([1.00, 0.00, 1.00, 1.00], [1.00, 0.00], 4.5),
            Self::B => row([1.40, 0.40, 1.00, 1.20], [1.10, -0.20], 5.0),
            Self::C => row([1.70, 0.60, 1.00, 1.50], [1.05, -0.33], 6.0),
            Self::D => row([2.40, 1.50, 0.90, 1.80], [1.25, -0.50], 6.0),
            Self::E => row([2.00, 1.10, 1.00, 1.60], [1.15, -0.40], 6.0),
        }
    }

    /// `S_S` of Tab. 3.2.IV for F0 `a_g`/g \[-\].
    fn amplification(self, x: f64) -> f64 {
        let [most, slope, low, high] = self.row().amplification;
        (most - slope * x).clamp(low, high)
    }

    /// `C_C` of Tab. 3.2.IV for `T_C`* \[s\].
    fn period_factor(self, tc: f64) -> f64 {
        let [factor, exponent] = self.row().period_factor;
        factor * libm::pow(tc, exponent)
    }
}

/// Category of topography of Tab. 3.2.V.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[allow(missing_docs, reason = "names of the code")]
pub enum Category {
    T1,
    T2,
    T3,
    T4,
}

/// Topography: a category of Tab. 3.2.V or `S_T`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected \"T1\" to \"T4\", or S_T from 1 to 1.4")]
pub enum Topography {
    /// `S_T` \[-\].
    Factor(f64),
    /// `T1` to `T4`.
    Category(Category),
}

impl Topography {
    /// `S_T` of Tab. 3.2.V \[-\].
    pub(crate) fn factor(self) -> f64 {
        match self {
            Self::Factor(factor) => factor,
            Self::Category(Category::T1) => 1.0,
            Self::Category(Category::T2 | Category::T3) => 1.2,
            Self::Category(Category::T4) => 1.4,
        }
    }
}

impl Described for Topography {
    fn describe(key: &str, tables: &mut Tables) -> Schema {
        let factor = with(with(f64::describe(key, tables), "minimum", 1), "maximum", 1.4);
        with(Schema::new(), "anyOf", vec![Category::describe(key, tables), factor])
    }
}

/// Hazard of a limit state on rigid ground, NTC 3.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hazard {
    /// `a_g` \[g\].
    pub ag: f64,
    /// F0, the largest amplification \[-\].
    pub f0: f64,
    /// `T_C`* \[s\].
    pub tc: f64,
}

/// The elastic spectrum of a limit state on the ground.
///
/// ```
/// use check::circolare::{GroundSpectrum, Hazard, Soil};
///
/// let hazard = Hazard { ag: 0.15, f0: 2.45, tc: 0.32 };
/// let ground = GroundSpectrum::new(hazard, Soil::B, 1.0);
/// assert!((ground.acceleration(0.0, 0.05) - 1.7658).abs() < 1e-12);
/// assert!((ground.acceleration(0.3, 0.05) - 4.32621).abs() < 5e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GroundSpectrum {
    /// `a_g` \[m/s²\].
    pub a_g: f64,
    /// F0 \[-\].
    #[serde(rename = "F0")]
    pub f0: f64,
    /// S = `S_S` `S_T` [3.2.3] \[-\].
    #[serde(rename = "S")]
    pub s: f64,
    /// `S_S` of Tab. 3.2.IV \[-\].
    #[serde(rename = "S_S")]
    pub soil_factor: f64,
    /// `C_C` of Tab. 3.2.IV \[-\].
    #[serde(rename = "C_C")]
    pub period_factor: f64,
    /// `T_B` [3.2.6] \[s\].
    #[serde(rename = "T_B")]
    pub t_b: f64,
    /// `T_C` [3.2.5] \[s\].
    #[serde(rename = "T_C")]
    pub t_c: f64,
    /// `T_D` [3.2.7] \[s\].
    #[serde(rename = "T_D")]
    pub t_d: f64,
    /// `T_E` of Tab. 3.2.VII \[s\].
    #[serde(rename = "T_E")]
    pub t_e: f64,
}

/// η of [3.2.4] for a damping ratio ξ as a fraction, √(10/(5 + ξ%)) ≥ 0.55 \[-\].
pub fn damping_factor(xi: f64) -> f64 {
    (10.0 / (5.0 + 100.0 * xi)).sqrt().max(0.55)
}

impl GroundSpectrum {
    /// Makes the spectrum of a hazard on a soil; `topography` is `S_T` of Tab. 3.2.V \[-\].
    pub fn new(hazard: Hazard, soil: Soil, topography: f64) -> Self {
        let Hazard { ag, f0, tc } = hazard;
        let (soil_factor, period_factor) = (soil.amplification(f0 * ag), soil.period_factor(tc));
        let t_c = period_factor * tc;
        Self {
            a_g: ag * G,
            f0,
            s: soil_factor * topography,
            soil_factor,
            period_factor,
            t_b: t_c / 3.0,
            t_c,
            t_d: 4.0 * ag + 1.6,
            t_e: soil.row().long_period,
        }
    }

    /// `S_e`(T, ξ) of [3.2.2], for any T \[m/s²\].
    pub fn acceleration(&self, period: f64, xi: f64) -> f64 {
        let Self { a_g, f0, s, t_b, t_c, t_d, .. } = *self;
        let eta = damping_factor(xi);
        let plateau = a_g * s * eta * f0;
        if period < t_b {
            plateau * (period / t_b + (1.0 - period / t_b) / (eta * f0))
        } else if period < t_c {
            plateau
        } else if period < t_d {
            plateau * (t_c / period)
        } else {
            plateau * (t_c * t_d / (period * period))
        }
    }

    /// `S_De`(T, ξ) of [3.2.10] to [3.2.12] \[m\].
    pub fn displacement(&self, period: f64, xi: f64) -> f64 {
        let Self { a_g, f0, s, t_c, t_d, t_e, .. } = *self;
        if period <= t_e {
            return self.acceleration(period, xi) * (period / TAU).powi(2);
        }
        // d_g of [3.2.12]
        let ground = 0.025 * a_g * s * t_c * t_d;
        let amplified = f0 * damping_factor(xi);
        let share = ((period - t_e) / (T_F - t_e)).min(1.0);
        ground * (amplified + (1.0 - amplified) * share)
    }

    /// `S_De`(T, ξ) as an acceleration, `S_De` 4π²/T²; it is `S_e` up to `T_E` \[m/s²\].
    pub(crate) fn pseudo_acceleration(&self, period: f64, xi: f64) -> f64 {
        if period <= self.t_e {
            self.acceleration(period, xi)
        } else {
            self.displacement(period, xi) * (TAU / period).powi(2)
        }
    }
}
