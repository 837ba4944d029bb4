//! Which of the devices will do the work?

use std::fmt;

use ash::vk;

use super::error::Error;

/// What kind of device it is, best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum DeviceKind {
    /// A graphics card with memory of its own.
    Discrete,
    /// A GPU that shares the processor's memory.
    Integrated,
    /// A GPU behind a virtual machine.
    Virtual,
    /// Something else.
    Other,
    /// A software rasteriser on the processor.
    Cpu,
}

impl DeviceKind {
    pub(super) fn from_vulkan(kind: vk::PhysicalDeviceType) -> Self {
        match kind {
            vk::PhysicalDeviceType::DISCRETE_GPU => Self::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => Self::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => Self::Virtual,
            vk::PhysicalDeviceType::CPU => Self::Cpu,
            _ => Self::Other,
        }
    }

    /// One lower-case word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Other => "other",
            Self::Cpu => "cpu",
        }
    }
}

/// One physical device as the user sees it.
#[derive(Clone, Debug)]
pub struct DeviceInfo {
    /// Its place in the loader's list.
    pub index: usize,
    /// The driver's name for it.
    pub name: String,
    /// Its kind.
    pub kind: DeviceKind,
    /// The driver's name.
    pub driver: String,
    /// The driver's version, in the driver's own words.
    pub driver_version: String,
    /// Vulkan version: major, minor, patch.
    pub api: (u32, u32, u32),
    /// Tells two equal cards apart.
    pub uuid: [u8; 16],
    /// What it lacks to run Umber; empty for a suitable device.
    pub missing: Vec<String>,
}

impl DeviceInfo {
    /// The UUID as 8-4-4-4-12 hex digits.
    pub fn uuid_text(&self) -> String {
        let hex: String = self.uuid.iter().map(|byte| format!("{byte:02x}")).collect();
        [
            &hex[..8],
            &hex[8..12],
            &hex[12..16],
            &hex[16..20],
            &hex[20..],
        ]
        .join("-")
    }

    /// The Vulkan version as text.
    pub fn api_text(&self) -> String {
        format!("{}.{}.{}", self.api.0, self.api.1, self.api.2)
    }
}

impl fmt::Display for DeviceInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})", self.index, self.name, self.kind.name())?;
        if !self.missing.is_empty() {
            write!(f, ", unsuitable: lacks {}", self.missing.join(", "))?;
        }
        Ok(())
    }
}

/// What `--device` says.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum DeviceSelector {
    /// The best suitable kind, first in the loader's order.
    #[default]
    Best,
    /// `cpu`: a software rasteriser.
    Cpu,
    /// `gpu`: anything but a software rasteriser.
    Gpu,
    /// The loader's index.
    Index(usize),
    /// 32 hex digits, dashes ignored.
    Uuid([u8; 16]),
    /// A part of the name, in any case.
    Name(String),
}

impl DeviceSelector {
    /// Reads `INDEX|NAME|UUID|cpu|gpu`. Every text means something: what is no index, kind or UUID
    /// is a name.
    pub fn parse(text: &str) -> Self {
        match text {
            "cpu" => return Self::Cpu,
            "gpu" => return Self::Gpu,
            _ => {}
        }
        if let Some(uuid) = parse_uuid(text) {
            return Self::Uuid(uuid);
        }
        match text.parse() {
            Ok(index) => Self::Index(index),
            Err(_) => Self::Name(text.to_lowercase()),
        }
    }

    fn accepts(&self, device: &DeviceInfo) -> bool {
        match self {
            Self::Best => true,
            Self::Cpu => device.kind == DeviceKind::Cpu,
            Self::Gpu => device.kind != DeviceKind::Cpu,
            Self::Index(index) => device.index == *index,
            Self::Uuid(uuid) => device.uuid == *uuid,
            Self::Name(name) => device.name.to_lowercase().contains(name),
        }
    }
}

impl fmt::Display for DeviceSelector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Best => write!(f, "the best device"),
            Self::Cpu => write!(f, "cpu"),
            Self::Gpu => write!(f, "gpu"),
            Self::Index(index) => write!(f, "{index}"),
            Self::Uuid(uuid) => uuid.iter().try_for_each(|byte| write!(f, "{byte:02x}")),
            Self::Name(name) => write!(f, "{name}"),
        }
    }
}

