//! Does a shader find in textures and in depth what was put there?
//!
//! Here and not in `tests/`, since only this crate may make a `Spirv`.

use std::sync::Arc;

use super::*;

mod guards;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Corner positions from a buffer; depth is the same for all.
const VERTEX: &str = "#version 460
layout(location = 0) in vec2 in_position;
layout(location = 1) in vec4 in_constant;
void main() { gl_Position = vec4(in_position, in_constant.w, 1.0); }";

/// Two triangles over the upper half of the picture, the first to the left; both face the eye. Then
/// the same for the whole of it.
const CORNERS: [[f32; 2]; 8] = [
    [-1.0, 0.0],
    [1.0, 0.0],
    [-1.0, 1.0],
    [1.0, 1.0],
    [-1.0, -1.0],
    [1.0, -1.0],
    [-1.0, 1.0],
    [1.0, 1.0],
];
const INDICES: [u32; 12] = [0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7];
const UPPER_HALF: std::ops::Range<u32> = 0..6;
const WHOLE: std::ops::Range<u32> = 6..12;

fn spirv(source: &str, stage: glslang::ShaderStage) -> Result<Spirv, Box<dyn std::error::Error>> {
    let compiler = glslang::Compiler::acquire().ok_or("glslang did not start")?;
    let source = glslang::ShaderSource::from(source);
    let options = glslang::CompilerOptions {
        source_language: glslang::SourceLanguage::GLSL,
        target: glslang::Target::Vulkan {
            version: glslang::VulkanVersion::Vulkan1_3,
            spirv_version: glslang::SpirvVersion::SPIRV1_6,
        },
        version_profile: None,
        messages: glslang::ShaderMessage::DEFAULT,
    };
    let input = glslang::ShaderInput::new(&source, stage, &options, None, None)?;
    let words = compiler.create_shader(input)?.compile()?;
    Ok(Spirv(Box::leak(words.into_boxed_slice())))
}

/// A device, geometry, and a layout of one texture at 0 and one sampler at 1.
struct Bench {
    device: Arc<Device>,
    layout: Arc<SetLayout>,
    pipelines: Arc<PipelineLayout>,
    cache: PipelineCache,
    corners: Buffer,
    indices: Buffer,
}

impl Bench {
    fn new() -> Result<Self, Error> {
        let instance = Instance::new(Validation::On)?;
        let devices = instance.devices()?;
        let device = Device::open(&instance, choose(&devices, &DeviceSelector::Best)?)?;
        let binding = |slot, kind| Binding { slot, kind };
        let bindings = [
            binding(0, BindingKind::Texture),
            binding(1, BindingKind::Sampler),
        ];
        let buffer = |usage, bytes| Buffer::with_data(&device, "geometry", usage, bytes);
        let layout = SetLayout::new(&device, "bench", &bindings)?;
        Ok(Self {
            pipelines: PipelineLayout::new(&device, "bench", &[&layout], 0)?,
            layout,
            cache: PipelineCache::open(&device, None)?,
            corners: buffer(BufferUse::Vertices, bytemuck::cast_slice(&CORNERS))?,
            indices: buffer(BufferUse::Indices, bytemuck::cast_slice(&INDICES))?,
            device,
        })
    }

    /// The attribute that all vertices share.
    fn constant(&self, w: f32) -> Result<Buffer, Error> {
        let bytes = [7.0, 8.0, 9.0, w];
        let bytes = bytemuck::cast_slice(&bytes);
        Buffer::with_data(&self.device, "constant", BufferUse::Vertices, bytes)
    }

    fn set(&self, texture: Resource, filter: Filter) -> Result<DescriptorSet, Error> {
        let sampler = Sampler::new(&self.device, "sampler", filter)?;
        let resources = [texture, Resource::Sampler(sampler)];
        DescriptorSet::new(&self.layout, "bench", &resources)
    }

