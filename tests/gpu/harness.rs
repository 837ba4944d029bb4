//! How does a test get a device, and how does it learn that the validation layers are silent?

use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use umber::gpu::{Device, DeviceSelector, Instance, Samples, Validation, choose};
use umber::reference::shade::{Lighting, Terms};
use umber::render::effects::Effects;
use umber::render::{FrameReport, Picture, Renderer, Settings, Variant};
use umber::scene::Scene;

/// One device for all tests: cargo runs them as threads of one process, and the log is the
/// instance's.
pub struct Gpu {
    pub device: Arc<Device>,
    pub renderer: Renderer,
}

impl Gpu {
    fn open() -> Result<Self, umber::gpu::Error> {
        let instance = Instance::new(Validation::On)?;
        let devices = instance.devices()?;
        let device = Device::open(&instance, choose(&devices, &DeviceSelector::Best)?)?;
        let renderer = Renderer::new(&device, None)?;
        Ok(Self { device, renderer })
    }

    /// Renders at one sample, as physics and NaN tests do.
    pub fn render(&self, scene: &Scene, size: (u32, u32), variant: Variant) -> Picture {
        self.render_at(scene, size, Samples::One, variant).0
    }

    /// Renders.
    pub fn render_at(
        &self,
        scene: &Scene,
        (width, height): (u32, u32),
        samples: Samples,
        variant: Variant,
    ) -> (Picture, FrameReport) {
        self.render_with(
            scene,
            &Settings {
                width,
                height,
                samples,
                variant,
                effects: Effects::default(),
            },
        )
    }

    /// Renders.
    pub fn render_with(&self, scene: &Scene, settings: &Settings) -> (Picture, FrameReport) {
        match self.renderer.render(scene, settings) {
            Ok(frame) => frame,
            Err(error) => panic!("no frame: {error}"),
        }
    }

    /// Whether this is lavapipe, whose min and max drop NaN.
    pub fn is_lavapipe(&self) -> bool {
        self.device.info().name.contains("llvmpipe")
    }
}

static GPU: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let gpu = Gpu::open().unwrap_or_else(|error| {
        panic!("the GPU tests need a driver and the validation layers; `make test` installs them\n{error}")
    });
    Mutex::new(gpu)
});

/// Runs a test's work on the device, alone; afterwards the validation layers must have been silent.
pub fn with_gpu<T>(work: impl FnOnce(&Gpu) -> T) -> T {
    // A test that failed with the device in hand has said so; the device itself is whole.
    let gpu = GPU.lock().unwrap_or_else(PoisonError::into_inner);
    gpu.device.instance().validation_log().drain();
    let result = work(&gpu);
    let messages = gpu.device.instance().validation_log().drain();
    assert!(messages.is_empty(), "validation:\n{}", messages.join("\n"));
    result
}

/// A variant of one lighting model with all terms.
pub fn whole(lighting: Lighting) -> Variant {
    Variant {
        lighting,
        terms: Terms::ALL,
    }
}

/// Each term alone, then all: what every comparison runs through.
pub const TERM_SETS: [Terms; 4] = [
    Terms {
        ambient: true,
        ..Terms::NONE
    },
    Terms {
        diffuse: true,
        ..Terms::NONE
    },
    Terms {
        specular: true,
        ..Terms::NONE
    },
    Terms::ALL,
];
