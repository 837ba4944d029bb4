//! How are cells measured one group after the other, so that a run that is killed keeps what it has?

use std::path::Path;
use std::sync::Arc;

use indicatif::ProgressBar;

use super::arguments::Arguments;
use super::heap;
use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::options::{count, software};
use crate::cli::output::{Output, print_bytes, progress_bar, talk, write_json};
use crate::gpu::Device;
use crate::render::Renderer;
use crate::render::state_changes::Mode;
use crate::report::{BenchReport, BenchRow, Machine, Method, Program};
use crate::studies::OwnProcessError;
use crate::studies::state_changes::{
    Creation, Group, Options, Plan, Visits, break_evens, creation_here,
};

/// How far it is.
const BAR: &str = "{bar:40} {pos}/{len} frames, {elapsed}: {msg}";

/// The one figure that a process of its own is asked for.
pub fn print_creation(arguments: &Arguments, mode: &'static Mode) -> Result<(), Failure> {
    let device = arguments.device.open()?;
    let cache = dirs::cache_dir().map(|folder| folder.join("umber"));
    let renderer = Renderer::new(&device, None)?;
    let (scene, materials) = arguments.creation();
    let options = arguments.options(&arguments.plan(device.info().kind));
    let what = (scene, materials, mode);
    let ms = creation_here(&renderer, cache.as_deref(), what, &options)?;
    print_bytes(format!("{{\"creation_ms\": {ms}}}\n").as_bytes())
}

/// What the plan asks for and an earlier run does not have yet.
pub fn measured(arguments: &Arguments) -> Result<BenchReport, Failure> {
    let device = arguments.device.open()?;
    let plan = arguments.plan(device.info().kind);
    let options = arguments.options(&plan);
    let mut report = new_report(arguments, &device, &plan, &options);
    if let Some(path) = &arguments.resume {
        report.rows = resumed(path, &report)?.rows;
    }
    let todo = plan.missing(&report.rows);
    say_what(arguments, &device, &todo);
    let cells: usize = todo.groups.iter().map(|group| group.cells.len()).sum();
    let frames = cells as u64 * u64::from(options.rounds);
    let bar = progress_bar(arguments.quiet, frames, BAR);
    let mut bench = Bench {
        arguments,
        device: &device,
        options: &options,
        creation: creation(arguments)?,
        bar: &bar,
    };
    let mut groups = todo.groups.iter();
    let done = groups.try_for_each(|group| bench.group(group, &mut report));
    bar.finish_and_clear();
    done?;
    report.break_even = break_evens(&report.rows);
    Ok(report)
}

/// The report of a run that was killed, if this run can go on with it.
fn resumed(path: &Path, new: &BenchReport) -> Result<BenchReport, Failure> {
    let old = super::read(path)?;
    let differs = [
        ("device", old.device != new.device),
        ("machine", old.machine != new.machine),
        ("method, plan, rounds or seed", old.method != new.method),
        ("version of Umber", old.program != new.program),
    ];
    match differs.iter().find(|(_, differs)| *differs) {
        None => Ok(old),
        Some((what, _)) => {
            let message = format!(
                "{}: it has another {what}: measure anew, or give what that run was given",
                path.display()
            );
            Err(Failure::new(Exit::Usage, message))
        }
    }
}

fn say_what(arguments: &Arguments, device: &Device, todo: &Plan) {
    if arguments.quiet {
        return;
    }
    let info = device.info();
    let cells: usize = todo.groups.iter().map(|group| group.cells.len()).sum();
    let kept = match arguments.kept() {
        Some(path) => format!(", kept in {} as they come in", path.display()),
        None => String::new(),
    };
    talk(format_args!(
        "{}{}: {}{kept}",
        info.name,
        software(info.kind),
        count(cells as u64, "cell"),
    ));
}

struct Bench<'a> {
    arguments: &'a Arguments,
    device: &'a Device,
    options: &'a Options,
    creation: Option<Creation>,
    bar: &'a ProgressBar,
}

impl Bench<'_> {
    /// Measures a group, and keeps its rows.
    fn group(&mut self, group: &Group, report: &mut BenchReport) -> Result<(), Failure> {
        self.bar.set_message(format!(
            "{}, {}, {}",
            group.scene.name(),
            count(group.materials.into(), "material"),
            count(group.draws.into(), "draw"),
        ));
        let mut rows = self.rows(group)?;
        if let Some(creation) = &mut self.creation
            && self.arguments.measures_creation_of(group.scene)
        {
            creation.add(self.device.info().kind, group, &mut rows)?;
        }
        report.rows.extend(rows);
        report.break_even = break_evens(&report.rows);
        match self.arguments.kept() {
            Some(path) => write_json(Output::open(&path)?, report),
            None => Ok(()),
        }
    }

    /// On devices of its own: what a driver keeps of the shaders of groups before must not crowd out this one's.
    fn rows(&self, group: &Group) -> Result<Vec<BenchRow>, Failure> {
        let mut visits = Visits::new(self.device, group, self.options)?;
        while visits.left() > 0 {
            let device = self.arguments.device.open()?;
            let renderer = Renderer::new(&device, None)?;
            let visited = visits.visit(&renderer, &|frames| self.bar.inc(frames));
            // Also, and above all, where a frame failed.
            let messages = device.instance().validation_log().drain();
            messages.iter().for_each(talk);
            visited?;
            judge_messages(messages.len())?;
        }
        Ok(visits.rows())
    }
}

fn creation(arguments: &Arguments) -> Result<Option<Creation>, Failure> {
    if !arguments.measures_creation() {
        return Ok(None);
    }
    let program = std::env::current_exe().map_err(OwnProcessError::from)?;
    let mut options = Vec::new();
    if let Some(device) = &arguments.device.device {
        options.extend(["--device".to_owned(), device.to_string()]);
    }
    let runs = if arguments.is_quick() { 1 } else { RUNS };
    Ok(Some(Creation::new(program, options, runs)))
}

/// Processes of a kind whose median counts.
const RUNS: usize = 3;

fn new_report(
    arguments: &Arguments,
    device: &Arc<Device>,
    plan: &Plan,
    options: &Options,
) -> BenchReport {
    BenchReport {
        schema: BenchReport::SCHEMA.to_owned(),
        device: device.info().into(),
        machine: Machine::this(),
        method: Method {
            name: arguments.method_name().to_owned(),
            plan: plan.name.to_owned(),
            rounds: options.rounds,
            further_seconds: options.further_seconds,
            warm_up: options.warm_up,
            cell_seconds: options.cell_seconds,
            seed: options.seed,
            heap: heap::told(),
        },
        rows: Vec::new(),
        break_even: Vec::new(),
        program: Program::this(),
    }
}
