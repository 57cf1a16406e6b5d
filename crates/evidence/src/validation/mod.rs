//! The model beside published tests: slow pushes and free decays. More tests are more files.
//!
//! ```
//! use evidence::validation::{Case, Test};
//!
//! let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/validation"));
//! let case = Case::read(&folder.join("brick_wall_12.toml"))?;
//! let Test::Push(push) = &case.test else { unreachable!("it was pushed") };
//! let comparison = push.compare(&case.parameters)?;
//! // P/W = 2 t/h at the hinge of a strip without overburden
//! assert!((comparison.strength - 2.0 * 0.11 / 1.5).abs() < 1e-12);
//! # Ok::<(), evidence::validation::ValidationError>(())
//! ```

mod case;
mod decay;
mod difference;
mod error;
mod push;

pub use case::{Case, Test};
pub use decay::{Decay, DecayComparison, DecayModel};
pub use difference::Difference;
pub use error::ValidationError;
pub use push::{Push, PushComparison, PushedLaw};
