//! Does the program end with the right code, say why, and leave no half-written file?

mod bench;
mod cost;
mod devices;
mod diff;
mod effects;
mod export;
mod hard_inputs;
mod inputs;
mod models;
mod options;
#[cfg(unix)]
mod outputs;
mod picture;
mod stability;
#[cfg(target_os = "linux")]
mod streams;

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const UMBER: &str = env!("CARGO_BIN_EXE_umber");

/// What a test of the program returns: what is wrong around it fails it too.
type Tested = Result<(), Box<dyn std::error::Error>>;

/// A square that fills the picture.
const SQUARE: &str = r#"
[camera]
position = [0, 5, 0]
target = [0, 0, 0]
up = [0, 0, -1]
projection = "orthographic"
height = 0.5
exposure_ev100 = 0

[ambient]
sky = [0.3, 0.4, 0.5]
ground = 0.1

[light.lamp]
kind = "directional"
direction = [-0.3, -1, 0.2]
illuminance = 3.0

[model.square]
shape = "plane"
material = "plaster"
"#;

/// A folder that one test works in.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    /// An empty folder.
    fn empty() -> io::Result<Self> {
        tempfile::tempdir().map(|folder| Self { folder })
    }

    /// A folder with `SQUARE` as scene.toml.
    fn new() -> io::Result<Self> {
        let place = Self::empty()?;
        place.write("scene.toml", SQUARE)?;
        Ok(place)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> io::Result<()> {
        std::fs::write(self.path(name), text)
    }

    /// What lies here, sorted.
    fn names(&self) -> io::Result<Vec<String>> {
        let mut names: Vec<_> = std::fs::read_dir(self.folder.path())?
            .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
            .collect::<Result<_, _>>()?;
        names.sort();
        Ok(names)
    }

    /// A command that runs here, with a cache that is no user's.
    fn command(&self, program: &str) -> Command {
        let cache = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache");
        let mut command = Command::new(program);
        command
            .current_dir(self.folder.path())
            .env("UMBER", UMBER)
            .env("XDG_CACHE_HOME", cache);
        command
    }

    /// `umber ARGUMENTS`.
    fn umber(&self, arguments: &[&str]) -> io::Result<Run> {
        let output = self.command(UMBER).args(arguments).output()?;
        Ok(Run::of(&format!("{arguments:?}"), &output))
    }

    /// `umber render --validation ARGUMENTS`: any message of the layers ends it with 4.
    fn render(&self, arguments: &[&str]) -> io::Result<Run> {
        self.umber(&[&["render", "--validation"], arguments].concat())
    }

    /// Runs a shell's script, in which `$UMBER` is the program.
    #[cfg(unix)]
    fn shell(&self, script: &str) -> io::Result<Run> {
        let output = self.command("sh").args(["-c", script]).output()?;
        Ok(Run::of(script, &output))
    }
}

/// How the program ended.
struct Run {
    what: String,
    code: Option<i32>,
    stdout: Vec<u8>,
    stderr: String,
}

impl Run {
    fn of(what: &str, output: &Output) -> Self {
        let run = Self {
            what: what.into(),
            code: output.status.code(),
            stdout: output.stdout.clone(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        };
        assert!(!run.stderr.contains("panicked"), "{what}: {}", run.stderr);
        run
    }

    /// It ended with this code, and said each of these words on stderr or, for data, on stdout.
    #[track_caller]
    fn ends(self, code: i32, words: &[&str]) -> Self {
        let Self { what, stderr, .. } = &self;
        assert_eq!(self.code, Some(code), "{what}: {stderr}");
        let said = format!("{stderr}{}", String::from_utf8_lossy(&self.stdout));
        for word in words {
            assert!(said.contains(word), "{what}: no '{word}' in: {said}");
        }
        self
    }
}
