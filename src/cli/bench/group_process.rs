//! How is a group of cells measured in a process of its own?
//!
//! What the frames of an earlier group leave in the C library's heap slows recording in the next ones, up to three
//! times, and so moves their ratios. The process is started with this one's command line and the group's place in the
//! plan; it answers on stdout, a line of JSON at a time, and says what it has to say on stderr.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::arguments::Arguments;
use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::output::talk;
use crate::render::Renderer;
use crate::report::BenchRow;
use crate::studies::OwnProcessError;
use crate::studies::state_changes::Visits;

/// A line of the process.
#[derive(serde::Serialize, serde::Deserialize)]
enum Answer {
    /// So many more frames are drawn.
    Frames(u64),
    /// All rows of the group: the last line.
    Rows(Vec<BenchRow>),
    /// Why there are none: the last line.
    Failed(Failure),
}

/// More often a bar need not move, and each line wakes a process beside the frames that are measured.
const BETWEEN_LINES: Duration = Duration::from_millis(200);

/// The rows of the plan's group at `place`. `progress` hears of frames.
pub fn rows(place: usize, progress: &dyn Fn(u64)) -> Result<Vec<BenchRow>, Failure> {
    let mut process = Command::new(std::env::current_exe().map_err(OwnProcessError::from)?)
        .args(std::env::args_os().skip(1))
        .args(["--group", &place.to_string()])
        .stdout(Stdio::piped())
        .spawn()
        .map_err(OwnProcessError::from)?;
    let lines = process.stdout.take().into_iter();
    let lines = lines.flat_map(|stdout| BufReader::new(stdout).lines());
    let mut last = None;
    for line in lines.map_while(Result::ok) {
        match serde_json::from_str(&line) {
            Ok(Answer::Frames(frames)) => progress(frames),
            Ok(answer) => last = Some(answer),
            Err(error) => talk(format_args!("{line}: {error}")),
        }
    }
    let status = process.wait().map_err(OwnProcessError::from)?;
    match last {
        Some(Answer::Rows(rows)) => Ok(rows),
        Some(Answer::Failed(failure)) => Err(failure),
        _ => Err(OwnProcessError::Failed(format!("no rows, {status}")).into()),
    }
}

/// In the process: measures the group, and answers.
pub fn answer(arguments: &Arguments, place: usize) -> Result<(), Failure> {
    match measure(arguments, place) {
        Ok(rows) => say(&Answer::Rows(rows)),
        Err(failure) => say(&Answer::Failed(failure)),
    }
}

/// On devices of its own: what a driver keeps of the visits before must not crowd out this one's.
fn measure(arguments: &Arguments, place: usize) -> Result<Vec<BenchRow>, Failure> {
    let device = arguments.device.open()?;
    let plan = arguments.plan(device.info().kind);
    let options = arguments.options(&plan);
    let Some(group) = plan.groups.get(place) else {
        let message = format!("the plan has no group {place}");
        return Err(OwnProcessError::Failed(message).into());
    };
    let mut visits = Visits::new(&device, group, &options)?;
    let told = Told::default();
    while visits.left() > 0 {
        let device = arguments.device.open()?;
        let renderer = Renderer::new(&device, None)?;
        let visited = visits.visit(&renderer, &|frames| told.add(frames));
        // Also, and above all, where a frame failed.
        let messages = device.instance().validation_log().drain();
        messages.iter().for_each(talk);
        visited?;
        judge_messages(messages.len())?;
    }
    told.rest();
    Ok(visits.rows())
}

fn say(answer: &Answer) -> Result<(), Failure> {
    let line = serde_json::to_string(answer);
    let line = line.map_err(|error| OwnProcessError::Failed(error.to_string()))?;
    let told = writeln!(std::io::stdout(), "{line}");
    told.map_err(|error| OwnProcessError::from(error).into())
}

/// Frames that the other process has not heard of.
struct Told {
    frames: Cell<u64>,
    at: Cell<Instant>,
}

impl Default for Told {
    fn default() -> Self {
        Self {
            frames: Cell::new(0),
            at: Cell::new(Instant::now()),
        }
    }
}

impl Told {
    fn add(&self, frames: u64) {
        self.frames.set(self.frames.get() + frames);
        if self.at.get().elapsed() >= BETWEEN_LINES {
            self.rest();
        }
    }

    fn rest(&self) {
        self.at.set(Instant::now());
        if say(&Answer::Frames(self.frames.take())).is_err() {
            // Whoever wanted the rows is gone.
            std::process::exit(Exit::File as i32);
        }
    }
}
