//! What does Vulkan see on this system, what is missing, and what mends it?

use std::fmt::Write;

use crate::cli::devices::describe;
use crate::cli::exit::{Exit, Failure};
use crate::cli::print_bytes;
use crate::gpu::{self, Instance, Validation, driver_files, install_line};

/// The variables that change what the loader finds.
const VARIABLES: &[&str] = &[
    "VK_DRIVER_FILES",
    "VK_ICD_FILENAMES",
    "VK_ADD_DRIVER_FILES",
    "VK_INSTANCE_LAYERS",
    "VK_LAYER_PATH",
    "MESA_VK_DEVICE_SELECT",
    "LP_NUM_THREADS",
];

/// Prints the findings; fails where no device can run Umber.
pub fn run() -> Result<(), Failure> {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = write!(text, "{}{}", environment(), drivers());
    let devices = Instance::new(Validation::Off).and_then(|instance| instance.devices());
    let suitable = match &devices {
        Ok(devices) => {
            text.push_str("loader: found\ndevices:\n");
            text.extend(devices.iter().map(describe));
            devices.iter().any(|device| device.missing.is_empty())
        }
        Err(error) => {
            let _ = writeln!(text, "loader or driver: {error}");
            false
        }
    };
    if devices.is_ok() {
        let _ = writeln!(text, "validation: {}", validation());
    }
    print_bytes(text.as_bytes())?;
    match (devices, suitable) {
        (Ok(_), true) => print_bytes(b"all is here: `umber render SCENE` will work\n"),
        (Ok(_), false) => Err(Failure::new(
            Exit::Device,
            format_args!(
                "no device can run Umber; a software one does:\n{}",
                install_line()
            ),
        )),
        (Err(error), _) => Err(Failure::new(
            exit_of(&error),
            "Vulkan is not usable, see above",
        )),
    }
}

fn exit_of(_: &gpu::Error) -> Exit {
    Exit::Device
}

fn environment() -> String {
    let set: Vec<_> = VARIABLES
        .iter()
        .filter_map(|name| {
            std::env::var(name)
                .ok()
                .map(|value| format!("  {name}={value}\n"))
        })
        .collect();
    if set.is_empty() {
        return "variables: none that changes Vulkan\n".into();
    }
    format!("variables:\n{}", set.concat())
}

fn drivers() -> String {
    let files = driver_files();
    if files.is_empty() {
        return "driver files: none in the usual folders\n".into();
    }
    let lines: String = files
        .iter()
        .map(|file| format!("  {}\n", file.display()))
        .collect();
    format!("driver files:\n{lines}")
}

fn validation() -> String {
    match Instance::new(Validation::On) {
        Ok(_) => "the layer is installed".into(),
        Err(error) => error.to_string(),
    }
}
