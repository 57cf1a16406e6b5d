//! Tests bodies of parts against exact integrals, Newton and Euler, and the impulses at their contacts.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::variables::{Mechanism, Solver};
use rocking_wall::wall::{Load, Parameters, Part, Support, Wall};

use crate::bodies::{held, mass_of, of_parts};
use crate::configuration::configuration;

/// A polynomial in z by its coefficients.
fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// m, ∫x, ∫z, ∫x², ∫z² dm of a part between two heights, by the exact integrals of polynomials.
fn integrals(part: &Part, [from, to]: [f64; 2]) -> [f64; 5] {
    let line = |[bottom, top]: [f64; 2]| {
        let slope = (top - bottom) / part.height;
        vec![bottom - slope * part.base, slope]
    };
    let (t, w, o) = (line(part.thickness), line(part.width), line(part.outer));
    let over = |polynomial: &[f64]| {
        let term = |(power, c): (usize, &f64)| {
            let power = i32::try_from(power).unwrap() + 1;
            c * (to.powi(power) - from.powi(power)) / f64::from(power)
        };
        part.density * polynomial.iter().enumerate().map(term).sum::<f64>()
    };
    let area = times(&w, &t);
    let added = |a: &[f64], factor: f64, b: &[f64]| {
        let mut sum = a.to_vec();
        sum.resize(a.len().max(b.len()), 0.0);
        sum.iter_mut().zip(b).for_each(|(x, y)| *x += factor * y);
        sum
    };
    // x: o + t/2; x²: o² + o t + t²/3
    let middle = added(&o, 0.5, &t);
    let square = added(&added(&times(&o, &o), 1.0, &times(&o, &t)), 1.0 / 3.0, &times(&t, &t));
    [
        over(&area),
        over(&times(&area, &middle)),
        over(&times(&area, &[0.0, 1.0])),
        over(&times(&area, &square)),
        over(&times(&area, &[0.0, 0.0, 1.0])),
    ]
}

/// The sums over the parts of a body, with loads as points.
pub(crate) fn whole(parts: &[Part], loads: &[Load], range: [f64; 2]) -> [f64; 5] {
    let mut sums = [0.0; 5];
    for part in parts {
        let range = [part.base.max(range[0]), part.top().min(range[1])];
        if range[0] < range[1] {
            sums.iter_mut().zip(integrals(part, range)).for_each(|(sum, one)| *sum += one);
        }
    }
    for load in loads.iter().filter(|load| range[0] < load.height && load.height <= range[1]) {
        let (m, x, z) = (mass_of(load), load.inside, load.height);
        sums.iter_mut().zip([m, m * x, m * z, m * x * x, m * z * z]).for_each(|(sum, one)| *sum += one);
    }
    sums
}

/// Three stacked parts that taper, with steps on both faces.
pub(crate) fn stacks() -> impl Strategy<Value = Vec<Part>> {
    let part = (
        0.3_f64..2.0,
        [0.25_f64..0.6, 0.25..0.6],
        [0.5_f64..3.0, 0.5..3.0],
        [-0.05_f64..0.05, -0.05..0.05],
        1500.0_f64..2500.0,
    );
    prop::collection::vec(part, 1..4).prop_map(|parts| {
        let mut base = 0.0;
        let stacked = parts.into_iter().map(|(height, thickness, width, outer, density)| {
            let outer = if base == 0.0 { [0.0, outer[1]] } else { outer };
            let part = Part { base, height, thickness, width, outer, density };
            base += height;
            part
        });
        stacked.collect()
    })
}

pub(crate) fn loads() -> impl Strategy<Value = Vec<[f64; 5]>> {
    prop::collection::vec([0.0..2e4, 0.05_f64..1.0, 0.05..0.3, 0.0..1.0, -50.0..50.0], 0..3)
}

/// Loads at shares of a height.
pub(crate) fn at_shares(loads: &[[f64; 5]], height: f64) -> Vec<Load> {
    let load = |&[force, share, inside, moving_mass, thrust]: &[f64; 5]| Load {
        moving_mass: Some(moving_mass),
        thrust,
        ..Load::resting(force, share * height, inside)
    };
    loads.iter().map(load).collect()
}

