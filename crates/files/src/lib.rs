#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Each module uses only modules above it in this table; a test checks that.
//!
//! | module | contents |
//! |---|---|
//! | `error` | what can be wrong with a file |
//! | `place` | byte ranges as lines |
//! | `text` | text files |
//! | `names` | the name that a mistyped one stands for |
//! | `syntax` | a text as TOML, or why it is none |
//! | `overlay` | tables laid over others |
//! | `schema` | JSON schemas of the structs that read |
//! | `limits` | values within the limits of their schema |
//! | `reader` | TOML as such a struct, or what is wrong with it |

mod error;
mod limits;
mod names;
mod overlay;
mod place;
mod reader;
mod schema;
mod syntax;
mod text;

pub use error::FileError;
pub use limits::{Fault, check_value};
pub use names::{Groups, suggestion, unknown_key};
pub use overlay::overlay;
pub use place::Place;
pub use reader::TomlFile;
pub use schema::{
    Described, Schema, Tables, file_schema, fraction, list, names, object, one_of, positive, several, text,
    with,
};
#[doc(hidden)]
pub use schema::{Field, describe_table};
pub use syntax::{NUMBER, number};
pub use text::read_text;
