//! Where does a group's every cell draw, and with which of its materials?

use std::cell::RefCell;
use std::sync::Arc;

use super::plan::{Cell, Group, SceneKind, most_pipelines};
use super::{BenchError, Options};
use crate::gpu::{self, DeviceKind, PipelineCache};
use crate::render::Renderer;
use crate::render::state_changes::{BareCase, BareStage, Case, Drawing, Equipment, Mode, Stage};
use crate::scene::{Order, Scene};

/// Distinct pictures that are made; further materials share them in turn. Every device has this many layers.
pub const MOST_PICTURES: u32 = 256;

/// A group's scenes on the host, which its stages borrow. A device's kind says how many pipelines it is asked for.
pub struct Scenes {
    /// None for bare triangles.
    scenes: Vec<Ordered>,
    distinct: u32,
    size: (u32, u32),
}

/// The scene of one order.
struct Ordered {
    order: Order,
    /// Whether materials beyond those that have pipelines of their own look like those in turn.
    folded: bool,
    scene: Scene,
}

impl Scenes {
    /// Makes them.
    ///
    /// # Errors
    /// None that a built program has.
    pub fn new(kind: DeviceKind, group: &Group, options: &Options) -> Result<Self, BenchError> {
        let distinct = most_pipelines(kind).min(group.materials);
        let pictures = group
            .cells
            .iter()
            .any(|cell| cell.mode.source.has_pictures());
        let pictures = if pictures { MOST_PICTURES } else { 0 };
        let mut scenes = Vec::new();
        let bare = matches!(group.scene, SceneKind::Bare { .. });
        for order in Order::ALL.into_iter().filter(|_| !bare) {
            let of_order = || group.cells.iter().filter(|cell| cell.order == order);
            let baked = of_order().any(|cell| cell.mode.source.is_baked());
            for folded in [false, true] {
                let wanted = match folded {
                    false => of_order().count() > 0,
                    true => baked && distinct < group.materials,
                };
                if wanted {
                    let distinct = if folded { distinct } else { group.materials };
                    let scene = group.wall(distinct, pictures).scene(order, options.seed)?;
                    scenes.push(Ordered {
                        order,
                        folded,
                        scene,
                    });
                }
            }
        }
        Ok(Self {
            scenes,
            distinct,
            size: group.wall(distinct, 0).size(),
        })
    }

    /// Pixels of the picture.
    pub fn size(&self) -> (u32, u32) {
        self.size
    }
}

/// A group's scenes on the device.
pub enum Stages<'s> {
    /// Walls, as `Scenes` has them.
    Walls(Box<Walls<'s>>),
    /// Bare triangles.
    Bare(Box<BareStage>),
}

/// A group's walls on the device.
pub struct Walls<'s> {
    scenes: &'s Scenes,
    /// Scene by scene.
    stages: Vec<Stage<'s>>,
    /// Whether triangles end before the rasteriser.
    discard: bool,
    /// By mode, and whether the scene is folded: both orders have the same materials, and a pipeline takes a CPU driver a tenth
    /// of a second.
    equipment: RefCell<Vec<(EquipmentKey, Arc<Equipment>)>>,
}

/// Mode, and whether the scene is folded.
type EquipmentKey = (&'static str, bool);

impl Walls<'_> {
    fn folded(&self, cell: &Cell) -> bool {
        self.scenes.scenes[place(self.scenes, cell)].folded
    }

    fn equipment(
        &self,
        place: usize,
        mode: &'static Mode,
        cache: &PipelineCache,
    ) -> Result<Arc<Equipment>, gpu::Error> {
        let key = (mode.name, self.scenes.scenes[place].folded);
        let mut all = self.equipment.borrow_mut();
        if let Some((_, known)) = all.iter().find(|(known, _)| *known == key) {
            return Ok(Arc::clone(known));
        }
        let new = Arc::new(Equipment::new(
            &self.stages[place],
            mode,
            self.discard,
            cache,
        )?);
        all.push((key, Arc::clone(&new)));
        Ok(new)
    }
}

impl<'s> Stages<'s> {
    /// Uploads them.
    ///
    /// # Errors
    /// A scene is beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &'s Renderer,
        group: &Group,
        scenes: &'s Scenes,
    ) -> Result<Self, BenchError> {
        if let SceneKind::Bare { storage } = group.scene {
            let wall = group.wall(group.materials, 0);
            let stage = BareStage::new(renderer.device(), wall, storage)?;
            return Ok(Self::Bare(Box::new(stage)));
        }
        let stages = scenes.scenes.iter();
        let stages = stages.map(|ordered| Stage::new(renderer, &ordered.scene, scenes.size));
        Ok(Self::Walls(Box::new(Walls {
            scenes,
            stages: stages.collect::<Result<_, _>>()?,
            discard: group.scene == SceneKind::Null,
            equipment: RefCell::default(),
        })))
    }

    /// A mode, ready to draw where a cell draws.
    ///
    /// # Errors
    /// The device cannot, there is no memory, or the driver fails.
    pub fn case<'a>(
        &'a self,
        cell: &Cell,
        mode: &'static Mode,
        cache: &PipelineCache,
    ) -> Result<Box<dyn Drawing + 'a>, gpu::Error> {
        Ok(match self {
            Self::Walls(walls) => {
                let place = place(walls.scenes, cell);
                let equipment = walls.equipment(place, mode, cache)?;
                Box::new(Case::with(&walls.stages[place], mode, equipment)?)
            }
            Self::Bare(stage) => Box::new(BareCase::new(stage, mode, cell.order, cache)?),
        })
    }

    /// Which of the pictures that a group leaves is this cell's.
    pub fn picture(&self, cell: &Cell) -> PictureKey {
        let of = cell.mode.picture_of();
        match self {
            Self::Walls(walls) => PictureKey {
                of,
                folded: walls.folded(cell),
                order: None,
            },
            // Shades follow the number of the draw, not the place.
            Self::Bare(_) => PictureKey {
                of,
                folded: false,
                order: Some(cell.order),
            },
        }
    }

    /// How many pipelines there are for materials, where not all have one.
    pub fn cap(&self, cell: &Cell) -> Option<u32> {
        match self {
            Self::Walls(walls) => walls.folded(cell).then_some(walls.scenes.distinct),
            Self::Bare(_) => None,
        }
    }
}

/// Cells of one key leave one picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PictureKey {
    /// The mode that leaves it, if a cell leaves any.
    pub of: Option<&'static str>,
    folded: bool,
    order: Option<Order>,
}

/// The scene of a cell. Folded scenes come after those that are not.
fn place(scenes: &Scenes, cell: &Cell) -> usize {
    let baked = cell.mode.source.is_baked();
    let mine = |scene: &Ordered| scene.order == cell.order && (!scene.folded || baked);
    scenes.scenes.iter().rposition(mine).unwrap_or_default()
}
