//! Would the validation layers speak if something were wrong, and would a test without them fail?

use std::process::Command;
use std::sync::Arc;

use umber::gpu::{Canary, Device, DeviceSelector, Instance, Samples, Validation, choose};
use umber::reference::shade::Lighting;
use umber::render::effects::Effects;
use umber::render::{Renderer, Settings};

use crate::harness::{whole, with_gpu};
use crate::zoo;

#[test]
fn each_canary_is_heard_by_its_rule() {
    with_gpu(|gpu| {
        for canary in Canary::ALL {
            // Written out: a text that every message holds would prove nothing.
            let rule = match canary {
                Canary::Core => "VUID-vkCmdCopyBuffer-size-00115",
                Canary::Synchronization => "SYNC-HAZARD-WRITE-AFTER-WRITE",
            };
            assert_eq!(canary.expected(), rule);
            if let Err(error) = canary.sing(&gpu.device) {
                panic!("{canary:?}: {error}");
            }
            let messages = gpu.device.instance().validation_log().drain();
            assert!(
                messages.iter().any(|message| message.contains(rule)),
                "{canary:?}: the layers said {messages:?}"
            );
        }
    });
}

/// What the harness asserts after every test.
#[test]
#[should_panic(expected = "SYNC-HAZARD-WRITE-AFTER-WRITE")]
fn a_message_fails_the_test_in_which_it_came() {
    with_gpu(|gpu| {
        if let Err(error) = Canary::Synchronization.sing(&gpu.device) {
            panic!("{error}");
        }
    });
}

/// The layers report what is left when a device goes, and what goes before its user.
#[test]
fn everything_is_destroyed_before_the_device_and_in_order() -> Result<(), umber::gpu::Error> {
    let scene = zoo::load("roughness.toml");
    let instance = Instance::new(Validation::On)?;
    let devices = instance.devices()?;
    let device = Device::open(&instance, choose(&devices, &DeviceSelector::Best)?)?;
    let renderer = Renderer::new(&device, None)?;
    for samples in [Samples::One, Samples::Four] {
        let settings = Settings {
            width: 32,
            height: 18,
            samples,
            variant: whole(Lighting::CORRECTED),
            effects: Effects::default(),
        };
        if let Err(error) = renderer.render(&scene, &settings) {
            panic!("no frame: {error}");
        }
    }
    // The renderer goes last: it holds the device.
    let watched = Arc::downgrade(&device);
    drop(device);
    assert!(watched.upgrade().is_some(), "the renderer holds its device");
    drop(renderer);
    assert!(watched.upgrade().is_none(), "something holds the device");
    let messages = instance.validation_log().drain();
    assert!(messages.is_empty(), "validation:\n{}", messages.join("\n"));
    Ok(())
}

/// What one test of this program says where the loader sees other drivers or layers.
fn said_with(variables: &[&str], place: &str) -> std::io::Result<String> {
    let mut command = Command::new(std::env::current_exe()?);
    command.args(["--exact", "canaries::each_canary_is_heard_by_its_rule"]);
    for variable in variables {
        command.env(variable, place);
    }
    let output = command.output()?;
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stdout) + &text(&output.stderr);
    assert!(said.contains("running 1 test"), "{said}");
    assert!(!output.status.success(), "{said}");
    Ok(said)
}

#[test]
fn without_driver_or_layers_the_tests_fail_and_say_how_to_get_them() -> std::io::Result<()> {
    let said = said_with(&["VK_DRIVER_FILES", "VK_ICD_FILENAMES"], "/nowhere.json")?;
    for words in ["make test", "finds no driver", "mesa-vulkan-drivers"] {
        assert!(said.contains(words), "{said}");
    }
    let said = said_with(&["VK_LAYER_PATH"], "/nowhere")?;
    for words in ["make test", "vulkan-validationlayers"] {
        assert!(said.contains(words), "{said}");
    }
    Ok(())
}
