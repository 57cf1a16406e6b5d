//! Tests bodies of parts in full rotations against the equation in θ, integrated by itself.

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::wall::{Hollow, Kinematics, Load, Opening, Parameters, Part, Sides, Support, Wall};

use crate::bodies::{PRISM, mass_of, of_parts};

const GRAVITY: f64 = 9.81;

/// A mass that moves along, a force downwards and a thrust outwards, at x inwards from the outer toe and z.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    mass: f64,
    pub(crate) force: f64,
    pub(crate) thrust: f64,
    x: f64,
    pub(crate) z: f64,
}

/// The places of a prism by Boole's rule over its height and Simpson's across: exact up to degree 5 and 3.
fn prism(part: &Part, sign: f64) -> Vec<Place> {
    let mut places = Vec::new();
    for (height, over) in [(0.0, 7.0), (0.25, 32.0), (0.5, 12.0), (0.75, 32.0), (1.0, 7.0)] {
        let at = |[bottom, top]: [f64; 2]| bottom + (top - bottom) * height;
        for (depth, across) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
            let area = part.height * at(part.thickness) * at(part.width);
            let mass = sign * part.density * area * over / 90.0 * across / 6.0;
            let x = at(part.outer) + depth * at(part.thickness);
            let z = part.base + height * part.height;
            places.push(Place { mass, force: GRAVITY * mass, thrust: 0.0, x, z });
        }
    }
    places
}

/// A body by its places: those of the masonry first.
pub(crate) struct Reference {
    places: Vec<Place>,
    masonry: usize,
    /// Distance of the toes.
    base: f64,
}

impl Reference {
    fn new(parts: &[Part], hollows: &[Part], loads: &[Load], base: f64) -> Self {
        let solid = parts.iter().flat_map(|part| prism(part, 1.0));
        let mut places: Vec<_> = solid.chain(hollows.iter().flat_map(|part| prism(part, -1.0))).collect();
        let masonry = places.len();
        places.extend(loads.iter().map(|load| {
            let Load { force, height: z, inside: x, thrust, .. } = *load;
            Place { mass: mass_of(load), force, thrust, x, z }
        }));
        Self { places, masonry, base }
    }

    /// Distance inwards from the toe of the side of `sign`.
    pub(crate) fn arm(&self, sign: f64, place: &Place) -> f64 {
        if sign > 0.0 { place.x } else { self.base - place.x }
    }

    pub(crate) fn sum(&self, of: impl Fn(&Place) -> f64) -> f64 {
        self.places.iter().map(of).sum()
    }

    /// Arm and height of the centroid of the masonry.
    pub(crate) fn centroid(&self, sign: f64) -> [f64; 2] {
        let mean = |of: fn(&Place) -> f64| {
            let own = &self.places[..self.masonry];
            own.iter().map(|p| p.mass * of(p)).sum::<f64>() / own.iter().map(|p| p.mass).sum::<f64>()
        };
        let centroid = Place { x: mean(|p| p.x), ..self.places[0] };
        [self.arm(sign, &centroid), mean(|p| p.z)]
    }

    /// θ̈ by the moments about the toe, of the inertia of the moving base among them.
    fn angular(&self, sign: f64, theta: f64, ground: f64) -> f64 {
        let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
        let inertia = self.sum(|p| p.mass * (p.z * p.z + self.arm(sign, p).powi(2)));
        let moment = self.sum(|p| {
            let d = self.arm(sign, p);
            // how far the place is outwards from the toe and above it
            let (out, up) = (p.z * sine - d * cosine, p.z * cosine + d * sine);
            p.force * out + (sign * p.thrust - sign * ground * p.mass) * up
        });
        moment / inertia
    }

    /// R_b: the momentum along the ground changes by it and by the thrusts.
    fn reaction(&self, sign: f64, [theta, rate]: [f64; 2], ground: f64) -> f64 {
        let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
        let angular = self.angular(sign, theta, ground);
        self.sum(|p| {
            let d = self.arm(sign, p);
            let own = (p.z * cosine + d * sine) * angular + (d * cosine - p.z * sine) * rate * rate;
            p.mass * (ground + sign * own) - p.thrust
        })
    }

