//! Is there Vulkan here, and which devices does it have?

use std::ffi::CStr;
use std::sync::Arc;

use ash::vk;

use super::error::{Error, Named, VulkanResult};
use super::selection::{DeviceInfo, DeviceKind};
use super::validation::{ValidationLog, messenger_info};

/// The oldest Vulkan that has dynamic rendering and synchronization2 in its core.
pub const API_VERSION: u32 = vk::API_VERSION_1_3;

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Whether the validation layers watch every call.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Validation {
    /// Core and synchronization validation; every message goes to the log.
    On,
    /// No layer.
    Off,
}

/// The loader's instance, its validation log and messenger.
///
/// Dropped in this order: messenger, instance, log, library. Whatever is made from the instance
/// holds an `Arc` of it.
pub struct Instance {
    pub(super) raw: ash::Instance,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    has_debug_utils: bool,
    // Boxed: the messenger holds its address.
    log: Box<ValidationLog>,
    // The library stays loaded as long as anything that was loaded from it.
    entry: ash::Entry,
}

impl Instance {
    /// Loads the Vulkan library and makes an instance.
    ///
    /// # Errors
    /// No loader, no driver, no validation layer where one is asked for.
    pub fn new(validation: Validation) -> Result<Arc<Self>, Error> {
        // SAFETY: loading a library runs its initialisers; the Vulkan loader's are sound.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| Error::NoLoader {
            reason: error.to_string(),
        })?;
        require_version(&entry)?;
        let log = Box::new(ValidationLog::default());
        let has_debug_utils = offers_debug_utils(&entry, validation)?;
        let raw = create(&entry, validation, has_debug_utils, &log)?;
        let mut instance = Self {
            raw,
            messenger: None,
            has_debug_utils,
            log,
            entry,
        };
        if validation == Validation::On {
            instance.attach_messenger()?;
        }
        Ok(Arc::new(instance))
    }

    /// What the validation layers said so far; empty where they are off.
    pub fn validation_log(&self) -> &ValidationLog {
        &self.log
    }

    /// Whether objects and scopes can be named.
    pub(super) fn has_debug_utils(&self) -> bool {
        self.has_debug_utils
    }

    /// Every device, in the loader's order.
    ///
    /// # Errors
    /// The loader fails, or has no device at all.
    pub fn devices(&self) -> Result<Vec<DeviceInfo>, Error> {
        // SAFETY: the instance is alive.
        let handles =
            unsafe { self.raw.enumerate_physical_devices() }.named("vkEnumeratePhysicalDevices")?;
        if handles.is_empty() {
            return Err(Error::NoDriver {
                reason: "it lists no device".into(),
            });
        }
        Ok(handles
            .into_iter()
            .enumerate()
            .map(|(index, handle)| self.describe(index, handle))
            .collect())
    }

    /// The device that `info` describes, asked anew: a description may be older than the instance.
    pub(super) fn find(
        &self,
        info: &DeviceInfo,
    ) -> Result<(vk::PhysicalDevice, DeviceInfo), Error> {
        // SAFETY: the instance is alive.
        let handles =
            unsafe { self.raw.enumerate_physical_devices() }.named("vkEnumeratePhysicalDevices")?;
        handles
            .into_iter()
            .enumerate()
            .map(|(index, handle)| (handle, self.describe(index, handle)))
            .find(|(_, found)| (found.index, found.uuid) == (info.index, info.uuid))
            .ok_or_else(|| Error::NoSuchDevice {
                wanted: info.name.clone(),
                available: "  it is no longer there".into(),
            })
    }

    fn describe(&self, index: usize, handle: vk::PhysicalDevice) -> DeviceInfo {
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut ids = vk::PhysicalDeviceIDProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default()
            .push_next(&mut driver)
            .push_next(&mut ids);
        // SAFETY: `handle` comes from this instance; the chain lives until the call returns.
        unsafe {
            self.raw
                .get_physical_device_properties2(handle, &mut properties);
        }
        let core = properties.properties;
        DeviceInfo {
            index,
            name: array_text(&core.device_name),
            kind: DeviceKind::from_vulkan(core.device_type),
            driver: array_text(&driver.driver_name),
            driver_version: match array_text(&driver.driver_info) {
                // A driver with nothing to say still has a number.
                none if none.is_empty() => version_text(core.driver_version),
                text => text,
            },
            api: (
                vk::api_version_major(core.api_version),
                vk::api_version_minor(core.api_version),
                vk::api_version_patch(core.api_version),
            ),
            uuid: ids.device_uuid,
            missing: super::requirements::missing(&self.raw, handle, core.api_version),
        }
    }

    fn attach_messenger(&mut self) -> Result<(), Error> {
        let loader = ash::ext::debug_utils::Instance::new(&self.entry, &self.raw);
        // SAFETY: the log is boxed, and outlives the messenger (see `Drop`).
        let messenger =
            unsafe { loader.create_debug_utils_messenger(&messenger_info(&self.log), None) }
                .named("vkCreateDebugUtilsMessengerEXT")?;
        self.messenger = Some((loader, messenger));
        Ok(())
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: everything made from the instance held an `Arc` of it, so nothing is left; the
        // messenger goes first, so that the callback never sees a dropped log.
        unsafe {
            if let Some((loader, messenger)) = &self.messenger {
                loader.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

fn require_version(entry: &ash::Entry) -> Result<(), Error> {
    // SAFETY: a plain query of the loader.
    let version = unsafe { entry.try_enumerate_instance_version() }
        .named("vkEnumerateInstanceVersion")?
        .unwrap_or(vk::API_VERSION_1_0);
    if version < API_VERSION {
        return Err(Error::NoLoader {
            reason: format!(
                "the loader speaks Vulkan {}.{}, and 1.3 is needed",
                vk::api_version_major(version),
                vk::api_version_minor(version)
            ),
        });
    }
    Ok(())
}

fn offers_debug_utils(entry: &ash::Entry, validation: Validation) -> Result<bool, Error> {
    // SAFETY: plain queries of the loader.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }
        .named("vkEnumerateInstanceLayerProperties")?;
    let has_layer = layers
        .iter()
        .any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    if validation == Validation::On {
        // The layer brings the extension with it.
        return if has_layer {
            Ok(true)
        } else {
            Err(Error::NoValidationLayer)
        };
    }
    // SAFETY: as above.
    let extensions = unsafe { entry.enumerate_instance_extension_properties(None) }
        .named("vkEnumerateInstanceExtensionProperties")?;
    Ok(extensions
        .iter()
        .any(|extension| extension.extension_name_as_c_str() == Ok(ash::ext::debug_utils::NAME)))
}

fn create(
    entry: &ash::Entry,
    validation: Validation,
    has_debug_utils: bool,
    log: &ValidationLog,
) -> Result<ash::Instance, Error> {
    let application = vk::ApplicationInfo::default()
        .application_name(c"umber")
        .engine_name(c"umber")
        .api_version(API_VERSION);
    let mut extensions = Vec::new();
    if has_debug_utils {
        extensions.push(ash::ext::debug_utils::NAME.as_ptr());
    }
    if validation == Validation::On {
        // The layer's own, so it is there when the layer is.
        extensions.push(ash::ext::validation_features::NAME.as_ptr());
    }
    let layers = [VALIDATION_LAYER.as_ptr()];
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    // Also chained here, so that messages about the instance itself are heard.
    let mut messenger = messenger_info(log);
    let mut info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&extensions);
    if validation == Validation::On {
        info = info
            .enabled_layer_names(&layers)
            .push_next(&mut features)
            .push_next(&mut messenger);
    }
    // SAFETY: every pointer in `info` lives until the call returns.
    unsafe { entry.create_instance(&info, None) }.map_err(no_driver)
}

fn no_driver(result: vk::Result) -> Error {
    match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => Error::NoDriver {
            reason: "VK_ERROR_INCOMPATIBLE_DRIVER".into(),
        },
        result => Error::Call {
            call: "vkCreateInstance",
            result: VulkanResult(result),
            pass: None,
        },
    }
}

fn version_text(version: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(version),
        vk::api_version_minor(version),
        vk::api_version_patch(version)
    )
}

fn array_text(array: &[std::ffi::c_char]) -> String {
    let bytes: Vec<u8> = array
        .iter()
        .map(|c| c.cast_unsigned())
        .take_while(|byte| *byte != 0)
        .collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
