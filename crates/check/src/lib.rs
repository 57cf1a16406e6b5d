#![doc = include_str!("../README.md")]

pub mod circolare;
pub mod points;
mod site;
