//! The program: what did the user ask for, and with which exit code does it end?

use std::process::ExitCode;

fn main() -> ExitCode {
    umber::cli::run()
}
