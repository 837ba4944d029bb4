//! Are the program's own models sound: finite, facing outward, closed, and the same every time?

use std::collections::{BTreeMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use glam::Vec3;
use umber::scene::Mesh;
use umber::scene::shapes::{Part, Shape};

/// The zoo shows all shapes but the plain ones; lavapipe's time goes with triangles.
const TRIANGLES_OF_ALL: usize = 320_000;

/// Parts that are closed surfaces. The others are open by design: sheets (`plane`, `backdrop`, `shadow`),
/// or pieces of a surface that a pattern cuts (grain, bark, nails, damp soil).
const CLOSED: &[(Shape, &str)] = &[
    (Shape::Sphere, "sphere"),
    (Shape::Cube, "cube"),
    (Shape::Plinth, "plinth"),
    (Shape::Drum, "drum"),
    (Shape::Goblet, "glass"),
    (Shape::Goblet, "wine"),
    (Shape::Bust, "plaster"),
    (Shape::Bricks, "red"),
    (Shape::Bricks, "blue"),
    (Shape::Bricks, "yellow"),
    (Shape::Bricks, "green"),
    (Shape::Rug, "backing"),
    (Shape::Rug, "fringe"),
    (Shape::Soil, "pebbles"),
    (Shape::Hardware, "steel"),
    (Shape::Bullion, "gold"),
    (Shape::Kettle, "copper"),
    (Shape::Kettle, "grip"),
];

fn each_part(mut check: impl FnMut(Shape, &Part)) {
    for shape in Shape::ALL {
        for part in shape.parts() {
            check(*shape, &part);
        }
    }
}

fn corners(mesh: &Mesh, face: &[u32]) -> [Vec3; 3] {
    [0, 1, 2].map(|k| Vec3::from(mesh.positions[face[k] as usize]))
}

#[test]
fn names_are_unique_and_found_again() {
    let names: HashSet<&str> = Shape::ALL.iter().map(|shape| shape.name()).collect();
    assert_eq!(names.len(), Shape::ALL.len());
    for shape in Shape::ALL {
        assert_eq!(Shape::from_name(shape.name()), Some(*shape));
        let parts: Vec<_> = shape.parts().iter().map(|part| part.name).collect();
        let distinct: HashSet<_> = parts.iter().collect();
        assert!(
            !parts.is_empty() && distinct.len() == parts.len(),
            "{}: {parts:?}",
            shape.name()
        );
    }
    assert_eq!(Shape::from_name("teapot"), None);
}

#[test]
fn indices_positions_and_normals_are_valid() {
    each_part(|shape, part| {
        let (mesh, at) = (&part.mesh, format!("{} / {}", shape.name(), part.name));
        assert_eq!(mesh.positions.len(), mesh.normals.len(), "{at}");
        assert!(
            !mesh.indices.is_empty() && mesh.indices.len().is_multiple_of(3),
            "{at}"
        );
        let count = mesh.positions.len();
        assert!(
            mesh.indices.iter().all(|index| (*index as usize) < count),
            "{at}"
        );
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(Vec3::from(*position).is_finite(), "{at}: {position:?}");
            let length = Vec3::from(*normal).length();
            // 1e-3 of length is far below what shading shows, and far above rounding.
            assert!(
                (length - 1.0).abs() < 1e-3,
                "{at}: normal {normal:?} has length {length}"
            );
        }
    });
}

#[test]
fn shapes_stand_on_the_ground_about_a_metre_tall() {
    for shape in Shape::ALL {
        if matches!(
            shape,
            Shape::Sphere | Shape::Plane | Shape::Backdrop | Shape::Shadow
        ) {
            continue;
        }
        let parts = shape.parts();
        let points = || parts.iter().flat_map(|part| part.mesh.positions.iter());
        let low = points().fold(f32::MAX, |low, p| low.min(p[1]));
        let high = points().fold(f32::MIN, |high, p| high.max(p[1]));
        // Clods and wheels dig in a little; nothing floats.
        assert!(
            (-0.06..=0.005).contains(&low),
            "{}: lowest point {low}",
            shape.name()
        );
        assert!(
            (0.4..=1.05).contains(&high),
            "{}: highest point {high}",
            shape.name()
        );
    }
}

