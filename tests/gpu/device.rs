//! Is the device chosen as asked, and are its limits kept?

use std::path::{Path, PathBuf};
use std::sync::Arc;

use umber::gpu::{Buffer, BufferUse, Error, Samples, Upload};
use umber::render::effects::Effects;
use umber::render::{RenderError, Renderer, Settings, Variant};

use crate::harness::with_gpu;
use crate::patches::{DARK, Patch, Patches, material};

fn settings(width: u32, height: u32) -> Settings {
    Settings {
        width,
        height,
        samples: Samples::One,
        variant: Variant::default(),
        effects: Effects::default(),
    }
}

fn one_patch() -> umber::scene::Scene {
    let patches = Patches {
        to_eye: glam::Vec3::Z,
        lights: Vec::new(),
        ambient: umber::scene::Ambient {
            sky: [1.0; 3],
            ..DARK
        },
        patches: vec![Patch {
            normal: glam::Vec3::Z,
            material: material([0.5; 3], [0.04; 3], 0.5),
        }],
    };
    patches.scene()
}

#[test]
fn a_size_of_0_or_beyond_the_device_is_refused_with_its_limit() {
    let scene = one_patch();
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

/// The one file in a folder of caches.
fn cache_file(folder: &Path) -> std::io::Result<PathBuf> {
    let files = std::fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    assert_eq!(files.len(), 1, "{files:?}");
    Ok(files[0].path())
}

#[test]
fn pipelines_are_kept_on_disk_and_a_damaged_file_costs_nothing_but_time()
-> Result<(), Box<dyn std::error::Error>> {
    let root = tempfile::tempdir()?;
    let folder = root.path().join("made").join("as needed");
    let scene = one_patch();
    let picture = |folder: &Path| {
        with_gpu(|gpu| {
            let renderer = Renderer::new(&gpu.device, Some(folder))?;
            renderer.render(&scene, &settings(8, 8))
        })
    };
    let (want, _) = picture(&folder)?;
    assert!(want.at(4, 4)[0] > 0.1);
    let file = cache_file(&folder)?;
    let good = std::fs::read(&file)?;
    let mut flipped = good.clone();
    let middle = good.len() / 2;
    flipped[middle] ^= 1;
    let cut = &good[..middle];
    for content in [&good[..], &flipped, cut, b"", b"umberPC1", b"\x7fELF"] {
        std::fs::write(&file, content)?;
        let (got, report) = picture(&folder)?;
        assert!(got == want && report.pipelines_created == 1);
        // Whole again, and alone.
        assert_eq!(cache_file(&folder)?, file);
        let kept = std::fs::read(&file)?;
        assert!(
            kept.starts_with(b"umberPC1") && kept.len() > 16,
            "{}",
            kept.len()
        );
    }
    // A place where no folder can be.
    let (got, _) = picture(&file.join("not a folder"))?;
    assert!(got == want);
    Ok(())
}
