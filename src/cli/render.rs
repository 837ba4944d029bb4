//! How does `umber render` go from a scene's file to a picture's?

mod check;
mod promise;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use clap::ValueEnum;

use crate::cli::exit::{Exit, Failure, judge_messages};
use crate::cli::lighting::LightingArguments;
use crate::cli::options::{
    DeviceArgument, ToneMappingArgument, build, count, effects, exposure, samples, size, software,
};
use crate::cli::output::{JsonArgument, Output, talk, write_json};
use crate::gpu::{Device, DeviceKind, Samples};
use crate::reference::shade::Terms;
use crate::render::effects::{Build, Effects};
use crate::render::{
    self, Defects, FrameReport, Picture, PictureFormat, Renderer, Settings, Variant,
    exposure_factor,
};
use crate::report::{ChoiceRow, Image, Program, RenderReport, SceneSize};
use crate::scene::{self, LoadOptions, Scene};
use crate::studies::stability::{BadPixel, bad_pixels};
use promise::PromiseArguments;

/// Options of `umber render`.
#[derive(clap::Args)]
pub struct Arguments {
    /// A scene (.toml), or a model on its own (.obj)
    scene: PathBuf,
    /// Where to write: .png (exposed, tone-mapped, sRGB), .exr or .hdr (linear, cd/m^2); - is a PNG
    /// on stdout [default: the scene's name, .png, in this folder]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Width and height, pixels
    #[arg(long, default_value = "1280x720", value_name = "WxH", value_parser = size)]
    size: (u32, u32),
    /// Samples a pixel: 1, 2, 4 or 8
    #[arg(long, default_value = "4", value_parser = samples)]
    samples: Samples,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    lighting: LightingArguments,
    #[command(flatten)]
    promise: PromiseArguments,
    /// What the picture may contain: census (what the scene calls for), all (the same picture, compiled for any
    /// scene), none, or a list of what is left of it: diffuse-lobe,point-light
    #[arg(long, value_name = "LIST", default_value = "census", value_parser = effects)]
    effects: Effects,
    /// How the effects are compiled: one pipeline for any scene, one for this scene, or one for each kind of
    /// material
    #[arg(long, value_parser = build, conflicts_with = "effects", value_name = "dynamic|scene|material")]
    build: Option<Build>,
    /// The terms that count; emission always does
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "ambient,diffuse,specular"
    )]
    terms: Vec<TermArgument>,
    /// Change a number of the scene: material.gold.roughness=0.3 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// How a PNG brings bright values into range
    #[arg(long, default_value = "neutral")]
    tone_mapping: ToneMappingArgument,
    /// Exposure of a PNG, EV at ISO 100 [default: the scene's]
    #[arg(long, value_name = "EV100", allow_negative_numbers = true, value_parser = exposure)]
    exposure: Option<f32>,
    /// Show pixels that hold a NaN, an infinity or a negative value in false colours (magenta, yellow, cyan), and tell the
    /// line that makes each again; one sample a pixel
    #[arg(long, conflicts_with = "samples")]
    check: bool,
    #[command(flatten)]
    json: JsonArgument,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TermArgument {
    Ambient,
    Diffuse,
    Specular,
}

/// Loads, renders, writes, reports.
pub fn run(arguments: &Arguments, start: Instant) -> Result<(), Failure> {
    let settings = settings(arguments)?;
    let Places { picture, json } = Places::open(arguments)?;
    let scene = scene::load(&arguments.scene, &load_options(arguments))?;
    let warnings = scene.warnings.iter().map(|w| format!("warning: {w}"));
    say(arguments, warnings);
    let device = open_device(arguments)?;
    let rendered = rendered(arguments, settings, &device, &scene);
    // Also, and above all, where the frame failed.
    let messages = device.instance().validation_log().drain();
    messages.iter().for_each(talk);
    let Rendered {
        image,
        frame,
        choice,
        defects,
        bad_pixels,
    } = rendered?;
    let bytes = encode(arguments, &scene, &image, picture.format)?;
    let path = picture.path.display().to_string();
    picture.output.write(&bytes)?;
    let outside_ms = frame.first_draw_ms + frame.submit_to_idle_ms;
    let report = RenderReport {
        schema: RenderReport::SCHEMA,
        device: device.info().into(),
        scene: scene_size(&scene),
        image: describe(path, settings.samples, &image, &defects),
        frame,
        choice,
        validation_messages: messages.len(),
        start_to_file_ms: start.elapsed().as_secs_f64() * 1e3 - outside_ms,
        program: Program::this(),
    };
    say(arguments, summary(&report, device.info().kind));
    if let Some(json) = json {
        write_json(json, &report)?;
    }
    if arguments.check {
        check::tell(&bad_pixels, &defects);
        judge_messages(messages.len())?;
        return check::judge(&defects);
    }
    judge(messages.len(), &defects)
}

