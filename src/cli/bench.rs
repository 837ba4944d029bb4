//! How does `umber bench` go from a plan to rows?

mod arguments;

pub use arguments::Arguments;

use std::sync::Arc;

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::exit::{Exit, Failure};
use crate::cli::options::count;
use crate::cli::output::{Output, print_bytes, talk, write_json};
use crate::gpu::Device;
use crate::render::Renderer;
use crate::render::state_changes::Mode;
use crate::report::{BenchReport, Machine, Method, Program};
use crate::studies::OwnProcessError;
use crate::studies::state_changes::{
    Creation, Group, Options, break_evens, creation_here, measure,
};

/// Measures, keeps, prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(mode) = arguments.creation_of {
        return print_creation(arguments, mode);
    }
    let report = measured(arguments)?;
    if let Some(json) = arguments.json.open()? {
        write_json(json, &report)?;
    }
    Ok(())
}

/// The one figure that a process of its own is asked for.
fn print_creation(arguments: &Arguments, mode: &'static Mode) -> Result<(), Failure> {
    let device = arguments.device.open()?;
    let cache = dirs::cache_dir().map(|folder| folder.join("umber"));
    let renderer = Renderer::new(&device, None)?;
    let (scene, materials) = arguments.creation();
    let options = arguments.options(1);
    let ms = creation_here(
        &renderer,
        cache.as_deref(),
        (scene, materials, mode),
        &options,
    )?;
    print_bytes(format!("{{\"creation_ms\": {ms}}}\n").as_bytes())
}

fn measured(arguments: &Arguments) -> Result<BenchReport, Failure> {
    let device = arguments.device.open()?;
    let renderer = Renderer::new(&device, None)?;
    let plan = arguments.plan(device.info().kind);
    let options = arguments.options(plan.rounds);
    let mut report = new_report(arguments, &device, plan.name, &options);
    let todo = plan.missing(&report.rows);
    let bar = progress_bar(arguments, &todo.groups, &options);
    let mut bench = Bench {
        arguments,
        renderer: &renderer,
        options: &options,
        creation: creation(arguments)?,
        bar: &bar,
    };
    let done = todo
        .groups
        .iter()
        .try_for_each(|group| bench.group(group, &mut report));
    bar.finish_and_clear();
    // Also, and above all, where a frame failed.
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    done?;
    match messages.len() {
        0 => Ok(report),
        number => {
            let number = count(number as u64, "message");
            let message = format!("the validation layers had {number}");
            Err(Failure::new(Exit::Validation, message))
        }
    }
}

struct Bench<'a> {
    arguments: &'a Arguments,
    renderer: &'a Renderer,
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
        let mut rows = measure(self.renderer, group, self.options, &|n| self.bar.inc(n))?;
        if let Some(creation) = &mut self.creation {
            creation.add(self.renderer, group, &mut rows)?;
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
    Ok(Some(Creation::new(program, options)))
}

fn new_report(
    arguments: &Arguments,
    device: &Arc<Device>,
    plan: &str,
    options: &Options,
) -> BenchReport {
    BenchReport {
        schema: BenchReport::SCHEMA.to_owned(),
        device: device.info().into(),
        machine: Machine::this(),
        method: Method {
            name: arguments.method_name().to_owned(),
            plan: plan.to_owned(),
            rounds: options.rounds,
            warm_up: options.warm_up,
            cell_seconds: options.cell_seconds,
            seed: options.seed,
        },
        rows: Vec::new(),
        break_even: Vec::new(),
        program: Program::this(),
    }
}

fn progress_bar(arguments: &Arguments, groups: &[Group], options: &Options) -> ProgressBar {
    if arguments.quiet {
        return ProgressBar::hidden();
    }
    let cells: usize = groups.iter().map(|group| group.cells.len()).sum();
    let bar = ProgressBar::new(cells as u64 * u64::from(options.rounds));
    match ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta}: {msg}") {
        Ok(style) => bar.with_style(style),
        // The default style serves as well.
        Err(_) => bar,
    }
}
