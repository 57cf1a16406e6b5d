//! `wall`: the command line of rocking-wall.

mod accuracy;
mod args;
mod building;
mod calibrate;
mod capacity;
mod demands;
mod describe;
mod ida;
mod linearisation;
mod motion;
mod output;
mod package;
mod page;
mod record;
mod reproduce;
mod schema;
mod simulate;
mod spectrum;
mod stability;
mod stability_page;
mod template;
mod work_precision;

use std::process::ExitCode;

use args::{Arguments, Command};
use clap::{CommandFactory, Parser};

/// Exit code for input that cannot be used; clap uses the same.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Package(arguments) => package::run(&arguments),
        Command::Building(arguments) => building::run(&arguments),
        Command::Describe(arguments) => describe::run(&arguments),
        Command::Motion(arguments) => motion::run(&arguments),
        Command::Accuracy(arguments) => accuracy::run(&arguments),
        Command::Stability(arguments) => stability::run(&arguments),
        Command::Record(arguments) => record::run(&arguments),
        Command::Ida(arguments) => ida::run(&arguments),
        Command::Merge(arguments) => ida::merge(&arguments),
        Command::Spectrum(arguments) => spectrum::run(&arguments),
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::Schema => schema::run(),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "wall", &mut script);
            output::to_stdout(&String::from_utf8_lossy(&script))
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            output::report(&output::message(&error));
            ExitCode::from(BAD_INPUT)
        }
    }
}
