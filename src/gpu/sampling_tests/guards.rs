//! Does a pass refuse what a draw would be undefined without, and what a buffer does not hold?

use super::*;

/// A pipeline whose layout has a window and four bytes to be pushed, and a set for it.
struct Guarded {
    bench: Bench,
    pipeline: Pipeline,
    set: DescriptorSet,
}

impl Guarded {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let bench = Bench::new()?;
        let device = &bench.device;
        let window = Binding {
            slot: 0,
            kind: BindingKind::UniformWindow,
        };
        let layout = SetLayout::new(device, "guarded", &[window])?;
        let pipelines = PipelineLayout::new(device, "guarded", &[&layout], 4)?;
        let bytes = u64::from(device.uniform_alignment()) * 2;
        let buffer = Buffer::new(device, "windows", BufferUse::UniformWindows, bytes)?;
        let resources = [Resource::Window(Arc::new(buffer), 16)];
        let attribute = |location, format, rate| Attribute {
            location,
            format,
            rate,
        };
        let info = PipelineInfo {
            name: "guarded",
            vertex: spirv(VERTEX, glslang::ShaderStage::Vertex)?,
            fragment: None,
            attributes: &[
                attribute(0, VertexFormat::Rg32Float, Rate::PerVertex),
                attribute(1, VertexFormat::Rgba32Float, Rate::Constant),
            ],
            constants: &[],
            targets: Targets {
                color: None,
                depth: requirements::DEPTH,
                samples: Samples::One,
            },
            output: Output::Discarded,
        };
        Ok(Self {
            pipeline: Pipeline::new(device, &pipelines, &bench.cache, &info)?,
            set: DescriptorSet::new(&layout, "guarded", &resources)?,
            bench,
        })
    }
}

/// Records a depth pass with `work`.
fn recording(work: impl for<'a> FnOnce(&'a Guarded, &'a Buffer, &mut Pass<'_, 'a>)) {
    let outcome = || -> Outcome {
        let guarded = Guarded::new()?;
        let constant = guarded.bench.constant(0.5)?;
        let array = DepthArray::new(&guarded.bench.device, "depth", 4, 1)?;
        let mut recorder = Recorder::new(&guarded.bench.device, "guarded")?;
        let info = DepthPassInfo {
            name: "guarded",
            target: &array,
            layer: 0,
        };
        recorder.depth_pass(&info, |pass| work(&guarded, &constant, pass));
        recorder.submit()?;
        guarded.bench.silent();
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}

fn bind_all<'a>(guarded: &'a Guarded, constant: &'a Buffer, pass: &mut Pass<'_, 'a>) {
    pass.bind_pipeline(&guarded.pipeline);
    pass.bind_set_at(0, &guarded.set, guarded.bench.device.uniform_alignment());
    pass.push_constants(&[0; 4]);
    pass.bind_geometry(&[&guarded.bench.corners, constant], &guarded.bench.indices);
}

#[test]
fn with_everything_bound_it_draws() {
    recording(|guarded, constant, pass| {
        bind_all(guarded, constant, pass);
        pass.draw(WHOLE, 0, 0);
        pass.draw_instances(WHOLE, 0, 0..3);
    });
}

#[test]
#[should_panic(expected = "a pipeline is bound before its sets")]
fn a_set_without_a_pipeline_is_refused() {
    recording(|guarded, _, pass| pass.bind_set_at(0, &guarded.set, 0));
}

#[test]
#[should_panic(expected = "set 1 of the pipeline's layout")]
fn a_set_at_a_place_that_the_layout_lacks_is_refused() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set_at(1, &guarded.set, 0);
    });
}

#[test]
#[should_panic(expected = "a set whose window can stand at 4")]
fn a_window_between_two_blocks_is_refused() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set_at(0, &guarded.set, 4);
    });
}

#[test]
#[should_panic(expected = "a set whose window can stand at")]
fn a_window_beyond_its_buffer_is_refused() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set_at(
            0,
            &guarded.set,
            2 * guarded.bench.device.uniform_alignment(),
        );
    });
}

#[test]
#[should_panic(expected = "a set without a window")]
fn a_window_must_stand_somewhere() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set(0, &guarded.set);
    });
}

#[test]
#[should_panic(expected = "the push constants of the pipeline's layout")]
fn more_push_constants_than_the_layout_has_are_refused() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.push_constants(&[0; 8]);
    });
}

#[test]
#[should_panic(expected = "constants are pushed")]
fn a_draw_without_its_push_constants_is_refused() {
    recording(|guarded, constant, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set_at(0, &guarded.set, 0);
        pass.bind_geometry(&[&guarded.bench.corners, constant], &guarded.bench.indices);
        pass.draw(WHOLE, 0, 0);
    });
}

#[test]
#[should_panic(expected = "set 0 of the pipeline's layout is bound")]
fn a_draw_without_its_set_is_refused() {
    recording(|guarded, constant, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.push_constants(&[0; 4]);
        pass.bind_geometry(&[&guarded.bench.corners, constant], &guarded.bench.indices);
        pass.draw(WHOLE, 0, 0);
    });
}

