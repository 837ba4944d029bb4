//! How long does a program that has just started wait for its first triangle?
//!
//! Only a process of its own can tell: a driver keeps what it compiled as long as its process lives, and on disk
//! beyond that.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::math::statistics::median;
use crate::render::effects::Build;

/// Processes of each kind; the median of their times counts.
const RUNS: usize = 3;

/// A program, a scene, and the rest of the command line.
#[derive(Clone, Debug)]
pub struct FirstDraw {
    /// `umber` itself.
    pub program: PathBuf,
    /// The scene's file.
    pub scene: PathBuf,
    /// What else `umber render` is told: device, lighting, `--set`.
    pub arguments: Vec<String>,
}

/// Why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum FirstDrawError {
    /// No process, or no folder for its caches.
    #[error("a process of its own for the first draw: {0}")]
    Io(#[from] std::io::Error),
    /// The process failed, or said something else than expected.
    #[error("a process of its own for the first draw failed: {0}")]
    Failed(String),
}

impl FirstDraw {
    /// Milliseconds without any cache, and with the caches that an earlier process filled.
    ///
    /// # Errors
    /// A process does not start, or fails.
    pub fn measure(&self, build: Build) -> Result<(f64, f64), FirstDrawError> {
        let folder = tempfile::tempdir()?;
        let run = |cold: bool, number: usize| {
            let name = if cold {
                format!("cold {number}")
            } else {
                "warm".to_owned()
            };
            self.run(build, &folder.path().join(name), cold)
        };
        let cold = (0..RUNS)
            .map(|i| run(true, i))
            .collect::<Result<Vec<_>, _>>()?;
        // The first one fills the caches.
        let warm = (0..=RUNS)
            .map(|i| run(false, i))
            .collect::<Result<Vec<_>, _>>()?;
        let middle = |times: &[f64]| median(times).unwrap_or(f64::NAN);
        Ok((middle(&cold), middle(&warm[1..])))
    }

    fn run(&self, build: Build, caches: &Path, cold: bool) -> Result<f64, FirstDrawError> {
        std::fs::create_dir_all(caches)?;
        let mut command = Command::new(&self.program);
        command
            .arg("render")
            .arg(&self.scene)
            .args(["--build", build.name(), "--size", "64x36", "--samples", "1"])
            .args(["--json", "--quiet", "--output"])
            .arg(caches.join("picture.exr"))
            .args(&self.arguments)
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
        let failed = |why: &str| FirstDrawError::Failed(why.to_owned());
        // A picture with a NaN, as the slides' listings make them, is drawn and reported all the same.
        const NOT_FINITE: i32 = 5;
        if !output.status.success() && output.status.code() != Some(NOT_FINITE) {
            return Err(failed(String::from_utf8_lossy(&output.stderr).trim()));
        }
        let report: serde_json::Value =
            serde_json::from_slice(&output.stdout).map_err(|error| failed(&error.to_string()))?;
        report["frame"]["first_draw_ms"]
            .as_f64()
            .ok_or_else(|| failed("its report has no first_draw_ms"))
    }
}