    /// u and u̇ of the centroid.
    fn displacement(&self, sign: f64, [theta, rate]: [f64; 2]) -> [f64; 2] {
        let [d, z] = self.centroid(sign);
        let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
        [sign * (z * sine + d * (1.0 - cosine)), sign * (z * cosine + d * sine) * rate]
    }

    /// The classical Runge-Kutta step.
    fn step(&self, sign: f64, [theta, rate]: [f64; 2], ground: [f64; 3], length: f64) -> [f64; 2] {
        let slope = |[theta, rate]: [f64; 2], a: f64| [rate, self.angular(sign, theta, a)];
        let ahead = |k: [f64; 2], share: f64| [theta + share * length * k[0], rate + share * length * k[1]];
        let k1 = slope([theta, rate], ground[0]);
        let k2 = slope(ahead(k1, 0.5), ground[1]);
        let k3 = slope(ahead(k2, 0.5), ground[1]);
        let k4 = slope(ahead(k3, 1.0), ground[2]);
        let mean = [0, 1].map(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        ahead(mean, 1.0)
    }
}

fn floor(force: f64, height: f64, inside: f64, thrust: f64) -> Load {
    Load { moving_mass: Some(1.0), thrust, ..Load::resting(force, height, inside) }
}

/// Bodies with their reference: gable, chimney, battered wall, and a façade whose floors move along and push.
pub(crate) fn cases() -> Vec<(&'static str, Parameters)> {
    let gable = Part { height: 2.4, width: [6.0, 0.0], ..PRISM };
    let battered = Part { height: 4.0, thickness: [0.5, 0.3], outer: [0.0, 0.2], ..PRISM };
    let facade = Part { height: 9.6, thickness: [0.6; 2], ..PRISM };
    let floors = [floor(12e3, 3.2, 0.5, 0.0), floor(12e3, 6.4, 0.5, 500.0), floor(8e3, 9.6, 0.4, 1e3)];
    let shaft = Part { height: 1.5, thickness: [0.6; 2], width: [0.6; 2], ..PRISM };
    let cap = Part { base: 1.5, height: 0.1, density: 2400.0, ..square(0.8, -0.1) };
    let hollow = Some(Hollow { thickness: 0.3, outer: 0.15 });
    let flue = Opening { base: 0.0, height: 1.5, width: 0.3, hollow };
    [
        ("gable", of_parts(&[gable], &[], &[])),
        ("chimney", of_parts(&[shaft, cap], &[flue], &[])),
        ("battered", of_parts(&[battered], &[], &[])),
        ("facade", of_parts(&[facade], &[], &floors)),
    ]
    .map(|(name, body)| {
        (name, Parameters { kinematics: Kinematics::Trigonometric, tolerance: 1e-12, ..body })
    })
    .into()
}

fn square(size: f64, outer: f64) -> Part {
    Part { thickness: [size; 2], width: [size; 2], outer: [outer; 2], ..PRISM }
}

pub(crate) fn reference_of(parameters: &Parameters) -> Reference {
    let profile = parameters.profile.as_deref().unwrap();
    let hollows: Vec<_> = profile
        .openings()
        .iter()
        .map(|opening| {
            let Hollow { thickness, outer } = opening.hollow.unwrap();
            let (base, height, width) = (opening.base, opening.height, opening.width);
            let faces = Part { thickness: [thickness; 2], outer: [outer; 2], ..PRISM };
            Part { base, height, width: [width; 2], ..faces }
        })
        .collect();
    Reference::new(profile.parts(), &hollows, profile.loads(), profile.base_thickness())
}

/// Time between samples of the ground, and steps of Runge and Kutta in it.
const SAMPLE: f64 = 0.02;
const STEPS: u32 = 40;

/// A ground that makes a body rock: it grows to a part of what lifts the body.
fn ground(wall: &Wall) -> impl Fn(u32) -> f64 + use<> {
    let body = wall.body();
    let onset = body.strength.least() / (body.participation * body.effective_mass);
    let omega = 1.4 * wall.rocking_rate();
    move |index| {
        let time = SAMPLE * f64::from(index);
        0.2 * onset * time.min(1.0) * libm::sin(omega * time + 0.3)
    }
}

/// A body that rocks by its reference, on the side of `sign`.
struct Rocking<'a> {
    reference: &'a Reference,
    e: Sides,
    sign: f64,
    /// θ and its rate.
    state: [f64; 2],
    /// ∫R_b dt, with impacts.
    impulse: f64,
    impacts: u32,
}

