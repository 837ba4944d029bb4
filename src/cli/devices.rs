//! Which Vulkan devices are here?

use crate::cli::exit::Failure;
use crate::cli::{print_bytes, print_json};
use crate::gpu::{DeviceInfo, Instance, Validation};
use crate::report::Device;

/// Options of `umber devices`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// `umber.devices/1`.
#[derive(serde::Serialize)]
struct Report {
    schema: &'static str,
    devices: Vec<Row>,
}

#[derive(serde::Serialize)]
struct Row {
    index: usize,
    #[serde(flatten)]
    device: Device,
    missing: Vec<String>,
}

/// Prints the list.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let devices = Instance::new(Validation::Off)?.devices()?;
    if arguments.json {
        let rows = devices.iter().map(|info| Row {
            index: info.index,
            device: info.into(),
            missing: info.missing.clone(),
        });
        return print_json(&Report {
            schema: "umber.devices/1",
            devices: rows.collect(),
        });
    }
    let lines: String = devices.iter().map(describe).collect();
    print_bytes(lines.as_bytes())
}

/// Three lines on one device.
pub fn describe(info: &DeviceInfo) -> String {
    format!(
        "{info}\n   driver {} {}, Vulkan {}\n   uuid {}\n",
        info.driver,
        info.driver_version,
        info.api_text(),
        info.uuid_text()
    )
}