/// What is written and told.
struct Rendered {
    image: Picture,
    frame: FrameReport,
    choice: Option<ChoiceRow>,
    defects: Defects,
    bad_pixels: Vec<BadPixel>,
}

/// Chooses a model where a promise asks for that, renders, and looks into bad pixels where that is asked for.
fn rendered(
    arguments: &Arguments,
    mut settings: Settings,
    device: &Arc<Device>,
    scene: &Scene,
) -> Result<Rendered, Failure> {
    let cache = dirs::cache_dir().map(|folder| folder.join("umber"));
    let renderer = Renderer::new(device, cache.as_deref())?;
    let mut choice = None;
    if let Some(promise) = arguments.promise.promise() {
        let (lighting, row) = promise::keep(&renderer, scene, &settings, promise)?;
        settings.variant.lighting = lighting;
        choice = Some(row);
    }
    let (mut image, frame) = renderer.render(scene, &settings)?;
    let defects = image.defects();
    let mut found = Vec::new();
    if arguments.check {
        found = bad_pixels(&renderer, scene, &settings, &image)?;
        let ev100 = arguments.exposure.unwrap_or(scene.camera.exposure_ev100);
        image = image.false_colours(1.0 / exposure_factor(ev100));
    }
    Ok(Rendered {
        image,
        frame,
        choice,
        defects,
        bad_pixels: found,
    })
}

fn encode(
    arguments: &Arguments,
    scene: &Scene,
    picture: &Picture,
    format: PictureFormat,
) -> Result<Vec<u8>, Failure> {
    let ev100 = arguments.exposure.unwrap_or(scene.camera.exposure_ev100);
    let tone_mapping = arguments.tone_mapping.mapping();
    render::encode(picture, format, ev100, tone_mapping)
        .map_err(|error| Failure::new(Exit::File, format_args!("the picture: {error}")))
}

fn load_options(arguments: &Arguments) -> LoadOptions {
    LoadOptions {
        overrides: arguments.set.clone(),
        progress: !arguments.quiet,
        aspect: arguments.size.0 as f32 / arguments.size.1 as f32,
    }
}

fn settings(arguments: &Arguments) -> Result<Settings, Failure> {
    let has = |term| arguments.terms.contains(&term);
    Ok(Settings {
        width: arguments.size.0,
        height: arguments.size.1,
        samples: match arguments.check {
            true => Samples::One,
            false => arguments.samples,
        },
        variant: Variant {
            lighting: arguments.lighting.model()?,
            terms: Terms {
                ambient: has(TermArgument::Ambient),
                diffuse: has(TermArgument::Diffuse),
                specular: has(TermArgument::Specular),
            },
        },
        effects: match arguments.build {
            Some(build) => Effects {
                build,
                ..Effects::default()
            },
            None => arguments.effects,
        },
    })
}

/// Before any work: a size that the device cannot have is a matter of the command line.
fn open_device(arguments: &Arguments) -> Result<Arc<Device>, Failure> {
    let device = arguments.device.open()?;
    device.check_target_size(arguments.size.0, arguments.size.1)?;
    device.check_samples(arguments.samples)?;
    Ok(device)
}

/// Where picture and report go.
struct Places {
    picture: PicturePlace,
    json: Option<Output>,
}

struct PicturePlace {
    path: PathBuf,
    format: PictureFormat,
    output: Output,
}

