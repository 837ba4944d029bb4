//! Which cells are measured, and which of them together?

use crate::gpu::{DeviceKind, Output};
use crate::render::state_changes::{
    BareCase, Call, Change, DYNAMIC, MODES, Mode, ONE_PIPELINE, PIPELINE_PER_MATERIAL,
};
use crate::report::BenchRow;
use crate::scene::{Exhibit, Order, Wall};

/// What is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum SceneKind {
    /// Triangles of 8 pixels: the driver's own cost.
    Tiny,
    /// Balls under four lamps, in a picture of one size: a user's cost.
    Zoo,
    /// Squares of so many pixels a side: what a pixel of the single shader costs.
    Patches(u32),
    /// The triangles, dropped before the rasteriser.
    Null,
    /// Triangles of 8 pixels that read one uniform block: a state command's cost where a draw has nothing else to pay for.
    Bare {
        /// Whether a storage buffer that no shader reads is in the set.
        storage: bool,
    },
}

impl SceneKind {
    /// What rows and the command line call it; patches of any size are one scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tiny => "tiny",
            Self::Zoo => "zoo",
            Self::Patches(_) => "patches",
            Self::Null => "null",
            Self::Bare { storage: false } => "bare",
            Self::Bare { storage: true } => "bare-storage",
        }
    }

    fn exhibit(self) -> Exhibit {
        match self {
            Self::Tiny | Self::Null | Self::Bare { .. } => Exhibit::Triangles,
            Self::Zoo => Exhibit::Balls,
            Self::Patches(side) => Exhibit::Squares(side),
        }
    }
}

/// One mode in one order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cell {
    /// How draws get their materials.
    pub mode: &'static Mode,
    /// In which order they are drawn.
    pub order: Order,
}

/// Cells that are drawn in turn: one scene, one number of materials and draws.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Group {
    /// What is drawn.
    pub scene: SceneKind,
    /// Materials.
    pub materials: u32,
    /// Objects.
    pub draws: u32,
    /// What is measured.
    pub cells: Vec<Cell>,
}

/// All that is measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// `quick`, `full` or `custom`.
    pub name: &'static str,
    /// Its groups, in the order of measuring.
    pub groups: Vec<Group>,
    /// Frames of each cell that count, at least, over all visits.
    pub rounds: u32,
    /// Groups are given further ones until each cell took this long on average, s.
    pub further_seconds: f64,
}

/// Materials of the sweep over them, at `SWEEP_DRAWS` draws.
const SWEEP: [u32; 5] = [1, 8, 64, 256, 4096];
const SWEEP_DRAWS: u32 = 10_000;
/// Draws of the sweep over them, at `SWEEP_MATERIALS` materials.
const DRAWS: [u32; 5] = [100, 1_000, 10_000, 100_000, 1_000_000];
const SWEEP_MATERIALS: u32 = 64;
/// From this many draws on a CPU driver is asked for the base and what draws with one command: with a state
/// command a draw one frame takes ten seconds.
const MANY_DRAWS: u32 = 1_000_000;
/// Materials of the quick plan: a CPU driver compiles the pipelines of more for longer than a minute has.
const QUICK_MATERIALS: u32 = 8;
/// Modes of the quick plan's zoo, whose frames are long.
const QUICK_ZOO: [&str; 5] = [
    ONE_PIPELINE,
    "indirect",
    "set-per-material",
    PIPELINE_PER_MATERIAL,
    DYNAMIC,
];
/// Sides of the squares, pixels.
const SIDES: [u32; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];

/// Some 12 rounds of 10,000 draws on a CPU driver, and the full plan ends within an hour.
pub const FURTHER_SECONDS: f64 = 0.4;

/// See `Group::visits`.
const VISITS: u32 = 6;
/// From so many draws on a CPU driver draws the zoo for more than a second.
const LONG_DRAWS: u32 = 100_000;
/// Pipelines of more materials take a CPU driver more than 4 s to compile.
const LONG_MATERIALS: u32 = 64;

