//! What every building code has: it is read from the table `[check]`, and gives a verdict on a wall.
//!
//! ```
//! use check::{CheckFile, Subject, read};
//! use rocking_wall::wall::Parameters;
//!
//! let text = r#"
//! [check]
//! code = "circolare-2019"
//! before_activation = "rigid"
//! soil = "B"
//! SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
//! "#;
//! let code = read(&CheckFile::parse("scene.toml", text)?)?;
//! let parameters = Parameters::default();
//! let verdict = code.check(Subject::new(&parameters))?;
//! assert!(!verdict.passed && (verdict.zeta - 0.855812).abs() < 5e-7);
//! assert_eq!(&*verdict.headline(), "NOT PASSED: SLV governs with zeta_E = 0.856 (both sides alike)");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod at_level;
pub(crate) mod before;
pub(crate) mod row;
pub(crate) mod sought;
mod table;
pub(crate) mod verdict;

use std::fmt;

use rocking_wall::wall::Parameters;
use scene::{Floors, Scene};

use crate::code::sought::Sought;
use crate::error::CheckError;
use crate::file::site::{Level, Records};
use crate::words::Sentence;
use crate::words::entry::Entry;
use verdict::Verdict;

/// What an engineer states by a code: the table `[check]`, validated, ready to check walls.
pub trait Code: InStudies + fmt::Debug + Send + Sync {
    /// Which code.
    fn entry(&self) -> Entry;

    /// Checks a wall.
    ///
    /// # Errors
    /// [`CheckError`] of a statement that is missing or does not fit the wall, of a wall that the code does
    /// not cover, of a spectrum that ends too early, or of a run.
    fn check<'a>(&'a self, subject: Subject<'a>) -> Result<Verdict<'a>, CheckError>;

    /// The records that the table names.
    fn records(&self) -> &Records;
}

/// What searches and studies ask of a code beyond its verdict. Each default is that of a code without it.
pub trait InStudies {
    /// The parameters of a wall with the tie that the table states.
    ///
    /// # Errors
    /// [`CheckError`] of a bar that cannot be.
    fn prepared(&self, parameters: &Parameters) -> Result<Parameters, CheckError> {
        Ok(parameters.clone())
    }

    /// Says why a check does not pass a wall, whose value of what is sought is the last of its range; `None`
    /// where there is nothing to say.
    fn blocks(&self, _subject: Subject<'_>, _check: &str, _sought: Sought) -> Option<Sentence> {
        None
    }

    /// The ratio from which on a check passes \[-\].
    fn target(&self) -> f64 {
        1.0
    }

    /// Whether a verdict takes runs under records: a search then tries fewer values.
    fn takes_runs(&self) -> bool {
        false
    }

    /// The spectrum of the ground over its acceleration, `S_e`(T)/`a_g` at 5 % damping, at some periods
    /// \[s\]: that of the limit state by which the wall must not fall. `None` where the table states no site.
    fn spectral_shape(&self, _periods: &[f64]) -> Option<Vec<f64>> {
        None
    }

    /// What its records become at a limit state, as its runs take them; `None` where the code has no runs.
    ///
    /// # Errors
    /// [`CheckError`] of a limit state without a site, without records, or of a wall that cannot be checked.
    fn level(&self, _subject: Subject<'_>, _state: &str) -> Result<Option<Level>, CheckError> {
        Ok(None)
    }

    /// Whether the demand is that of a building which only the table `[check]` states.
    fn states_building(&self) -> bool {
        false
    }

    /// A number of the rule of a check; `None` where it has no part.
    fn rule(&self, _check: &str, _rule: Rule) -> Option<f64> {
        None
    }

    /// The same statements with another number in the rule of a check; `None` where it has no part.
    fn with_rule(&self, _check: &str, _rule: Rule, _value: f64) -> Option<Box<dyn Code>> {
        None
    }

    /// The same statements without what only informs; `None` where nothing does.
    fn deciding(&self) -> Option<Box<dyn Code>> {
        None
    }
}

/// A wall that is checked.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Its parameters.
    pub parameters: &'a Parameters,
    /// Storeys between ground and wall; a code that does not apply them warns of that.
    pub floors: Option<&'a Floors>,
    /// Parameters that decide, and that nobody stated: see [`assumed`](crate::CheckFile::assumed).
    pub assumed: &'a [&'static str],
}

impl<'a> Subject<'a> {
    /// Makes a wall on the ground, all of whose parameters are stated.
    pub fn new(parameters: &'a Parameters) -> Self {
        Self { parameters, floors: None, assumed: &[] }
    }

    /// # Errors
    /// [`CheckError::Wall`] of a wall that is no rectangle, which the codes here do not check.
    pub(crate) fn check_shape(&self) -> Result<(), CheckError> {
        if !self.parameters.further_ties.is_empty() {
            return Err(CheckError::wall("this check counts one tie: leave the others out"));
        }
        if self.parameters.is_rectangle() {
            return Ok(());
        }
        Err(CheckError::wall(
            "this check takes rectangles: state the wall by height, thickness, width and density, without \
             [[geometry.part]] and [geometry.body]",
        ))
    }
}

impl<'a> From<&'a Scene> for Subject<'a> {
    fn from(scene: &'a Scene) -> Self {
        Self { floors: scene.floors.as_ref(), ..Self::new(&scene.parameters) }
    }
}

/// A number in the rule of a check, which a study of reliability varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Displacement capacity over the displacement at which the force vanishes \[-\].
    Fraction,
    /// Factor of π √(d/a) in the period of the demand \[-\].
    PeriodFactor,
    /// Behaviour factor q \[-\].
    BehaviourFactor,
}

impl Rule {
    /// Every variant.
    pub const ALL: [Self; 3] = [Self::Fraction, Self::PeriodFactor, Self::BehaviourFactor];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fraction => "fraction of d_0",
            Self::PeriodFactor => "factor of the period",
            Self::BehaviourFactor => "q",
        }
    }
}
