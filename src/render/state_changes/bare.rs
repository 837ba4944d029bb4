//! What does a state command cost where a draw has nothing else to pay for?
//!
//! Triangles that read one uniform block. The same with a storage buffer in the set that no shader reads tells what the
//! mere presence of one costs: Mesa 22.3's lavapipe then validates all state anew before every draw.

use std::sync::Arc;
use std::time::Instant;

use super::canvas::{Drawing, NAME};
use super::case::Made;
use super::mode::{Call, Change, Mode, Source};
use crate::gpu::{
    Attribute, Binding, BindingKind, Buffer, BufferUse, Constant, DescriptorSet, Device,
    DrawCommand, Error, IndirectDraws, Pass, PassCounts, Pipeline, PipelineCache, PipelineInfo,
    PipelineLayout, Rate, Resource, Samples, SetLayout, Spirv, Targets, VertexFormat, requirements,
};
use crate::interface::reflected::{bindings, constants, values, vertex_inputs};
use crate::interface::{self, spirv};
use crate::scene::{Order, Wall};

/// The place of the set that a draw has of its own.
const PLACE: u32 = 1;

/// The slot of the storage buffer that nobody reads.
const UNREAD_SLOT: u32 = bindings::BareBlock + 1;

/// Bare triangles on the device.
pub struct BareStage {
    device: Arc<Device>,
    /// `Bare` for each order.
    sets: [DescriptorSet; 2],
    own: Vec<DescriptorSet>,
    window: DescriptorSet,
    corners: Buffer,
    indices: Buffer,
    wall: Wall,
}

/// A mode of theirs, ready to draw.
pub struct BareCase<'s> {
    mode: &'static Mode,
    stage: &'s BareStage,
    order: Order,
    pipelines: Vec<Pipeline>,
    indirect: Option<IndirectDraws>,
    made: Made,
}

impl BareStage {
    /// Bare triangles on a wall's cells, in as many shades as it has materials. `storage` puts a buffer into the set that no
    /// shader reads.
    ///
    /// # Errors
    /// There is no memory, or the driver fails.
    pub fn new(device: &Arc<Device>, wall: Wall, storage: bool) -> Result<Self, Error> {
        let binding = |slot, kind| Binding { slot, kind };
        let mut slots = vec![binding(bindings::BareBlock, BindingKind::Uniform)];
        let mut rest = Vec::new();
        if storage {
            slots.push(binding(UNREAD_SLOT, BindingKind::Storage));
            let unread = Buffer::with_data(device, "unread", BufferUse::Storage, &[0; 16])?;
            rest.push(Resource::Buffer(Arc::new(unread)));
        }
        let layout = SetLayout::new(device, "bare", &slots)?;
        let set = |order| {
            let record = record(&wall, order);
            let bytes = bytemuck::bytes_of(&record);
            let block = Buffer::with_data(device, "bare", BufferUse::Uniform, bytes)?;
            let mut resources = vec![Resource::Buffer(Arc::new(block))];
            resources.extend(rest.iter().cloned());
            DescriptorSet::new(&layout, "bare", &resources)
        };
        let mesh = wall.mesh();
        let bytes = |usage, bytes| Buffer::with_data(device, "bare", usage, bytes);
        Ok(Self {
            sets: [set(Order::Sorted)?, set(Order::Shuffled)?],
            own: own_sets(device, wall.materials)?,
            window: window(device, wall.materials)?,
            corners: bytes(BufferUse::Vertices, bytemuck::cast_slice(&mesh.positions))?,
            indices: bytes(BufferUse::Indices, bytemuck::cast_slice(&mesh.indices))?,
            wall,
            device: Arc::clone(device),
        })
    }

    /// The set of an order.
    fn set(&self, order: Order) -> &DescriptorSet {
        match order {
            Order::Sorted => &self.sets[0],
            Order::Shuffled => &self.sets[1],
        }
    }

    /// The shade of a draw, as the shader computes it.
    fn shade(&self, order: Order, draw: u32) -> u32 {
        let shades = self.wall.materials;
        match order {
            Order::Sorted => {
                (u64::from(draw) * u64::from(shades) / u64::from(self.wall.objects)) as u32
            }
            Order::Shuffled => draw % shades,
        }
    }
}

