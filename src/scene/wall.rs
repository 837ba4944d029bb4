//! What is drawn to measure a driver: a wall of equal objects, each in a cell of its own?
//!
//! Objects do not touch, so that opaque ones may be drawn in any order and leave the same picture. Everything follows
//! from a few numbers: the same wall on every machine.

use glam::{Affine3A, Vec2, Vec3};

use super::{
    Ambient, Camera, Error, Light, LightKind, Maps, Material, Mesh, Object, Projection, Scene,
    Slot, Texture, built_in_materials, shapes,
};

/// What stands on a wall, and how it is lit.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Exhibit {
    /// Opaque triangles that cover 8 pixels each, under one lamp far away: little but the driver's own work.
    Triangles,
    /// Balls of 120 triangles of the built-in materials, glass too, under four lamps of three kinds, in a picture of one
    /// size: what a user's frame is like.
    Balls,
    /// Squares of so many pixels a side, of the opaque built-in materials under the same four lamps.
    Squares(u32),
}

/// In which order opaque objects are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Order {
    /// Those of a material after each other.
    Sorted,
    /// Anyhow.
    Shuffled,
}

impl Order {
    /// Every order.
    pub const ALL: [Self; 2] = [Self::Sorted, Self::Shuffled];

    /// One lower-case word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sorted => "sorted",
            Self::Shuffled => "shuffled",
        }
    }
}

/// A wall.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Wall {
    /// What stands on it.
    pub exhibit: Exhibit,
    /// Objects, at least one.
    pub objects: u32,
    /// Materials, at least one. Each has as many objects as the others, or one more.
    pub materials: u32,
    /// Only the first so many of them are there; those beyond look like them, in turn.
    pub distinct: u32,
    /// Pictures, of which each material has one, in turn.
    pub pictures: u32,
}

/// The picture of balls, whatever their number, pixels.
const BALLS_SIZE: [u32; 2] = [640, 360];

/// Legs of the triangle, pixels: 8 pixel centres lie inside, and none nearer to an edge than 0.07 pixel, so that no
/// rounding decides about one (corners are snapped to 1/16 of a pixel or less on every device, to 1/256 on most).
const LEGS: [f32; 2] = [4.5, 3.6];
/// Its cell.
const TRIANGLE_CELL: u32 = 5;

/// A ball's radius in cells.
const BALL_RADIUS: f32 = 0.45;
/// Its segments and rows; 12 x 6 has 120 triangles.
const BALL_MESH: (usize, usize) = (12, 6);

/// The side of a material's picture, texels.
const PICTURE_SIDE: u32 = 16;

impl Wall {
    /// Pixels of the picture in which it stands: width and height. Beyond a `u32` they saturate, and no device has them.
    pub fn size(&self) -> (u32, u32) {
        let (columns, rows) = self.grid();
        let times = |cell: u32| (columns.saturating_mul(cell), rows.saturating_mul(cell));
        match self.exhibit {
            Exhibit::Triangles => times(TRIANGLE_CELL),
            Exhibit::Balls => (BALLS_SIZE[0], BALLS_SIZE[1]),
            Exhibit::Squares(side) => times(side.saturating_add(1)),
        }
    }

    /// Pixels that an object covers, about.
    pub fn pixels_per_object(&self) -> f64 {
        match self.exhibit {
            Exhibit::Triangles => 8.0,
            Exhibit::Balls => {
                let cell = f64::from(self.size().1) / f64::from(self.extent().y);
                std::f64::consts::PI * (cell * f64::from(BALL_RADIUS)).powi(2)
            }
            Exhibit::Squares(side) => f64::from(side).powi(2),
        }
    }

    /// Cells in a row, and rows.
    pub fn grid(&self) -> (u32, u32) {
        let aspect = match self.exhibit {
            Exhibit::Balls => f64::from(BALLS_SIZE[0]) / f64::from(BALLS_SIZE[1]),
            Exhibit::Triangles | Exhibit::Squares(_) => 1.0,
        };
        let columns = (f64::from(self.objects) * aspect).sqrt().ceil().max(1.0) as u32;
        (columns, self.objects.div_ceil(columns).max(1))
    }

    /// The material of the object in a cell.
    fn material_of(&self, cell: u32) -> u32 {
        let material = u64::from(cell) * u64::from(self.materials) / u64::from(self.objects.max(1));
        material as u32 % self.distinct.max(1)
    }

