//! Which pictures lie on a surface, and what does each change?
//!
//! * base colour: multiplies the albedo;
//! * roughness: multiplies the roughness;
//! * metalness: with M = metalness * map, f0 becomes mix(f0, albedo, M) and albedo becomes
//!   albedo (1 - M), both after the base colour;
//! * normal: turns the normal, in the frame of the tangents; its x and y are scaled first;
//! * emission: multiplies the emission;
//! * occlusion: multiplies the light from everywhere, and no lamp's;
//! * alpha mask: below the cutoff there is no surface.

/// What a texture says of a surface; decides colour space and how it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    BaseColor,
    Roughness,
    Metalness,
    Normal,
    Emission,
    Occlusion,
    AlphaMask,
}

impl Slot {
    /// Every slot.
    pub const ALL: [Self; 7] = [
        Self::BaseColor,
        Self::Roughness,
        Self::Metalness,
        Self::Normal,
        Self::Emission,
        Self::Occlusion,
        Self::AlphaMask,
    ];

    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::BaseColor => "base colour",
            Self::Roughness => "roughness",
            Self::Metalness => "metalness",
            Self::Normal => "normal",
            Self::Emission => "emission",
            Self::Occlusion => "occlusion",
            Self::AlphaMask => "alpha mask",
        }
    }

    /// True where a texel has three values, false where it has one.
    pub(super) fn is_colored(self) -> bool {
        matches!(self, Self::BaseColor | Self::Normal | Self::Emission)
    }
}

/// A material's pictures, as indices into [`Scene::textures`](super::Scene::textures).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maps {
    pub base_color: Option<usize>,
    pub roughness: Option<usize>,
    pub metalness: Option<usize>,
    pub normal: Option<usize>,
    pub emission: Option<usize>,
    pub occlusion: Option<usize>,
    pub alpha_mask: Option<usize>,
    /// How often the pictures repeat per unit of the coordinates, along u and v.
    pub repeat: [f32; 2],
}

impl Default for Maps {
    fn default() -> Self {
        Self {
            base_color: None,
            roughness: None,
            metalness: None,
            normal: None,
            emission: None,
            occlusion: None,
            alpha_mask: None,
            repeat: [1.0; 2],
        }
    }
}

impl Maps {
    /// The texture of a slot.
    pub fn get(&self, slot: Slot) -> Option<usize> {
        match slot {
            Slot::BaseColor => self.base_color,
            Slot::Roughness => self.roughness,
            Slot::Metalness => self.metalness,
            Slot::Normal => self.normal,
            Slot::Emission => self.emission,
            Slot::Occlusion => self.occlusion,
            Slot::AlphaMask => self.alpha_mask,
        }
    }

    /// Puts a texture into a slot.
    pub(super) fn set(&mut self, slot: Slot, texture: usize) {
        let place = match slot {
            Slot::BaseColor => &mut self.base_color,
            Slot::Roughness => &mut self.roughness,
            Slot::Metalness => &mut self.metalness,
            Slot::Normal => &mut self.normal,
            Slot::Emission => &mut self.emission,
            Slot::Occlusion => &mut self.occlusion,
            Slot::AlphaMask => &mut self.alpha_mask,
        };
        *place = Some(texture);
    }

    /// True where the material has no picture.
    pub fn is_empty(&self) -> bool {
        Slot::ALL.iter().all(|&slot| self.get(slot).is_none())
    }
}
