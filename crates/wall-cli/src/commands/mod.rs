//! The commands of `wall`: each reads its arguments, calls the library and reports.

mod building;
mod check;
mod describe;
mod package;
mod record;
mod schema;
mod simulate;
mod study;
mod verify;

use anyhow::Result;
use clap::{CommandFactory, Parser, Subcommand};

use crate::output::Console;

/// The version with commit and profile, which `build.rs` states.
const VERSION: &str = env!("PROGRAM_VERSION");

/// Out-of-plane rocking of masonry walls under earthquakes.
#[derive(Debug, Parser)]
#[command(name = "wall", version = VERSION, arg_required_else_help = true, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene, or the default wall, under a motion
    #[command(allow_negative_numbers = true)]
    Simulate(simulate::Arguments),
    /// Make an FMU of a scene
    Package(package::Arguments),
    /// Run a building of storeys and walls, or make it an SSP
    Building(building::Arguments),
    /// Print what follows from a wall's parameters
    Describe(describe::Arguments),
    /// Check walls by a building code, or over a spectrum
    Check(check::Arguments),
    /// Print what record files hold, or write a motion as CSV
    #[command(allow_negative_numbers = true)]
    Record(record::Arguments),
    /// Run a study
    #[command(subcommand)]
    Study(study::Command),
    /// Is the program right?
    #[command(subcommand)]
    Verify(verify::Subject),
    /// Print the JSON schema of scenes, studies or buildings
    Schema(schema::Arguments),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

impl Arguments {
    /// Returns the commands. What one with parts is for ends with their names.
    pub(crate) fn described() -> clap::Command {
        Self::command().mut_subcommands(|command| {
            let parts: Vec<_> = command.get_subcommands().map(clap::Command::get_name).collect();
            let (Some(about), false) = (command.get_about(), parts.is_empty()) else { return command };
            let about = about.to_string();
            let colon = if about.ends_with('?') { "" } else { ":" };
            let about = format!("{about}{colon} {}", parts.join(", "));
            command.about(about)
        })
    }

    /// Runs the command with its arguments.
    pub(crate) fn run(&self, console: &Console<'_>) -> Result<u8> {
        match &self.command {
            Command::Simulate(arguments) => simulate::run(console, arguments),
            Command::Package(arguments) => package::run(console, arguments),
            Command::Building(arguments) => building::run(console, arguments),
            Command::Describe(arguments) => describe::run(console, arguments),
            Command::Check(arguments) => check::run(console, arguments),
            Command::Record(arguments) => record::run(console, arguments),
            Command::Study(command) => study::run(console, command),
            Command::Verify(subject) => return verify::run(console, subject),
            Command::Schema(arguments) => schema::run(console, arguments),
            Command::Completions { shell } => {
                let mut script = Vec::new();
                clap_complete::generate(*shell, &mut Self::described(), "wall", &mut script);
                console.print(&String::from_utf8_lossy(&script))
            }
        }
        .map(|()| 0)
    }
}
