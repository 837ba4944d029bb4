//! How does a folder of GLSL become SPIR-V for the device and offsets for the host?
//!
//! Used by the build script, by the tests, and by whatever reloads a shader while the program runs.
//! Each entry point is expanded ([`include`]), compiled by glslang ([`compile`]), parsed by naga
//! ([`reflect`]), and the two results are held against each other ([`agreement`]). [`generate`] writes
//! what the host needs as Rust, [`sources`] the texts that it exports.

pub mod agreement;
pub mod compile;
pub mod generate;
pub mod include;
pub mod reflect;
pub mod sources;

use std::fmt;
use std::fs;
use std::path::Path;

use include::Expanded;
use reflect::Reflection;

/// What is wrong, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    /// The file as the user may open it: the shader folder joined with the path inside it.
    pub file: String,
    /// The line in that file, from 1; 0 where the error has no line.
    pub line: usize,
    /// One line of prose.
    pub message: String,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.file, self.message),
            line => write!(f, "{}:{line}: {}", self.file, self.message),
        }
    }
}

impl std::error::Error for Error {}

/// An error about a whole file.
fn file_error(file: &Path, message: impl Into<String>) -> Error {
    Error {
        file: file.display().to_string(),
        line: 0,
        message: message.into(),
    }
}

/// The pipeline stage of an entry point, told by the file's ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// `*.vert`
    Vertex,
    /// `*.frag`
    Fragment,
    /// `*.comp`
    Compute,
}

impl Stage {
    /// The stage of a file name, `None` where it is no entry point.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        match Path::new(name).extension()?.to_str()? {
            "vert" => Some(Self::Vertex),
            "frag" => Some(Self::Fragment),
            "comp" => Some(Self::Compute),
            _ => None,
        }
    }
}

/// One entry point, compiled and reflected.
#[derive(Debug, Clone)]
pub struct Entry {
    /// The file name, such as `surface.frag`.
    pub name: String,
    /// The SPIR-V module.
    pub words: Vec<u32>,
    /// What the host must agree with.
    pub reflection: Reflection,
}

/// What a build did.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Report {
    /// Entry points that were compiled, in order of name.
    pub compiled: Vec<String>,
    /// Entry points whose expansion had not changed since `out` was last written.
    pub reused: Vec<String>,
}

/// Builds every `*.vert`, `*.frag` and `*.comp` directly under `folder`.
///
/// Writes `NAME.EXT.spv` and `NAME.EXT.expanded` for each, `shaders.rs` and `sources.rs` into `out`. An entry point
/// is compiled anew only where its expansion differs from the one in `out`; so a change to one file
/// rebuilds only what includes it. `salt` is whatever else a compilation depends on (the compiler): a
/// new one rebuilds all.
///
/// # Errors
///
/// All errors of all entry points, each once, though several may include the file at fault.
pub fn build(folder: &Path, out: &Path, salt: &str) -> Result<Report, Vec<Error>> {
    let mut report = Report::default();
    let mut entries = Vec::new();
    let mut errors: Vec<Error> = Vec::new();
    for name in entry_names(folder).map_err(|error| vec![error])? {
        match build_entry(folder, out, salt, &name, &mut report) {
            Ok(entry) => entries.push(entry),
            Err(found) => {
                for error in found {
                    if !errors.contains(&error) {
                        errors.push(error);
                    }
                }
            }
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let all = Reflection::merge(folder, &entries)?;
    write(&out.join("shaders.rs"), generate::rust(&entries, &all)).map_err(|error| vec![error])?;
    let sources = sources::rust(folder).map_err(|error| vec![error])?;
    write(&out.join("sources.rs"), sources).map_err(|error| vec![error])?;
    Ok(report)
}

/// The entry points directly under `folder`, in order of name.
fn entry_names(folder: &Path) -> Result<Vec<String>, Error> {
    let unreadable = |error: std::io::Error| file_error(folder, error.to_string());
    let mut names = Vec::new();
    for item in fs::read_dir(folder).map_err(unreadable)? {
        if let Ok(name) = item.map_err(unreadable)?.file_name().into_string()
            && Stage::of(&name).is_some()
        {
            names.push(name);
        }
    }
    names.sort();
    if names.is_empty() {
        return Err(file_error(folder, "no *.vert, *.frag or *.comp in it"));
    }
    Ok(names)
}

/// Expands, compiles (or finds compiled) and reflects one entry point.
fn build_entry(
    folder: &Path,
    out: &Path,
    salt: &str,
    name: &str,
    report: &mut Report,
) -> Result<Entry, Vec<Error>> {
    let one = |error: Error| vec![error];
    let stage = Stage::of(name).ok_or_else(|| one(file_error(&folder.join(name), "no stage")))?;
    let expanded = include::expand(folder, name).map_err(one)?;
    let key_file = out.join(format!("{name}.expanded"));
    let spirv_file = out.join(format!("{name}.spv"));
    let key = format!("// {salt}; {}\n{}", compile::OPTIONS, expanded.text);

    let words = match reuse(&key_file, &key, &spirv_file) {
        Some(words) => {
            report.reused.push(name.to_owned());
            words
        }
        None => {
            report.compiled.push(name.to_owned());
            compile::compile(&expanded, stage)?
        }
    };
    let reflection = reflected(&expanded, stage, &words)?;
    // The key comes last: a build that is cut short leaves no key, so nothing is taken for done.
    write(&spirv_file, bytes(&words)).map_err(one)?;
    write(&key_file, key).map_err(one)?;
    Ok(Entry {
        name: name.to_owned(),
        words,
        reflection,
    })
}

/// Reflects the source, and holds the result against the SPIR-V that ships.
fn reflected(expanded: &Expanded, stage: Stage, words: &[u32]) -> Result<Reflection, Vec<Error>> {
    let reflection = reflect::reflect(expanded, stage)?;
    agreement::check(&reflection, words).map_err(|message| vec![expanded.error(1, message)])?;
    Ok(reflection)
}

/// The SPIR-V of an earlier build, where it was made from the same text.
fn reuse(key_file: &Path, key: &str, spirv_file: &Path) -> Option<Vec<u32>> {
    if fs::read_to_string(key_file).ok()? != key {
        return None;
    }
    let bytes = fs::read(spirv_file).ok()?;
    let (words, rest) = bytes.as_chunks::<4>();
    rest.is_empty()
        .then(|| words.iter().map(|word| u32::from_ne_bytes(*word)).collect())
}

/// A SPIR-V module as it lies in a file: the reader tells the byte order by the magic number.
fn bytes(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_ne_bytes()).collect()
}

/// Writes a file, unless it holds that already.
fn write(path: &Path, data: impl AsRef<[u8]>) -> Result<(), Error> {
    if fs::read(path).is_ok_and(|old| old == data.as_ref()) {
        return Ok(());
    }
    fs::write(path, data).map_err(|error| file_error(path, error.to_string()))
}
