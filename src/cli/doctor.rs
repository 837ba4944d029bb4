//! What does Vulkan see on this system, what is missing, and what mends it?

use crate::cli::devices::describe;
use crate::cli::exit::{Exit, Failure};
use crate::cli::output::print_bytes;
use crate::gpu::{
    Canary, Device, DeviceInfo, DeviceSelector, Error, Instance, Validation, choose, driver_files,
    install_line,
};

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
    print_bytes(environment().as_bytes())?;
    print_bytes(drivers().as_bytes())?;
    let devices = Instance::new(Validation::Off)?.devices()?;
    print_bytes(found(&devices).as_bytes())?;
    if devices.iter().all(|device| !device.missing.is_empty()) {
        let line = install_line();
        let message = format!("no device can run Umber; a software one does:\n{line}");
        return Err(Failure::new(Exit::Device, message));
    }
    let validation = match validation() {
        Ok(heard) => format!("validation: the layer is installed, {heard}\n"),
        Err(error) => format!("validation: {error}\n"),
    };
    print_bytes(validation.as_bytes())?;
    print_bytes(b"all is here: `umber render SCENE` will work\n")
}

fn environment() -> String {
    let set: Vec<_> = VARIABLES
        .iter()
        .filter_map(|name| {
            let value = std::env::var_os(name)?;
            Some(format!("  {name}={}\n", value.display()))
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

fn found(devices: &[DeviceInfo]) -> String {
    let lines: String = devices.iter().map(describe).collect();
    format!("loader: found\ndevices:\n{lines}")
}

/// Makes known mistakes under the layers, and says whether they were heard.
fn validation() -> Result<String, Error> {
    let instance = Instance::new(Validation::On)?;
    let devices = instance.devices()?;
    let device = Device::open(&instance, choose(&devices, &DeviceSelector::Best)?)?;
    let mut heard = Vec::new();
    for canary in Canary::ALL {
        canary.sing(&device)?;
        let messages = instance.validation_log().drain();
        let answer = messages.iter().any(|m| m.contains(canary.expected()));
        let answer = if answer { "answers" } else { "is silent" };
        heard.push(format!("{} validation {answer}", canary.name()));
    }
    Ok(heard.join(", "))
}
