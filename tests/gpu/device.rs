//! Is the device chosen as asked, and are its limits kept?

use std::sync::Arc;

use umber::gpu::{Buffer, BufferUse, Error, Samples, Upload};
use umber::render::{RenderError, Settings, Variant};

use crate::harness::with_gpu;
use crate::patches::{DARK, Patch, Patches, material};

fn settings(width: u32, height: u32) -> Settings {
    Settings {
        width,
        height,
        samples: Samples::One,
        variant: Variant::default(),
    }
}

#[test]
fn a_size_of_0_or_beyond_the_device_is_refused_with_its_limit() {
    let scene = Patches {
        to_eye: glam::Vec3::Z,
        lights: Vec::new(),
        ambient: DARK,
        patches: vec![Patch {
            normal: glam::Vec3::Z,
            material: material([0.5; 3], [0.04; 3], 0.5),
        }],
    }
    .scene();
    with_gpu(|gpu| {
        for (width, height) in [(0, 8), (8, 0), (1 << 20, 8), (8, u32::MAX)] {
            let refused = gpu.renderer.render(&scene, &settings(width, height));
            let limited = matches!(refused, Err(RenderError::Gpu(Error::BeyondLimit { .. })));
            assert!(limited, "{width}x{height}");
        }
    });
}

#[test]
fn a_storage_buffer_beyond_the_device_is_refused() {
    with_gpu(|gpu| {
        let bytes = gpu.device.max_storage_bytes() + 1;
        let refused = Buffer::new(&gpu.device, "too large", BufferUse::Storage, bytes);
        assert!(matches!(refused, Err(Error::BeyondLimit { .. })));
    });
}

#[test]
fn pieces_of_any_size_arrive_in_order_and_the_rest_is_zero() -> Result<(), Error> {
    with_gpu(|gpu| {
        // Larger than one staging buffer (32 MiB), in pieces that do not divide it.
        let data: Vec<u8> = (0..(33 << 20) + 5)
            .map(|i: u32| (i * 7 % 251) as u8)
            .collect();
        let bytes = data.len() as u64 + 40;
        let mut upload = Upload::new(&gpu.device, "pieces", BufferUse::Readback, bytes)?;
        for piece in data.chunks(1_000_003) {
            upload.write(piece)?;
        }
        let buffer = upload.finish()?;
        let (content, rest) = buffer.read()?.split_at(data.len());
        assert!(content == data, "the bytes came back as they were");
        assert!(rest.iter().all(|byte| *byte == 0) && rest.len() == 40);
        Ok(())
    })
}

#[test]
fn a_device_outlives_its_last_handle_but_not_its_objects() -> Result<(), Error> {
    with_gpu(|gpu| {
        let before = Arc::strong_count(&gpu.device);
        let buffer = Buffer::new(&gpu.device, "held", BufferUse::Vertices, 64)?;
        assert_eq!(Arc::strong_count(&gpu.device), before + 1);
        drop(buffer);
        assert_eq!(Arc::strong_count(&gpu.device), before);
        Ok(())
    })
}