    /// A pipeline for colour, or for depth alone where there is no fragment shader.
    fn pipeline(&self, fragment: Option<&str>) -> Result<Pipeline, Box<dyn std::error::Error>> {
        let attribute = |location, format, rate| Attribute {
            location,
            format,
            rate,
        };
        let fragment = fragment
            .map(|source| spirv(source, glslang::ShaderStage::Fragment))
            .transpose()?;
        let info = PipelineInfo {
            name: "bench",
            vertex: spirv(VERTEX, glslang::ShaderStage::Vertex)?,
            fragment,
            attributes: &[
                attribute(0, VertexFormat::Rg32Float, Rate::PerVertex),
                attribute(1, VertexFormat::Rgba32Float, Rate::Constant),
            ],
            constants: &[],
            targets: Targets {
                color: fragment.map(|_| requirements::COLOR),
                depth: requirements::DEPTH,
                samples: Samples::One,
            },
            output: Output::Blended,
        };
        Ok(Pipeline::new(
            &self.device,
            &self.pipelines,
            &self.cache,
            &info,
        )?)
    }

    fn image(&self, format: TargetFormat, width: u32, height: u32) -> Result<Image, Error> {
        let info = ImageInfo {
            name: "bench",
            format,
            width,
            height,
            samples: Samples::One,
        };
        Image::new(&self.device, &info)
    }

    fn canvas(
        &self,
        (width, height): (u32, u32),
        fragment: &str,
    ) -> Result<(Canvas, Buffer), Box<dyn std::error::Error>> {
        let color = self.image(requirements::COLOR, width, height)?;
        let usage = BufferUse::Readback;
        let readback = Buffer::new(&self.device, "readback", usage, color.bytes())?;
        let canvas = Canvas {
            pipeline: self.pipeline(Some(fragment))?,
            constant: self.constant(0.5)?,
            depth: self.image(requirements::DEPTH, width, height)?,
            color,
        };
        Ok((canvas, readback))
    }

    /// The picture that `fragment` makes of a set without depth.
    fn picture(
        &self,
        size: (u32, u32),
        fragment: &str,
        set: &DescriptorSet,
    ) -> Result<Vec<[f32; 4]>, Box<dyn std::error::Error>> {
        let (canvas, mut readback) = self.canvas(size, fragment)?;
        canvas.draw(self, set, &[], &mut readback, |_| {})?;
        texels(&readback)
    }

    /// The layers had nothing to say.
    fn silent(&self) {
        let messages = self.device.instance().validation_log().drain();
        assert!(messages.is_empty(), "validation:\n{}", messages.join("\n"));
    }
}

/// What a picture is drawn with.
struct Canvas {
    pipeline: Pipeline,
    constant: Buffer,
    color: Image,
    depth: Image,
}

impl Canvas {
    /// Draws with `set`; `before` records what goes before it.
    fn draw<'a>(
        &'a self,
        bench: &'a Bench,
        set: &'a DescriptorSet,
        reads: &'a [&'a DepthArray],
        readback: &'a mut Buffer,
        before: impl FnOnce(&mut Recorder<'a>),
    ) -> Result<(), Error> {
        let info = PassInfo {
            name: "picture",
            color: &self.color,
            resolve: None,
            depth: &self.depth,
            reads,
        };
        let mut recorder = Recorder::new(&bench.device, "bench")?;
        before(&mut recorder);
        recorder.pass(&info, |pass| {
            pass.bind_pipeline(&self.pipeline);
            pass.bind_set(0, set);
            pass.bind_geometry(&[&bench.corners, &self.constant], &bench.indices);
            pass.draw(WHOLE, 0, 0);
        });
        recorder.copy_image(&self.color, readback);
        recorder.submit()?;
        Ok(())
    }
}

fn texels(readback: &Buffer) -> Result<Vec<[f32; 4]>, Box<dyn std::error::Error>> {
    Ok(bytemuck::cast_slice(readback.read()?).to_vec())
}

/// A fragment shader that sees `textures` and `filtering`, and ends in `color = ...`.
fn fragment(body: &str) -> String {
    format!(
        "#version 460
layout(set = 0, binding = 0) uniform texture2DArray textures;
layout(set = 0, binding = 1) uniform sampler filtering;
layout(location = 0) out vec4 color;
void main() {{ ivec2 at = ivec2(gl_FragCoord.xy); {body} }}"
    )
}

/// Four bytes that differ with level, layer and place.
fn texel(level: u32, layer: u32, x: u32, y: u32) -> [u8; 4] {
    let seed = ((level * 7 + layer) * 8191 + y) * 4099 + x;
    let mixed = seed.wrapping_mul(0x9e37_79b1);
    (mixed ^ mixed >> 15).to_le_bytes()
}

