//! How are cells measured one group after the other, so that a run that is killed keeps what it has?

use std::path::Path;

use indicatif::ProgressBar;

use super::arguments::Arguments;
use super::{group_process, heap};
use crate::cli::exit::{Exit, Failure};
use crate::cli::options::{count, software};
use crate::cli::output::{Output, print_bytes, progress_bar, talk, write_json};
use crate::gpu::{DeviceInfo, DeviceKind};
use crate::render::Renderer;
use crate::render::state_changes::Mode;
use crate::report::{BenchReport, Machine, Method, Program};
use crate::studies::OwnProcessError;
use crate::studies::state_changes::{Creation, Group, Options, Plan, break_evens, creation_here};

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
    let info = arguments.device.open()?.info().clone();
    let plan = arguments.plan(info.kind);
    let options = arguments.options(&plan);
    let mut report = new_report(arguments, &info, &plan, &options);
    if let Some(path) = &arguments.resume {
        report.rows = resumed(path, &report)?.rows;
    }
    let todo = plan.missing(&report.rows);
    let cells: usize = todo.iter().map(|(_, group)| group.cells.len()).sum();
    say_what(arguments, &info, cells);
    let frames = cells as u64 * u64::from(options.rounds);
    let bar = progress_bar(arguments.quiet, frames, BAR);
    let mut bench = Bench {
        arguments,
        kind: info.kind,
        creation: creation(arguments)?,
        bar: &bar,
    };
    let mut groups = todo.iter();
    let done = groups.try_for_each(|(place, group)| bench.group(*place, group, &mut report));
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

fn say_what(arguments: &Arguments, info: &DeviceInfo, cells: usize) {
    if arguments.quiet {
        return;
    }
    let kept = match arguments.kept() {
        Some(path) => format!(", kept in {} as they come in", path.display()),
        None => String::new(),
    };
    talk(format_args!(
        "{}{}: {}{kept}",
        info.name,
        software(info.kind.name()),
        count(cells as u64, "cell"),
    ));
}

struct Bench<'a> {
    arguments: &'a Arguments,
    kind: DeviceKind,
    creation: Option<Creation>,
    bar: &'a ProgressBar,
}

impl Bench<'_> {
    /// Measures a group, and keeps its rows.
    fn group(
        &mut self,
        place: usize,
        group: &Group,
        report: &mut BenchReport,
    ) -> Result<(), Failure> {
        self.bar.set_message(format!(
            "{}, {}, {}",
            group.scene.name(),
            count(group.materials.into(), "material"),
            count(group.draws.into(), "draw"),
        ));
        let mut rows = group_process::rows(place, &|frames| self.bar.inc(frames))?;
        rows.retain(|row| group.cells.iter().any(|cell| group.has(cell, row)));
        if let Some(creation) = &mut self.creation
            && self.arguments.measures_creation_of(group.scene)
        {
            creation.add(self.kind, group, &mut rows)?;
        }
        report.rows.extend(rows);
        report.break_even = break_evens(&report.rows);
        match self.arguments.kept() {
            Some(path) => write_json(Output::open(&path)?, report),
            None => Ok(()),
        }
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
    info: &DeviceInfo,
    plan: &Plan,
    options: &Options,
) -> BenchReport {
    BenchReport {
        schema: BenchReport::SCHEMA.to_owned(),
        device: info.into(),
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
