//! What did the validation layers say, and to whom?
//!
//! Each instance owns its log: tests run as threads of one process, and a global log would mix them.
//! The callback only records. It never panics (it is called from C) and never blocks for long.

use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};

use ash::vk;

/// Messages that are known to be wrong, with the reason. Empty: nothing is muted.
const MUTED: &[(&str, &str)] = &[];

/// The errors and warnings of the validation layers, in the order they came.
#[derive(Debug, Default)]
pub struct ValidationLog {
    messages: Mutex<Vec<String>>,
}

impl ValidationLog {
    /// How many messages came so far.
    pub fn len(&self) -> usize {
        self.lock().len()
    }

    /// Whether the layers had nothing to say.
    pub fn is_empty(&self) -> bool {
        self.lock().is_empty()
    }

    /// Takes the messages out, leaving none.
    pub fn drain(&self) -> Vec<String> {
        std::mem::take(&mut *self.lock())
    }

    fn record(&self, message: String) {
        self.lock().push(message);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<String>> {
        // A poisoned log is still a log: no code that holds the lock can leave it half written.
        self.messages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The messenger that fills `log`. The log must outlive the messenger: `Instance` holds both.
pub(super) fn messenger_info(log: &ValidationLog) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::WARNING
                | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
        )
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
        )
        .pfn_user_callback(Some(on_message))
        .user_data(std::ptr::from_ref(log).cast_mut().cast())
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    log: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: Vulkan passes a valid structure, or none; `log` is the pointer given in
    // `messenger_info`, which `Instance` keeps alive until after the messenger is destroyed.
    let (data, log) = unsafe { (data.as_ref(), log.cast::<ValidationLog>().as_ref()) };
    if let (Some(data), Some(log)) = (data, log) {
        let id = text(data.p_message_id_name);
        if !MUTED.iter().any(|(muted, _)| *muted == id) {
            log.record(text(data.p_message));
        }
    }
    vk::FALSE
}

fn text(pointer: *const std::ffi::c_char) -> String {
    if pointer.is_null() {
        return String::new();
    }
    // SAFETY: not null, and Vulkan promises a NUL-terminated string for the length of the callback.
    unsafe { CStr::from_ptr(pointer) }
        .to_string_lossy()
        .into_owned()
}
