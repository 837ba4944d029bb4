//! Which models does the program make by itself?
//!
//! Each shape is a function without input: the same triangles on every run. A shape has
//! named parts, so that a scene can give each its own material. Form carries what a texture
//! would: pile, threads, growth rings and studs are triangles.

mod basic;
mod bricks;
mod bullion;
mod bust;
mod goblet;
mod hand;
mod hardware;
mod kettle;
mod loft;
mod noise;
mod rug;
mod sdf;
mod soil;
mod surface;
mod surface_nets;
mod timber;

use super::Mesh;
use surface::Surface;

/// A piece of a shape that has one material.
pub struct Part {
    /// What a scene file calls it.
    pub name: &'static str,
    /// Metres, +y up.
    pub mesh: Mesh,
}

fn part(name: &'static str, surface: Surface) -> Part {
    let mesh = Mesh {
        name: name.to_owned(),
        positions: surface.positions.iter().map(|p| p.to_array()).collect(),
        normals: surface.normals.iter().map(|n| n.to_array()).collect(),
        indices: surface.indices,
        ..Mesh::default()
    };
    Part { name, mesh }
}

/// A ball of radius 1 m around the origin, of so many segments and rows.
pub fn ball(segments: usize, rows: usize) -> Mesh {
    part("ball", basic::ball(segments, rows)).mesh
}

/// Lists the shapes once: variant, name in a scene file, maker, what it is.
macro_rules! shapes {
    ($($variant:ident $name:literal $make:path, $what:literal;)*) => {
        /// A model of the program's own making, about 1 m tall, standing on y = 0.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum Shape { $(#[doc = $what] $variant,)* }

        impl Shape {
            /// Every shape.
            pub const ALL: &'static [Shape] = &[$(Shape::$variant,)*];

            /// What a scene file calls it.
            pub fn name(self) -> &'static str {
                match self { $(Shape::$variant => $name,)* }
            }

            /// The shape of that name.
            pub fn from_name(name: &str) -> Option<Shape> {
                Shape::ALL.iter().copied().find(|shape| shape.name() == name)
            }

            /// Makes its triangles; a shape has at least one part, and no two of one name.
            pub fn parts(self) -> Vec<Part> {
                match self { $(Shape::$variant => $make(),)* }
            }
        }
    };
}

shapes! {
    Sphere "sphere" basic::sphere, "Radius 1 m, centred at the origin.";
    Plane "plane" basic::plane, "2 m x 2 m at y = 0, facing up.";
    Cube "cube" basic::cube, "Side 1 m, standing on y = 0.";
    Plinth "plinth" basic::plinth, "A square museum pedestal, 1 m tall.";
    Drum "drum" basic::drum, "A round museum pedestal, 1 m tall.";
    Shadow "shadow" basic::shadow, "A soft disc of radius 1 m, to be dark and translucent under a model.";
    Goblet "goblet" goblet::goblet, "Glass: a goblet with wine, and a carafe.";
    Bust "bust" bust::bust, "Plaster: a head of curls on a turned foot.";
    Hand "hand" hand::hand, "Skin: a hand seen from its back.";
    Bricks "bricks" bricks::bricks, "Plastic: studded toy bricks.";
    Timber "timber" timber::timber, "Wood: a sawn log on boards.";
    Rug "rug" rug::rug, "Carpet: a half-rolled rug.";
    Soil "soil" soil::soil, "Dirt: a heap with a seedling.";
    Hardware "hardware" hardware::hardware, "Metal: gear wheel, bolt and nuts.";
    Bullion "bullion" bullion::bullion, "Gold: ingots and coins.";
    Kettle "kettle" kettle::kettle, "Copper: a hammered kettle.";
    Backdrop "backdrop" basic::backdrop, "Floor and wall of a room, joined by a wide curve.";
}
