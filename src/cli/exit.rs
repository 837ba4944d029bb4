//! With which code does the program end, and what does it say?

use std::fmt;
use std::process::ExitCode;

use crate::cli::options::count;
use crate::gpu;
use crate::render::RenderError;
use crate::scene;
use crate::studies::OwnProcessError;
use crate::studies::state_changes::BenchError;

/// The exit codes. 0 is success.
#[derive(Clone, Copy, PartialEq, Eq, Debug, serde::Serialize, serde::Deserialize)]
pub enum Exit {
    /// A comparison failed, or a threshold was passed.
    Compared = 1,
    /// The command line makes no sense, or asks for what the device does not have.
    Usage = 2,
    /// No suitable device or driver.
    Device = 3,
    /// The validation layers had something to say.
    Validation = 4,
    /// The picture holds a NaN or an infinity.
    NotFinite = 5,
    /// A file could not be read or written.
    File = 6,
}

/// Why the program ends without success.
#[derive(Debug, serde::Serialize, serde::Deserialize)]
pub struct Failure {
    /// The exit code.
    pub exit: Exit,
    /// What, where, and what to do.
    pub message: String,
}

impl Failure {
    /// A failure with this code.
    pub fn new(exit: Exit, message: impl fmt::Display) -> Self {
        Self {
            exit,
            message: message.to_string(),
        }
    }
}

/// The failure that so many messages of the validation layers are; none is none.
pub fn judge_messages(number: usize) -> Result<(), Failure> {
    if number == 0 {
        return Ok(());
    }
    let number = count(number as u64, "message");
    let message = format!("the validation layers had {number}");
    Err(Failure::new(Exit::Validation, message))
}

impl From<Failure> for ExitCode {
    fn from(failure: Failure) -> Self {
        Self::from(failure.exit as u8)
    }
}

impl From<gpu::Error> for Failure {
    fn from(error: gpu::Error) -> Self {
        let exit = match error {
            // Too large a picture, or too many samples: the command line asks for them.
            gpu::Error::BeyondLimit { .. }
            | gpu::Error::NoSuchSampleCount { .. }
            | gpu::Error::Memory { .. } => Exit::Usage,
            _ => Exit::Device,
        };
        Self::new(exit, error)
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Gpu(error) => error.into(),
            // The file holds more than can be drawn.
            RenderError::Scene(_) | RenderError::TooMany(_) => Self::new(Exit::File, error),
        }
    }
}

impl From<BenchError> for Failure {
    fn from(error: BenchError) -> Self {
        let exit = match error {
            BenchError::Render(error) => return error.into(),
            BenchError::Scene(error) => return error.into(),
            BenchError::Mode(_) | BenchError::TooManyDraws { .. } | BenchError::TooLarge { .. } => {
                Exit::Usage
            }
            BenchError::OtherPicture { .. } | BenchError::OtherCommands { .. } => Exit::Compared,
        };
        Self::new(exit, error)
    }
}

impl From<OwnProcessError> for Failure {
    fn from(error: OwnProcessError) -> Self {
        let exit = match error {
            OwnProcessError::Io(_) => Exit::File,
            OwnProcessError::Failed(_) => Exit::Device,
        };
        Self::new(exit, error)
    }
}

impl From<scene::Error> for Failure {
    fn from(error: scene::Error) -> Self {
        let exit = match error {
            scene::Error::Override { .. } => Exit::Usage,
            scene::Error::File { .. } => Exit::File,
        };
        Self::new(exit, error)
    }
}
