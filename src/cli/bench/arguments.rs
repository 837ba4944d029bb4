//! What can be asked of `umber bench`?

use std::path::PathBuf;

use clap::ValueEnum;

use crate::cli::options::DeviceArgument;
use crate::cli::output::JsonArgument;
use crate::gpu::DeviceKind;
use crate::render::state_changes::{MODES, Mode};
use crate::studies::state_changes::{
    FURTHER_SECONDS, Group, Options, Plan, SCENES, SceneKind, Timing,
};

/// Options of `umber bench`.
#[derive(clap::Args)]
#[command(after_long_help = MODES_HELP.as_str())]
pub struct Arguments {
    /// A minute on two cores: every mode in every scene, small [default]
    #[arg(long, conflicts_with_all = ["full", "mode", "scene", "materials", "draws"])]
    quick: bool,
    /// An hour on two cores: materials 1 to 4,096, draws 100 to 1,000,000, patches 1 to 65,536 pixels
    #[arg(long, conflicts_with_all = ["mode", "scene", "materials", "draws"])]
    full: bool,
    /// The modes to measure, with commas between them [default: all; see below]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = mode)]
    mode: Vec<&'static Mode>,
    /// What is drawn: tiny, zoo, patches, null, bare, bare-storage [default: tiny]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = scene)]
    scene: Vec<SceneKind>,
    /// Numbers of materials [default: 64]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = number(MOST_MATERIALS))]
    materials: Vec<u32>,
    /// Numbers of draws; patches are drawn once each [default: 10000]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = number(MOST_DRAWS))]
    draws: Vec<u32>,
    /// Frames of each cell that count; fewer than 6 have no interval [default: at least 12, more where that is quick]
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    rounds: Option<u16>,
    /// A cell that took this many seconds is drawn no further
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = seconds)]
    cell_seconds: f64,
    /// Orders draws and rounds
    #[arg(long, default_value = "1")]
    seed: u64,
    /// What is done with a frame's commands
    #[arg(long, default_value = "submit")]
    method: MethodArgument,
    /// Leave out the times in which pipelines are made: they take processes of their own
    #[arg(long)]
    skip_creation: bool,
    #[command(flatten)]
    pub device: DeviceArgument,
    #[command(flatten)]
    pub json: JsonArgument,
    /// Write the rows as CSV
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write one page with plots, machine and method
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
    /// Measure what a report of an earlier, killed run lacks, and add it there
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["json", "read"])]
    pub resume: Option<PathBuf>,
    /// Measure nothing: take the rows of a report
    #[arg(long, value_name = "FILE.json",
          conflicts_with_all = ["quick", "full", "mode", "scene", "materials", "draws", "rounds"])]
    pub read: Option<PathBuf>,
    /// Say what changed against an earlier report of this device, beyond the spread
    #[arg(long, value_name = "OLD.json")]
    pub baseline: Option<PathBuf>,
    /// With --baseline: end with exit code 1 where something grew by more than this factor
    #[arg(long, value_name = "FACTOR", default_value = "1.1", value_parser = factor)]
    pub threshold: f64,
    /// Say nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// One figure, for a process of its own
    #[arg(long, hide = true, value_name = "MODE", value_parser = mode)]
    pub creation_of: Option<&'static Mode>,
    /// One group of the plan, for a process of its own
    #[arg(long, hide = true, value_name = "PLACE")]
    pub group: Option<usize>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum MethodArgument {
    /// Submitted and waited for
    Submit,
    /// Recorded and reset, 10,000 draws of three vertices a buffer, as vkoverhead's draw cases are; scene null
    Vkoverhead,
}

/// The modes, for the end of the help.
static MODES_HELP: std::sync::LazyLock<String> = std::sync::LazyLock::new(|| {
    let lines = MODES
        .iter()
        .map(|mode| format!("  {:<22}{}", mode.name, mode.what));
    format!("Modes:\n{}", lines.collect::<Vec<_>>().join("\n"))
});

/// Beyond, a material has no pixel of its own in any picture that can be shown.
const MOST_MATERIALS: u32 = 1_000_000;
/// Ten million objects take 2 GiB on the host before anything is drawn.
const MOST_DRAWS: u32 = 10_000_000;
/// Draws that vkoverhead records between two resets.
const VKOVERHEAD_DRAWS: u32 = 10_000;
/// Materials that a plan of the user's own has.
const MATERIALS: u32 = 64;
const DRAWS: u32 = 10_000;
const ROUNDS: u32 = 12;

