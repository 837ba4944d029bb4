//! What does a program that has just started say, with caches that are empty or that an earlier one filled?
//!
//! Only a process of its own can tell: a driver keeps what it compiled as long as its process lives, and on disk
//! beyond that.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs of a kind end once they took this long, s.
const SECONDS: f64 = 3.0;

/// `umber` with a command line, which reports as JSON on stdout.
#[derive(Clone, Debug)]
pub struct OwnProcess {
    /// `umber` itself.
    pub program: PathBuf,
    /// Its command line.
    pub arguments: Vec<String>,
}

/// A figure without any cache, and with the caches that an earlier process filled.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ColdAndWarm {
    /// Without.
    pub cold: f64,
    /// With.
    pub warm: f64,
}

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum OwnProcessError {
    /// No process, or no folder for its caches.
    #[error("a process of its own: {0}")]
    Io(#[from] std::io::Error),
    /// The process failed, or said something else than expected.
    #[error("a process of its own failed: {0}")]
    Failed(String),
}

impl OwnProcess {
    /// The median of the figure at `pointer` (RFC 6901) in its reports, of `runs` while they are short. `extra` adds to the command line what goes into a
    /// folder of the run's own.
    ///
    /// # Errors
    /// A process does not start, fails, or reports no such figure.
    pub fn cold_and_warm(
        &self,
        pointer: &str,
        runs: usize,
        extra: &dyn Fn(&Path) -> Vec<String>,
    ) -> Result<ColdAndWarm, OwnProcessError> {
        let folder = tempfile::tempdir()?;
        let run = |cold: bool, number: usize| {
            let name = match cold {
                true => format!("cold {number}"),
                false => "warm".to_owned(),
            };
            let caches = folder.path().join(name);
            std::fs::create_dir_all(&caches)?;
            self.run(pointer, &caches, &extra(&caches), cold)
        };
        let cold = median_of(runs, |number| run(true, number))?;
        // Fills the caches.
        run(false, 0)?;
        let warm = median_of(runs, |number| run(false, number))?;
        Ok(ColdAndWarm { cold, warm })
    }

    fn run(
        &self,
        pointer: &str,
        caches: &Path,
        extra: &[String],
        cold: bool,
    ) -> Result<f64, OwnProcessError> {
        let mut command = Command::new(&self.program);
        command
            .args(&self.arguments)
            .args(extra)
            // Umber's own cache, and those of Mesa and of NVIDIA's driver.
            .env("XDG_CACHE_HOME", caches)
            .env("MESA_SHADER_CACHE_DIR", caches)
            .env("__GL_SHADER_DISK_CACHE_PATH", caches);
        if cold {
            command
                .env("MESA_SHADER_CACHE_DISABLE", "true")
                .env("__GL_SHADER_DISK_CACHE", "0");
        }
        let output = command.output()?;
        let failed = |why: &str| OwnProcessError::Failed(why.to_owned());
        // A picture with a NaN, as the slides' listings make them, is drawn and reported all the same.
        const NOT_FINITE: i32 = 5;
        if !output.status.success() && output.status.code() != Some(NOT_FINITE) {
            return Err(failed(String::from_utf8_lossy(&output.stderr).trim()));
        }
        let report: serde_json::Value =
            serde_json::from_slice(&output.stdout).map_err(|error| failed(&error.to_string()))?;
        let figure = report.pointer(pointer).and_then(serde_json::Value::as_f64);
        figure.ok_or_else(|| failed(&format!("its report has no {pointer}")))
    }
}

/// The median of a few runs; of fewer where they are long.
fn median_of(
    runs: usize,
    run: impl Fn(usize) -> Result<f64, OwnProcessError>,
) -> Result<f64, OwnProcessError> {
    let before = std::time::Instant::now();
    let mut figures = Vec::new();
    while figures.is_empty() || figures.len() < runs && before.elapsed().as_secs_f64() < SECONDS {
        figures.push(run(figures.len())?);
    }
    Ok(crate::math::statistics::median(&figures).unwrap_or(f64::NAN))
}
