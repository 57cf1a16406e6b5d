//! The coefficient of restitution: Eqs. (2)–(4), and by impulses.
//!
//! Eq. (3) and [`momentum_vertical_spanning`] take moments of both bodies of a strip about its new base hinge
//! *without the horizontal impulse of the top support*, which is not 0: they are true of a top that gives
//! none. By impulses, an impact projects the old field of velocities on the new one; for a strip that
//! includes the top support, for a rectangular parapet it is Eq. (2).

use crate::choices::Mechanism;

/// Analytic coefficient of restitution of a parapet, `e_an` = 1 − (3/2) sin²α. Eq. (2).
pub fn analytic_parapet(slenderness: f64) -> f64 {
    1.0 - 1.5 * slenderness.sin().powi(2)
}

/// Analytic coefficient of restitution of a vertical spanning wall, `e_an` = 1 − 2 sin²α₁. Eq. (3).
pub fn analytic_vertical_spanning(slenderness: f64) -> f64 {
    1.0 - 2.0 * slenderness.sin().powi(2)
}

/// Moments about the new bottom hinge of a vertical spanning wall whose top support gives no horizontal
/// impulse, of height h and thickness b with its hinge at h₁ \[m\]: e = (h h₁ + h₁² − 3b²)/(h h₁ + h₁² +
/// 3b²). Equals Eq. (3) at h₁ = h/2.
pub fn momentum_vertical_spanning(height: f64, hinge_height: f64, thickness: f64) -> f64 {
    let (h, h1, b) = (height, hinge_height, thickness);
    let (sum, loss) = (h * h1 + h1 * h1, 3.0 * b * b);
    (sum - loss) / (sum + loss)
}

/// Coefficient of restitution by impulses of a rectangular strip of height h and thickness b with its hinge
/// at h₁ \[m\]: [2h h₁² − 2h₁³ + b²(5h₁ − 6h)]/[2(h h₁² − h₁³ + b²(3h − 2h₁))], at mid-height (h² −
/// 14b²)/(h² + 16b²). Below 0 for squat walls.
///
/// ```
/// let e = rocking_wall::wall::restitution::impulses_of_strip(3.0, 1.5, 0.25);
/// assert!((e - (144.0 - 14.0) / (144.0 + 16.0)).abs() < 1e-15);
/// ```
pub fn impulses_of_strip(height: f64, hinge_height: f64, thickness: f64) -> f64 {
    let (h, h1, b2) = (height, hinge_height, thickness * thickness);
    let common = (h - h1) * h1 * h1;
    (2.0 * common + b2 * (5.0 * h1 - 6.0 * h)) / (2.0 * (common + b2 * (3.0 * h - 2.0 * h1)))
}

/// Ratio `e_exp`/`e_an` of restitution measured on masonry: 0.95 for a parapet, 0.90 for a vertical spanning
/// wall. Tomassetti et al., section 3.2.
pub fn calibration(mechanism: Mechanism) -> f64 {
    match mechanism {
        Mechanism::Parapet | Mechanism::RigidBody => 0.95,
        Mechanism::VerticalSpanning => 0.90,
    }
}

/// Factor on the angular velocity of a homogeneous block that turned about one edge of its base or top and
/// goes on about the back face's edge at the other end: 1 − (3/2) cos²α, negative for slender ones.
pub fn toe_to_top(slenderness: f64) -> f64 {
    1.0 - 1.5 * slenderness.cos().powi(2)
}

/// Coefficient of a parapet against transverse walls, e₁ = −(1 − (3/2) sin²α)² (1 − (3/2) cos²α), as u̇⁺ =
/// −e₁ u̇⁻.
///
/// Conventional, after Sorrentino, Al Shawa and Decanini 2011. The block changes its pivot from the outer toe
/// to the inner one ([`analytic_parapet`]), from there to the back face at the top ([`toe_to_top`]), and once
/// more by the first factor, *assuming* that it keeps its angular velocity and turns about the inner toe
/// again. The strict change from the top back to the outer toe has the factor −1/2 and gives no rebound.
pub fn analytic_one_sided(slenderness: f64) -> f64 {
    -analytic_parapet(slenderness).powi(2) * toe_to_top(slenderness)
}