impl Arguments {
    /// What is to be measured on a device of this kind.
    pub fn plan(&self, kind: DeviceKind) -> Plan {
        let plan = match self.full {
            true => Plan::full(kind),
            false if self.is_custom() => self.custom(),
            false => Plan::quick(),
        };
        match self.rounds {
            None => plan,
            Some(rounds) => Plan {
                rounds: rounds.into(),
                further_seconds: 0.0,
                ..plan
            },
        }
    }

    fn is_custom(&self) -> bool {
        let lists = self.mode.len() + self.scene.len() + self.materials.len() + self.draws.len();
        lists > 0 || self.timing() == Timing::RecordAndReset
    }

    fn custom(&self) -> Plan {
        let or = |list: &[u32], default: u32| match list {
            [] => vec![default],
            list => list.to_vec(),
        };
        let overhead = self.timing() == Timing::RecordAndReset;
        let (scenes, draws) = match overhead {
            true => (vec![SceneKind::Null], VKOVERHEAD_DRAWS),
            false => (vec![SceneKind::Tiny], DRAWS),
        };
        let scenes = if self.scene.is_empty() {
            scenes
        } else {
            self.scene.clone()
        };
        let modes = match self.mode[..] {
            [] => MODES.iter().collect(),
            _ => self.mode.clone(),
        };
        let mut groups = Vec::new();
        for scene in scenes {
            for materials in or(&self.materials, MATERIALS) {
                if matches!(scene, SceneKind::Patches(_)) {
                    groups.extend(Plan::patches(materials));
                    continue;
                }
                for draws in or(&self.draws, draws) {
                    groups.push(Group::of_all(scene, materials, draws, &modes));
                }
            }
        }
        Plan {
            name: "custom",
            groups: groups.into_iter().flat_map(Group::split).collect(),
            rounds: ROUNDS,
            further_seconds: FURTHER_SECONDS,
        }
    }

    fn timing(&self) -> Timing {
        match self.method {
            MethodArgument::Submit => Timing::Submit,
            MethodArgument::Vkoverhead => Timing::RecordAndReset,
        }
    }

    /// How a plan is measured.
    pub fn options(&self, plan: &Plan) -> Options {
        Options {
            rounds: plan.rounds,
            further_seconds: plan.further_seconds,
            warm_up: WARM_UP,
            cell_seconds: self.cell_seconds,
            seed: self.seed,
            timing: self.timing(),
        }
    }

    /// Whether a minute must suffice.
    pub fn is_quick(&self) -> bool {
        !self.full && !self.is_custom()
    }

    /// What reports call the method.
    pub fn method_name(&self) -> &'static str {
        match self.method {
            MethodArgument::Submit => "submit",
            MethodArgument::Vkoverhead => "vkoverhead",
        }
    }

    /// Whether the times in which pipelines are made are measured.
    pub fn measures_creation(&self) -> bool {
        !self.skip_creation && self.timing() == Timing::Submit
    }

    /// Whether they are of this scene: a minute suffices for those in which something is shaded as a user's frame is.
    pub fn measures_creation_of(&self, scene: SceneKind) -> bool {
        let shaded = matches!(
            scene,
            SceneKind::Tiny | SceneKind::Zoo | SceneKind::Patches(_)
        );
        shaded || !self.is_quick()
    }

    /// Scene and materials of the one figure that a process of its own is asked for.
    pub fn creation(&self) -> (SceneKind, u32) {
        let scene = self.scene.first().copied().unwrap_or(SceneKind::Tiny);
        (scene, self.materials.first().copied().unwrap_or(1))
    }

    /// Where the rows are kept as they come in, if the user wants them kept or they take long.
    pub fn kept(&self) -> Option<PathBuf> {
        let own = self.full.then(|| PathBuf::from("umber-bench.json"));
        let json = self.json.json.clone();
        let named = json.filter(|path| path.as_os_str() != "-");
        self.resume.clone().or(named).or(own)
    }
}

/// Frames before those that count, on each device: the first compiles.
const WARM_UP: u32 = 1;

fn mode(text: &str) -> Result<&'static Mode, String> {
    Mode::of_name(text)
}

fn scene(text: &str) -> Result<SceneKind, String> {
    let found = SCENES.into_iter().find(|scene| scene.name() == text);
    found.ok_or_else(|| "it is tiny, zoo, patches, null, bare or bare-storage".into())
}

fn number(most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone {
    move |text: &str| match text.parse() {
        Ok(number) if (1..=most).contains(&number) => Ok(number),
        _ => Err(format!("it is a whole number from 1 to {most}")),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if seconds > 0.0 && f64::is_finite(seconds) => Ok(seconds),
        _ => Err("it is a number of seconds above 0".into()),
    }
}

fn factor(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(factor) if factor >= 1.0 && f64::is_finite(factor) => Ok(factor),
        _ => Err("it is a number from 1 on".into()),
    }
}
