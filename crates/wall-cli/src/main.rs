//! `wall`: the command line of rocking-wall.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(wall::run(std::env::args_os(), &mut std::io::stdout(), &mut std::io::stderr()))
}
