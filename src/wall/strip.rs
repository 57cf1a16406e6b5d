//! How the two bodies of a strip of parts move, per unit of u at the hinge between them.

use super::error::ParameterError;
use super::profile::{Profile, SAME};

/// A strip of parts between its supports, cut by its hinge into two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// Heights of the wall and of the hinge \[m\].
    h: f64,
    h1: f64,
    /// The outer and the inner toe \[m\].
    toes: [f64; 2],
    /// The outer and the inner edge of the sections in contact at the hinge \[m\].
    edges: [f64; 2],
}

impl Strip {
    /// Cuts a strip by a hinge at the height `h1` \[m\].
    ///
    /// # Errors
    /// [`ParameterError::NoHinge`] where the sections at the hinge do not touch.
    pub fn new(profile: &Profile, h1: f64) -> Result<Self, ParameterError> {
        Ok(Self { h: profile.height(), h1, toes: profile.toes(), edges: profile.hinge_edges(h1)? })
    }

    /// The toe on which it bears on the side of `sign` \[m\].
    pub(super) fn toe(&self, sign: f64) -> f64 {
        self.toes[usize::from(sign < 0.0)]
    }

    /// The edge about which the hinge opens on the side of `sign` \[m\].
    pub(super) fn edge(&self, sign: f64) -> f64 {
        self.edges[usize::from(sign > 0.0)]
    }

    /// Returns whether a height \[m\] belongs to the lower body; that of the hinge does.
    pub fn is_below(&self, z: f64) -> bool {
        z <= self.h1 + SAME * self.h
    }

    /// Returns φ, the displacement of a height \[m\] for u = 1.
    pub fn share(&self, z: f64) -> f64 {
        if self.is_below(z) { z / self.h1 } else { (self.h - z) / (self.h - self.h1) }
    }

    /// Returns ρ, by which a place \[m\] rises for |u| = 1 on the side of `sign`.
    pub fn rise(&self, sign: f64, x: f64, z: f64) -> f64 {
        let (toe, edge) = (self.toe(sign), self.edge(sign));
        sign * if self.is_below(z) {
            (x - toe) / self.h1
        } else {
            (edge - toe) / self.h1 + (edge - x) / (self.h - self.h1)
        }
    }
}
