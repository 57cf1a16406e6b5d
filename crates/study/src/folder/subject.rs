//! Walls and classes of walls, with their fragilities in the order of rising limit states.

use fragility::{CONFIDENCE, ClassResamples, FragilityFunction, Interval, Lognormal, Summary, covariance};

use crate::results::WallResults;

use super::contents::Manifest;

/// Most walls that the page and the summary show one by one.
pub const MOST_WALLS: usize = 40;

/// A wall, or a class of walls.
pub(crate) struct Subject<'a> {
    pub(crate) name: &'a str,
    /// Number of its walls; `None` of a wall.
    pub(crate) class: Option<usize>,
    /// Tables of the parameters of a wall.
    pub(crate) parameters: &'a str,
    /// Model by model.
    pub(crate) models: Vec<Fragilities>,
}

/// The fragilities of a subject with one model.
pub(crate) struct Fragilities {
    /// The curves, where every limit state has one.
    pub(crate) function: Option<FragilityFunction>,
    pub(crate) states: Vec<State>,
    /// Of a class with curves, its walls with their shares.
    members: Vec<(f64, FragilityFunction)>,
}

/// What is known of a limit state. Every β has all its parts.
pub(crate) struct State {
    /// |u|/`u_ins` that is exceeded \[-\].
    pub(crate) fraction: f64,
    /// θ in SI units, and β.
    pub(crate) curve: Option<[f64; 2]>,
    /// θ and β of each resample.
    pub(crate) resamples: Vec<[f64; 2]>,
    pub(crate) theta: Interval,
    pub(crate) beta: Interval,
    /// Variance of ln θ, covariance of ln θ and β, variance of β.
    pub(crate) covariance: Option<[f64; 3]>,
    pub(crate) misfit: Option<f64>,
}

impl<'a> Subject<'a> {
    /// Takes a wall of a study.
    pub(crate) fn of_wall(manifest: &'a Manifest, wall: usize, results: &WallResults) -> Self {
        let (note, report) = (&manifest.contents.walls[wall], &manifest.report);
        let places = report.rising();
        let of_model = |model: usize| {
            let curve = |&place: &usize| results.summary(place, model).fitted.ok();
            let curves: Option<Vec<Lognormal>> = places.iter().map(curve).collect();
            let state = |&place: &usize| {
                let summary = results.summary(place, model).clone().widened(report.modelling_uncertainty);
                State::of_wall(report.fractions[place], summary)
            };
            Fragilities {
                function: curves.map(|curves| FragilityFunction::new(&curves, report.modelling_uncertainty)),
                states: places.iter().map(state).collect(),
                members: Vec::new(),
            }
        };
        let models = (0..manifest.contents.models.len()).map(of_model).collect();
        Self { name: &note.name, class: None, parameters: &note.parameters, models }
    }

    /// Returns whether the page and the terminal show it: classes, and walls unless there are many.
    pub(crate) fn is_shown(&self, manifest: &Manifest) -> bool {
        self.class.is_some() || manifest.contents.walls.len() <= MOST_WALLS
    }
}

impl Fragilities {
    /// Takes a class from its walls, if they have all curves, and the resamples of each limit state.
    pub(crate) fn of_class(
        manifest: &Manifest,
        shares: Vec<f64>,
        walls: Option<Vec<FragilityFunction>>,
        resamples: &[[ClassResamples; 2]],
    ) -> Self {
        let report = &manifest.report;
        let function = walls.as_ref().map(|walls| FragilityFunction::of_class(&shares, walls));
        let state = |(k, place): (usize, usize)| {
            let resamples = resamples[k].each_ref().map(|own| own.curves(report.modelling_uncertainty));
            let curve = function.as_ref().map(|function| [function.states[k].median, function.dispersion(k)]);
            State::of_class(report.fractions[place], curve, resamples)
        };
        let states = report.rising().into_iter().enumerate().map(state).collect();
        Self { states, function, members: shares.into_iter().zip(walls.into_iter().flatten()).collect() }
    }

    /// Returns the mean over the walls of a class of what follows from θ and β of a limit state.
    pub(crate) fn mean_of_walls(&self, state: usize, of: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let of_wall = |(share, wall): &(f64, FragilityFunction)| {
            share * of(wall.states[state].median, wall.dispersion(state))
        };
        (!self.members.is_empty()).then(|| self.members.iter().map(of_wall).sum())
    }
}

impl State {
    fn of_wall(fraction: f64, summary: Summary) -> Self {
        Self {
            fraction,
            curve: summary.fitted.ok().map(|curve| [curve.median, curve.dispersion]),
            theta: summary.theta,
            beta: summary.beta,
            covariance: summary.covariance(),
            misfit: summary.misfit,
            resamples: summary.resamples,
        }
    }

    /// Takes a class from its curve and its resamples, studentised and as fitted.
    fn of_class(fraction: f64, curve: Option<[f64; 2]>, [resamples, drawn]: [Vec<[f64; 2]>; 2]) -> Self {
        let known = if curve.is_some() { &resamples[..] } else { &[] };
        let [theta, beta] = [0, 1].map(|part| {
            let estimate = curve.map_or(f64::NAN, |curve| curve[part]);
            Interval::new(estimate, known.iter().map(|pair| pair[part]), CONFIDENCE)
        });
        let covariance = curve.and_then(|_| covariance(&drawn));
        Self { fraction, curve, theta, beta, covariance, misfit: None, resamples }
    }
}
