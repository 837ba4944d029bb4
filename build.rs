//! Which SPIR-V, and which numbers that the host must agree with, does this build ship?

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::UNIX_EPOCH;

#[path = "src/shader_build/mod.rs"]
mod shader_build;

/// Where the GLSL sources are, from the package's root, which is where cargo runs this.
const SHADERS: &str = "shaders-glsl";

fn main() -> ExitCode {
    println!("cargo:rerun-if-changed={SHADERS}");
    println!("cargo:rustc-env=UMBER_REVISION={}", revision());
    let Some(out) = env::var_os("OUT_DIR").map(PathBuf::from) else {
        eprintln!("error: no OUT_DIR: this is run by cargo");
        return ExitCode::FAILURE;
    };
    match shader_build::build(Path::new(SHADERS), &out, &salt()) {
        Ok(report) => {
            println!("compiled {:?}, reused {:?}", report.compiled, report.reused);
            ExitCode::SUCCESS
        }
        Err(errors) => {
            for error in errors {
                eprintln!("error: {error}");
            }
            ExitCode::FAILURE
        }
    }
}

/// Tells one build of this script from another: it is linked anew when the compiler crates or the
/// shader builder change, and then every shader is compiled anew.
fn salt() -> String {
    let linked = env::current_exe()
        .and_then(fs::metadata)
        .and_then(|data| data.modified());
    match linked.map(|time| time.duration_since(UNIX_EPOCH)) {
        Ok(Ok(age)) => format!("script of {}", age.as_nanos()),
        _ => "script of unknown age".to_owned(),
    }
}

/// The first twelve digits of the commit that is checked out, or `unknown` outside a clone.
fn revision() -> String {
    let git = git_folder();
    let commit = read(&git.join("HEAD")).and_then(|head| match head.strip_prefix("ref: ") {
        Some(name) => read(&git.join(name)).or_else(|| packed(&git, name)),
        None => Some(head.clone()),
    });
    match commit.as_deref().and_then(|commit| commit.get(..12)) {
        Some(short) if short.bytes().all(|b| b.is_ascii_hexdigit()) => short.to_owned(),
        _ => "unknown".to_owned(),
    }
}

/// `.git`, or what it points at in a worktree.
fn git_folder() -> PathBuf {
    let git = PathBuf::from(".git");
    let pointer = fs::read_to_string(&git).ok();
    let target = pointer
        .as_deref()
        .and_then(|text| text.strip_prefix("gitdir: "));
    target.map_or(git, |target| PathBuf::from(target.trim()))
}

/// A ref that git has moved into its one file of refs.
fn packed(git: &Path, name: &str) -> Option<String> {
    // Until a commit moves it out again, into a file of its own in this folder.
    watch(&git.join("refs/heads"));
    let refs = read(&git.join("packed-refs"))?;
    let line = refs
        .lines()
        .find(|line| line.split_once(' ').is_some_and(|(_, of)| of == name))?;
    line.split(' ').next().map(str::to_owned)
}

/// Reads a file and runs this script again when it changes.
fn read(path: &Path) -> Option<String> {
    watch(path);
    fs::read_to_string(path)
        .ok()
        .map(|text| text.trim().to_owned())
}

/// Only what exists is watched: cargo takes a missing path for one that always changes.
fn watch(path: &Path) {
    if path.exists() {
        println!("cargo:rerun-if-changed={}", path.display());
    }
}
