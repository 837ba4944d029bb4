//! What does a driver tell of the code that it made of a pipeline (VK_KHR_pipeline_executable_properties)?

use std::ffi::CStr;

use ash::khr::pipeline_executable_properties;
use ash::vk;

use super::device::Device;
use super::error::{Error, Named};

/// A number that a driver tells of one of a pipeline's programs: registers, instructions, bytes.
#[derive(Clone, PartialEq, Debug)]
pub struct Statistic {
    /// The program, in the driver's words.
    pub executable: String,
    /// What is counted, in the driver's words.
    pub name: String,
    /// How many; a yes is 1.
    pub value: f64,
}

/// Whether the driver can tell.
pub(super) fn are_told(instance: &ash::Instance, device: vk::PhysicalDevice) -> bool {
    // SAFETY: `device` comes from `instance`.
    let Ok(extensions) = (unsafe { instance.enumerate_device_extension_properties(device) }) else {
        return false;
    };
    let named = |extension: &vk::ExtensionProperties| {
        extension.extension_name_as_c_str() == Ok(pipeline_executable_properties::NAME)
    };
    if !extensions.iter().any(named) {
        return false;
    }
    let mut told = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut told);
    // SAFETY: `device` comes from `instance`, and has the extension of the chain, which lives until the call returns.
    unsafe { instance.get_physical_device_features2(device, &mut features) };
    told.pipeline_executable_info == vk::TRUE
}

/// What a pipeline must be made with to be asked.
pub(super) fn flags(device: &Device) -> vk::PipelineCreateFlags {
    match device.executable_properties {
        Some(_) => vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR,
        None => vk::PipelineCreateFlags::empty(),
    }
}

/// All that the driver tells of a pipeline that was made with `flags`; nothing where it cannot tell.
pub(super) fn of(device: &Device, pipeline: vk::Pipeline) -> Result<Vec<Statistic>, Error> {
    let Some(functions) = &device.executable_properties else {
        return Ok(Vec::new());
    };
    let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
    // SAFETY: the pipeline is this device's, whose feature is on.
    let executables = unsafe { functions.get_pipeline_executable_properties(&info) }
        .named("vkGetPipelineExecutablePropertiesKHR")?;
    let mut all = Vec::new();
    for (index, executable) in (0..).zip(&executables) {
        let info = vk::PipelineExecutableInfoKHR::default()
            .pipeline(pipeline)
            .executable_index(index);
        // SAFETY: the pipeline was made with `flags`, and has that many programs.
        let statistics = unsafe { functions.get_pipeline_executable_statistics(&info) }
            .named("vkGetPipelineExecutableStatisticsKHR")?;
        let executable = text(executable.name_as_c_str());
        all.extend(statistics.iter().map(|statistic| Statistic {
            executable: executable.clone(),
            name: text(statistic.name_as_c_str()),
            value: value(statistic.format, statistic.value),
        }));
    }
    Ok(all)
}

fn text<E>(name: Result<&CStr, E>) -> String {
    name.map_or_else(
        |_| String::new(),
        |name| name.to_string_lossy().into_owned(),
    )
}

fn value(
    format: vk::PipelineExecutableStatisticFormatKHR,
    value: vk::PipelineExecutableStatisticValueKHR,
) -> f64 {
    use vk::PipelineExecutableStatisticFormatKHR as Format;
    // SAFETY: all of the union's fields are plain numbers, of which every bit pattern is one.
    unsafe {
        match format {
            Format::BOOL32 => f64::from(value.b32 != vk::FALSE),
            Format::INT64 => value.i64 as f64,
            Format::UINT64 => value.u64 as f64,
            _ => value.f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_by_their_format() {
        use vk::PipelineExecutableStatisticFormatKHR as Format;
        use vk::PipelineExecutableStatisticValueKHR as Value;
        assert_eq!(value(Format::BOOL32, Value { b32: vk::TRUE }), 1.0);
        assert_eq!(value(Format::BOOL32, Value { b32: vk::FALSE }), 0.0);
        assert_eq!(value(Format::INT64, Value { i64: -7 }), -7.0);
        assert_eq!(
            value(Format::UINT64, Value { u64: 1 << 40 }),
            (1_u64 << 40) as f64
        );
        assert_eq!(value(Format::FLOAT64, Value { f64: 0.25 }), 0.25);
    }
}
