//! Does the device do what the references say? Needs a Vulkan driver and the validation layers.
//!
//! Every test runs under core and synchronization validation, and any message fails it.

mod binary;
mod blending;
mod canaries;
mod claim;
mod continuity;
mod corrections;
mod cost;
mod depth_passes;
mod device;
mod effects;
mod golden;
mod harness;
mod ladders;
mod patches;
mod physics;
mod records;
mod shadows;
mod slides_breakdown;
mod spheres;
mod stability;
mod state_changes;
mod textures;
#[path = "../tolerances.rs"]
mod tolerances;
mod zoo;