#[test]
#[should_panic(expected = "the pipeline's vertex buffers are bound")]
fn a_draw_without_its_vertices_is_refused() {
    recording(|guarded, _, pass| {
        pass.bind_pipeline(&guarded.pipeline);
        pass.bind_set_at(0, &guarded.set, 0);
        pass.push_constants(&[0; 4]);
        pass.bind_geometry(&[&guarded.bench.corners], &guarded.bench.indices);
        pass.draw(WHOLE, 0, 0);
    });
}

#[test]
#[should_panic(expected = "the index range is in the index buffer")]
fn indirect_draws_beyond_the_indices_are_refused() {
    let device = match Bench::new() {
        Ok(bench) => bench,
        Err(error) => panic!("{error}"),
    };
    // 12 indices are there.
    let beyond = DrawCommand {
        indices: 6..15,
        vertex_offset: 0,
        instance: 0,
    };
    let outcome = || -> Outcome {
        let array = DepthArray::new(&device.device, "depth", 4, 1)?;
        let set = device.set(
            Resource::Depth(Arc::new(DepthArray::new(&device.device, "d", 4, 1)?)),
            Filter::Nearest,
        )?;
        let pipeline = device.pipeline(None)?;
        let constant = device.constant(0.5)?;
        let draws = IndirectDraws::new(&device.device, "draws", &[beyond])?;
        let mut recorder = Recorder::new(&device.device, "guarded")?;
        recorder.depth_pass(&pass_to(&array, 0), |pass| {
            pass.bind_pipeline(&pipeline);
            pass.bind_set(0, &set);
            pass.bind_geometry(&[&device.corners, &constant], &device.indices);
            pass.draw_indirect(&draws);
        });
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}

/// What a dispatch needs: a pipeline that writes its one word, and a set for it.
struct Computing {
    bench: Bench,
    pipeline: ComputePipeline,
    set: DescriptorSet,
    words: Arc<Buffer>,
}

const WRITER: &str = "#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer Words { uint words[]; };
layout(push_constant) uniform Push { uint pushed; };
void main() { words[gl_GlobalInvocationID.x] += pushed; }";

impl Computing {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        let bench = Bench::new()?;
        let device = &bench.device;
        let written = Binding {
            slot: 0,
            kind: BindingKind::Written,
        };
        let layout = SetLayout::new(device, "computing", &[written])?;
        let pipelines = PipelineLayout::for_compute(device, "computing", &layout, 4)?;
        let shader = spirv(WRITER, glslang::ShaderStage::Compute)?;
        let data = [1_u32, 2, 3, 4];
        let data = bytemuck::cast_slice(&data);
        let words = Buffer::with_data(device, "words", BufferUse::Written, data)?;
        let words = Arc::new(words);
        let resources = [Resource::Buffer(Arc::clone(&words))];
        Ok(Self {
            pipeline: ComputePipeline::new(
                device,
                &pipelines,
                &bench.cache,
                "computing",
                shader,
                &[],
            )?,
            set: DescriptorSet::new(&layout, "computing", &resources)?,
            words,
            bench,
        })
    }
}

#[test]
fn dispatches_see_what_was_written_before_them() -> Outcome {
    let computing = Computing::new()?;
    let device = &computing.bench.device;
    let mut to = Buffer::new(device, "to", BufferUse::Readback, 16)?;
    let mut recorder = Recorder::new(device, "computing")?;
    // More groups than words: what would be written beyond the buffer is not.
    recorder.dispatch(
        &computing.pipeline,
        &computing.set,
        &10_u32.to_ne_bytes(),
        9,
    );
    recorder.dispatch(
        &computing.pipeline,
        &computing.set,
        &100_u32.to_ne_bytes(),
        3,
    );
    recorder.read_back(&computing.words, &mut to, 16);
    recorder.submit()?;
    let words: Vec<u32> = bytemuck::cast_slice(to.read()?).to_vec();
    assert_eq!(words, [111, 112, 113, 14]);
    computing.bench.silent();
    Ok(())
}

/// Records dispatches with `work`.
fn computing(work: impl for<'a> FnOnce(&'a Computing, &mut Recorder<'a>)) {
    let outcome = || -> Outcome {
        let computing = Computing::new()?;
        let mut recorder = Recorder::new(&computing.bench.device, "computing")?;
        work(&computing, &mut recorder);
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}

#[test]
#[should_panic(expected = "the push constants of the pipeline's layout")]
fn a_dispatch_without_its_push_constants_is_refused() {
    computing(|c, recorder| recorder.dispatch(&c.pipeline, &c.set, &[], 1));
}

#[test]
#[should_panic(expected = "65536 work groups")]
fn more_groups_than_every_device_takes_are_refused() {
    computing(|c, recorder| recorder.dispatch(&c.pipeline, &c.set, &[0; 4], MOST_GROUPS + 1));
}

#[test]
#[should_panic(expected = "its set")]
fn a_dispatch_with_the_set_of_another_layout_is_refused() {
    let outcome = || -> Outcome {
        let (one, other) = (Computing::new()?, Computing::new()?);
        let mut recorder = Recorder::new(&one.bench.device, "computing")?;
        recorder.dispatch(&one.pipeline, &other.set, &[0; 4], 1);
        Ok(())
    };
    if let Err(error) = outcome() {
        panic!("{error}");
    }
}