    /// The scene, its objects in the order in which they are to be drawn.
    ///
    /// # Errors
    /// None that a built program has: the built-in materials are read.
    pub fn scene(&self, order: Order, seed: u64) -> Result<Scene, Error> {
        let materials = self.palette()?;
        let mut objects: Vec<_> = (0..self.objects).map(|cell| self.object(cell)).collect();
        if order == Order::Shuffled {
            let mut opaque: Vec<_> = objects
                .iter()
                .filter(|object| materials[object.material].opacity >= 1.0)
                .map(|object| (object.material, object.transform))
                .collect();
            fastrand::Rng::with_seed(seed).shuffle(&mut opaque);
            let places = objects
                .iter_mut()
                .filter(|object| materials[object.material].opacity >= 1.0);
            for (object, (material, transform)) in places.zip(opaque) {
                object.material = material;
                object.transform = transform;
            }
        }
        Ok(Scene {
            camera: self.camera(),
            ambient: Ambient {
                sky: [0.6, 0.7, 0.8],
                ground: [0.15, 0.12, 0.1],
            },
            lights: self.lights(),
            materials,
            meshes: vec![self.mesh()],
            textures: self.textures(),
            objects,
            warnings: Vec::new(),
        })
    }

    fn object(&self, cell: u32) -> Object {
        let (columns, _) = self.grid();
        let place = Vec3::new((cell % columns) as f32, (cell / columns) as f32, 0.0);
        Object {
            // A million objects: their names would take longer than their triangles.
            name: String::new(),
            mesh: 0,
            material: self.material_of(cell) as usize,
            transform: Affine3A::from_translation(place),
        }
    }

    /// The world's part that the picture shows, m: all cells, each 1 m.
    fn extent(&self) -> Vec2 {
        let (columns, rows) = self.grid();
        let (width, height) = self.size();
        let [columns, rows, width, height] = [columns, rows, width, height].map(u64::from);
        let rows = match columns * height > rows * width {
            true => columns as f32 * height as f32 / width as f32,
            false => rows as f32,
        };
        Vec2::new(rows * width as f32 / height as f32, rows)
    }

    /// The wall in the middle, its first cell at the lower left.
    fn camera(&self) -> Camera {
        let (columns, rows) = self.grid();
        let middle = Vec3::new(columns as f32, rows as f32, 0.0) / 2.0;
        let height = self.extent().y;
        Camera {
            // As far as the wall is high, and beyond the nearest ball.
            position: middle + Vec3::Z * height.max(2.0),
            target: middle,
            up: Vec3::Y,
            projection: Projection::Orthographic { height },
            exposure_ev100: 0.0,
        }
    }

    /// What stands in each cell; the cell's corners are (0, 0) and (1, 1).
    pub fn mesh(&self) -> Mesh {
        let pixels = |cell: u32, corners: &[[f32; 2]], indices: &[u32]| {
            let corner = |corner: &[f32; 2]| Vec2::from(*corner) / cell as f32;
            flat(corners.iter().map(corner), indices)
        };
        match self.exhibit {
            Exhibit::Triangles => {
                let [a, b] = LEGS;
                pixels(TRIANGLE_CELL, &[[0.0, 0.0], [a, 0.0], [0.0, b]], &[0, 1, 2])
            }
            Exhibit::Squares(side) => {
                let s = side as f32;
                let corners = [[0.0, 0.0], [s, 0.0], [s, s], [0.0, s]];
                pixels(side + 1, &corners, &[0, 1, 2, 0, 2, 3])
            }
            Exhibit::Balls => ball(),
        }
    }

    fn lights(&self) -> Vec<Light> {
        let light = |name: &str, kind| Light {
            name: name.to_owned(),
            color: [1.0; 3],
            shadow: false,
            kind,
        };
        let sun = LightKind::Directional {
            direction: Vec3::new(0.4, -0.5, -0.8).normalize(),
            illuminance: 3.0,
            angular_diameter_degrees: 0.5,
        };
        if self.exhibit == Exhibit::Triangles {
            return vec![light("sun", sun)];
        }
        let extent = self.extent().extend(0.0);
        // In front of the wall, as far as it is high: candela grow with the square of that.
        let lamp = |x: f32, y: f32| extent * Vec3::new(x, y, 0.0) + Vec3::Z * extent.y;
        let intensity = extent.y * extent.y;
        let radius = 0.02 * extent.y;
        let point = |position| LightKind::Point {
            position,
            intensity,
            radius,
        };
        let place = lamp(0.5, 0.9);
        vec![
            light("sun", sun),
            light("left", point(lamp(0.2, 0.7))),
            light("right", point(lamp(0.9, 0.3))),
            light(
                "spot",
                LightKind::Spot {
                    position: place,
                    direction: (extent * 0.5 - place).normalize(),
                    intensity: 3.0 * intensity,
                    radius,
                    inner_degrees: 10.0,
                    outer_degrees: 35.0,
                },
            ),
        ]
    }