impl Places {
    /// Checks both before any work is done, and that nothing is written over anything.
    fn open(arguments: &Arguments) -> Result<Self, Failure> {
        let path = match &arguments.output {
            Some(path) => path.clone(),
            None => default_output(&arguments.scene),
        };
        let format = format_of(&path)?;
        let output = Output::open(&path)?;
        let json = arguments.json.open()?;
        if json.as_ref().is_some_and(|json| json.is(&path)) {
            let message = "the picture and the report go to the same place: give each its own";
            return Err(Failure::new(Exit::Usage, message));
        }
        for output in [&output].into_iter().chain(&json) {
            if output.is(&arguments.scene) {
                let message = format!("{}: it would be overwritten", arguments.scene.display());
                return Err(Failure::new(Exit::Usage, message));
            }
        }
        let picture = PicturePlace {
            path,
            format,
            output,
        };
        Ok(Self { picture, json })
    }
}

fn format_of(path: &Path) -> Result<PictureFormat, Failure> {
    if path == Path::new("-") {
        return Ok(PictureFormat::Png);
    }
    // A device has no ending, and takes what is sent to it.
    let is_special = path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir());
    match PictureFormat::of(path) {
        Some(format) => Ok(format),
        None if is_special => Ok(PictureFormat::Png),
        None => {
            let endings: Vec<_> = PictureFormat::ALL.iter().map(|f| f.ending()).collect();
            let message = format!(
                "{}: no picture format has this ending; one of {} does",
                path.display(),
                endings.join(", ")
            );
            Err(Failure::new(Exit::Usage, message))
        }
    }
}

fn default_output(scene: &Path) -> PathBuf {
    let stem = scene.file_stem().unwrap_or("picture".as_ref());
    Path::new(stem).with_added_extension("png")
}

fn scene_size(scene: &Scene) -> SceneSize {
    SceneSize {
        triangles: scene.triangle_count() as u64,
        objects: scene.objects.len(),
        materials: scene.materials.len(),
        lights: scene.lights.len(),
    }
}

fn describe(path: String, samples: Samples, picture: &Picture, defects: &Defects) -> Image {
    Image {
        path,
        width: picture.width,
        height: picture.height,
        samples: samples.count(),
        nan_pixels: defects.not_finite(),
    }
}

/// What makes a written picture a failure all the same.
fn judge(messages: usize, defects: &Defects) -> Result<(), Failure> {
    judge_messages(messages)?;
    if let Some((x, y)) = defects.first {
        let message = format!(
            "{} pixels hold a NaN, {} an infinity; the first at column {x}, row {y} (the picture \
             was written)",
            defects.nan, defects.infinite
        );
        return Err(Failure::new(Exit::NotFinite, message));
    }
    Ok(())
}

fn say(arguments: &Arguments, lines: impl IntoIterator<Item = impl std::fmt::Display>) {
    if !arguments.quiet {
        lines.into_iter().for_each(talk);
    }
}

fn summary(report: &RenderReport, kind: DeviceKind) -> Vec<String> {
    let RenderReport {
        device,
        scene,
        image,
        frame,
        ..
    } = report;
    let software = software(kind.name());
    let mut lines = vec![
        format!("device   {}{software}", device.name),
        format!(
            "scene    {}, {}, {}, {}",
            count(scene.triangles, "triangle"),
            count(scene.objects as u64, "object"),
            count(scene.materials as u64, "material"),
            count(scene.lights as u64, "light"),
        ),
    ];
    lines.extend(report.choice.as_ref().map(promise::told));
    lines.push(match &frame.effects[..] {
        [] => "effects  none".to_owned(),
        effects => format!("effects  {}", effects.join(", ")),
    });
    lines.extend(frame.passes.iter().map(|pass| {
        format!(
            "pass     {}: {}, {}, {}",
            pass.name,
            count(pass.draws, "draw"),
            count(pass.pipeline_binds, "pipeline bind"),
            count(pass.descriptor_set_binds, "descriptor set bind"),
        )
    }));
    lines.push(times(frame, report.start_to_file_ms));
    lines.push(format!(
        "picture  {} ({}x{})",
        image.path, image.width, image.height
    ));
    lines
}

