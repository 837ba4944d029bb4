//! Would the validation layers speak if something were wrong?

use umber::gpu::Canary;

use crate::harness::with_gpu;

#[test]
fn each_canary_is_heard() {
    with_gpu(|gpu| {
        for canary in Canary::ALL {
            if let Err(error) = canary.sing(&gpu.device) {
                panic!("{canary:?}: {error}");
            }
            let messages = gpu.device.instance().validation_log().drain();
            assert!(
                messages
                    .iter()
                    .any(|message| message.contains(canary.expected())),
                "{canary:?}: the layers said {messages:?}"
            );
        }
    });
}