/// What a format's four bytes mean, from the specification's words.
fn decoded(format: TextureFormat, bytes: [u8; 4]) -> [f64; 4] {
    let fraction = |byte: u8| f64::from(byte) / 255.0;
    let linear = |byte: u8| match fraction(byte) {
        s if s <= 0.04045 => s / 12.92,
        s => ((s + 0.055) / 1.055).powf(2.4),
    };
    let half = |low: u8, high: u8| {
        let bits = u16::from_le_bytes([low, high]);
        let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
        let exponent = i32::from(bits >> 10 & 31);
        let fraction = f64::from(bits & 1023) / 1024.0;
        match exponent {
            0 => sign * fraction * 2f64.powi(-14),
            _ => sign * (1.0 + fraction) * 2f64.powi(exponent - 15),
        }
    };
    let [r, g, b, a] = bytes;
    let shared = u32::from_le_bytes(bytes);
    let nine = |shift: u32| {
        let scale = 2f64.powi((shared >> 27) as i32 - 15 - 9);
        f64::from(shared >> shift & 511) * scale
    };
    match format {
        TextureFormat::Rgba8 => bytes.map(fraction),
        TextureFormat::Rgba8Srgb => [linear(r), linear(g), linear(b), fraction(a)],
        TextureFormat::Rg16Float => [half(r, g), half(b, a), 0.0, 1.0],
        TextureFormat::Rgb9E5 => [nine(0), nine(9), nine(18), 1.0],
    }
}

/// The same bytes, kept from the halfs that are infinite or no number.
fn finite(format: TextureFormat, bytes: [u8; 4]) -> [u8; 4] {
    let [r, g, b, a] = bytes;
    match format {
        TextureFormat::Rg16Float => [r, g & 0xbf, b, a & 0xbf],
        _ => bytes,
    }
}

fn filled(bench: &Bench, info: &TextureInfo) -> Result<Arc<TextureArray>, Error> {
    let mut upload = TextureUpload::new(&bench.device, info)?;
    // Last first: the order is free.
    for level in (0..info.levels).rev() {
        for layer in (0..info.layers).rev() {
            let side = info.side(level);
            let texels: Vec<u8> = (0..side)
                .flat_map(|y| (0..side).map(move |x| (x, y)))
                .flat_map(|(x, y)| finite(info.format, texel(level, layer, x, y)))
                .collect();
            upload.write(level, layer, &texels)?;
        }
    }
    upload.finish()
}

#[test]
fn each_texel_of_each_level_and_layer_is_found_in_each_format() -> Outcome {
    let bench = Bench::new()?;
    // Blocks of even sides: llvmpipe takes one level for each 2x2 pixels (and for `textureSize` one for
    // even more, so it is not asked).
    let source = fragment(
        "int level = at.x / 6, layer = at.y / 6;
         int side = 5 >> level;
         ivec2 place = at % 6;
         bool inside = place.x < side && place.y < side;
         ivec3 texel = ivec3(inside ? place : ivec2(0), layer);
         color = texelFetch(sampler2DArray(textures, filtering), texel, level);",
    );
    for &format in TextureFormat::ALL {
        let info = TextureInfo {
            name: "numbered",
            format,
            size: 5,
            layers: 2,
            levels: 3,
        };
        let array = filled(&bench, &info)?;
        let set = bench.set(Resource::Texture(array), Filter::Nearest)?;
        let picture = bench.picture((18, 12), &source, &set)?;
        for (i, got) in (0..).zip(picture) {
            let (x, y) = (i % 18, i / 18);
            let (level, layer, x, y) = (x / 6, y / 6, x % 6, y % 6);
            let side = info.side(level);
            let (x, y) = if x.max(y) < side { (x, y) } else { (0, 0) };
            let want = decoded(format, finite(format, texel(level, layer, x, y)));
            for (got, want) in got.into_iter().zip(want) {
                // Half a step of the eight bits that a driver may decode sRGB with; the rest is exact.
                let tolerance = match format {
                    TextureFormat::Rgba8Srgb => 0.5 / 255.0,
                    _ => want.abs() * 1e-6,
                };
                let error = (f64::from(got) - want).abs();
                assert!(
                    error <= tolerance,
                    "{format:?} {level} {layer} {x} {y}: {got} for {want}"
                );
            }
        }
    }
    bench.silent();
    Ok(())
}

