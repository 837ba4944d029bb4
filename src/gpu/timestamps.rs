//! How long did the device itself take?

use std::sync::Arc;

use ash::vk;

use super::device::Device;
use super::error::{Error, Named};

/// Two timestamps around a piece of work, outside every rendering instance: inside one they mean
/// nothing on a rasteriser that defers its work.
pub struct Timestamps {
    pub(super) pool: vk::QueryPool,
    device: Arc<Device>,
}

impl Timestamps {
    /// A pair, or `None` where the queue has no clock.
    ///
    /// # Errors
    /// The driver fails.
    pub fn new(device: &Arc<Device>) -> Result<Option<Self>, Error> {
        if device.timestamp_bits == 0 {
            return Ok(None);
        }
        let info = vk::QueryPoolCreateInfo::default()
            .query_type(vk::QueryType::TIMESTAMP)
            .query_count(2);
        // SAFETY: the queue has timestamps.
        let pool =
            unsafe { device.raw.create_query_pool(&info, None) }.named("vkCreateQueryPool")?;
        device.name(pool, "timestamps");
        Ok(Some(Self {
            pool,
            device: Arc::clone(device),
        }))
    }

    pub(super) fn is_of(&self, device: &Arc<Device>) -> bool {
        Arc::ptr_eq(&self.device, device)
    }

    /// Milliseconds between the two stamps of the last submission that was `timed`.
    ///
    /// # Errors
    /// There was none, or the driver fails.
    pub fn elapsed_ms(&self) -> Result<f64, Error> {
        let mut ticks = [0_u64; 2];
        // SAFETY: two 64-bit results fit; without WAIT a query that was never written is an error.
        unsafe {
            self.device.raw.get_query_pool_results(
                self.pool,
                0,
                &mut ticks,
                vk::QueryResultFlags::TYPE_64,
            )
        }
        .named("vkGetQueryPoolResults")?;
        let bits = self.device.timestamp_bits;
        let period_ns = f64::from(self.device.limits.timestamp_period);
        Ok(elapsed_ticks(ticks, bits) as f64 * period_ns * 1e-6)
    }
}

impl Drop for Timestamps {
    fn drop(&mut self) {
        // SAFETY: recorders borrow the pool until the device is done with it.
        unsafe { self.device.raw.destroy_query_pool(self.pool, None) };
    }
}

/// The difference on a counter of `bits` bits, which may have wrapped once between the stamps.
fn elapsed_ticks([begin, end]: [u64; 2], bits: u32) -> u64 {
    let mask = u64::MAX >> (64 - bits.clamp(1, 64));
    end.wrapping_sub(begin) & mask
}

#[cfg(test)]
mod tests {
    use super::elapsed_ticks;

    #[test]
    fn a_counter_that_wraps_still_counts() {
        assert_eq!(elapsed_ticks([10, 25], 64), 15);
        assert_eq!(elapsed_ticks([u64::MAX, 4], 64), 5);
        assert_eq!(elapsed_ticks([0xffff_fff0, 0x10], 32), 0x20);
        assert_eq!(elapsed_ticks([(1 << 36) - 1, 1], 36), 2);
    }
}