#[test]
fn normals_agree_with_the_winding() {
    each_part(|shape, part| {
        let mesh = &part.mesh;
        let against = mesh.indices.chunks_exact(3).filter(|face| {
            let [a, b, c] = corners(mesh, face);
            let normal = (b - a).cross(c - a);
            face.iter()
                .any(|v| normal.dot(Vec3::from(mesh.normals[*v as usize])) <= 0.0)
        });
        let (against, all) = (against.count(), mesh.indices.len() / 3);
        // Where a crease is finer than a cell of the surface nets (between the bust's locks), a normal
        // leans past its face. 2 in 100 are allowed.
        assert!(
            against * 50 <= all,
            "{} / {}: {against} of {all}",
            shape.name(),
            part.name
        );
    });
}

#[test]
fn triangles_have_area() {
    each_part(|shape, part| {
        let mesh = &part.mesh;
        for face in mesh.indices.chunks_exact(3) {
            let [a, b, c] = corners(mesh, face);
            let area = (b - a).cross(c - a).length() * 0.5;
            // 1e-14 m^2: a square of a tenth of a micrometre.
            assert!(
                area > 1e-14,
                "{} / {}: {a} {b} {c}",
                shape.name(),
                part.name
            );
        }
    });
}

/// Directed edges that have no partner in the other direction, vertices at one place being one.
fn open_edges(mesh: &Mesh) -> usize {
    let mut edges: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    // Zero and minus zero are one place.
    let place = |index: u32| mesh.positions[index as usize].map(|x| (x + 0.0).to_bits());
    for face in mesh.indices.chunks_exact(3) {
        for k in 0..3 {
            let (a, b) = (place(face[k]), place(face[(k + 1) % 3]));
            let (edge, step) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
            *edges.entry(edge).or_default() += step;
        }
    }
    edges.values().filter(|balance| **balance != 0).count()
}

#[test]
fn closed_parts_have_no_open_edge() {
    each_part(|shape, part| {
        if CLOSED.contains(&(shape, part.name)) {
            let open = open_edges(&part.mesh);
            assert_eq!(open, 0, "{} / {}", shape.name(), part.name);
        }
    });
    for (shape, name) in CLOSED {
        assert!(
            shape.parts().iter().any(|part| part.name == *name),
            "{} / {name}",
            shape.name()
        );
    }
}

#[test]
fn a_closed_part_encloses_a_positive_volume() {
    each_part(|shape, part| {
        if CLOSED.contains(&(shape, part.name)) {
            let faces = part.mesh.indices.chunks_exact(3);
            let volume: f64 = faces
                .map(|face| {
                    let [a, b, c] = corners(&part.mesh, face).map(Vec3::as_dvec3);
                    a.dot(b.cross(c)) / 6.0
                })
                .sum();
            assert!(volume > 0.0, "{} / {}: {volume}", shape.name(), part.name);
        }
    });
}

fn digest(part: &Part) -> u64 {
    let mut hasher = DefaultHasher::new();
    part.name.hash(&mut hasher);
    part.mesh.indices.hash(&mut hasher);
    for triple in part.mesh.positions.iter().chain(&part.mesh.normals) {
        triple.map(f32::to_bits).hash(&mut hasher);
    }
    hasher.finish()
}

#[test]
fn a_shape_is_the_same_each_time() {
    for shape in Shape::ALL {
        let make = || shape.parts().iter().map(digest).collect::<Vec<_>>();
        assert_eq!(make(), make(), "{}", shape.name());
    }
}

#[test]
fn all_shapes_keep_the_triangle_budget() {
    let mut total = 0;
    each_part(|_, part| total += part.mesh.indices.len() / 3);
    assert!(total <= TRIANGLES_OF_ALL, "{total} triangles");
}
