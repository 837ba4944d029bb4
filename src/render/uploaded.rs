//! What of a scene is on the device, whatever its frames are like?

use super::draw_list::{DrawList, draw_list};
use super::effects::{Census, EffectSet, Need};
use super::geometry::{Attributes, Geometry};
use super::maps::Maps;
use super::renderer::{RenderError, Renderer};
use crate::scene::Scene;

/// A scene, who in it calls for what, and its triangles and maps on the device.
pub struct Uploaded<'s> {
    pub(super) scene: &'s Scene,
    pub(super) census: Census,
    pub(super) list: DrawList,
    pub(super) geometry: Geometry,
    pub(super) maps: Maps,
}

impl<'s> Uploaded<'s> {
    /// Uploads what frames with no more than the `allowed` effects may need.
    ///
    /// # Errors
    /// The scene is beyond the device, there is no memory, or the driver fails.
    pub fn new(
        renderer: &Renderer,
        scene: &'s Scene,
        allowed: EffectSet,
    ) -> Result<Self, RenderError> {
        let census = Census::of(scene);
        let list = draw_list(scene)?;
        let attributes = attributes(&census, allowed);
        let geometry = Geometry::new(&renderer.device, scene, &list, attributes)
            .map_err(RenderError::of_scene)?;
        let maps = Maps::new(&renderer.device, scene, |slot| {
            census.needs(allowed, Need::Maps(slot))
        })
        .map_err(RenderError::of_scene)?;
        Ok(Self {
            scene,
            census,
            list,
            geometry,
            maps,
        })
    }
}

/// The attributes that the `allowed` effects need.
pub(super) fn attributes(census: &Census, allowed: EffectSet) -> Attributes {
    Attributes {
        coordinates: census.needs(allowed, Need::Coordinates),
        tangents: census.needs(allowed, Need::Tangents),
    }
}
