//! How does `umber effects` go from scenes to a table of prices?

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;

use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::lighting::LightingArguments;
use crate::cli::options::{DeviceArgument, count, effect_set, samples, size, software};
use crate::cli::output::{JsonArgument, print_bytes, progress_bar, talk, write_json};
use crate::gpu::Samples;
use crate::reference::shade::Terms;
use crate::render::effects::{ALL, Build, EffectSet, Effects};
use crate::render::{Renderer, Settings, Variant};
use crate::report::{Align, BuildRow, EffectRow, EffectsReport, Interval95, Program, write_table};
use crate::scene::{self, LoadOptions, Scene};
use crate::studies::{self, FirstDraw, Options, OwnProcessError};

/// Options of `umber effects`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Scenes (.toml), or models on their own (.obj)
    #[arg(required_unless_present = "price_list")]
    scenes: Vec<PathBuf>,
    /// Price each effect in a scene of its own instead: FOLDER/EFFECT.toml
    #[arg(long, value_name = "FOLDER", conflicts_with = "scenes")]
    price_list: Option<PathBuf>,
    /// The effects to price [default: all]
    #[arg(long, value_name = "LIST", value_parser = effect_set)]
    only: Option<EffectSet>,
    /// Width and height, pixels
    #[arg(long, default_value = "640x360", value_name = "WxH", value_parser = size)]
    size: (u32, u32),
    /// Samples a pixel: 1, 2, 4 or 8
    #[arg(long, default_value = "1", value_parser = samples)]
    samples: Samples,
    /// Frames of each kind; fewer than 6 have no interval
    #[arg(long, default_value = "11", value_parser = clap::value_parser!(u16).range(1..=10_000))]
    rounds: u16,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    lighting: LightingArguments,
    /// Change a number of the scene: material.gold.roughness=0.3 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    json: JsonArgument,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// How far it is.
const BAR: &str = "measuring {bar:40} {pos}/{len} frames, {eta}";

/// A scene, and what of it is measured.
struct Task {
    path: PathBuf,
    scene: Scene,
    options: Options,
}

/// Loads, measures, prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let json = arguments.json.open()?;
    let tasks = tasks(arguments)?;
    for task in &tasks {
        if json.as_ref().is_some_and(|json| json.is(&task.path)) {
            let message = format!("{}: it would be overwritten", task.path.display());
            return Err(Failure::new(Exit::Usage, message));
        }
    }
    let device = arguments.device.open()?;
    device.check_target_size(arguments.size.0, arguments.size.1)?;
    device.check_samples(arguments.samples)?;
    let cache = dirs::cache_dir().map(|folder| folder.join("umber"));
    let renderer = Renderer::new(&device, cache.as_deref())?;
    let mut report = EffectsReport {
        schema: EffectsReport::SCHEMA,
        device: device.info().into(),
        width: arguments.size.0,
        height: arguments.size.1,
        samples: arguments.samples.count(),
        rounds: arguments.rounds.into(),
        rows: Vec::new(),
        builds: Vec::new(),
        program: Program::this(),
    };
    let frames = |task: &Task| studies::frames(&task.scene, &task.options);
    let frames = tasks.iter().map(frames).sum();
    let bar = progress_bar(arguments.quiet, frames, BAR);
    let measured = tasks
        .iter()
        .try_for_each(|task| measure(arguments, task, &renderer, &bar, &mut report));
    bar.finish_and_clear();
    // Also, and above all, where a frame failed.
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    measured?;
    match json {
        Some(json) => write_json(json, &report)?,
        None => {
            let titled = arguments.price_list.is_none();
            print_bytes(text(&report, software(device.info().kind.name()), titled).as_bytes())?;
        }
    }
    judge_messages(messages.len())
}

fn measure(
    arguments: &Arguments,
    task: &Task,
    renderer: &Renderer,
    bar: &ProgressBar,
    report: &mut EffectsReport,
) -> Result<(), Failure> {
    let name = task.path.display().to_string();
    let study = studies::study(renderer, &name, &task.scene, &task.options, &|| bar.inc(1))?;
    report.rows.extend(study.effects);
    report
        .builds
        .extend(with_first_draws(arguments, task, study.builds)?);
    Ok(())
}

fn tasks(arguments: &Arguments) -> Result<Vec<Task>, Failure> {
    let wanted = arguments.only.unwrap_or(EffectSet::ALL);
    match &arguments.price_list {
        None => arguments
            .scenes
            .iter()
            .map(|path| task(arguments, path, wanted))
            .collect(),
        Some(folder) => ALL
            .iter()
            .filter(|effect| wanted.has(effect))
            .map(|effect| {
                let path = folder.join(effect.name).with_added_extension("toml");
                task(arguments, &path, EffectSet::NONE.with(effect))
            })
            .collect(),
    }
}

