//! How does `umber cost` go from scenes to a table of what accuracy costs?

use std::path::PathBuf;

use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::options::{DeviceArgument, size, software};
use crate::cli::output::{JsonArgument, Output, print_bytes, progress_bar, talk, write_json};
use crate::render::{PictureFormat, Renderer, encode};
use crate::report::{CostReport, Machine, Program, Sample, cost_page};
use crate::scene::{self, LoadOptions, Scene};
use crate::studies::cost::{Found, Options, SightError, made_opaque, steps, study};
use crate::studies::{Cache, ladders};

/// Options of `umber cost`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Scenes (.toml), or models on their own (.obj)
    #[arg(default_values = ["scenes/zoo.toml", "scenes/roughness.toml", "scenes/colour-shift.toml"])]
    scenes: Vec<PathBuf>,
    /// Two minutes on two cores: every tier, the presets, and the 20 mixes nearest the front that the tiers predict [default]
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Half an hour: all 222 mixes
    #[arg(long)]
    full: bool,
    /// Width and height of the pictures, pixels [default: 256x144, or 320x180 with --full]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Frames of each model in each scene; fewer than 6 have no interval [default: 3, or 11 with --full]
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    rounds: Option<u16>,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    json: JsonArgument,
    /// Write one page with plots, pictures, machine and method
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// How far it is.
const BAR: &str = "measuring {bar:40} {pos}/{len}, {eta}";

impl Arguments {
    fn options(&self) -> Options {
        let rounds = self.rounds.map(usize::from);
        Options {
            // `--quick` is what is done anyway.
            full: self.full && !self.quick,
            size: self
                .size
                .unwrap_or(if self.full { (320, 180) } else { (256, 144) }),
            rounds: rounds.unwrap_or(if self.full { 11 } else { 3 }),
            paths: ladders::PATHS,
        }
    }
}

/// Loads, measures, prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut taken: Vec<&PathBuf> = arguments.scenes.iter().collect();
    let json = Output::open_apart(arguments.json.json.as_ref(), &mut taken)?;
    let page = Output::open_apart(arguments.report.as_ref(), &mut taken)?;
    let options = arguments.options();
    let (width, height) = options.size;
    let scenes = load(arguments, width as f32 / height as f32)?;
    let device = arguments.device.open()?;
    device.check_target_size(width, height)?;
    let caches = dirs::cache_dir().map(|folder| folder.join("umber"));
    let renderer = Renderer::new(&device, caches.as_deref())?;
    let bar = progress_bar(arguments.quiet, steps(scenes.len(), &options), BAR);
    let quiet = arguments.quiet;
    let folder = caches.as_deref().map(ladders::folder);
    let cache = Cache::new(folder.as_deref(), move |text| {
        if !quiet {
            talk(format_args!("warning: {text}"));
        }
    });
    let found = study(&renderer, &scenes, &options, &cache, &|| bar.inc(1));
    bar.finish_and_clear();
    // Also, and above all, where a frame failed.
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    let found = found?;
    let samples = samples(&found)?;
    let report = CostReport {
        schema: CostReport::SCHEMA.to_owned(),
        device: device.info().into(),
        machine: Machine::this(),
        method: found.method,
        rows: found.rows,
        lamps: found.lamps,
        promises: found.promises,
        program: Program::this(),
    };
    if let Some(page) = page {
        page.write(cost_page(&report, &samples).as_bytes())?;
    }
    match json {
        Some(json) => write_json(json, &report)?,
        None => {
            let software = software(&report.device.kind);
            let head = format!(
                "{}{software}; * beaten by no other; [95 % intervals]\n",
                report.device.name
            );
            print_bytes((head + &report.table()).as_bytes())?;
        }
    }
    judge_messages(messages.len())
}

fn load(arguments: &Arguments, aspect: f32) -> Result<Vec<(String, Scene)>, Failure> {
    let options = LoadOptions {
        overrides: Vec::new(),
        progress: !arguments.quiet,
        aspect,
    };
    let mut scenes = Vec::new();
    for path in &arguments.scenes {
        let scene = scene::load(path, &options)?;
        if !arguments.quiet {
            let warnings = scene.warnings.iter();
            warnings.for_each(|w| talk(format_args!("warning: {w}")));
        }
        let name = path.file_stem().unwrap_or(path.as_os_str());
        scenes.push((name.to_string_lossy().into_owned(), made_opaque(&scene)));
    }
    Ok(scenes)
}

/// Pictures for the page.
fn samples(found: &Found) -> Result<Vec<Sample>, Failure> {
    let encoded = found.shown.iter().map(|shown| {
        let display = shown.display;
        let png = encode(
            &shown.picture,
            PictureFormat::Png,
            display.ev100,
            display.tone_mapping,
        );
        Ok(Sample {
            scene: shown.scene.clone(),
            tier: shown.tier.clone(),
            flip_mean: shown.flip_mean,
            png: png.map_err(|error| Failure::new(Exit::File, error))?,
        })
    });
    encoded.collect()
}

impl From<SightError> for Failure {
    fn from(error: SightError) -> Self {
        match error {
            SightError::Render(error) => error.into(),
            SightError::Difference(error) => Self::new(Exit::NotFinite, error),
        }
    }
}