fn record(wall: &Wall, order: Order) -> interface::Bare {
    let (columns, rows) = wall.grid();
    interface::Bare {
        columns,
        rows,
        draws: wall.objects,
        shades: wall.materials,
        sorted: u32::from(order == Order::Sorted),
        ..bytemuck::Zeroable::zeroed()
    }
}

/// A block with each shade, and a set for it.
fn own_sets(device: &Arc<Device>, shades: u32) -> Result<Vec<DescriptorSet>, Error> {
    let block = |shade: u32| {
        let bytes = [shade, 0, 0, 0];
        let bytes = bytemuck::bytes_of(&bytes);
        let buffer = Buffer::with_data(device, "a shade", BufferUse::Uniform, bytes)?;
        Ok(vec![Resource::Buffer(Arc::new(buffer))])
    };
    let contents: Vec<_> = (0..shades).map(block).collect::<Result<_, Error>>()?;
    let layout = own_layout(device, BindingKind::Uniform)?;
    DescriptorSet::several(&layout, "a shade's set", &contents)
}

/// All shades in one buffer, and one set that looks at one of them.
fn window(device: &Arc<Device>, shades: u32) -> Result<DescriptorSet, Error> {
    let stride = device.uniform_alignment().max(BLOCK_BYTES) as usize;
    let mut data = vec![0; shades as usize * stride];
    for (shade, place) in (0_u32..).zip(data.chunks_exact_mut(stride)) {
        place[..4].copy_from_slice(&shade.to_ne_bytes());
    }
    let buffer = Buffer::with_data(device, "shades", BufferUse::UniformWindows, &data)?;
    let layout = own_layout(device, BindingKind::UniformWindow)?;
    let resources = [Resource::Window(Arc::new(buffer), BLOCK_BYTES)];
    DescriptorSet::new(&layout, "shades", &resources)
}

/// `OwnShadeBlock`, as std140 rounds it.
const BLOCK_BYTES: u32 = 16;

fn own_layout(device: &Arc<Device>, kind: BindingKind) -> Result<Arc<SetLayout>, Error> {
    let slot = bindings::OwnShadeBlock;
    SetLayout::new(device, "a shade", &[Binding { slot, kind }])
}

impl<'s> BareCase<'s> {
    /// Whether these triangles can be drawn so: without pictures, and without effects to have at hand.
    pub fn has(mode: &Mode) -> bool {
        !mode.source.has_pictures()
            && !matches!(
                mode.source,
                Source::RecordOfAnyScene | Source::BakedWithOwnSet
            )
    }

    /// Makes what the mode needs.
    ///
    /// # Errors
    /// The device cannot, there is no memory, or the driver fails.
    pub fn new(
        stage: &'s BareStage,
        mode: &'static Mode,
        order: Order,
        cache: &PipelineCache,
    ) -> Result<Self, Error> {
        let device = &stage.device;
        let memory = device.memory_in_use();
        let second = match mode.source {
            Source::Window => &stage.window,
            _ => &stage.own[0],
        };
        let sets = [stage.set(order).layout(), second.layout()];
        let layout = PipelineLayout::new(device, "bare", &sets, size_of::<u32>() as u32)?;
        let shades = if mode.source.is_baked() {
            stage.wall.materials
        } else {
            1
        };
        let before = Instant::now();
        let pipelines: Vec<_> = (0..shades)
            .map(|shade| pipeline(device, &layout, cache, mode, shade))
            .collect::<Result<_, _>>()?;
        let calls_ms = before.elapsed().as_secs_f64() * 1e3;
        let indirect = (mode.call == Call::Indirect)
            .then(|| stage.indirect())
            .transpose()?;
        Ok(Self {
            mode,
            stage,
            order,
            made: Made {
                calls_ms,
                pipelines: pipelines.len() as u64,
                memory_bytes: device.memory_in_use().saturating_sub(memory),
            },
            pipelines,
            indirect,
        })
    }

    fn pipeline(&self, shade: u32) -> &Pipeline {
        &self.pipelines[(shade as usize).min(self.pipelines.len() - 1)]
    }

