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
        let Body { overburden: o, height: h, hinge_height: h1, .. } = *body;
        let [whole, above] = standing(body, parameters);
        let at_base = Contact::new(parameters, 0.0)?;
        let refused = |message: String| Err(CheckError::wall(message));
        let edge = body.strength.of(sign);
        let base = at_base.depth(whole, strength);
        let (set_back, force, places) = match body.mechanism {
            Mechanism::Parapet | Mechanism::RigidBody => {
                let set_back = Self { base, ..Self::default() };
                let force = edge - whole * base / body.centroid_height;
                (set_back, force, vec![("base", whole, at_base)])
            }
            Mechanism::VerticalSpanning => {
                let h2 = h - h1;
                let [at_hinge, at_top] = [Contact::new(parameters, h1)?, Contact::new(parameters, h)?];
                let (middle, top) = (at_hinge.depth(above, strength), at_top.depth(o, strength));
                let set_back = Self { base, middle, top };
                let follows = parameters.eccentricity_mode == EccentricityMode::FollowsPivot;
                let c = if follows { 1.0 } else { sign } * parameters.overburden_eccentricity;
                // the overburden passes no nearer to the edge than t of the top
                let cut = (c - (at_top.thickness / 2.0 - set_back.top)).max(0.0);
                let force = edge
                    - 2.0 / h1 * whole * base
                    - 2.0 * above * set_back.middle * h / (h1 * h2)
                    - 2.0 / h2 * o * cut;
                let places = vec![("base", whole, at_base), ("middle", above, at_hinge), ("top", o, at_top)];
                (set_back, force, places)
            }
        };
        // each below b/2, the set-backs of base and middle together are below b
        for (place, force, contact) in places {
            let (depth, b) = (contact.depth(force, strength), contact.thickness);
            if 2.0 * depth >= b {
                let [deep, thick] = apart([2e3 * depth, 1e3 * b], 4);
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

/// The masonry in contact at a hinge.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    /// Distance of its edges \[m\].
    pub(super) thickness: f64,
    /// Its width, the least of the parts \[m\].
    pub(super) width: f64,
}

impl Contact {
    /// The contact at a height; at the top that of the section there.
    pub(super) fn new(parameters: &Parameters, z: f64) -> Result<Self, CheckError> {
        let Parameters { thickness, width, .. } = *parameters;
        let Some(profile) = &parameters.profile else {
            if parameters.mechanism == Mechanism::RigidBody {
                let message = "masonry_strength needs the width of the contact, which [geometry.body] does \
                               not state: give the wall as [[geometry.part]], or reduce arm and arm_inner \
                               and state compression_considered = true";
                return Err(CheckError::value(&["masonry_strength"], message));
            }
            return Ok(Self { thickness, width });
        };
        let [outer, inner] = if z == 0.0 {
            profile.toes()
        } else if z < profile.height() {
            profile.hinge_edges(z)?
        } else {
            profile.top_faces()
        };
        Ok(Self { thickness: inner - outer, width: profile.contact_width(z) })
    }

    /// Half the depth of the stress block that carries a force \[m\].
    fn depth(&self, force: f64, strength: f64) -> f64 {
        force / (2.0 * strength * self.width)
    }
}

/// All that stands on the base, and on the hinge of a strip \[N\].
pub(super) fn standing(body: &Body, parameters: &Parameters) -> [f64; 2] {
    let (h, h1, o) = (body.height, body.hinge_height, body.overburden);
    let Some(profile) = &parameters.profile else {
        // a body that is given by its integrals has its loads as a sum
        let whole = body.weight + parameters.load_force + o;
        return [whole, body.weight * (h - h1) / h + o];
    };
    let gravity = body.weight / body.mass;
    let loads = |from: f64| -> f64 {
        profile.loads().iter().filter(|load| load.height > from).map(|load| load.force).sum()
    };
    let above = if body.is_strip() {
        gravity * profile.centroid([h1, h]).mass + loads(h1 * (1.0 + 1e-9))
    } else {
        0.0
    };
    [body.weight + loads(0.0) + o, above + o]
}
