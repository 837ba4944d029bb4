//! Which options do several verbs have?

use std::sync::Arc;

use clap::ValueEnum;

use crate::cli::exit::Failure;
use crate::gpu::{self, Device, DeviceSelector, Instance, Samples, Validation};
use crate::render::ToneMapping;
use crate::render::effects::{Build, EffectSet, Effects};

/// `--device` and `--validation`.
#[derive(clap::Args)]
pub struct DeviceArgument {
    /// INDEX, part of the NAME, UUID, cpu or gpu [default: discrete, integrated, virtual, cpu]
    #[arg(long, value_parser = device_selector)]
    pub device: Option<DeviceSelector>,
    /// Run under the validation layers; a message is a failure
    #[arg(long)]
    pub validation: bool,
}

impl DeviceArgument {
    /// Opens the device.
    pub fn open(&self) -> Result<Arc<Device>, Failure> {
        let validation = if self.validation {
            Validation::On
        } else {
            Validation::Off
        };
        let instance = Instance::new(validation)?;
        let devices = instance.devices()?;
        let selector = self.device.clone().unwrap_or_default();
        Ok(Device::open(&instance, gpu::choose(&devices, &selector)?)?)
    }
}

pub fn device_selector(text: &str) -> Result<DeviceSelector, &'static str> {
    match text {
        "" => Err("it names no device"),
        text => Ok(DeviceSelector::parse(text)),
    }
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ToneMappingArgument {
    /// Cut off at white
    None,
    /// Khronos PBR Neutral
    Neutral,
}

impl ToneMappingArgument {
    /// The mapping that is meant.
    pub fn mapping(self) -> ToneMapping {
        match self {
            Self::None => ToneMapping::None,
            Self::Neutral => ToneMapping::Neutral,
        }
    }

    /// The word on the command line.
    pub fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// EV at ISO 100.
pub fn exposure(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        // Beyond it 2^EV leaves the range of f32.
        Ok(ev) if ev.abs() <= 100.0 => Ok(ev),
        _ => Err("it is a number from -100 to 100".into()),
    }
}

/// `census`, `all`, `none`, or names of effects.
pub fn effects(text: &str) -> Result<Effects, String> {
    let census = Effects::default();
    match text {
        "census" => Ok(census),
        "all" => Ok(Effects {
            build: Build::Dynamic,
            ..census
        }),
        "none" => Ok(Effects {
            allowed: EffectSet::NONE,
            ..census
        }),
        list => Ok(Effects {
            allowed: effect_set(list)?,
            ..census
        }),
    }
}

/// Names of effects, with commas between them.
pub fn effect_set(text: &str) -> Result<EffectSet, String> {
    EffectSet::of_names(text.split(',')).map_err(|error| error.to_string())
}

pub fn build(text: &str) -> Result<Build, String> {
    let found = Build::ALL.into_iter().find(|build| build.name() == text);
    found.ok_or_else(|| "it is dynamic, scene or material".into())
}

/// What is said beside the name of a device that is none of its own; its kind by the name that reports have.
pub fn software(kind: &str) -> &'static str {
    match kind {
        "cpu" => " (a software rasteriser: times are a CPU's)",
        _ => "",
    }
}

/// `1 draw`, `2 draws`.
pub fn count(number: u64, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {what}{plural}")
}

pub fn size(text: &str) -> Result<(u32, u32), String> {
    let number = |digits: &str| {
        let all_digits = digits.bytes().all(|byte| byte.is_ascii_digit());
        all_digits.then(|| digits.parse().ok())?
    };
    let parsed = text
        .split_once(['x', 'X'])
        .and_then(|(w, h)| Some((number(w)?, number(h)?)));
    match parsed {
        Some((0, _) | (_, 0)) => Err("a picture has at least one pixel each way".into()),
        Some(size) => Ok(size),
        None => Err("write it as WIDTHxHEIGHT, such as 1280x720".into()),
    }
}

pub fn samples(text: &str) -> Result<Samples, String> {
    text.parse()
        .ok()
        .and_then(Samples::from_count)
        .ok_or_else(|| "it is 1, 2, 4 or 8".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_two_numbers_of_digits() {
        assert_eq!(size("1280x720"), Ok((1280, 720)));
        assert_eq!(size("1X1"), Ok((1, 1)));
        assert_eq!(size("4294967295x0007"), Ok((u32::MAX, 7)));
        for text in ["0x1", "1x0", "0x0"] {
            assert!(
                size(text).is_err_and(|e| e.contains("at least one pixel")),
                "{text}"
            );
        }
        for text in [
            "",
            "x",
            "8",
            "8x",
            "x8",
            "+8x8",
            "8x+8",
            "-8x8",
            " 8x8",
            "8x8 ",
            "8x8x8",
            "8.0x8",
            "4294967296x8",
            "8\u{d7}8",
            "0x8x8",
        ] {
            assert!(size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn exposure_has_its_range() {
        assert_eq!(exposure("-100"), Ok(-100.0));
        assert_eq!(exposure("1e1"), Ok(10.0));
        for text in ["", "nan", "inf", "-inf", "100.1", "ten"] {
            assert!(exposure(text).is_err(), "{text}");
        }
    }

    #[test]
    fn samples_are_a_power_of_two_up_to_eight() {
        for count in [1, 2, 4, 8] {
            assert_eq!(samples(&count.to_string()).map(Samples::count), Ok(count));
        }
        for text in ["", "0", "3", "16", "-4", "four", "4.0"] {
            assert!(samples(text).is_err(), "{text}");
        }
    }

    #[test]
    fn effects_are_words_or_names() {
        assert_eq!(effects("census"), Ok(Effects::default()));
        assert_eq!(effects("all").map(|e| e.build), Ok(Build::Dynamic));
        assert_eq!(effects("none").map(|e| e.allowed), Ok(EffectSet::NONE));
        let two = effects("shadow,spot-light").map(|e| e.allowed.to_string());
        assert_eq!(two, Ok("spot-light,shadow".to_owned()));
        let near = effects("shadows").unwrap_err();
        assert!(near.contains("'shadow'"), "{near}");
        for text in ["", ",", "shadow,", "census,all", "fog"] {
            assert!(effects(text).is_err(), "{text}");
        }
    }

    #[test]
    fn one_has_no_plural() {
        assert_eq!(count(1, "draw"), "1 draw");
        assert_eq!(count(0, "draw"), "0 draws");
        assert_eq!(count(2, "draw"), "2 draws");
    }
}
