//! Which Vulkan devices are here?

use crate::cli::exit::Failure;
use crate::cli::output::{JsonArgument, print_bytes, write_json};
use crate::gpu::{DeviceInfo, Instance, Validation};
use crate::report::Device;

/// Options of `umber devices`.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    json: JsonArgument,
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
    let json = arguments.json.open()?;
    let devices = Instance::new(Validation::Off)?.devices()?;
    let Some(json) = json else {
        let lines: String = devices.iter().map(describe).collect();
        return print_bytes(lines.as_bytes());
    };
    let rows = devices.iter().map(|info| Row {
        index: info.index,
        device: info.into(),
        missing: info.missing.clone(),
    });
    let report = Report {
        schema: "umber.devices/1",
        devices: rows.collect(),
    };
    write_json(json, &report)
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
