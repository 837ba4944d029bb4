//! On what, and by what, was a figure made?

use crate::gpu::DeviceInfo;

/// The device of a report.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Device {
    /// The driver's name for it.
    pub name: String,
    /// `discrete`, `integrated`, `virtual`, `other` or `cpu`.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// The driver's name.
    pub driver: String,
    /// Its version, in its own words.
    pub driver_version: String,
    /// Vulkan version.
    pub api: String,
    /// Tells two equal cards apart.
    pub uuid: String,
}

impl From<&DeviceInfo> for Device {
    fn from(info: &DeviceInfo) -> Self {
        Self {
            name: info.name.clone(),
            kind: info.kind.name(),
            driver: info.driver.clone(),
            driver_version: info.driver_version.clone(),
            api: info.api_text(),
            uuid: info.uuid_text(),
        }
    }
}

/// The program that made a report.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct Program {
    /// Its version.
    pub version: &'static str,
    /// The git revision that it was built from, or `unknown`.
    pub revision: &'static str,
    /// What its times were taken with.
    pub clock: &'static str,
}

impl Program {
    /// This one.
    pub const THIS: Self = Self {
        version: env!("CARGO_PKG_VERSION"),
        revision: env!("UMBER_REVISION"),
        clock: "host: monotonic; gpu_ms: device timestamps",
    };
}
