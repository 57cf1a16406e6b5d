//! The model beside published tests: slow pushes and free decays. More tests are more files.
//!
//! ```
//! use evidence::validation::{PublishedTest, Test};
//!
//! let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/validation"));
//! let case = PublishedTest::read(&folder.join("brick_wall_12.toml"))?;
//! let Test::Push(push) = &case.test else { unreachable!("it was pushed") };
//! let comparison = push.compare(&case.parameters)?;
//! // P/W = 2 t/h at the hinge of a strip without overburden
//! assert!((comparison.strength - 2.0 * 0.11 / 1.5).abs() < 1e-12);
//! # Ok::<(), evidence::EvidenceError>(())
//! ```

mod case;
mod decay;
mod page;
mod push;

pub use case::{PublishedTest, Test};
pub use decay::{Decay, DecayComparison, DecayModel};
pub use push::{Push, PushComparison, PushedLaw};

/// Size of some differences \[-\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Root of their mean square.
    pub rms: f64,
    /// The largest.
    pub largest: f64,
}

impl Difference {
    /// Measures differences.
    ///
    /// # Panics
    /// If there is none.
    fn of(differences: impl IntoIterator<Item = f64>) -> Self {
        let differences: Vec<f64> = differences.into_iter().collect();
        assert!(!differences.is_empty(), "no point is compared");
        let squares: f64 = differences.iter().map(|difference| difference * difference).sum();
        Self {
            rms: (squares / differences.len() as f64).sqrt(),
            largest: differences.iter().fold(0.0, |largest, difference| largest.max(difference.abs())),
        }
    }
}
