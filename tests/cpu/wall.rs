//! Is the wall that a driver is measured with what it says, in any order?

use umber::scene::{Exhibit, Order, Scene, Wall, built_in_materials};

fn wall(exhibit: Exhibit, materials: u32, objects: u32) -> Wall {
    Wall {
        exhibit,
        objects,
        materials,
        distinct: materials,
        pictures: 0,
    }
}

fn scene(wall: Wall, order: Order, seed: u64) -> Scene {
    match wall.scene(order, seed) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

/// Where each object stands and what it is made of, as numbers that can be sorted.
fn placed(scene: &Scene) -> Vec<(u32, u32, usize)> {
    let place = |o: &umber::scene::Object| {
        let at = o.transform.translation;
        (at.x as u32, at.y as u32, o.material)
    };
    scene.objects.iter().map(place).collect()
}

#[test]
fn shuffling_moves_opaque_draws_and_leaves_the_wall_as_it_was() {
    for exhibit in [Exhibit::Triangles, Exhibit::Balls, Exhibit::Squares(7)] {
        let wall = wall(exhibit, 10, 200);
        let sorted = scene(wall, Order::Sorted, 1);
        let shuffled = scene(wall, Order::Shuffled, 1);
        assert_ne!(placed(&sorted), placed(&shuffled), "{exhibit:?}");
        let all = |scene: &Scene| {
            let mut all = placed(scene);
            all.sort_unstable();
            all
        };
        assert_eq!(all(&sorted), all(&shuffled), "{exhibit:?}");
        assert_eq!(sorted.materials, shuffled.materials);
        // What lets light through keeps its turn among itself.
        let glass = |scene: &Scene| -> Vec<_> {
            let opaque = |material: usize| scene.materials[material].opacity >= 1.0;
            placed(scene)
                .into_iter()
                .filter(|(_, _, m)| !opaque(*m))
                .collect()
        };
        assert_eq!(glass(&sorted), glass(&shuffled), "{exhibit:?}");
        assert_eq!(glass(&sorted).is_empty(), exhibit != Exhibit::Balls);
    }
}

#[test]
fn a_seed_gives_one_order() {
    let wall = wall(Exhibit::Triangles, 10, 200);
    let order = |seed| placed(&scene(wall, Order::Shuffled, seed));
    assert_eq!(order(3), order(3));
    assert_ne!(order(3), order(4));
}

#[test]
fn materials_share_the_objects_evenly_and_sorted_ones_follow_each_other() {
    for (materials, objects) in [(1, 10), (7, 100), (64, 100), (100, 100)] {
        let scene = scene(
            wall(Exhibit::Triangles, materials, objects),
            Order::Sorted,
            1,
        );
        let used: Vec<_> = placed(&scene)
            .iter()
            .map(|(_, _, material)| *material)
            .collect();
        assert!(used.is_sorted(), "{materials} of {objects}");
        let counts: Vec<_> = (0..materials as usize)
            .map(|material| used.iter().filter(|used| **used == material).count())
            .collect();
        let (least, most) = (counts.iter().min(), counts.iter().max());
        assert!(
            most.zip(least)
                .is_some_and(|(most, least)| most - least <= 1),
            "{counts:?}"
        );
    }
}

#[test]
fn no_two_objects_share_a_cell_and_the_picture_shows_all() {
    for exhibit in [Exhibit::Triangles, Exhibit::Balls, Exhibit::Squares(2)] {
        for objects in [1, 2, 3, 70, 101] {
            let wall = wall(exhibit, 3, objects);
            let (columns, rows) = wall.grid();
            let scene = scene(wall, Order::Shuffled, 5);
            let mut cells: Vec<_> = placed(&scene).iter().map(|(x, y, _)| (*x, *y)).collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells.len(), objects as usize, "{exhibit:?}");
            assert!(cells.iter().all(|(x, y)| *x < columns && *y < rows));
            let bounds = scene.meshes[0].bounds();
            assert!(bounds.min.min_element() >= -0.5 && bounds.max.max_element() <= 1.0);
            assert!(bounds.min.x >= 0.0 && bounds.min.y >= 0.0);
        }
    }
}

#[test]
fn a_ball_has_as_many_triangles_as_it_says() {
    let mesh = wall(Exhibit::Balls, 1, 1).mesh();
    assert_eq!(mesh.triangle_count(), 120);
    assert_eq!(mesh.coordinates.len(), mesh.positions.len());
}

#[test]
fn every_built_in_material_is_on_a_wall_of_balls() {
    let built_in = match built_in_materials() {
        Ok(materials) => materials,
        Err(error) => panic!("{error}"),
    };
    assert_eq!(built_in.len(), 10);
    let scene = scene(wall(Exhibit::Balls, 25, 100), Order::Sorted, 1);
    for (number, material) in scene.materials.iter().enumerate() {
        let base = &built_in[number % 10];
        assert!(material.name.starts_with(&base.name), "{}", material.name);
        assert_eq!((material.f0, material.opacity), (base.f0, base.opacity));
        assert!(material.roughness > 0.0 && material.roughness <= base.roughness);
    }
    // No two are alike, or a wrong material would not show.
    for (i, a) in scene.materials.iter().enumerate() {
        let alike = |b: &umber::scene::Material| {
            (a.albedo, a.f0, a.roughness) == (b.albedo, b.f0, b.roughness)
        };
        assert_eq!(
            scene.materials.iter().position(alike),
            Some(i),
            "{}",
            a.name
        );
    }
}

#[test]
fn folded_materials_come_in_turn() {
    let folded = Wall {
        distinct: 4,
        ..wall(Exhibit::Triangles, 9, 90)
    };
    let folded = scene(folded, Order::Sorted, 1);
    let whole = scene(wall(Exhibit::Triangles, 9, 90), Order::Sorted, 1);
    assert_eq!(folded.materials.len(), 4);
    assert_eq!(folded.materials[..], whole.materials[..4]);
    for (a, b) in folded.objects.iter().zip(&whole.objects) {
        assert_eq!((a.material, a.transform), (b.material % 4, b.transform));
    }
}