/// More than one staging buffer holds, in rows that do not divide it.
#[test]
fn a_large_texture_comes_in_pieces() -> Outcome {
    let bench = Bench::new()?;
    let info = TextureInfo {
        name: "large",
        format: TextureFormat::Rgba8,
        size: 3001,
        layers: 1,
        levels: 2,
    };
    let array = filled(&bench, &info)?;
    let set = bench.set(Resource::Texture(array), Filter::Nearest)?;
    let source =
        fragment("color = texelFetch(sampler2DArray(textures, filtering), ivec3(at * 46, 0), 0);");
    let picture = bench.picture((66, 66), &source, &set)?;
    for (i, got) in (0..).zip(picture) {
        let (x, y) = (i % 66 * 46, i / 66 * 46);
        let want = decoded(info.format, texel(0, 0, x, y)).map(|v| v as f32);
        assert!(
            (0..4).all(|c| (got[c] - want[c]).abs() < 1e-6),
            "{x} {y}: {got:?} for {want:?}"
        );
    }
    bench.silent();
    Ok(())
}

/// Black and white side by side at level 0, and 0.2 at level 1.
#[test]
fn trilinear_repeats_and_blends_where_nearest_clamps() -> Outcome {
    let bench = Bench::new()?;
    let info = TextureInfo {
        name: "edge",
        format: TextureFormat::Rgba8,
        size: 2,
        layers: 1,
        levels: 2,
    };
    let mut upload = TextureUpload::new(&bench.device, &info)?;
    let row = [[0; 4], [255; 4]].concat();
    upload.write(0, 0, &row.repeat(2))?;
    upload.write(1, 0, &[51; 4])?;
    let texture = Resource::Texture(upload.finish()?);
    let source = fragment(
        "const vec2 asked[5] = vec2[](
             vec2(0.25, 0.0), vec2(2.25, 0.0), vec2(0.5, 0.0), vec2(0.25, 0.5), vec2(-0.75, 1.0));
         vec2 a = asked[at.x];
         color = textureLod(sampler2DArray(textures, filtering), vec3(a.x, 0.25, 0.0), a.y);",
    );
    let wanted = [
        (Filter::Trilinear, [0.0, 0.0, 0.5, 0.1, 0.2]),
        // One level, and nothing between its texels.
        (Filter::Nearest, [0.0, 1.0, f32::NAN, 0.0, 0.0]),
    ];
    for (filter, wanted) in wanted {
        let set = bench.set(texture.clone(), filter)?;
        let picture = bench.picture((5, 1), &source, &set)?;
        for (i, (got, want)) in picture.iter().zip(wanted).enumerate() {
            // Drivers filter with as few as eight bits of weight. On the border of two texels either
            // is the nearest.
            let holds = want.is_nan() || (got[0] - want).abs() < 5e-3;
            assert!(holds, "{filter:?} {i}: {got:?} for {want}");
        }
    }
    bench.silent();
    Ok(())
}

/// What each layer was drawn with, sampled side by side.
const TWO_LAYERS: &str = "vec2 uv = vec2((at % 4 + 0.5) / 4.0);
    uv.y = (at.y + 0.5) / 4.0;
    color = vec4(textureLod(sampler2DArray(textures, filtering), vec3(uv, at.x / 4), 0.0).r);";

#[test]
fn a_later_pass_samples_the_depth_that_was_drawn_to_each_layer() -> Outcome {
    let bench = Bench::new()?;
    let array = Arc::new(DepthArray::new(&bench.device, "depth", 4, 2)?);
    let pipeline = bench.pipeline(None)?;
    let set = bench.set(Resource::Depth(Arc::clone(&array)), Filter::Nearest)?;
    let depths = [bench.constant(0.25)?, bench.constant(0.75)?];
    let (canvas, mut readback) = bench.canvas((8, 4), &fragment(TWO_LAYERS))?;
    canvas.draw(&bench, &set, &[&array], &mut readback, |recorder| {
        // Twice, with a reader between: the second time the array comes back from being read.
        recorder.depth_pass(&pass_to(&array, 1), |_| {});
        for (layer, depth) in (0..).zip(&depths) {
            recorder.depth_pass(&pass_to(&array, layer), |pass| {
                pass.set_cull([Cull::Back, Cull::None][layer as usize]);
                pass.bind_pipeline(&pipeline);
                pass.bind_set(0, &set);
                pass.bind_geometry(&[&bench.corners, depth], &bench.indices);
                pass.draw(UPPER_HALF, 0, 0);
            });
        }
    })?;
    for (i, got) in texels(&readback)?.iter().enumerate() {
        let (x, y) = (i % 8, i / 8);
        let want = match (y < 2, x < 4) {
            (true, true) => 0.25,
            (true, false) => 0.75,
            (false, _) => 0.0,
        };
        assert_eq!(got[0], want, "{x} {y}");
    }
    bench.silent();
    Ok(())
}