fn times(frame: &FrameReport, start_to_file_ms: f64) -> String {
    let gpu = frame.gpu_ms.map_or(String::new(), |ms| {
        format!(" ({ms:.1} by the device's clock)")
    });
    format!(
        "time     first draw {:.0} ms, record {:.2} ms, submit to idle {:.1} ms{gpu}, all else {:.0} ms",
        frame.first_draw_ms, frame.record_ms, frame.submit_to_idle_ms, start_to_file_ms
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu;

    const CLEAN: Defects = Defects {
        nan: 0,
        infinite: 0,
        negative: 0,
        first: None,
    };
    const BROKEN: Defects = Defects {
        nan: 3,
        infinite: 2,
        negative: 1,
        first: Some((7, 5)),
    };

    fn ended(done: Result<(), Failure>) -> (Option<Exit>, String) {
        match done {
            Ok(()) => (None, String::new()),
            Err(failure) => (Some(failure.exit), failure.message),
        }
    }

    #[test]
    fn messages_end_with_4_and_nan_with_5_and_messages_come_first() {
        assert_eq!(ended(judge(0, &CLEAN)).0, None);
        // Negative values alone are the picture's own affair.
        let negative = Defects {
            negative: 9,
            ..CLEAN
        };
        assert_eq!(ended(judge(0, &negative)).0, None);
        let (exit, message) = ended(judge(12, &CLEAN));
        assert_eq!(exit, Some(Exit::Validation));
        assert!(message.contains("12 messages"), "{message}");
        let (exit, message) = ended(judge(0, &BROKEN));
        assert_eq!(exit, Some(Exit::NotFinite));
        for words in ["3 pixels hold a NaN", "2 an infinity", "column 7, row 5"] {
            assert!(message.contains(words), "{message}");
        }
        assert_eq!(ended(judge(12, &BROKEN)).0, Some(Exit::Validation));
    }

    #[test]
    fn each_code_is_the_designs() {
        let codes = [
            Exit::Usage,
            Exit::Device,
            Exit::Validation,
            Exit::NotFinite,
            Exit::File,
        ];
        assert_eq!(codes.map(|code| code as u8), [2, 3, 4, 5, 6]);
    }

    #[test]
    fn what_the_device_refuses_ends_as_who_asked_for_it() {
        let beyond = || gpu::Error::BeyondLimit {
            what: "materials".into(),
            value: 2,
            limit: 1,
            device: "a card".into(),
        };
        let memory = gpu::Error::Memory {
            what: "shading: colour".into(),
            bytes: 1 << 40,
            reason: "none left".into(),
        };
        let samples = gpu::Error::NoSuchSampleCount {
            wanted: 8,
            available: "1, 4".into(),
            device: "a card".into(),
        };
        let exit = |error: render::RenderError| Failure::from(error).exit;
        // The size and the samples are the command line's, the materials the scene's.
        assert_eq!(exit(render::RenderError::Gpu(beyond())), Exit::Usage);
        assert_eq!(exit(render::RenderError::Gpu(memory)), Exit::Usage);
        assert_eq!(exit(render::RenderError::Gpu(samples)), Exit::Usage);
        assert_eq!(exit(render::RenderError::Scene(beyond())), Exit::File);
        let lost = gpu::Error::NoValidationLayer;
        assert_eq!(exit(render::RenderError::Gpu(lost)), Exit::Device);
        let message = Failure::from(render::RenderError::Scene(beyond())).message;
        assert!(message.contains("materials is 2"), "{message}");
    }

    #[test]
    fn the_picture_is_named_after_the_scene_and_lies_where_the_user_is() {
        for (scene, picture) in [
            ("zoo.toml", "zoo.png"),
            ("scenes/zoo.toml", "zoo.png"),
            ("/a/b.c.obj", "b.c.png"),
            ("..", "picture.png"),
        ] {
            assert_eq!(default_output(Path::new(scene)), Path::new(picture));
        }
    }
}