pub(crate) fn close(found: f64, expected: f64, scale: f64) -> Result<(), TestCaseError> {
    // the rounding of some dozen terms
    prop_assert!(
        (found - expected).abs() <= 1e-12 * scale.abs().max(expected.abs()),
        "{found} for {expected}"
    );
    Ok(())
}

proptest! {
    #![proptest_config(configuration())]

    /// One body: its constants by exact integrals, its acceleration by moments about the toe, and e by the
    /// impulses at the new toe.
    #[test]
    fn one_body_is_that_of_newton_and_euler(parts in stacks(), loads in loads(), share in -0.5_f64..0.5) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let loads = at_shares(&loads, height);
        let parameters = of_parts(&parts, &[], &loads);
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let body = wall.body();
        let [m, mx, mz, ..] = whole(&parts, &[], [0.0, height]);
        let (x_g, z_g, weight) = (mx / m, mz / m, m * 9.81);
        close(body.mass, m, 0.0)?;
        close(body.centroid_height, z_g, 0.0)?;
        let [moving, mx, mz, mx2, mz2] = whole(&parts, &loads, [0.0, height]);
        let [outer, inner] = [0.0, parts[0].thickness[0]];
        let sum = |of: &dyn Fn(&Load) -> f64| loads.iter().map(of).sum::<f64>();
        for side in [1.0, -1.0] {
            let toe = if side > 0.0 { outer } else { inner };
            let moment = weight * side * (x_g - toe)
                + sum(&|l| l.force * side * (l.inside - toe) - side * l.thrust * l.height);
            let overturning = weight * z_g + sum(&|l| l.force * l.height);
            // θ̈ of a small θ under a ground acceleration, u = θ z_G
            let u = side * share.abs() * body.instability.of(side);
            let ground = share;
            let theta = (-ground * mz - side * moment + overturning * u / z_g) / mz2;
            let support = Support::rigid(ground);
            let mut simulation = Simulation::new(&parameters, None, 0.0, support).unwrap();
            simulation.place(u, 0.0, support);
            close(simulation.outputs(support).acceleration, theta * z_g, moment * z_g / mz2)?;
            // impact: the body leaves `toe` for `other`; unknown are both impulses there and the new rate
            let other = if side > 0.0 { inner } else { outer };
            let (x, z) = (mx / moving, mz / moving);
            let inertia = mx2 + mz2 - moving * (x * x + z * z);
            // outwards is -x: a rate towards the outside moves the centroid by (z, x - toe) outwards and up
            #[rustfmt::skip]
            let matrix = Matrix3::new(
                1.0, 0.0, -moving * z,
                0.0, 1.0, -moving * (x - other),
                z, x - other, inertia,
            );
            let right = Vector3::new(-moving * z, -moving * (x - toe), inertia);
            let found = matrix.lu().solve(&right).unwrap()[2];
            close(body.impulses.unwrap().of(side), found, 1.0)?;
        }
    }

    /// A strip: e by the impulses at the base, at the hinge and at the top support.
    #[test]
    fn a_strip_loses_what_impulses_at_its_contacts_take(
        parts in stacks(), loads in loads(), hinge_ratio in 0.3_f64..0.7,
    ) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let loads = at_shares(&loads, height);
        let parameters = Parameters {
            mechanism: Mechanism::VerticalSpanning,
            hinge_ratio,
            restitution: 0.9,
            ..of_parts(&parts, &[], &loads)
        };
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let h1 = hinge_ratio * height;
        let h2 = height - h1;
        let holds_hinge = |part: &&Part| part.base < h1 && h1 < part.top();
        let section = parts.iter().find(holds_hinge).unwrap().section(h1);
        let bodies = [[0.0, h1], [h1, height]].map(|range| whole(&parts, &loads, range));
        for side in [1.0, -1.0] {
            let toes = [0.0, parts[0].thickness[0]];
            let [toe, new_toe] = if side > 0.0 { toes } else { [toes[1], toes[0]] };
            let edges = [section.inner, section.outer];
            let [edge, new_edge] = if side > 0.0 { edges } else { [edges[1], edges[0]] };
            // per unit u̇ outwards: rates of turning, and velocities of the centroids outwards and up
            let velocity = |toe: f64, edge: f64| {
                let [lower, upper] = bodies.map(|[m, mx, mz, ..]| (mx / m, mz / m));
                let at_hinge = (edge - toe) / h1;
                let lower = [1.0 / h1, lower.1 / h1, (lower.0 - toe) / h1];
                let upper = [-1.0 / h2, (height - upper.1) / h2, at_hinge + (edge - upper.0) / h2];
                [lower, upper]
            };
            let [before, after] = [velocity(toe, edge), velocity(new_toe, new_edge)];
            // unknown: impulses at the base, at the hinge on the lower body, at the top; u̇ after the impact
            let mut matrix = Matrix6::zeros();
            let mut right = Vector6::zeros();
            let contacts = [(new_toe, 0.0), (new_edge, h1)];
            for (index, [m, mx, mz, mx2, mz2]) in bodies.into_iter().enumerate() {
                let (x, z) = (mx / m, mz / m);
                let inertia = mx2 + mz2 - m * (x * x + z * z);
                let row = 3 * index;
                // the base acts on the lower body, the hinge on both, the top on the upper one
                let impulses: &[(usize, (f64, f64), f64)] = if index == 0 {
                    &[(0, contacts[0], 1.0), (2, contacts[1], 1.0)]
                } else {
                    &[(2, contacts[1], -1.0)]
                };
                for &(column, (at_x, at_z), sign) in impulses {
                    matrix[(row, column)] += sign;
                    matrix[(row + 1, column + 1)] += sign;
                    // about the centroid, turning outwards; x counts inwards
                    matrix[(row + 2, column)] += sign * (at_z - z);
                    matrix[(row + 2, column + 1)] += sign * (at_x - x);
                }
                if index == 1 {
                    matrix[(row, 4)] += 1.0;
                    matrix[(row + 2, 4)] += height - z;
                }
                let [rate, out, up] = after[index];
                matrix[(row, 5)] = -m * out;
                matrix[(row + 1, 5)] = -m * up;
                matrix[(row + 2, 5)] = -inertia * rate;
                let [rate, out, up] = before[index];
                right[row] = -m * out;
                right[row + 1] = -m * up;
                right[row + 2] = -inertia * rate;
            }
            let found = matrix.lu().solve(&right).unwrap()[5];
            let e = wall.body().impulses.unwrap().of(side);
            prop_assert!((e - found).abs() <= 1e-10 * found.abs().max(1.0), "{e} for {found}");
        }
    }

    /// A free motion with impacts of different strength on both sides is the same in three solvers.
    #[test]
    fn solvers_agree_on_unlike_sides(parts in stacks(), loads in loads(), share in 0.2_f64..0.8) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let parameters = of_parts(&parts, &[], &at_shares(&loads, height));
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let end = 3.0 / wall.rocking_rate();
        let u_start = share * wall.body().instability.positive;
        let run = |solver| {
            let (tolerance, newmark_step) = (1e-13, 1e-4);
            let given = Parameters { solver, u_start, tolerance, newmark_step, ..parameters.clone() };
            let mut simulation = Simulation::new(&given, None, 0.0, Support::default()).unwrap();
            simulation.advance(&held(Support::default(), end)).unwrap();
            simulation.progress().state.displacement
        };
        let [exact, adaptive, newmark] = [Solver::Exact, Solver::Adaptive, Solver::Newmark].map(run);
        prop_assert!((exact - adaptive).abs() <= 1e-9 * u_start, "{exact}, {adaptive}");
        // of second order, and a passage of u = 0 is located within a step
        prop_assert!((exact - newmark).abs() <= 1e-3 * u_start, "{exact}, {newmark}");
    }
}