impl Rocking<'_> {
    /// Moves through one sample, over which the ground's acceleration is linear.
    fn advance(&mut self, [from, to]: [f64; 2]) {
        let mut time = 0.0;
        while time < SAMPLE - 1e-12 {
            let length = (SAMPLE / f64::from(STEPS)).min(SAMPLE - time);
            let at = |share: f64| from + (to - from) * (time + share * length) / SAMPLE;
            let ahead = |share: f64| {
                let ground = [0.0, 0.5 * share, share].map(at);
                self.reference.step(self.sign, self.state, ground, share * length)
            };
            let mut share = 1.0;
            if ahead(share)[0] < 0.0 {
                let mut low = 0.0;
                for _ in 0..60 {
                    let middle = f64::midpoint(low, share);
                    (low, share) = if ahead(middle)[0] < 0.0 { (low, middle) } else { (middle, share) };
                }
            }
            let force = |part: f64| self.reference.reaction(self.sign, ahead(part), at(part));
            // Simpson's rule
            self.impulse += share * length * (force(0.0) + 4.0 * force(0.5 * share) + force(share)) / 6.0;
            self.state = ahead(share);
            time += share * length;
            if share < 1.0 {
                self.strike();
            }
        }
    }

    /// e acts on the rate of rotation; at θ = 0 the momentum along the ground is ∫z dm times it.
    fn strike(&mut self) {
        let (before, after) = (self.state[1], self.e.of(self.sign) * self.state[1]);
        self.impulse += self.sign * (after - before) * self.reference.sum(|place| place.mass * place.z);
        (self.state, self.sign, self.impacts) = ([0.0, -after], -self.sign, self.impacts + 1);
    }
}

/// u, u̇ and the reaction follow the equation in θ through impacts, with e of each direction on the rate of
/// rotation; impulses are the integrals of reactions.
#[test]
fn bodies_follow_the_equation_of_their_rotation() {
    for (name, parameters) in cases() {
        let reference = &reference_of(&parameters);
        let wall = Wall::new(&parameters).unwrap();
        let (u_ins, weight, e) = (wall.body().instability, wall.body().weight, wall.restitution());
        let ground = ground(&wall);
        for sign in [1.0, -1.0] {
            let u_start = sign * 0.3 * u_ins.least();
            let parameters = Parameters { u_start, ..parameters.clone() };
            let mut simulation = Simulation::new(&parameters, None, 0.0, Support::rigid(ground(0))).unwrap();
            let state = [wall.rotations().unwrap().rotation(u_start).abs(), 0.0];
            let mut rocking = Rocking { reference, e, sign, state, impulse: 0.0, impacts: 0 };
            let mut impulse = 0.0;
            for index in 0..150 {
                let samples = [index, index + 1].map(&ground);
                let [from, to] = samples.map(Support::rigid);
                let step = simulation.advance(&Segment { duration: SAMPLE, from, to }).unwrap();
                if step.departed {
                    break;
                }
                impulse += step.impulses.bottom;
                rocking.advance(samples);
                let (sign, state) = (rocking.sign, rocking.state);
                let (found, [u, v]) = (simulation.outputs(to), reference.displacement(sign, state));
                let (scale, rate) = (u_ins.of(sign), wall.rocking_rate());
                let force = reference.reaction(sign, state, samples[1]);
                let errors = [
                    (found.displacement - u) / scale,
                    (found.velocity - v) / (scale * rate),
                    if u.abs() > 1e-6 * scale { (found.reactions.bottom - force) / weight } else { 0.0 },
                    (impulse - rocking.impulse) * rate / weight,
                ];
                // steps of half the length are off by a sixteenth of what these are
                let most = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
                assert!(most <= 1e-9, "{name}, sample {index}: {errors:?}, {found:?}");
            }
            assert!(rocking.impacts >= 2, "{name}: {} impacts", rocking.impacts);
        }
    }
}
