//! `wall`: the command line of rocking-wall.

mod args;
mod commands;
mod output;

use std::process::ExitCode;

use clap::Parser;

use commands::Arguments;

/// Exit code for input that cannot be used; clap uses the same.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| {
        let text = error.to_string();
        let plain = args::in_plain_words(&text);
        if plain == text {
            error.exit();
        }
        output::to_stderr(&plain);
        std::process::exit(i32::from(BAD_INPUT))
    });
    match arguments.run() {
        Ok(code) => code,
        Err(error) => {
            output::report(&output::message(&error));
            ExitCode::from(BAD_INPUT)
        }
    }
}
