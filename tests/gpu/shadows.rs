//! Is a lit plane free of shadows of its own, and does a shadow begin where its object stands?
//!
//! No bias is set anywhere: the same code must do for every lamp, angle, size and place.

use glam::{Affine3A, DVec3, DVec4, Mat4, Quat, Vec3};
use umber::gpu::Samples;
use umber::reference::shade::{Lighting, Terms};
use umber::render::effects::Effects;
use umber::render::{Picture, Settings, ShadowMaps, Variant, draw_list};
use umber::scene::{
    Ambient, Camera, Light, LightKind, Material, Mesh, Object, Projection, Scene, Slot, Texture,
};

use crate::harness::with_gpu;
use crate::tolerances::{CORNER_PIXELS, HOLLOW_LIGHT};

const SIZE: (u32, u32) = (192, 108);

/// The angles between a lamp's rays and the plane's normal, degrees.
const ANGLES: [f32; 17] = [
    5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0,
    85.0,
];

/// A flat square of side 2 in the plane y = 0, of n x n cells.
fn plane(n: u32) -> Mesh {
    let step = 2.0 / n as f32;
    let at = |i: u32| i as f32 * step - 1.0;
    let corner = |i: u32, j: u32| j * (n + 1) + i;
    let cell = |i, j| {
        let [a, b, c, d] = [
            corner(i, j),
            corner(i, j + 1),
            corner(i + 1, j + 1),
            corner(i + 1, j),
        ];
        [a, b, c, a, c, d]
    };
    let places = || (0..=n).flat_map(move |j| (0..=n).map(move |i| (i, j)));
    Mesh {
        name: "plane".into(),
        positions: places().map(|(i, j)| [at(i), 0.0, at(j)]).collect(),
        normals: places().map(|_| [0.0, 1.0, 0.0]).collect(),
        indices: (0..n)
            .flat_map(|j| (0..n).flat_map(move |i| cell(i, j)))
            .collect(),
        ..Mesh::default()
    }
}

fn matte() -> Material {
    Material {
        name: "matte".into(),
        albedo: [0.5; 3],
        f0: [0.0; 3],
        roughness: 0.0,
        ..Material::default()
    }
}

fn object(name: &str, mesh: usize, transform: Affine3A) -> Object {
    Object {
        name: name.into(),
        mesh,
        material: 0,
        transform,
    }
}

/// Meshes that stand in the world, seen by a camera, under a lamp that throws shadows.
fn scene(objects: Vec<Object>, meshes: Vec<Mesh>, camera: Camera, kind: LightKind) -> Scene {
    Scene {
        camera,
        ambient: Ambient::default(),
        lights: vec![Light {
            name: "lamp".into(),
            color: [1.0; 3],
            kind,
            shadow: true,
        }],
        materials: vec![matte()],
        meshes,
        objects,
        textures: Vec::new(),
        warnings: Vec::new(),
    }
}

fn render(scene: &Scene, shadow: bool) -> Picture {
    let mut scene = scene.clone();
    scene.lights[0].shadow = shadow;
    let settings = Settings {
        width: SIZE.0,
        height: SIZE.1,
        samples: Samples::One,
        variant: Variant {
            lighting: Lighting::CORRECTED,
            terms: Terms::ALL,
        },
        effects: Effects::default(),
    };
    with_gpu(|gpu| gpu.render_with(&scene, &settings).0)
}

/// Pixels that are darker with shadows than without.
fn shadowed(scene: &Scene) -> usize {
    let (with, without) = (render(scene, true), render(scene, false));
    let lit = without.pixels.iter().filter(|pixel| pixel[0] > 0.0).count();
    assert!(lit > 1000, "{lit} pixels are lit at all");
    let pixels = with.pixels.iter().zip(&without.pixels);
    pixels
        .filter(|(with, without)| with[0] < without[0])
        .count()
}

