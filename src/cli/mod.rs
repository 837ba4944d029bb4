//! What can a user ask for on the command line?

mod bench;
mod cost;
mod devices;
mod diff;
mod doctor;
mod effects;
mod eval;
mod exit;
mod export;
mod lighting;
mod models;
mod options;
mod output;
mod render;
mod reports;
mod stability;

use std::process::ExitCode;
use std::time::Instant;

use clap::{CommandFactory, Parser, Subcommand};

use exit::Exit;
use output::{print_bytes, talk};

/// Physically-based lighting with one Vulkan pipeline and one descriptor set for every material.
#[derive(Parser)]
#[command(name = "umber", version, after_help = EXIT_CODES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

const EXIT_CODES: &str = "Exit codes: 0 ok; 1 a comparison failed or a threshold was passed; 2 usage; 3 no suitable device or driver; \
    4 a validation message; 5 a picture holds a NaN or an infinity; \
    6 a file could not be read or written.\n\
    Data goes to stdout, everything else to stderr.";

#[derive(Subcommand)]
enum Verb {
    /// Render a scene to a picture
    Render(render::Arguments),
    /// Say which effects a scene calls for, and what each costs on this device
    Effects(effects::Arguments),
    /// Measure what one pipeline saves, against switching, and what the single shader costs
    Bench(bench::Arguments),
    /// Say what each step nearer to the truth costs on this device, in time, and what a person sees of it
    Cost(cost::Arguments),
    /// Hold the lighting functions against their truth, at hard cases and at millions of others
    Stability(stability::Arguments),
    /// Evaluate a lighting function as the shaders compute it, at inputs from a file
    Eval(eval::Arguments),
    /// Hold the tiers of the lighting models against the surfaces that they stand for
    Models(models::Arguments),
    /// Say how far two pictures are apart, to a person and in numbers: PNG, EXR, HDR in any pairing
    Diff(diff::Arguments),
    /// Write the lighting functions in WGSL, HLSL, MSL or GLSL, for use elsewhere
    Export(export::Arguments),
    /// List the Vulkan devices
    Devices(devices::Arguments),
    /// Say what Vulkan finds on this system, what is missing, and the line that mends it
    Doctor,
    /// Print the completions of a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// Parses the command line, does what it says, prints, and tells the exit code.
pub fn run() -> ExitCode {
    let start = Instant::now();
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help goes to stdout, errors to stderr; if neither can be written, nobody listens.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(Exit::Usage as u8));
        }
    };
    let done = match cli.verb {
        Verb::Render(arguments) => render::run(&arguments, start),
        Verb::Effects(arguments) => effects::run(&arguments),
        Verb::Bench(arguments) => bench::run(&arguments),
        Verb::Stability(arguments) => stability::run(&arguments),
        Verb::Eval(arguments) => eval::run(&arguments),
        Verb::Models(arguments) => models::run(&arguments),
        Verb::Cost(arguments) => cost::run(&arguments),
        Verb::Diff(arguments) => diff::run(&arguments),
        Verb::Export(arguments) => export::run(&arguments),
        Verb::Devices(arguments) => devices::run(&arguments),
        Verb::Doctor => doctor::run(),
        Verb::Completions { shell } => {
            let mut text = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "umber", &mut text);
            print_bytes(&text)
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            talk(format_args!("umber: {}", failure.message));
            failure.into()
        }
    }
}
