//! Storeys as a chain of masses, integrated without modes: what the floors of tests are compared with.

use ground_motion::{GroundMotion, Storey, SyntheticMotion};

pub(crate) const STOREYS: [(f64, f64); 3] = [(2.0e4, 4.0e7), (2.0e4, 3.0e7), (1.5e4, 2.0e7)];

pub(crate) const TAIL: f64 = 4.0;

pub(crate) fn ground() -> GroundMotion {
    SyntheticMotion { duration: 10.0, ..SyntheticMotion::default() }.motion().unwrap()
}

pub(crate) fn storeys(damping_ratio: f64, periods: &[(f64, f64)]) -> Vec<Storey> {
    periods.iter().map(|&(mass, stiffness)| Storey { mass, stiffness, damping_ratio }).collect()
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
pub(crate) fn rounded(count: f64) -> usize {
    count.round() as usize
}

/// Absolute accelerations and displacements of the floors at a small step, by the classical Runge-Kutta
/// method on the chain itself. Dashpots lie between the storeys.
pub(crate) fn integrated(
    storeys: &[Storey],
    dashpots: &[f64],
    ground: &GroundMotion,
    parts: usize,
) -> Vec<Vec<[f64; 2]>> {
    let n = storeys.len();
    let step = ground.step() / parts as f64;
    let forces = |x: &[f64], v: &[f64]| -> Vec<f64> {
        let spring = |i: usize| {
            let (below, rate) = if i == 0 { (0.0, 0.0) } else { (x[i - 1], v[i - 1]) };
            storeys[i].stiffness * (x[i] - below) + dashpots[i] * (v[i] - rate)
        };
        (0..n).map(|i| (if i + 1 < n { spring(i + 1) } else { 0.0 } - spring(i)) / storeys[i].mass).collect()
    };
    let samples = ground.samples();
    let at = |interval: usize, fraction: f64| match samples.get(interval..interval + 2) {
        Some(ends) => ends[0] + fraction * (ends[1] - ends[0]),
        None => 0.0,
    };
    let (mut x, mut v) = (vec![0.0; n], vec![0.0; n]);
    let mut floors = vec![Vec::new(); n];
    let intervals = rounded((ground.duration() + TAIL) / ground.step());
    for interval in 0..intervals {
        for part in 0..parts {
            let absolute = forces(&x, &v);
            for i in 0..n {
                floors[i].push([absolute[i], x[i]]);
            }
            let rates = |x: &[f64], v: &[f64], offset: f64| {
                let a = at(interval, (part as f64 + offset) / parts as f64);
                let relative: Vec<_> = forces(x, v).into_iter().map(|force| force - a).collect();
                (v.to_vec(), relative)
            };
            let moved = |(dx, dv): &(Vec<f64>, Vec<f64>), h: f64| {
                let moved = |from: &[f64], by: &[f64]| from.iter().zip(by).map(|(a, b)| a + h * b).collect();
                (moved(&x, dx), moved(&v, dv))
            };
            let k1 = rates(&x, &v, 0.0);
            let (x2, v2): (Vec<_>, Vec<_>) = moved(&k1, 0.5 * step);
            let k2 = rates(&x2, &v2, 0.5);
            let (x3, v3): (Vec<_>, Vec<_>) = moved(&k2, 0.5 * step);
            let k3 = rates(&x3, &v3, 0.5);
            let (x4, v4): (Vec<_>, Vec<_>) = moved(&k3, step);
            let k4 = rates(&x4, &v4, 1.0);
            for i in 0..n {
                x[i] += step / 6.0 * (k1.0[i] + 2.0 * k2.0[i] + 2.0 * k3.0[i] + k4.0[i]);
                v[i] += step / 6.0 * (k1.1[i] + 2.0 * k2.1[i] + 2.0 * k3.1[i] + k4.1[i]);
            }
        }
    }
    floors
}