fn camera(position: Vec3, target: Vec3) -> Camera {
    Camera {
        position,
        target,
        up: Vec3::Y,
        projection: Projection::Perspective {
            vertical_fov_degrees: 35.0,
        },
        exposure_ev100: 0.0,
    }
}

/// Towards a lamp at this angle from +y, turned about it by an angle that is no multiple of anything.
fn towards_lamp(degrees: f32) -> Vec3 {
    let turn = Quat::from_rotation_y(0.7 + degrees * 0.13);
    turn * Vec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0)
}

fn kinds(degrees: f32, distance: f32, about: Vec3, spin: Quat) -> [(&'static str, LightKind); 4] {
    let to_lamp = spin * towards_lamp(degrees);
    let position = about + to_lamp * distance;
    let intensity = distance * distance;
    [
        (
            "directional",
            LightKind::Directional {
                direction: -to_lamp,
                illuminance: 1.0,
                angular_diameter_degrees: 0.5,
            },
        ),
        (
            "spot",
            LightKind::Spot {
                position,
                direction: -to_lamp,
                intensity,
                radius: 0.01 * distance,
                inner_degrees: 30.0,
                outer_degrees: 40.0,
            },
        ),
        (
            "wide spot",
            LightKind::Spot {
                position,
                direction: -to_lamp,
                intensity,
                radius: 0.01 * distance,
                inner_degrees: 70.0,
                outer_degrees: 80.0,
            },
        ),
        (
            "point",
            LightKind::Point {
                position,
                intensity,
                radius: 0.01 * distance,
            },
        ),
    ]
}

/// A plane that is turned, moved and scaled, and the camera that sees it from above at about 40 degrees.
fn lit_plane(
    scale: f32,
    moved: Vec3,
    spin: Quat,
    cells: u32,
    from: Vec3,
) -> (Vec<Object>, Vec<Mesh>, Camera) {
    let transform = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), spin, moved);
    let mut eye = camera(moved + spin * (from * scale), moved);
    eye.up = spin * Vec3::Y;
    (vec![object("plane", 0, transform)], vec![plane(cells)], eye)
}

#[test]
fn no_pixel_of_a_lit_plane_shadows_itself_from_5_to_85_degrees() {
    let askew = Quat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -0.7);
    let above = Vec3::new(0.3, 1.8, 2.0);
    let grazing = Vec3::new(0.1, 0.25, 1.6);
    let near = Vec3::new(0.02, 0.1, 0.12);
    let cases = [
        ("flat", 1.0, Vec3::ZERO, Quat::IDENTITY, 1, above),
        ("askew", 1.0, Vec3::ZERO, askew, 1, above),
        ("fine", 1.0, Vec3::ZERO, askew, 64, above),
        ("seen grazing", 1.0, Vec3::ZERO, askew, 8, grazing),
        ("seen near", 1.0, Vec3::ZERO, askew, 8, near),
        ("large", 1000.0, Vec3::ZERO, askew, 1, above),
        ("small", 0.001, Vec3::ZERO, askew, 4, above),
        (
            "far from the origin",
            1.0,
            Vec3::new(80.0, -30.0, 50.0),
            askew,
            8,
            above,
        ),
    ];
    for (name, scale, moved, spin, cells, from) in cases {
        let (objects, meshes, eye) = lit_plane(scale, moved, spin, cells, from);
        for degrees in ANGLES {
            for (lamp, kind) in kinds(degrees, 3.0 * scale, moved, spin) {
                let scene = scene(objects.clone(), meshes.clone(), eye.clone(), kind);
                let acne = shadowed(&scene);
                assert_eq!(
                    acne, 0,
                    "{name}, {lamp} at {degrees} degrees: pixels in shadow"
                );
            }
        }
    }
}

