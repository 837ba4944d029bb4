//! On what, and by what, was a figure made?

use crate::gpu::DeviceInfo;

/// The device of a report.
#[derive(Clone, PartialEq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Device {
    /// The driver's name for it.
    pub name: String,
    /// `discrete`, `integrated`, `virtual`, `other` or `cpu`.
    #[serde(rename = "type")]
    pub kind: String,
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
            kind: info.kind.name().to_owned(),
            driver: info.driver.clone(),
            driver_version: info.driver_version.clone(),
            api: info.api_text(),
            uuid: info.uuid_text(),
        }
    }
}

/// The machine around the device. Empty or null where the system does not say.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Machine {
    /// The processor's name.
    pub processor: String,
    /// Threads that the program may run at once.
    pub threads: Option<usize>,
    /// Memory, bytes.
    pub memory_bytes: Option<u64>,
    /// Kernel and its release.
    pub system: String,
}

impl Machine {
    /// This one, as far as Linux tells; elsewhere its threads and its system's name.
    pub fn this() -> Self {
        let read = |path| std::fs::read_to_string(path).unwrap_or_default();
        let system = match read("/proc/sys/kernel/osrelease").trim() {
            "" => std::env::consts::OS.to_owned(),
            release => format!("{} {release}", std::env::consts::OS),
        };
        Self {
            processor: value(&read("/proc/cpuinfo"), "model name").to_owned(),
            threads: std::thread::available_parallelism().ok().map(usize::from),
            memory_bytes: kibibytes(value(&read("/proc/meminfo"), "MemTotal")),
            system,
        }
    }
}

/// What follows `key` and a colon in the first line that begins with it.
fn value<'t>(text: &'t str, key: &str) -> &'t str {
    let mut lines = text.lines().filter_map(|line| line.split_once(':'));
    let found = lines.find(|(name, _)| name.trim() == key);
    found.map_or("", |(_, value)| value.trim())
}

fn kibibytes(text: &str) -> Option<u64> {
    let number: u64 = text.strip_suffix("kB")?.trim().parse().ok()?;
    number.checked_mul(1024)
}

/// The program that made a report.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize, serde::Deserialize)]
pub struct Program {
    /// Its version.
    pub version: String,
    /// The git revision that it was built from, or `unknown`.
    pub revision: String,
    /// What its times were taken with.
    pub clock: String,
}

impl Program {
    /// This one.
    pub fn this() -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            revision: env!("UMBER_REVISION").to_owned(),
            clock: "host: monotonic; gpu_ms: device timestamps".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_linux_says_is_found() {
        let cpu = "processor\t: 0\nmodel name\t: A CPU @ 2 GHz\nmodel name\t: another\n";
        assert_eq!(value(cpu, "model name"), "A CPU @ 2 GHz");
        assert_eq!(value(cpu, "model"), "");
        assert_eq!(kibibytes("16 kB"), Some(16384));
        for text in ["", "16", "kB", "-1 kB", "99999999999999999999 kB"] {
            assert_eq!(kibibytes(text), None, "{text}");
        }
    }
}
