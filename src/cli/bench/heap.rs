//! How does a driver's memory not disturb the times?
//!
//! glibc gives what is freed at the end of a heap back to the system, and asks for it again, page by page, in the next
//! frame. Whether it can depends on what happens to lie there: on lavapipe, which takes 160 MB for a frame of 10,000
//! draws, the same frame took 23 or 126 ms from one run to the next. Told to keep the memory, in one heap for all
//! threads, it takes 24 to 28.

use std::process::Command;

/// What glibc reads when a program starts; other C libraries pass it over. 16 GiB are more than any frame frees.
const VARIABLES: [(&str, &str); 2] = [
    ("MALLOC_TRIM_THRESHOLD_", "17179869184"),
    ("MALLOC_ARENA_MAX", "1"),
];

/// Starts the program again with a heap that keeps its memory, unless it has one or somebody chose another.
#[cfg(target_os = "linux")]
pub fn keep() {
    use std::os::unix::process::CommandExt;
    let missing: Vec<_> = VARIABLES
        .into_iter()
        .filter(|(name, _)| std::env::var_os(name).is_none())
        .collect();
    if missing.is_empty() {
        return;
    }
    if let Ok(program) = std::env::current_exe() {
        // Where it cannot be started again the times are noisier, and their intervals wider.
        let _ = Command::new(program)
            .args(std::env::args_os().skip(1))
            .envs(missing)
            .exec();
    }
}

/// Elsewhere there is nothing to tell.
#[cfg(not(target_os = "linux"))]
pub fn keep() {}

/// What reports say of it.
pub fn told() -> String {
    let told = VARIABLES.iter().filter_map(|(name, _)| {
        let value = std::env::var(name).ok()?;
        Some(format!("{name}={value}"))
    });
    told.collect::<Vec<_>>().join(" ")
}
