//! Which material, lamp and angles make a pixel that no screen can show, and how is it made again?

use crate::gpu::Samples;
use crate::interface::ProbeInput;
use crate::reference::shade::Lighting;
use crate::render::library::{Function, Tier, name_of_diffuse, name_of_specular};
use crate::render::probe::Probe;
use crate::render::{
    Defect, Frame, Inspection, Picture, RenderError, Renderer, Settings, Uploaded,
};
use crate::scene::Scene;

/// Pixels that are looked into: one line each is read by somebody.
const MOST: usize = 100;

/// A pixel, and what it was shaded from.
#[derive(Clone, PartialEq, Debug)]
pub struct BadPixel {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// What is wrong.
    pub defect: Defect,
    /// The material's name.
    pub material: String,
    /// The first lamp that makes it by itself; none where no lamp does.
    pub cause: Option<Cause>,
}

/// A lamp that makes it.
#[derive(Clone, PartialEq, Debug)]
pub struct Cause {
    /// The lamp's name.
    pub light: String,
    /// Its angle to the normal, degrees.
    pub light_degrees: f64,
    /// The eye's.
    pub eye_degrees: f64,
    /// The function of the library.
    pub function: &'static Function,
    /// What it is evaluated at.
    pub input: ProbeInput,
    /// What it gives.
    pub value: f32,
}

/// Looks into the first bad pixels of a picture that was drawn with these settings, one sample a pixel.
///
/// # Errors
/// There is no memory, or the driver fails.
pub fn bad_pixels(
    renderer: &Renderer,
    scene: &Scene,
    settings: &Settings,
    picture: &Picture,
) -> Result<Vec<BadPixel>, RenderError> {
    let bad: Vec<_> = picture.defective().take(MOST).collect();
    if bad.is_empty() {
        return Ok(Vec::new());
    }
    let look = Look::new(renderer, scene, settings)?;
    let normals = look.at(Inspection::NormalAndMaterial)?;
    let eyes = look.at(Inspection::EyeAndRoughness)?;
    let mut found: Vec<BadPixel> = bad
        .iter()
        .map(|((x, y), defect)| {
            let [.., material] = normals.at(*x, *y);
            let material = scene.materials.get(material as usize);
            BadPixel {
                x: *x,
                y: *y,
                defect: *defect,
                material: material.map_or_else(String::new, |material| material.name.clone()),
                cause: None,
            }
        })
        .collect();
    for (number, light) in (0..).zip(&scene.lights) {
        let lights = look.at(Inspection::LightAndF0(number))?;
        let inputs: Vec<_> = found
            .iter()
            .map(|pixel| input([&normals, &eyes, &lights], pixel.x, pixel.y))
            .collect();
        for function in functions(settings.variant.lighting) {
            let results = Probe::new(renderer.device(), function, Tier::F32)?.at(&inputs)?;
            for ((pixel, input), result) in found.iter_mut().zip(&inputs).zip(results) {
                let bad = result.nans + result.infinities + result.negatives > 0;
                // -1: nothing arrives from this lamp.
                if bad && input.f0 >= 0.0 && pixel.cause.is_none() {
                    pixel.cause = Some(cause(&light.name, function, *input, result.value));
                }
            }
        }
    }
    Ok(found)
}

/// What a lamp's light is multiplied with.
fn functions(lighting: Lighting) -> impl Iterator<Item = &'static Function> {
    let names = match lighting {
        Lighting::Phong => vec![],
        Lighting::Slides => vec!["slides-oren-nayar", "slides-cook-torrance"],
        Lighting::CORRECTED => vec!["corrected"],
        Lighting::Mixed(mix) => vec![name_of_diffuse(mix.diffuse), name_of_specular(mix.specular)],
    };
    names
        .into_iter()
        .filter_map(|name| Function::of_name(name).ok())
}

fn cause(light: &str, function: &'static Function, input: ProbeInput, value: f32) -> Cause {
    let degrees = |v: [f32; 3]| {
        let [n, v] = [input.normal, v].map(|v| glam::Vec3::from(v).as_dvec3());
        crate::math::frame::angle(n, v).to_degrees()
    };
    Cause {
        light: light.to_owned(),
        light_degrees: degrees(input.light),
        eye_degrees: degrees(input.eye),
        function,
        input,
        value,
    }
}

fn input([normals, eyes, lights]: [&Picture; 3], x: u32, y: u32) -> ProbeInput {
    let [nx, ny, nz, _] = normals.at(x, y);
    let [ex, ey, ez, roughness] = eyes.at(x, y);
    let [lx, ly, lz, f0] = lights.at(x, y);
    ProbeInput::new([[nx, ny, nz], [lx, ly, lz], [ex, ey, ez]], roughness, f0)
}

/// A scene that is looked into.
struct Look<'s> {
    renderer: &'s Renderer,
    uploaded: Uploaded<'s>,
    settings: Settings,
}

impl<'s> Look<'s> {
    fn new(
        renderer: &'s Renderer,
        scene: &'s Scene,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        Ok(Self {
            renderer,
            uploaded: Uploaded::new(renderer, scene, settings.effects.allowed)?,
            settings: Settings {
                samples: Samples::One,
                ..*settings
            },
        })
    }

    fn at(&self, inspection: Inspection) -> Result<Picture, RenderError> {
        let (renderer, uploaded) = (self.renderer, &self.uploaded);
        let mut frame = Frame::inspecting(renderer, uploaded, &self.settings, inspection)?;
        frame.draw()?;
        Ok(frame.picture()?)
    }
}