    /// The built-in materials in turn, each turn a little darker and smoother than the one before.
    fn palette(&self) -> Result<Vec<Material>, Error> {
        let built_in: Vec<_> = built_in_materials()?
            .into_iter()
            .filter(|material| self.exhibit == Exhibit::Balls || material.opacity >= 1.0)
            .collect();
        let turns = self.materials.div_ceil(built_in.len() as u32).max(1) as f32;
        let count = self.materials.min(self.distinct);
        let material = |number: u32| {
            let number = number as usize;
            let base = &built_in[number % built_in.len()];
            let turn = (number / built_in.len()) as f32 / turns;
            Material {
                name: format!("{} {number}", base.name),
                albedo: base.albedo.map(|channel| channel * (1.0 - 0.5 * turn)),
                roughness: base.roughness * (1.0 - 0.5 * turn),
                maps: Maps {
                    base_color: (self.pictures > 0).then(|| number % self.pictures as usize),
                    ..Maps::default()
                },
                ..base.clone()
            }
        };
        Ok((0..count).map(material).collect())
    }

    /// A picture for each material, in turn: bands of two shades, whose number and shade tell it from the others.
    fn textures(&self) -> Vec<Texture> {
        let count = self.pictures.min(self.materials);
        let texture = |number: u32| {
            let dark = 0.3 + 0.6 * (number as f32 / count as f32);
            let texel = |place: u32| {
                let (x, y) = (place % PICTURE_SIDE, place / PICTURE_SIDE);
                let band = ((x + y * (1 + number % 3)) / 4).is_multiple_of(2);
                let shade = if band { dark } else { 1.0 };
                [shade, shade, 1.0 - 0.3 * shade, 1.0]
            };
            let texels: Vec<_> = (0..PICTURE_SIDE * PICTURE_SIDE).map(texel).collect();
            let name = format!("picture {number}");
            Texture::from_linear(&name, Slot::BaseColor, PICTURE_SIDE, PICTURE_SIDE, &texels)
        };
        // Sides, count and numbers are in range, so that none is missing.
        (0..count).filter_map(texture).collect()
    }
}

/// A flat mesh that faces +z; the picture fills a cell.
fn flat(corners: impl Iterator<Item = Vec2>, indices: &[u32]) -> Mesh {
    let corners: Vec<_> = corners.collect();
    Mesh {
        name: "flat".into(),
        positions: corners
            .iter()
            .map(|corner| corner.extend(0.0).to_array())
            .collect(),
        normals: vec![Vec3::Z.to_array(); corners.len()],
        indices: indices.to_vec(),
        coordinates: corners.iter().map(Vec2::to_array).collect(),
        tangents: Vec::new(),
    }
}

/// A ball in the middle of its cell; the picture lies on it as thrown from the front.
fn ball() -> Mesh {
    let (segments, rows) = BALL_MESH;
    let unit = shapes::ball(segments, rows);
    let middle = Vec3::new(0.5, 0.5, 0.0);
    let place = |position: &[f32; 3]| middle + BALL_RADIUS * Vec3::from_array(*position);
    let positions: Vec<_> = unit.positions.iter().map(|p| place(p).to_array()).collect();
    Mesh {
        coordinates: positions.iter().map(|[x, y, _]| [*x, *y]).collect(),
        positions,
        ..unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_pixel_centres_lie_in_a_triangle_and_none_near_its_edge() {
        let [a, b] = LEGS;
        // The distance to the long edge, positive inside.
        let distance = |x: f32, y: f32| (1.0 - x / a - y / b) / (1.0 / a).hypot(1.0 / b);
        let centres = (0..25).map(|n| ((n % 5) as f32 + 0.5, (n / 5) as f32 + 0.5));
        let distances: Vec<_> = centres.map(|(x, y)| distance(x, y)).collect();
        assert_eq!(distances.iter().filter(|d| **d > 0.0).count(), 8);
        assert!(distances.iter().all(|d| d.abs() > 0.07), "{distances:?}");
    }
}