/// Up to so many materials the pipelines of a group's four cells that have one for each are well below a hundred.
const MOST_TOGETHER: u32 = 8;

/// How many pipelines are made for materials; beyond, they are made in turn (`capped`). A CPU driver takes 70 ms and
/// more to compile one, and keeps it in memory.
pub fn most_pipelines(kind: DeviceKind) -> u32 {
    match kind {
        DeviceKind::Cpu => 256,
        _ => 4096,
    }
}

impl Group {
    /// A group of all modes that apply.
    pub fn of_all(scene: SceneKind, materials: u32, draws: u32, modes: &[&'static Mode]) -> Self {
        let cells = modes.iter().flat_map(|mode| cells_of(scene, mode));
        Self {
            scene,
            materials,
            draws,
            cells: cells.collect(),
        }
    }

    /// The same cells in groups whose pipelines a driver can keep: each mode of a pipeline for each material by itself.
    /// Mesa's lavapipe keeps some hundred shaders of this size (2^21 instructions in all), and compiles anew what it dropped.
    pub fn split(self) -> Vec<Self> {
        if self.materials <= MOST_TOGETHER {
            return vec![self];
        }
        let (baked, few): (Vec<_>, Vec<_>) =
            (self.cells.iter().copied()).partition(|cell| cell.mode.source.is_baked());
        let same = |a: &Cell, b: &Cell| a.mode.name == b.mode.name;
        let baked = baked.chunk_by(same).map(<[Cell]>::to_vec);
        let groups = [few]
            .into_iter()
            .chain(baked)
            .filter(|cells| !cells.is_empty());
        let group = |cells| Self {
            cells,
            ..self.clone()
        };
        groups.map(group).collect()
    }

    /// Devices on which it is drawn, one after the other, in so many rounds: as many medians as an interval of 95 % needs.
    /// One where drawing or compiling takes long: the hour that a full plan has is better spent on frames.
    pub fn visits(&self, rounds: u32) -> u32 {
        let baked = self.cells.iter().any(|cell| cell.mode.source.is_baked());
        let long = self.draws >= LONG_DRAWS || baked && self.materials > LONG_MATERIALS;
        if long { 1 } else { rounds.clamp(1, VISITS) }
    }

    /// The wall that it draws, with so many distinct materials and pictures.
    pub fn wall(&self, distinct: u32, pictures: u32) -> Wall {
        Wall {
            exhibit: self.scene.exhibit(),
            objects: self.draws,
            materials: self.materials,
            distinct: distinct.min(self.materials),
            pictures: pictures.min(self.materials),
        }
    }

    /// Whether a row is one of its cells.
    pub fn has(&self, cell: &Cell, row: &BenchRow) -> bool {
        let side = match self.scene {
            SceneKind::Patches(side) => f64::from(side).powi(2),
            _ => row.pixels_per_draw,
        };
        row.mode == cell.mode.name
            && row.order == cell.order.name()
            && row.scene == self.scene.name()
            && row.materials == self.materials
            && row.draws == self.draws
            && row.pixels_per_draw == side
    }
}

/// A mode in the orders that matter to it. Without anything between its draws it is measured shuffled alone, unless it is
/// what sorted modes are compared with.
fn cells_of(scene: SceneKind, mode: &'static Mode) -> Vec<Cell> {
    // Of a wall with glass the unblended picture is another.
    let opaque = scene != SceneKind::Zoo;
    if mode.output != Output::Blended && !opaque {
        return Vec::new();
    }
    if matches!(scene, SceneKind::Bare { .. }) && !BareCase::has(mode) {
        return Vec::new();
    }
    // What is not rasterised shows no pictures.
    if scene == SceneKind::Null && mode.source.has_pictures() {
        return Vec::new();
    }
    let is_base = MODES.iter().any(|other| other.base == mode.name);
    let control = matches!(mode.change, Change::SamePipeline | Change::SameSet);
    let sorted = is_base || mode.change != Change::Nothing && !control;
    let once = matches!(scene, SceneKind::Patches(_));
    let orders = Order::ALL.into_iter();
    orders
        .filter(|order| match order {
            Order::Sorted => sorted && !once,
            Order::Shuffled => true,
        })
        .map(|order| Cell { mode, order })
        .collect()
}

impl Plan {
    /// What a minute on two cores suffices for.
    pub fn quick() -> Self {
        let modes: Vec<_> = MODES.iter().collect();
        let few: Vec<_> = MODES
            .iter()
            .filter(|m| QUICK_ZOO.contains(&m.name))
            .collect();
        let mut groups = vec![
            Group::of_all(SceneKind::Tiny, QUICK_MATERIALS, 1_000, &modes),
            Group::of_all(SceneKind::Zoo, QUICK_MATERIALS, 500, &few),
            Group::of_all(SceneKind::Null, QUICK_MATERIALS, 1_000, &modes),
        ];
        groups.extend(bare(QUICK_MATERIALS, 1_000, &modes));
        groups.extend([1, 8, 64].map(|side| patches(side, QUICK_MATERIALS)));
        Self {
            name: "quick",
            groups: groups.into_iter().flat_map(Group::split).collect(),
            rounds: 12,
            further_seconds: 0.0,
        }
    }

