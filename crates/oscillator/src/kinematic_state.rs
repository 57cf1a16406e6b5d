//! Displacement, velocity and acceleration.

/// Displacement, velocity and acceleration at one instant \[m, m/s, m/s²\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinematicState {
    /// u \[m\].
    pub displacement: f64,
    /// u̇ \[m/s\].
    pub velocity: f64,
    /// ü \[m/s²\].
    pub acceleration: f64,
}
