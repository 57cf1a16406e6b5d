//! The program `wall`, as a function: [`run()`] reads arguments, runs a command and prints.

mod args;
mod commands;
mod output;

use std::ffi::OsString;
use std::io::Write;

use clap::FromArgMatches;

use commands::Arguments;
use output::Console;

/// Exit code for input that cannot be used; clap uses the same.
const BAD_INPUT: u8 = 2;

/// Returns the commands of the program, with their help.
pub fn command() -> clap::Command {
    Arguments::described()
}

/// Runs the program with its arguments, the first of which is its name. Results go to `out`, messages to
/// `err`. Returns the exit code: 0, 1 where a verification fails, 2 for input that cannot be used.
///
/// ```
/// let (mut out, mut err) = (Vec::new(), Vec::new());
/// let code = wall::run(["wall", "describe"], &mut out, &mut err);
/// assert!(code == 0 && String::from_utf8_lossy(&out).contains("u_ins") && err.is_empty());
/// ```
pub fn run<T: Into<OsString> + Clone>(
    arguments: impl IntoIterator<Item = T>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    let console = Console::new(out, err);
    let parsed = command().try_get_matches_from(arguments);
    let told = match parsed.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments.run(&console),
        Err(refused) if refused.use_stderr() => {
            console.to_stderr(&args::in_plain_words(&refused));
            return BAD_INPUT;
        }
        Err(help) => console.print(&help.to_string()).map(|()| 0),
    };
    told.unwrap_or_else(|error| {
        console.report(&output::message(&error));
        BAD_INPUT
    })
}