    /// Both sweeps over three scenes, bare triangles, and the patches; the longest last.
    pub fn full(kind: DeviceKind) -> Self {
        let all: Vec<_> = MODES.iter().collect();
        let mut groups = sweeps(SceneKind::Tiny, kind);
        groups.extend(bare(SWEEP_MATERIALS, SWEEP_DRAWS, &all));
        groups.extend(Self::patches(SWEEP_MATERIALS));
        groups.extend(sweeps(SceneKind::Null, kind));
        groups.extend(sweeps(SceneKind::Zoo, kind));
        Self {
            name: "full",
            groups: groups.into_iter().flat_map(Group::split).collect(),
            rounds: 12,
            further_seconds: FURTHER_SECONDS,
        }
    }

    /// Squares of every measured size, one for each material.
    pub fn patches(materials: u32) -> impl Iterator<Item = Group> {
        SIDES.into_iter().map(move |side| patches(side, materials))
    }

    /// The cells that it has and `rows` has not: each group that lacks some, after its place in the plan.
    pub fn missing(&self, rows: &[BenchRow]) -> Vec<(usize, Group)> {
        let groups = self.groups.iter().enumerate();
        let missing = groups.filter_map(|(place, group)| {
            let done = |cell: &Cell| rows.iter().any(|row| group.has(cell, row));
            let cells: Vec<_> = group.cells.iter().filter(|c| !done(c)).copied().collect();
            let group = Group {
                cells,
                ..group.clone()
            };
            (!group.cells.is_empty()).then_some((place, group))
        });
        missing.collect()
    }
}

/// A scene over materials, and over draws.
fn sweeps(scene: SceneKind, kind: DeviceKind) -> Vec<Group> {
    let all: Vec<_> = MODES.iter().collect();
    let over_materials = SWEEP.map(|materials| Group::of_all(scene, materials, SWEEP_DRAWS, &all));
    let draws = DRAWS.into_iter().filter(|draws| *draws != SWEEP_DRAWS);
    let over_draws = draws.map(|draws| {
        let few = draws >= MANY_DRAWS && kind == DeviceKind::Cpu;
        let kept = |mode: &&&Mode| !few || mode.name == ONE_PIPELINE || is_one_command(mode);
        let modes: Vec<_> = all.iter().filter(kept).copied().collect();
        Group::of_all(scene, SWEEP_MATERIALS, draws, &modes)
    });
    over_materials.into_iter().chain(over_draws).collect()
}

fn is_one_command(mode: &Mode) -> bool {
    matches!(mode.call, Call::Indirect | Call::Instanced)
}

/// Triangles without and with a storage buffer that nobody reads.
fn bare(materials: u32, draws: u32, modes: &[&'static Mode]) -> [Group; 2] {
    let group = |storage| Group::of_all(SceneKind::Bare { storage }, materials, draws, modes);
    [group(false), group(true)]
}

/// Squares of one size, each of a material of its own: the single shader in both builds, and switching.
fn patches(side: u32, materials: u32) -> Group {
    let named = [ONE_PIPELINE, DYNAMIC, PIPELINE_PER_MATERIAL];
    let modes: Vec<_> = MODES.iter().filter(|m| named.contains(&m.name)).collect();
    Group::of_all(SceneKind::Patches(side), materials, materials, &modes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_is_there_once_and_so_is_its_base() {
        for plan in [
            Plan::quick(),
            Plan::full(DeviceKind::Cpu),
            Plan::full(DeviceKind::Discrete),
        ] {
            for group in &plan.groups {
                let same = |other: &&Group| {
                    (other.scene, other.materials, other.draws)
                        == (group.scene, group.materials, group.draws)
                };
                let cells = || plan.groups.iter().filter(same).flat_map(|g| &g.cells);
                for cell in &group.cells {
                    let base = |other: &Cell| {
                        other.mode.name == cell.mode.base && other.order == cell.order
                    };
                    assert!(cells().any(base), "{}: {cell:?}", plan.name);
                    assert_eq!(cells().filter(|other| *other == cell).count(), 1);
                }
            }
        }
    }

    #[test]
    fn what_is_missing_is_what_no_row_has() {
        let plan = Plan::quick();
        let group = &plan.groups[0];
        let options = |cell: &Cell| {
            let timing = super::super::Timing::Submit;
            super::super::rows::row(group, cell, (5, 5), None, Vec::new(), timing)
        };
        let rows: Vec<_> = group.cells.iter().skip(2).map(options).collect();
        let whole: Vec<_> = plan.groups.iter().cloned().enumerate().collect();
        let missing = plan.missing(&rows);
        assert_eq!((missing.len(), missing[0].0), (plan.groups.len(), 0));
        assert_eq!(missing[0].1.cells, group.cells[..2]);
        assert_eq!(missing[1..], whole[1..]);
        let all: Vec<_> = group.cells.iter().map(options).collect();
        assert_eq!(plan.missing(&all), whole[1..]);
    }

    #[test]
    fn patches_of_two_sizes_are_two_groups() {
        let small = patches(8, 16);
        let timing = super::super::Timing::Submit;
        let cell = small.cells[0];
        let row = super::super::rows::row(&small, &cell, (5, 5), None, Vec::new(), timing);
        assert!(small.has(&cell, &row));
        assert!(!patches(64, 16).has(&cell, &row));
    }

    #[test]
    fn both_orders_of_a_mode_stand_in_one_group() {
        for group in Plan::full(DeviceKind::Cpu).groups {
            let orders = |cell: &Cell| cells_of(group.scene, cell.mode).len();
            for cell in group
                .cells
                .iter()
                .filter(|cell| cell.mode.source.is_baked())
            {
                let same = group
                    .cells
                    .iter()
                    .filter(|other| other.mode.name == cell.mode.name);
                assert_eq!(same.count(), orders(cell), "{cell:?}");
            }
        }
    }

    #[test]
    fn a_cpu_is_spared_a_million_state_commands() {
        let modes = |kind| {
            let plan = Plan::full(kind);
            let many = |g: &&Group| g.draws == MANY_DRAWS && g.scene == SceneKind::Tiny;
            let cells = plan.groups.iter().filter(many).flat_map(|g| &g.cells);
            let mut names: Vec<_> = cells.map(|cell| cell.mode.name).collect();
            names.dedup();
            names
        };
        assert_eq!(
            modes(DeviceKind::Cpu),
            [ONE_PIPELINE, "indirect", "instanced"]
        );
        assert_eq!(modes(DeviceKind::Discrete).len(), MODES.len());
    }
}
