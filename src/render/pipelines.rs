//! Which pipelines were made so far, and with which constants?

use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use super::effects::States;
use super::geometry::Attributes;
use super::inspection::Inspection;
use super::variant::Variant;
use crate::gpu::{
    Attribute, Constant, Device, Error, Output, Pipeline, PipelineCache, PipelineInfo,
    PipelineLayout, Samples, Spirv, Targets, requirements,
};
use crate::interface::reflected::constants;
use crate::interface::spirv;

/// What tells one pipeline from another; never a material as such.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PipelineKey {
    /// The pass that it is for.
    pub pass: PassKey,
    /// The effects that are compiled in.
    pub states: States,
    /// The size classes of maps that it tells apart.
    pub map_classes: i32,
}

/// What a pass asks of its pipelines.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum PassKey {
    /// The pass `shading`.
    Surface {
        variant: Variant,
        inspection: Inspection,
        attributes: Attributes,
        samples: Samples,
    },
    /// The pass `shadow`; with a fragment stage where materials have holes.
    Shadow {
        masked: bool,
        attributes: Attributes,
    },
}

impl PipelineKey {
    pub fn inputs(&self) -> Vec<Attribute> {
        match self.pass {
            PassKey::Surface { attributes, .. } => attributes.surface().into(),
            PassKey::Shadow { attributes, .. } => attributes.shadow().into(),
        }
    }

    fn stages(&self) -> (Spirv, Option<Spirv>) {
        let (vertex, fragment) = match self.pass {
            PassKey::Surface { .. } => (spirv::SURFACE_VERT, Some(spirv::SURFACE_FRAG)),
            PassKey::Shadow { masked, .. } => {
                (spirv::SHADOW_VERT, masked.then_some(spirv::SHADOW_FRAG))
            }
        };
        (Spirv(vertex), fragment.map(Spirv))
    }

    /// The constants of all stages; a stage passes over those that it does not have.
    pub fn constants(&self, subpixel_bits: u32) -> Vec<Constant> {
        let (variant, inspection) = match self.pass {
            PassKey::Surface {
                variant,
                inspection,
                ..
            } => (variant, inspection),
            PassKey::Shadow { .. } => (Variant::default(), Inspection::Nothing),
        };
        let tables = [
            (constants::MAP_CLASSES, self.map_classes),
            (constants::SHADOW_SNAP_BITS, subpixel_bits.cast_signed()),
        ]
        .map(|(id, value)| Constant { id, value });
        let variant = variant.constants().into_iter();
        variant
            .chain(inspection.constants())
            .chain(self.states.constants())
            .chain(tables)
            .collect()
    }

    fn output(&self) -> Output {
        match self.pass {
            PassKey::Surface { inspection, .. } => inspection.output(),
            PassKey::Shadow { .. } => Output::Blended,
        }
    }

    pub fn targets(&self) -> Targets {
        let (color, samples) = match self.pass {
            PassKey::Surface { samples, .. } => (Some(requirements::COLOR), samples),
            PassKey::Shadow { .. } => (None, Samples::One),
        };
        Targets {
            color,
            depth: requirements::DEPTH,
            samples,
        }
    }
}

impl fmt::Display for PipelineKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.pass {
            PassKey::Surface {
                variant,
                inspection,
                ..
            } => write!(f, "surface[{variant}; {}{inspection}]", self.states),
            PassKey::Shadow { masked: true, .. } => write!(f, "shadow[alpha-mask]"),
            PassKey::Shadow { masked: false, .. } => write!(f, "shadow"),
        }
    }
}

/// The pipelines of a device; they share one layout.
pub struct Pipelines {
    device: Arc<Device>,
    layout: Arc<PipelineLayout>,
    cache: PipelineCache,
    made: Mutex<Vec<(PipelineKey, Arc<Pipeline>)>>,
}

impl Pipelines {
    /// None yet. What the driver compiles is kept in `cache_folder`, if there is one.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(
        device: &Arc<Device>,
        layout: &Arc<PipelineLayout>,
        cache_folder: Option<&Path>,
    ) -> Result<Self, Error> {
        Ok(Self {
            device: Arc::clone(device),
            layout: Arc::clone(layout),
            cache: PipelineCache::open(device, cache_folder)?,
            made: Mutex::default(),
        })
    }

    /// Keeps what the driver compiled.
    pub fn save(&self) {
        self.cache.save();
    }

    /// The pipeline of a key; made, if it was not there.
    ///
    /// # Errors
    /// The driver fails.
    pub fn get(&self, key: PipelineKey) -> Result<Arc<Pipeline>, Error> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, pipeline)) = made.iter().find(|(known, _)| *known == key) {
            return Ok(Arc::clone(pipeline));
        }
        let pipeline = Arc::new(self.make(key)?);
        made.push((key, Arc::clone(&pipeline)));
        Ok(pipeline)
    }

    fn make(&self, key: PipelineKey) -> Result<Pipeline, Error> {
        let (vertex, fragment) = key.stages();
        let info = PipelineInfo {
            name: &key.to_string(),
            vertex,
            fragment,
            attributes: &key.inputs(),
            constants: &key.constants(self.device.subpixel_bits()),
            targets: key.targets(),
            output: key.output(),
        };
        Pipeline::new(&self.device, &self.layout, &self.cache, &info)
    }
}
