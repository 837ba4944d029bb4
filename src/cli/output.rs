//! Where do data and talk go, and can they be written there?
//!
//! Data goes to stdout or a file, talk to stderr. A file's place is checked before any work is done.

use std::fmt;
use std::io::Write;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::exit::{Exit, Failure};
use crate::render::OutputFile;

/// Writes data to stdout. A reader that has gone away (`| head`) is no failure.
pub fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::new(Exit::File, format_args!("stdout: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a line to stderr, if anybody can hear it: what is said there is never worth a failure.
pub fn talk(line: impl fmt::Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// A bar on a terminal for work of so many steps, unless the user wants quiet.
pub fn progress_bar(quiet: bool, steps: u64, template: &str) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(steps);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        // The default style serves as well.
        Err(_) => bar,
    }
}

/// A place for data.
pub enum Output {
    /// `-`
    Stdout,
    /// Anything else, with the name that the user gave it.
    File(OutputFile, PathBuf),
}

impl Output {
    /// Checks that the place can be written.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return Ok(Self::Stdout);
        }
        let file = OutputFile::create(path).map_err(|error| cannot_write(path, &error))?;
        Ok(Self::File(file, path.to_owned()))
    }

    /// A place, if one is wanted, that is none of those `taken`; it is one of them then.
    pub fn open_apart<'a>(
        path: Option<&'a PathBuf>,
        taken: &mut Vec<&'a PathBuf>,
    ) -> Result<Option<Self>, Failure> {
        let Some(path) = path else {
            return Ok(None);
        };
        let output = Self::open(path)?;
        if taken.iter().any(|other| output.is(other)) {
            let message = format!(
                "{}: it is given twice, and would be overwritten",
                path.display()
            );
            return Err(Failure::new(Exit::Usage, message));
        }
        taken.push(path);
        Ok(Some(output))
    }

    /// Whether it is the same place as `other`, which a second output or an input would overwrite.
    pub fn is(&self, other: &Path) -> bool {
        match self {
            Self::Stdout => other == Path::new("-"),
            Self::File(file, _) => file.is(other),
        }
    }

    /// Writes the data.
    pub fn write(self, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Self::Stdout => print_bytes(bytes),
            Self::File(file, path) => file
                .commit(bytes)
                .map_err(|error| cannot_write(&path, &error)),
        }
    }
}

/// `--json[=FILE]`, the same for every verb.
#[derive(clap::Args)]
pub struct JsonArgument {
    /// Report as JSON, on stdout or to a file
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true,
          default_missing_value = "-")]
    pub json: Option<PathBuf>,
}

impl JsonArgument {
    /// Checks the place, if JSON is wanted.
    pub fn open(&self) -> Result<Option<Output>, Failure> {
        self.json.as_deref().map(Output::open).transpose()
    }
}

/// Writes a report.
pub fn write_json(output: Output, report: &impl serde::Serialize) -> Result<(), Failure> {
    let mut bytes =
        serde_json::to_vec_pretty(report).map_err(|error| Failure::new(Exit::File, error))?;
    bytes.push(b'\n');
    output.write(&bytes)
}

fn cannot_write(path: &Path, error: &std::io::Error) -> Failure {
    let message = format!("cannot write {}: {error}", path.display());
    Failure::new(Exit::File, message)
}
