//! `wall`: the command line of rocking-wall.

mod args;
mod commands;
mod output;
mod pages;

use std::process::ExitCode;

use clap::Parser;

use commands::Arguments;

/// Exit code for input that cannot be used; clap uses the same.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    match Arguments::parse().run() {
        Ok(code) => code,
        Err(error) => {
            output::report(&output::message(&error));
            ExitCode::from(BAD_INPUT)
        }
    }
}
