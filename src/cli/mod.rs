//! What can a user ask for on the command line?

mod devices;
mod doctor;
mod exit;
mod render;

use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;

use clap::{CommandFactory, Parser, Subcommand};

use crate::gpu::DeviceSelector;
use exit::Failure;

/// Physically-based lighting with one Vulkan pipeline and one descriptor set for every material.
#[derive(Parser)]
#[command(name = "umber", version, after_help = EXIT_CODES, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

const EXIT_CODES: &str = "Exit codes: 0 ok; 2 usage; 3 no suitable device or driver; \
    4 a validation message; 5 the picture holds a NaN or an infinity; \
    6 a file could not be read or written.\n\
    Data goes to stdout, everything else to stderr.";

#[derive(Subcommand)]
enum Verb {
    /// Render a scene to a picture
    Render(render::Arguments),
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
            eprintln!("umber: {}", failure.message);
            failure.into()
        }
    }
}

use exit::Exit;

/// Writes data to stdout. A reader that has gone away (`| head`) is no failure.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::new(Exit::File, format_args!("stdout: {error}")))
        }
        _ => Ok(()),
    }
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print_bytes(&json(value)?)
}

fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, Failure> {
    let mut bytes = serde_json::to_vec_pretty(value).map_err(|e| Failure::new(Exit::File, e))?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn device_selector(text: &str) -> Result<DeviceSelector, std::convert::Infallible> {
    Ok(DeviceSelector::parse(text))
}