fn task(arguments: &Arguments, path: &Path, measured: EffectSet) -> Result<Task, Failure> {
    let (width, height) = arguments.size;
    let load = LoadOptions {
        overrides: arguments.set.clone(),
        progress: !arguments.quiet,
        aspect: width as f32 / height as f32,
    };
    let scene = scene::load(path, &load)?;
    if !arguments.quiet {
        scene
            .warnings
            .iter()
            .for_each(|w| talk(format_args!("warning: {w}")));
    }
    let settings = Settings {
        width,
        height,
        samples: arguments.samples,
        variant: Variant {
            lighting: arguments.lighting.model()?,
            terms: Terms::ALL,
        },
        effects: Effects::default(),
    };
    Ok(Task {
        path: path.to_owned(),
        scene,
        options: Options {
            settings,
            rounds: arguments.rounds.into(),
            measured,
            builds: arguments.price_list.is_none(),
        },
    })
}

fn with_first_draws(
    arguments: &Arguments,
    task: &Task,
    rows: Vec<BuildRow>,
) -> Result<Vec<BuildRow>, Failure> {
    let program =
        std::env::current_exe().map_err(|error| Failure::from(OwnProcessError::from(error)))?;
    let mut options = arguments.lighting.repeated();
    for set in &arguments.set {
        options.extend(["--set".to_owned(), set.clone()]);
    }
    if let Some(device) = &arguments.device.device {
        options.extend(["--device".to_owned(), device.to_string()]);
    }
    let first_draw = FirstDraw {
        program,
        scene: task.path.clone(),
        arguments: options,
    };
    let measured = rows.into_iter().zip(Build::ALL).map(|(row, build)| {
        let times = first_draw.measure(build)?;
        Ok(BuildRow {
            first_draw_cold_ms: Some(times.cold),
            first_draw_warm_ms: Some(times.warm),
            ..row
        })
    });
    measured.collect()
}

/// The tables as a person reads them; `titled` where scenes do not go without saying.
fn text(report: &EffectsReport, software: &str, titled: bool) -> String {
    let scene = |scene: &String| match titled {
        true => scene.clone(),
        false => String::new(),
    };
    let mut text = format!(
        "{}{software}; {}x{}, {}, {}; [95 % intervals]\n",
        report.device.name,
        report.width,
        report.height,
        count(report.samples.into(), "sample"),
        count(report.rounds as u64, "round"),
    );
    let effects = report
        .rows
        .iter()
        .map(|row| (scene(&row.scene), effect_cells(row)));
    write_table(&mut text, EFFECT_HEAD, [Align::Left; 6], effects);
    let builds = report
        .builds
        .iter()
        .map(|row| (scene(&row.scene), build_cells(row)));
    if !report.builds.is_empty() {
        write_table(&mut text, BUILD_HEAD, [Align::Left; 7], builds);
    }
    text
}

const EFFECT_HEAD: [&str; 6] = [
    "effect",
    "with ms",
    "without ms",
    "cost ms",
    "unused %",
    "called for by",
];

const BUILD_HEAD: [&str; 7] = [
    "build",
    "pipelines",
    "frame ms",
    "of scene",
    "first draw cold ms",
    "warm ms",
    "max difference",
];

fn effect_cells(row: &EffectRow) -> [String; 6] {
    let ms = |ms: Option<f64>| ms.map_or("-".to_owned(), |ms| format!("{ms:.2}"));
    let cost = match (row.cost_ms, &row.cost_ms_95) {
        (Some(cost), Some(bounds)) => format!("{cost:.2} {}", range(bounds, 2)),
        _ => "-".to_owned(),
    };
    [
        row.effect.to_owned(),
        ms(row.frame_ms_with),
        ms(Some(row.frame_ms_without)),
        cost,
        format!(
            "{:.1} {}",
            row.unused_cost_percent,
            range(&row.unused_cost_percent_95, 1)
        ),
        callers(&row.called_for_by),
    ]
}

fn build_cells(row: &BuildRow) -> [String; 7] {
    let ms = |ms: Option<f64>| ms.map_or("-".to_owned(), |ms| format!("{ms:.0}"));
    [
        row.build.to_owned(),
        row.pipelines.to_string(),
        format!("{:.2}", row.frame_ms),
        format!("{:.3} {}", row.relative, range(&row.relative_95, 3)),
        ms(row.first_draw_cold_ms),
        ms(row.first_draw_warm_ms),
        format!("{:.1e}", row.max_difference),
    ]
}

/// `[1.2, 1.4]`; a dash for a bound that too few rounds gave.
fn range(interval: &Interval95, digits: usize) -> String {
    let bound = |bound: Option<f64>| match bound {
        Some(bound) => format!("{bound:.digits$}"),
        None => "-".to_owned(),
    };
    format!("[{}, {}]", bound(interval.low), bound(interval.high))
}

/// The first few by name; JSON has them all.
fn callers(all: &[String]) -> String {
    match all {
        [] => "nobody".to_owned(),
        [one] => one.clone(),
        [one, two] => format!("{one}, {two}"),
        [one, two, rest @ ..] => format!("{one}, {two} and {} more", rest.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_callers_are_told_by_their_first_two() {
        let names = |n: usize| -> Vec<_> { (0..n).map(|i| format!("m{i}")).collect() };
        assert_eq!(callers(&names(0)), "nobody");
        assert_eq!(callers(&names(1)), "m0");
        assert_eq!(callers(&names(2)), "m0, m1");
        assert_eq!(callers(&names(5)), "m0, m1 and 3 more");
    }
}