/// What a driver of the CPU keeps anyway.
#[test]
fn drawn_layers_and_copied_texels_are_kept() -> Outcome {
    let bench = Bench::new()?;
    let array = DepthArray::new(&bench.device, "depth", 4, 1)?;
    let depth = pass_to(&array, 0).rendering(&bench.device).depth;
    assert_eq!(depth.load_op, ash::vk::AttachmentLoadOp::CLEAR);
    assert_eq!(depth.store_op, ash::vk::AttachmentStoreOp::STORE);
    let info = TextureInfo {
        name: "large",
        format: TextureFormat::Rgba8,
        size: 3001,
        layers: 1,
        levels: 1,
    };
    let mut upload = TextureUpload::new(&bench.device, &info)?;
    assert_eq!(upload.used, barriers::ImageUse::Undefined);
    upload.write(0, 0, &vec![0; 3001 * 3001 * 4])?;
    assert_eq!(upload.used, barriers::ImageUse::TransferDestination);
    Ok(())
}

fn pass_to(target: &DepthArray, layer: u32) -> DepthPassInfo<'_> {
    DepthPassInfo {
        name: "depth",
        target,
        layer,
    }
}

/// A quad whose corners run clockwise.
#[test]
fn back_faces_are_culled_only_where_asked() -> Outcome {
    let bench = Bench::new()?;
    let array = Arc::new(DepthArray::new(&bench.device, "depth", 4, 2)?);
    let pipeline = bench.pipeline(None)?;
    let set = bench.set(Resource::Depth(Arc::clone(&array)), Filter::Nearest)?;
    let depth = bench.constant(0.5)?;
    let mut turned = INDICES;
    turned.reverse();
    let turned = bytemuck::cast_slice(&turned);
    let turned = Buffer::with_data(&bench.device, "turned", BufferUse::Indices, turned)?;
    let (canvas, mut readback) = bench.canvas((8, 4), &fragment(TWO_LAYERS))?;
    canvas.draw(&bench, &set, &[&array], &mut readback, |recorder| {
        for (layer, cull) in (0..).zip([Cull::Back, Cull::Front]) {
            recorder.depth_pass(&pass_to(&array, layer), |pass| {
                pass.set_cull(cull);
                pass.bind_pipeline(&pipeline);
                pass.bind_set(0, &set);
                pass.bind_geometry(&[&bench.corners, &depth], &turned);
                pass.draw(0..6, 0, 0);
            });
        }
    })?;
    for (i, got) in texels(&readback)?.iter().enumerate() {
        let want = if i % 8 < 4 { 0.0 } else { 0.5 };
        assert_eq!(got[0], want, "{i}");
    }
    bench.silent();
    Ok(())
}

#[test]
#[should_panic(expected = "the pass reads the depth that set 0 holds")]
fn depth_that_a_pass_does_not_name_cannot_be_sampled_in_it() {
    let outcome = || -> Outcome {
        let bench = Bench::new()?;
        let array = Arc::new(DepthArray::new(&bench.device, "depth", 4, 1)?);
        let set = bench.set(Resource::Depth(array), Filter::Nearest)?;
        bench.picture((8, 4), &fragment(TWO_LAYERS), &set)?;
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}

#[test]
#[should_panic(expected = "colour comes from a fragment stage")]
fn colour_without_a_fragment_stage_is_refused() {
    let outcome = || -> Outcome {
        let bench = Bench::new()?;
        let info = PipelineInfo {
            name: "no fragments",
            vertex: spirv(VERTEX, glslang::ShaderStage::Vertex)?,
            fragment: None,
            attributes: &[],
            constants: &[],
            targets: Targets {
                color: Some(requirements::COLOR),
                depth: requirements::DEPTH,
                samples: Samples::One,
            },
            output: Output::Blended,
        };
        Pipeline::new(&bench.device, &bench.pipelines, &bench.cache, &info)?;
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}