/// A wall of height 1 and no thickness, in the plane x = 0, from z = -1 to 1.
fn wall() -> Mesh {
    Mesh {
        name: "wall".into(),
        positions: vec![
            [0.0, 0.0, -1.0],
            [0.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
            [0.0, 1.0, -1.0],
        ],
        normals: vec![[1.0, 0.0, 0.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

/// A texel's extent on the plane along +x at the wall's foot, m: by the map's own matrix.
fn texel_on_plane(scene: &Scene) -> Option<f64> {
    let list = draw_list(scene).ok()?;
    let aspect = SIZE.0 as f32 / SIZE.1 as f32;
    let maps = ShadowMaps::new(scene, &list, aspect, |light| light.shadow).ok()?;
    let side = f64::from(maps.side());
    let steps = maps.maps.iter().filter_map(|map| {
        let clip = Mat4::from_cols_array_2d(&map.clip).as_dmat4();
        let at = |point: DVec3| -> Option<DVec3> {
            let clip: DVec4 = clip * point.extend(1.0);
            let inside = clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w;
            inside.then(|| clip.truncate() / clip.w)
        };
        let step = 1e-4;
        let (a, b) = (at(DVec3::ZERO)?, at(DVec3::X * step)?);
        Some(step / ((b - a).truncate().length() * 0.5 * side))
    });
    steps.reduce(f64::min)
}

/// The lamp of this kind towards `to_lamp`, 6 m from the origin.
fn turned(kind: LightKind, to_lamp: Vec3) -> LightKind {
    let mut kind = kind;
    match &mut kind {
        LightKind::Directional { direction, .. } => *direction = -to_lamp,
        LightKind::Spot {
            position,
            direction,
            ..
        } => {
            *position = to_lamp * 6.0;
            *direction = -to_lamp;
        }
        LightKind::Point { position, .. } => *position = to_lamp * 6.0,
    }
    kind
}

/// The gap between the wall's foot and its shadow, m, and a texel there. The camera looks straight down on the foot and
/// sees 0.1 m: pixels of 0.93 mm, finer than any texel here.
fn gap(kind: LightKind) -> Option<(f64, f64)> {
    let height = 0.1;
    let eye = Camera {
        position: Vec3::new(0.0, 3.0, 0.0),
        target: Vec3::ZERO,
        up: Vec3::NEG_Z,
        projection: Projection::Orthographic { height },
        exposure_ev100: 0.0,
    };
    let ground = Affine3A::from_scale(Vec3::splat(2.0));
    let objects = vec![
        object("plane", 0, ground),
        object("wall", 1, Affine3A::IDENTITY),
    ];
    let scene = scene(objects, vec![plane(1), wall()], eye, kind);
    let texel = texel_on_plane(&scene)?;
    let picture = render(&scene, true);
    let row = SIZE.1 / 2;
    let dark = |x: &u32| picture.at(*x, row)[0] < 0.5 * picture.at(0, row)[0];
    let first = (SIZE.0 / 2..SIZE.0).find(dark)?;
    let pixel = f64::from(height) / f64::from(SIZE.1);
    Some((f64::from(first - SIZE.0 / 2) * pixel, texel))
}

#[test]
fn a_shadow_begins_within_two_texels_of_what_throws_it() {
    let mut widest = 0.0_f64;
    for degrees in ANGLES {
        // Across the wall.
        let to_lamp = Vec3::new(-degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0);
        for (lamp, kind) in kinds(degrees, 6.0, Vec3::ZERO, Quat::IDENTITY) {
            let Some((gap, texel)) = gap(turned(kind, to_lamp)) else {
                panic!("{lamp} at {degrees} degrees: no shadow, or no map");
            };
            let texels = gap / texel;
            assert!(
                texels < 2.0,
                "{lamp} at {degrees} degrees: {texels:.2} texels"
            );
            widest = widest.max(texels);
        }
    }
    println!("the widest gap is {widest:.2} texels");
}

/// A lamp straight above a plane, and a plate of this material and height between them.
fn under_a_plate(height: f32, plate_of: Material, textures: Vec<Texture>) -> Scene {
    let plate = Affine3A::from_scale_rotation_translation(
        Vec3::splat(0.3),
        Quat::IDENTITY,
        Vec3::new(0.0, height, 0.0),
    );
    let kind = LightKind::Point {
        position: Vec3::new(0.0, 2.0, 0.0),
        intensity: 4.0,
        radius: 0.2,
    };
    // From the side, below the plate.
    let eye = camera(Vec3::new(0.0, 0.5, 3.0), Vec3::ZERO);
    let objects = vec![
        object("plane", 0, Affine3A::IDENTITY),
        object("plate", 1, plate),
    ];
    let mut plate = plane(1);
    plate.coordinates = vec![[0.5; 2]; plate.positions.len()];
    let mut scene = scene(objects, vec![plane(1), plate], eye, kind);
    scene.materials.push(plate_of);
    scene.objects[1].material = 1;
    scene.textures = textures;
    scene
}

#[test]
fn only_what_is_opaque_and_outside_the_lamp_throws_a_shadow() {
    let mask = |value: f32| {
        let texels = [[value, value, value, 1.0]; 4];
        let texture = Texture::from_linear("mask", Slot::AlphaMask, 2, 2, &texels);
        let mut masked = matte();
        masked.maps.alpha_mask = Some(0);
        (masked, texture.into_iter().collect::<Vec<_>>())
    };
    let glass = Material {
        opacity: 0.5,
        ..matte()
    };
    let (holes, no_surface) = mask(0.2);
    let (whole, surface) = mask(0.8);
    let cases = [
        ("opaque", under_a_plate(1.0, matte(), Vec::new()), true),
        ("glass", under_a_plate(1.0, glass, Vec::new()), false),
        ("a hole", under_a_plate(1.0, holes, no_surface), false),
        ("no hole", under_a_plate(1.0, whole, surface), true),
        (
            "in the lamp",
            under_a_plate(1.9, matte(), Vec::new()),
            false,
        ),
        (
            "behind the lamp",
            under_a_plate(3.0, matte(), Vec::new()),
            false,
        ),
    ];
    for (name, scene, throws) in cases {
        assert_eq!(shadowed(&scene) > 0, throws, "{name}");
    }
}

#[test]
fn a_lamp_without_shadows_shines_through_beside_one_with() {
    let mut scene = under_a_plate(1.0, matte(), Vec::new());
    let one = shadowed(&scene);
    let mut second = scene.lights[0].clone();
    second.shadow = false;
    scene.lights.push(second);
    // Lit by the second lamp, the same pixels are half as dark.
    assert_eq!(shadowed(&scene), one);
    let picture = render(&scene, true);
    let lit = render(&scene, false);
    let pixels = picture.pixels.iter().zip(&lit.pixels);
    let darkest = pixels
        .filter(|(_, lit)| lit[0] > 0.0)
        .map(|(with, without)| with[0] / without[0])
        .fold(1.0, f32::min);
    assert!((darkest - 0.5).abs() < 1e-5, "{darkest}");
}

/// The inside of half a sphere of radius 1, open above, of this many segments around.
fn bowl(segments: u32) -> Mesh {
    let rings = segments / 4;
    let point = |ring: u32, segment: u32| {
        let polar = std::f32::consts::FRAC_PI_2 * ring as f32 / rings as f32;
        let around = std::f32::consts::TAU * segment as f32 / segments as f32;
        Vec3::new(
            polar.sin() * around.cos(),
            -polar.cos(),
            polar.sin() * around.sin(),
        )
    };
    let places = || (0..=rings).flat_map(move |ring| (0..=segments).map(move |s| (ring, s)));
    let number = |ring: u32, segment: u32| ring * (segments + 1) + segment;
    let cell = |ring: u32, segment: u32| {
        let [a, b] = [number(ring, segment), number(ring, segment + 1)];
        let [c, d] = [number(ring + 1, segment + 1), number(ring + 1, segment)];
        [a, b, c, a, c, d]
    };
    Mesh {
        name: "bowl".into(),
        positions: places().map(|(r, s)| point(r, s).to_array()).collect(),
        normals: places().map(|(r, s)| (-point(r, s)).to_array()).collect(),
        indices: (0..rings)
            .flat_map(|r| (0..segments).flat_map(move |s| cell(r, s)))
            .collect(),
        ..Mesh::default()
    }
}

/// Lamps that give next to nothing and take so many maps that each has the least size.
fn crowd(scene: &mut Scene) {
    let mut dim = scene.lights[0].clone();
    dim.kind = LightKind::Point {
        position: Vec3::new(0.0, 50.0, 0.0),
        intensity: 1e-12,
        radius: 0.1,
    };
    scene.lights.extend(std::iter::repeat_n(dim, 11));
}

/// The light on a picture with shadows over that without.
fn light_left(scene: &Scene) -> f64 {
    let sum =
        |picture: &Picture| -> f64 { picture.pixels.iter().map(|pixel| f64::from(pixel[0])).sum() };
    sum(&render(scene, true)) / sum(&render(scene, false))
}

#[test]
fn a_hollow_surface_shadows_itself_no_more_than_its_map_is_coarse() {
    for (segments, crowded) in [(32, false), (256, false), (32, true), (256, true)] {
        for (lamp, kind) in kinds(0.001, 4.0, Vec3::ZERO, Quat::IDENTITY) {
            let eye = camera(Vec3::new(0.2, 5.0, 0.3), Vec3::ZERO);
            let objects = vec![object("bowl", 0, Affine3A::IDENTITY)];
            let mut scene = scene(objects, vec![bowl(segments)], eye, turned(kind, Vec3::Y));
            if crowded {
                crowd(&mut scene);
            }
            let left = light_left(&scene);
            println!("{segments} segments, crowded {crowded}, {lamp}: {left:.4}");
            assert!(left > HOLLOW_LIGHT, "{segments}, {crowded}, {lamp}: {left}");
        }
    }
}

#[test]
fn a_corner_that_is_lit_has_no_seam() {
    for degrees in ANGLES {
        // From the wall's open side.
        let to_lamp = Vec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.1);
        for (lamp, kind) in kinds(degrees, 6.0, Vec3::ZERO, Quat::IDENTITY) {
            let eye = camera(Vec3::new(2.0, 1.5, 0.3), Vec3::new(0.0, 0.2, 0.0));
            let moved = Affine3A::from_translation(Vec3::new(1.0, 0.0, 0.0));
            let objects = vec![
                object("plane", 0, moved),
                object("wall", 1, Affine3A::IDENTITY),
            ];
            let scene = scene(
                objects,
                vec![plane(1), wall()],
                eye,
                turned(kind, to_lamp.normalize()),
            );
            let dark = shadowed(&scene);
            assert!(dark <= CORNER_PIXELS, "{lamp} at {degrees} degrees: {dark}");
        }
    }
}

#[test]
fn a_lamp_of_any_size_throws_its_shadow() {
    for radius in [1.0e-40, 1.0e-30, 1.0e-6, 1.0e-3, 0.1] {
        let mut scene = under_a_plate(1.0, matte(), Vec::new());
        let whole = shadowed(&scene);
        // A speck in the lamp itself, which would draw the near plane to it.
        let speck = Affine3A::from_scale_rotation_translation(
            Vec3::splat(1e-4),
            Quat::IDENTITY,
            Vec3::new(0.0, 2.0, 0.0),
        );
        scene.objects.push(object("speck", 0, speck));
        let LightKind::Point { radius: own, .. } = &mut scene.lights[0].kind else {
            panic!("a point light");
        };
        *own = radius;
        let dark = shadowed(&scene);
        // The same shadow but for its edge.
        assert!(
            dark.abs_diff(whole) < whole / 20,
            "{radius:e}: {dark} for {whole}"
        );
        assert_eq!(render(&scene, true).defects().not_finite(), 0, "{radius:e}");
    }
}
