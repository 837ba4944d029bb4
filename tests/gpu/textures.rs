//! Are textures and samplers made, bound and refused as they should be?

use std::sync::Arc;

use umber::gpu::{
    Binding, BindingKind, Buffer, BufferUse, DescriptorSet, Device, Error, Filter, Resource,
    Sampler, SetLayout, TextureArray, TextureFormat, TextureInfo, TextureUpload,
};

use crate::harness::with_gpu;

const INFO: TextureInfo = TextureInfo {
    name: "test",
    format: TextureFormat::Rgba8,
    size: 4,
    layers: 2,
    levels: 2,
};

fn filled(device: &Arc<Device>, info: &TextureInfo) -> Result<Arc<TextureArray>, Error> {
    let mut upload = TextureUpload::new(device, info)?;
    for level in 0..info.levels {
        let texels = vec![0; info.side(level).pow(2) as usize * 4];
        for layer in 0..info.layers {
            upload.write(level, layer, &texels)?;
        }
    }
    upload.finish()
}

#[test]
fn an_array_says_what_it_is_and_counts_once() -> Result<(), Error> {
    with_gpu(|gpu| {
        let counts = || (gpu.device.images_created(), gpu.device.buffers_created());
        let (images, buffers) = counts();
        for &format in TextureFormat::ALL {
            let array = filled(&gpu.device, &TextureInfo { format, ..INFO })?;
            let said = (array.format(), array.size(), array.layers(), array.levels());
            assert_eq!(said, (format, 4, 2, 2));
        }
        // One for staging each.
        assert_eq!(counts(), (images + 4, buffers + 4));
        Ok(())
    })
}

#[test]
fn levels_end_at_one_texel() {
    let levels = [(1, 1), (2, 2), (3, 2), (4, 3), (5, 3), (4096, 13)];
    for (size, levels) in levels {
        assert_eq!(TextureInfo::all_levels(size), levels, "{size}");
        let info = TextureInfo { size, ..INFO };
        assert_eq!(info.side(levels - 1), 1, "{size}");
        assert_eq!(info.side(levels), 1, "{size}");
    }
}

#[test]
fn sides_and_layers_of_none_or_beyond_the_device_are_refused() {
    with_gpu(|gpu| {
        let device = &gpu.device;
        assert!(device.max_texture_size() >= 4096 && device.max_layers() >= 256);
        let one = TextureInfo { levels: 1, ..INFO };
        let sizes = [0, device.max_texture_size() + 1];
        let layers = [0, device.max_layers() + 1];
        let infos = (sizes.map(|size| TextureInfo { size, ..one }).into_iter())
            .chain(layers.map(|layers| TextureInfo { layers, ..one }));
        for info in infos {
            let refused = TextureUpload::new(device, &info);
            let limited = matches!(refused, Err(Error::BeyondLimit { .. }));
            assert!(limited, "{info:?}");
        }
    });
}

/// Makes the mistake of a program, which must panic.
fn mistake(work: impl FnOnce(&mut TextureUpload) -> Result<(), Error>) {
    with_gpu(|gpu| {
        let done = TextureUpload::new(&gpu.device, &INFO).and_then(|mut upload| work(&mut upload));
        if let Err(error) = done {
            panic!("{error}");
        }
    });
}

#[test]
#[should_panic(expected = "level 1 of layer 0 is written once")]
fn nothing_is_written_twice() {
    mistake(|upload| {
        upload.write(1, 0, &[0; 16])?;
        upload.write(1, 0, &[0; 16])
    });
}

#[test]
#[should_panic(expected = "texels of level 1")]
fn a_layer_is_written_whole() {
    mistake(|upload| upload.write(1, 0, &[0; 12]));
}

#[test]
#[should_panic(expected = "level 0 of 2, layer 2 of 2")]
fn there_are_no_more_layers_than_were_asked_for() {
    mistake(|upload| upload.write(0, 2, &[0; 64]));
}

#[test]
#[should_panic(expected = "layers of levels that were not written")]
fn nothing_is_left_unwritten() {
    with_gpu(|gpu| {
        let finished = TextureUpload::new(&gpu.device, &INFO).and_then(|mut upload| {
            upload.write(0, 0, &[0; 64])?;
            upload.finish()
        });
        assert!(finished.is_ok());
    });
}

#[test]
#[should_panic(expected = "4 levels of a side of 4")]
fn there_are_no_levels_below_one_texel() {
    with_gpu(|gpu| {
        let upload = TextureUpload::new(&gpu.device, &TextureInfo { levels: 4, ..INFO });
        assert!(upload.is_ok());
    });
}

fn layout(device: &Arc<Device>, kinds: &[BindingKind]) -> Result<Arc<SetLayout>, Error> {
    let bindings: Vec<_> = (0..)
        .zip(kinds)
        .map(|(slot, &kind)| Binding { slot, kind })
        .collect();
    SetLayout::new(device, "test", &bindings)
}

#[test]
fn a_set_holds_what_it_points_at() -> Result<(), Error> {
    with_gpu(|gpu| {
        let device = &gpu.device;
        let array = filled(device, &INFO)?;
        let sampler = Sampler::new(device, "test", Filter::Trilinear)?;
        let block = Buffer::with_data(device, "test", BufferUse::Storage, &[0; 16])?;
        let layout = layout(
            device,
            &[
                BindingKind::Texture,
                BindingKind::Storage,
                BindingKind::Sampler,
                BindingKind::Texture,
            ],
        )?;
        let resources = [
            Resource::Texture(Arc::clone(&array)),
            Resource::Buffer(Arc::new(block)),
            Resource::Sampler(Arc::clone(&sampler)),
            Resource::Texture(Arc::clone(&array)),
        ];
        let set = DescriptorSet::new(&layout, "test", &resources)?;
        drop(resources);
        let held = (Arc::strong_count(&array), Arc::strong_count(&sampler));
        assert_eq!(held, (3, 2));
        drop(set);
        let held = (Arc::strong_count(&array), Arc::strong_count(&sampler));
        assert_eq!(held, (1, 1));
        Ok(())
    })
}

#[test]
#[should_panic(expected = "test: binding 0")]
fn a_resource_of_another_kind_is_refused() {
    with_gpu(|gpu| {
        let made = || {
            let sampler = Sampler::new(&gpu.device, "test", Filter::Nearest)?;
            let layout = layout(&gpu.device, &[BindingKind::Texture])?;
            DescriptorSet::new(&layout, "test", &[Resource::Sampler(sampler)])
        };
        assert!(made().is_ok());
    });
}

#[test]
#[should_panic(expected = "test: too many")]
fn no_set_has_more_textures_than_every_device_sees() {
    with_gpu(|gpu| {
        let most = layout(&gpu.device, &[BindingKind::Texture; 16]);
        assert!(most.is_ok());
        let more = layout(&gpu.device, &[BindingKind::Texture; 17]);
        assert!(more.is_ok());
    });
}
