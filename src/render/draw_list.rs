//! What is drawn, in which order?
//!
//! Opaque objects first, by the faces that are culled and else in the scene's order; then what lets light through, far to near by object,
//! and within an object far to near by triangle, so that both walls of a glass are seen through it.

use std::ops::Range;

use glam::Vec3;

use crate::gpu::Cull;
use crate::render::camera;
use crate::scene::{Mesh, Object, Scene};

/// One draw command: a range of the index buffer, read for one object.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Draw {
    /// Which indices.
    pub indices: Range<u32>,
    /// Where the object's vertices start.
    pub vertex_offset: i32,
    /// The object's number: its record in `instances`.
    pub instance: u32,
    /// Which of its faces are there.
    pub faces: Faces,
}

/// Which faces of an object are seen. In this order opaque objects are drawn, so that the rasteriser is told seldom.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Faces {
    /// Also from behind.
    pub two_sided: bool,
    /// The object's map mirrors it, and what is the front runs the other way round.
    pub mirrored: bool,
}

impl Faces {
    fn of(scene: &Scene, object: &Object) -> Self {
        Self {
            two_sided: scene.materials[object.material].two_sided,
            mirrored: object.transform.matrix3.determinant().signum() < 0.0,
        }
    }

    /// What the rasteriser drops; all backs where faces may have only one side.
    pub(super) fn cull(self, may_have_two_sides: bool) -> Cull {
        match (self.two_sided && may_have_two_sides, self.mirrored) {
            (true, _) => Cull::None,
            (false, false) => Cull::Back,
            (false, true) => Cull::Front,
        }
    }
}

impl Draw {
    /// Its first triangle alone, if it has one.
    pub(super) fn one_triangle(&self) -> Option<Self> {
        let Range { start, end } = self.indices;
        (end >= start + 3).then(|| Self {
            indices: start..start + 3,
            ..self.clone()
        })
    }
}

/// Draws, and the indices that they read: those of every mesh in turn, then one sorted copy for each
/// transparent object.
pub struct DrawList {
    /// In the order of drawing.
    pub draws: Vec<Draw>,
    /// The indices of transparent objects, to be appended to those of the meshes.
    pub sorted_indices: Vec<u32>,
}

/// More of something than can be drawn.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene has {count} {what}, and at most {most} can be drawn")]
pub struct TooMany {
    count: u64,
    what: &'static str,
    most: u64,
}

impl TooMany {
    pub(super) fn new(count: u64, what: &'static str, most: u64) -> Self {
        Self { count, what, most }
    }

    /// More than a draw's signed 32-bit offset reaches.
    fn for_an_offset(count: u64, what: &'static str) -> Self {
        Self::new(count, what, i32::MAX as u64)
    }
}

/// The draws of a scene.
///
/// # Errors
/// More indices or vertices than can be drawn.
pub fn draw_list(scene: &Scene) -> Result<DrawList, TooMany> {
    let mesh_indices = starts(scene, "indices", |mesh| mesh.indices.len())?;
    let mesh_vertices = starts(scene, "vertices", |mesh| mesh.positions.len())?;
    let (mut opaque, transparent): (Vec<_>, Vec<_>) = (0..)
        .zip(&scene.objects)
        .partition(|(_, object)| scene.materials[object.material].opacity >= 1.0);
    // Stable: of two faces in one place the first stays.
    opaque.sort_by_key(|(_, object)| Faces::of(scene, object));
    let transparent = far_to_near(transparent, |(_, object)| middle(scene, object));

    let mut list = DrawList {
        draws: Vec::with_capacity(scene.objects.len()),
        sorted_indices: Vec::new(),
    };
    let vertex_offset = |object: &Object| mesh_vertices[object.mesh].cast_signed();
    for (instance, object) in opaque {
        let start = mesh_indices[object.mesh];
        // Fits: `starts` checked the sum of all lengths.
        let length = scene.meshes[object.mesh].indices.len() as u32;
        list.draws.push(Draw {
            indices: start..start + length,
            vertex_offset: vertex_offset(object),
            instance,
            faces: Faces::of(scene, object),
        });
    }
    let mut next = *mesh_indices.last().unwrap_or(&0);
    for (instance, object) in transparent {
        let sorted = sorted_triangles(scene, object);
        let end = u64::from(next) + sorted.len() as u64;
        let end = i32::try_from(end)
            .map_err(|_| TooMany::for_an_offset(end, "indices"))?
            .cast_unsigned();
        list.draws.push(Draw {
            indices: next..end,
            vertex_offset: vertex_offset(object),
            instance,
            faces: Faces::of(scene, object),
        });
        list.sorted_indices.extend(sorted);
        next = end;
    }
    Ok(list)
}

/// Where each mesh starts when all lie one behind the other, and where the last one ends.
fn starts(
    scene: &Scene,
    what: &'static str,
    length: impl Fn(&Mesh) -> usize,
) -> Result<Vec<u32>, TooMany> {
    let mut sum = 0_u64;
    let mut starts = vec![0];
    for mesh in &scene.meshes {
        sum += length(mesh) as u64;
        // Signed, since a draw's vertex offset is.
        let fits = i32::try_from(sum).map_err(|_| TooMany::for_an_offset(sum, what))?;
        starts.push(fits.cast_unsigned());
    }
    Ok(starts)
}

/// The distance of the middle of an object's box.
fn middle(scene: &Scene, object: &Object) -> f32 {
    let center = scene.meshes[object.mesh].bounds().center();
    camera::distance(&scene.camera, object.transform.transform_point3(center))
}

/// An object's indices, its triangles far to near.
fn sorted_triangles(scene: &Scene, object: &Object) -> Vec<u32> {
    let mesh = &scene.meshes[object.mesh];
    let distance = |triangle: &[u32; 3]| {
        let sum: Vec3 = triangle
            .iter()
            .map(|&i| Vec3::from_array(mesh.positions[i as usize]))
            .sum();
        camera::distance(&scene.camera, object.transform.transform_point3(sum / 3.0))
    };
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    far_to_near(triangles.to_vec(), distance).concat()
}

/// Sorted by a distance that is taken once an item. Stable, so that equal distances keep their order
/// and pictures repeat.
fn far_to_near<T>(items: Vec<T>, distance: impl Fn(&T) -> f32) -> Vec<T> {
    let mut keyed: Vec<_> = items
        .into_iter()
        .map(|item| (distance(&item), item))
        .collect();
    keyed.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    keyed.into_iter().map(|(_, item)| item).collect()
}
