//! Hinges set back from the edges for the compressive strength of the masonry, C8.7.1.2.1 d).
//!
//! A rectangular block of depth N/(κ `f_d` `b_w`) carries the force N of a hinge, which is in its middle: t =
//! N/(2 κ `f_d` `b_w`). k₀ does not change, so that F falls parallel to itself.

use report::{apart, number};
use rocking_wall::variables::{EccentricityMode, Mechanism};
use rocking_wall::wall::{Body, Parameters};

use crate::error::CheckError;

/// What a strip or a parapet loses of its thickness at its hinges \[m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SetBack {
    /// At the base.
    pub base: f64,
    /// At the hinge of a strip.
    pub middle: f64,
    /// At the top of a strip.
    pub top: f64,
}

impl SetBack {
    /// Returns the set-backs of a body whose masonry bears `strength` = κ `f_d` \[Pa\], and F₀ of the side of
    /// `sign` with them \[N\].
    ///
    /// # Errors
    /// [`CheckError::Wall`] of masonry that is crushed, or of a wall without strength.
    pub(crate) fn new(
        body: &Body,
        parameters: &Parameters,
        strength: f64,
        sign: f64,
    ) -> Result<(Self, f64), CheckError> {
        let Body { weight: w, overburden: o, height: h, hinge_height: h1, .. } = *body;
        let Parameters { thickness: b, width, .. } = *parameters;
        let depth = |force: f64| force / (2.0 * strength * width);
        let base = depth(w + o);
        let refused = |message: String| Err(CheckError::wall(message));
        let edge = body.strength.of(sign);
        let (set_back, force, forces) = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody => {
                let set_back = Self { base, ..Self::default() };
                (set_back, edge - 2.0 / h * (w + o) * base, vec![("base", w + o)])
            }
            Mechanism::VerticalSpanning => {
                let h2 = h - h1;
                let above = w * h2 / h + o;
                let set_back = Self { base, middle: depth(above), top: depth(o) };
                let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot;
                let c = if follows { 1.0 } else { sign } * parameters.overburden_eccentricity;
                // the overburden passes no nearer to the edge than t of the top
                let cut = (c - (b / 2.0 - set_back.top)).max(0.0);
                let force = edge
                    - 2.0 / h1 * (w + o) * base
                    - 2.0 * above * set_back.middle * h / (h1 * h2)
                    - 2.0 / h2 * o * cut;
                (set_back, force, vec![("base", w + o), ("middle", above), ("top", o)])
            }
        };
        // the base carries most: where it is not crushed, the set-backs of base and middle together are
        // below b
        for (place, force) in forces {
            if 2.0 * depth(force) >= b {
                let [deep, thick] = apart([2e3 * depth(force), 1e3 * b], 4);
                return refused(format!(
                    "the masonry at the {place} is crushed by N = {} kN alone: its stress block would be \
                     {deep} mm deep, the wall is b = {thick} mm thick; check masonry_strength (Pa)",
                    number(1e-3 * force, 4)
                ));
            }
        }
        if force <= 0.0 {
            let force = number(1e-3 * force, 4);
            return refused(format!("with hinges set back the wall has no strength: F0 = {force} kN"));
        }
        Ok((set_back, force))
    }
}
