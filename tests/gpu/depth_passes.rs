//! Are depth passes recorded, counted and refused as they should be?

use umber::gpu::{
    DepthArray, DepthPassInfo, Error, Image, ImageInfo, PassInfo, Recorder, Samples, TargetFormat,
};

use crate::harness::{Gpu, with_gpu};

fn depth_pass(target: &DepthArray, layer: u32) -> DepthPassInfo<'_> {
    DepthPassInfo {
        name: "depth",
        target,
        layer,
    }
}

fn image(gpu: &Gpu, format: TargetFormat) -> Result<Image, Error> {
    let info = ImageInfo {
        name: "test",
        format,
        width: 8,
        height: 8,
        samples: Samples::One,
    };
    Image::new(&gpu.device, &info)
}

#[test]
fn layers_are_drawn_and_read_in_turn() -> Result<(), Error> {
    with_gpu(|gpu| {
        let before = gpu.device.images_created();
        let color = image(gpu, TargetFormat::Rgba32Float)?;
        let depth = image(gpu, TargetFormat::Depth32Float)?;
        let array = DepthArray::new(&gpu.device, "test", 16, 3)?;
        let untouched = DepthArray::new(&gpu.device, "placeholder", 1, 1)?;
        assert_eq!((array.size(), array.layers()), (16, 3));
        assert_eq!(gpu.device.images_created(), before + 4);
        let reads = [&array, &untouched];
        let info = PassInfo {
            name: "reading",
            color: &color,
            resolve: None,
            depth: &depth,
            reads: &reads,
        };
        let mut recorder = Recorder::new(&gpu.device, "test")?;
        for layer in [0, 2, 2] {
            recorder.depth_pass(&depth_pass(&array, layer), |_| {});
        }
        recorder.pass(&info, |_| {});
        recorder.depth_pass(&depth_pass(&array, 1), |_| {});
        recorder.pass(&info, |_| {});
        recorder.pass(&info, |_| {});
        let names: Vec<_> = (recorder.submit()?.into_iter())
            .map(|pass| {
                assert_eq!(
                    (pass.draws, pass.pipeline_binds, pass.descriptor_set_binds),
                    (0, 0, 0)
                );
                pass.name
            })
            .collect();
        let [d, r] = ["depth", "reading"];
        assert_eq!(names, [d, d, d, r, d, r, r]);
        Ok(())
    })
}

/// Draws to an array and reads it, or does the first alone.
fn drawn(gpu: &Gpu, array: &DepthArray, read: bool) -> Result<(), Error> {
    let color = image(gpu, TargetFormat::Rgba32Float)?;
    let depth = image(gpu, TargetFormat::Depth32Float)?;
    let reads = [array];
    let info = PassInfo {
        name: "reading",
        color: &color,
        resolve: None,
        depth: &depth,
        reads: &reads,
    };
    let mut recorder = Recorder::new(&gpu.device, "test")?;
    recorder.depth_pass(&depth_pass(array, 0), |_| {});
    if read {
        recorder.pass(&info, |_| {});
    }
    recorder.submit()?;
    Ok(())
}

#[test]
fn what_was_read_last_can_be_kept() -> Result<(), Error> {
    with_gpu(|gpu| {
        let array = DepthArray::new(&gpu.device, "test", 16, 1)?;
        drawn(gpu, &array, true)?;
        for _ in 0..2 {
            let color = image(gpu, TargetFormat::Rgba32Float)?;
            let depth = image(gpu, TargetFormat::Depth32Float)?;
            let reads = [&array];
            let info = PassInfo {
                name: "reading",
                color: &color,
                resolve: None,
                depth: &depth,
                reads: &reads,
            };
            let mut recorder = Recorder::new(&gpu.device, "test")?;
            recorder.keep(&array);
            recorder.pass(&info, |_| {});
            assert_eq!(recorder.submit()?.len(), 1);
        }
        Ok(())
    })
}

#[test]
#[should_panic(expected = "there is something to keep")]
fn what_was_drawn_to_last_cannot_be_kept() {
    let refused = with_gpu(|gpu| {
        let array = DepthArray::new(&gpu.device, "test", 16, 1)?;
        drawn(gpu, &array, true)?;
        drawn(gpu, &array, false)?;
        Recorder::new(&gpu.device, "test")?.keep(&array);
        Ok::<(), Error>(())
    });
    panic!("it was kept: {refused:?}");
}

#[test]
fn sides_and_layers_of_none_or_beyond_the_device_are_refused() {
    with_gpu(|gpu| {
        let device = &gpu.device;
        let wrong = [
            (0, 1),
            (1, 0),
            (device.max_texture_size() + 1, 1),
            (1, device.max_layers() + 1),
        ];
        for (size, layers) in wrong {
            let refused = DepthArray::new(device, "test", size, layers);
            let limited = matches!(refused, Err(Error::BeyondLimit { .. }));
            assert!(limited, "{size} {layers}");
        }
    });
}

#[test]
#[should_panic(expected = "depth: layer 2 of 2")]
fn there_is_no_pass_to_a_layer_that_is_not_there() {
    with_gpu(|gpu| {
        let done = || {
            let array = DepthArray::new(&gpu.device, "test", 4, 2)?;
            let mut recorder = Recorder::new(&gpu.device, "test")?;
            recorder.depth_pass(&depth_pass(&array, 2), |_| {});
            recorder.submit()
        };
        assert!(done().is_ok());
    });
}