fn parse_uuid(text: &str) -> Option<[u8; 16]> {
    let digits: Vec<u8> = text
        .chars()
        .filter(|c| *c != '-')
        .map(|c| c.to_digit(16).and_then(|digit| u8::try_from(digit).ok()))
        .collect::<Option<_>>()?;
    let bytes: Vec<u8> = digits
        .chunks_exact(2)
        .map(|pair| pair[0] << 4 | pair[1])
        .collect();
    (digits.len() == 32).then(|| bytes.try_into().ok())?
}

/// Picks the device: among those that the selector accepts, the suitable one of the best kind,
/// the first in the loader's order where kinds tie.
///
/// # Errors
/// Nothing fits the selector (the message lists what there is), or all that fits is unsuitable.
pub fn choose<'a>(
    devices: &'a [DeviceInfo],
    selector: &DeviceSelector,
) -> Result<&'a DeviceInfo, Error> {
    let accepted: Vec<_> = devices.iter().filter(|d| selector.accepts(d)).collect();
    let best = accepted
        .iter()
        .filter(|device| device.missing.is_empty())
        .min_by_key(|device| device.kind);
    match (best, accepted.first()) {
        (Some(best), _) => Ok(best),
        (None, Some(unsuitable)) => Err(Error::Unsuitable {
            device: unsuitable.name.clone(),
            missing: unsuitable.missing.join(", "),
        }),
        (None, None) => Err(Error::NoSuchDevice {
            wanted: selector.to_string(),
            available: devices
                .iter()
                .map(|device| format!("  {device}"))
                .collect::<Vec<_>>()
                .join("\n"),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(index: usize, name: &str, kind: DeviceKind) -> DeviceInfo {
        DeviceInfo {
            index,
            name: name.into(),
            kind,
            driver: String::new(),
            driver_version: String::new(),
            api: (1, 3, 0),
            uuid: [index as u8; 16],
            missing: Vec::new(),
        }
    }

    fn machine() -> Vec<DeviceInfo> {
        vec![
            device(0, "llvmpipe", DeviceKind::Cpu),
            device(1, "Old Card", DeviceKind::Discrete),
            device(2, "Built In", DeviceKind::Integrated),
            device(3, "Old Card", DeviceKind::Discrete),
        ]
    }

    fn chosen(selector: &str) -> Option<usize> {
        choose(&machine(), &DeviceSelector::parse(selector))
            .ok()
            .map(|device| device.index)
    }

    #[test]
    fn prefers_discrete_then_integrated_then_virtual_then_cpu() {
        let best =
            |devices: &[DeviceInfo]| choose(devices, &DeviceSelector::Best).ok().map(|d| d.index);
        assert_eq!(best(&machine()), Some(1));
        assert_eq!(best(&machine()[2..3]), Some(2));
        assert_eq!(best(&machine()[..1]), Some(0));
    }

    #[test]
    fn every_form_of_selector_finds_its_device() {
        assert_eq!(chosen("cpu"), Some(0));
        assert_eq!(chosen("gpu"), Some(1));
        assert_eq!(chosen("2"), Some(2));
        assert_eq!(chosen("built"), Some(2));
        assert_eq!(chosen("03030303-0303-0303-0303-030303030303"), Some(3));
        assert_eq!(chosen("9"), None);
        assert_eq!(chosen("voodoo"), None);
    }

    #[test]
    fn a_device_that_lacks_something_is_passed_over_and_refused_by_name() {
        let mut devices = machine();
        devices[1].missing = vec!["dynamicRendering".into()];
        let best = choose(&devices, &DeviceSelector::Best).map(|d| d.index);
        assert!(matches!(best, Ok(3)));
        let refused = choose(&devices, &DeviceSelector::Index(1)).map(|d| d.index);
        assert!(
            matches!(refused, Err(Error::Unsuitable { missing, .. }) if missing.contains("dynamicRendering"))
        );
    }

    #[test]
    fn the_refusal_lists_what_there_is() {
        let Err(error) = choose(&machine(), &DeviceSelector::parse("voodoo")) else {
            panic!("a device was found");
        };
        let text = error.to_string();
        assert!(text.contains("voodoo") && text.contains("llvmpipe") && text.contains("Built In"));
    }

    #[test]
    fn a_uuid_prints_as_it_is_read() {
        let device = device(7, "x", DeviceKind::Cpu);
        let selector = DeviceSelector::parse(&device.uuid_text());
        assert_eq!(selector, DeviceSelector::Uuid(device.uuid));
    }
}