    /// Binds the second set as draws of this shade need it.
    fn own<'a>(&'a self, pass: &mut Pass<'_, 'a>, shade: u32) {
        let stage = self.stage;
        match self.mode.source {
            Source::Window => {
                let stride = stage.device.uniform_alignment().max(BLOCK_BYTES);
                pass.bind_set_at(PLACE, &stage.window, shade * stride);
            }
            _ => pass.bind_set(PLACE, &stage.own[shade as usize]),
        }
    }

    fn change<'a>(&'a self, pass: &mut Pass<'_, 'a>, shade: u32) {
        match self.mode.change {
            Change::Nothing => {}
            Change::Push => pass.push_constants(&shade.to_ne_bytes()),
            Change::Window | Change::Set => self.own(pass, shade),
            Change::Pipeline | Change::SamePipeline => pass.bind_pipeline(self.pipeline(shade)),
            Change::SameSet => pass.bind_set(0, self.stage.set(self.order)),
            Change::PipelineAndSet => {
                pass.bind_pipeline(self.pipeline(shade));
                self.own(pass, shade);
            }
        }
    }
}

impl Drawing for BareCase<'_> {
    fn made(&self) -> Made {
        self.made
    }

    fn expected(&self) -> PassCounts {
        let draws = self.stage.wall.objects;
        let shade = |draw| self.stage.shade(self.order, draw);
        let changes = (1..draws)
            .filter(|draw| shade(*draw) != shade(draw - 1))
            .count() as u64;
        let [pipelines, sets, pushes] = self.mode.change.binds().map(|binds| binds * changes);
        let drawn = u64::from(self.mode.call != Call::Nothing);
        PassCounts {
            name: NAME.to_owned(),
            draws: match self.mode.call {
                Call::Each => draws.into(),
                Call::Indirect | Call::Instanced => 1,
                Call::Nothing => 0,
            },
            pipeline_binds: drawn * (1 + pipelines),
            descriptor_set_binds: drawn * (2 + sets),
            push_constants: drawn * (1 + pushes),
            cull_changes: 0,
        }
    }

    fn commands<'a>(&'a self, pass: &mut Pass<'_, 'a>) {
        if self.mode.call == Call::Nothing {
            return;
        }
        let stage = self.stage;
        let mut last = stage.shade(self.order, 0);
        pass.bind_pipeline(self.pipeline(last));
        pass.bind_set(0, stage.set(self.order));
        self.own(pass, last);
        pass.push_constants(&last.to_ne_bytes());
        pass.bind_geometry(&[&stage.corners], &stage.indices);
        let indices = 0..(stage.indices.bytes() / 4) as u32;
        match (self.mode.call, &self.indirect) {
            (_, Some(draws)) => pass.draw_indirect(draws),
            (Call::Instanced, _) => pass.draw_instances(indices, 0, 0..stage.wall.objects),
            _ => {
                for draw in 0..stage.wall.objects {
                    let shade = stage.shade(self.order, draw);
                    if shade != last {
                        self.change(pass, shade);
                        last = shade;
                    }
                    pass.draw(indices.clone(), 0, draw);
                }
            }
        }
    }
}

impl BareStage {
    fn indirect(&self) -> Result<IndirectDraws, Error> {
        let command = |instance| DrawCommand {
            indices: 0..(self.indices.bytes() / 4) as u32,
            vertex_offset: 0,
            instance,
        };
        let commands: Vec<_> = (0..self.wall.objects).map(command).collect();
        IndirectDraws::new(&self.device, "bare draws", &commands)
    }
}

fn pipeline(
    device: &Arc<Device>,
    layout: &Arc<PipelineLayout>,
    cache: &PipelineCache,
    mode: &Mode,
    shade: u32,
) -> Result<Pipeline, Error> {
    let source = match mode.source {
        Source::Pushed => values::BARE_PUSHED,
        Source::Window | Source::OwnSet => values::BARE_BOUND,
        Source::Baked => values::BARE_COMPILED,
        _ => values::BARE_NUMBER,
    };
    let constants = [
        (constants::BARE_SOURCE, source),
        (constants::BARE_SHADE, shade.cast_signed()),
    ]
    .map(|(id, value)| Constant { id, value });
    let info = PipelineInfo {
        name: &format!("bare {}", mode.name),
        vertex: Spirv(spirv::BARE_VERT),
        fragment: Some(Spirv(spirv::BARE_FRAG)),
        attributes: &[Attribute {
            location: vertex_inputs::in_position,
            format: VertexFormat::Rgb32Float,
            rate: Rate::PerVertex,
        }],
        constants: &constants,
        targets: Targets {
            color: Some(requirements::COLOR),
            depth: requirements::DEPTH,
            samples: Samples::One,
        },
        output: mode.output,
    };
    Pipeline::new(device, layout, cache, &info)
}
