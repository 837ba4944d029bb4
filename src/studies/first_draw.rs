//! How long does a program that has just started wait for its first triangle?

use std::path::PathBuf;

use super::own_process::{ColdAndWarm, OwnProcess, OwnProcessError};
use crate::render::effects::Build;

/// Processes of a kind whose median counts.
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

impl FirstDraw {
    /// Milliseconds without any cache, and with the caches that an earlier process filled.
    ///
    /// # Errors
    /// A process does not start, or fails.
    pub fn measure(&self, build: Build) -> Result<ColdAndWarm, OwnProcessError> {
        let scene = self.scene.display().to_string();
        let mut arguments = vec!["render".to_owned(), scene];
        arguments.extend(
            ["--build", build.name(), "--size", "64x36", "--samples", "1"].map(str::to_owned),
        );
        arguments.extend(["--json", "--quiet"].map(str::to_owned));
        arguments.extend(self.arguments.iter().cloned());
        let process = OwnProcess {
            program: self.program.clone(),
            arguments,
        };
        process.cold_and_warm("/frame/first_draw_ms", RUNS, &|folder| {
            let picture = folder.join("picture.exr");
            vec!["--output".to_owned(), picture.display().to_string()]
        })
    }
}
