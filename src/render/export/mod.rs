//! How do the lighting functions leave for other renderers, in which languages, and with which promises?
//!
//! GLSL is the very text that frames are shaded with. WGSL, HLSL and MSL are made of it by naga, and each function's comment, with
//! its source and its bound, is put back over it. Nothing here is a list: what is in `brdf/` is exported.

mod comments;
mod names;
mod sources;
mod translate;

use sources::{File, Item, with_needs};

use crate::render::library::{FUNCTIONS, Function};
use crate::scene::suggest;

/// A shading language.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// WebGPU's.
    Wgsl,
    /// Direct3D's.
    Hlsl,
    /// Metal's.
    Msl,
    /// OpenGL's and Vulkan's, from version 4.00 on.
    Glsl,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Wgsl, Self::Hlsl, Self::Msl, Self::Glsl];

    /// What the command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::Glsl => "glsl",
        }
    }

    /// What a compiler of it must be told so that the bounds hold.
    fn caution(self) -> &'static str {
        match self {
            Self::Wgsl => "",
            Self::Hlsl => " Compile with strict IEEE arithmetic (-Gis).",
            Self::Msl => " Compile without fast math, which Metal has on by default.",
            Self::Glsl => " What is `precise` must stay so.",
        }
    }
}

/// Why a function cannot be exported.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum ExportError {
    /// There is none of that name; the text tells the nearest.
    #[error("{0}")]
    Unknown(String),
    /// It computes with what rounding loses, and the language's text could not forbid to reorder that.
    #[error(
        "{function} needs {item}, which keeps nothing where a compiler reorders: only glsl, where it is `precise`, has it"
    )]
    Precise {
        /// What was asked for.
        function: String,
        /// What it needs.
        item: &'static str,
    },
    /// naga refuses the text, or left something out.
    #[error("naga: {0}")]
    Naga(String),
}

/// The names that can be asked for: the functions, and the files of `brdf/`, each of which stands for its functions.
pub fn names() -> impl Iterator<Item = &'static str> {
    let functions = sources::FILES.iter().flat_map(File::functions);
    functions.map(|item| item.name).chain(stems())
}

fn stems() -> impl Iterator<Item = &'static str> {
    let files = sources::FILES.iter().filter(|file| file.is_in("brdf"));
    files.map(File::stem)
}

/// What there is, file by file: its question and its functions.
pub fn list() -> String {
    let mut text = String::new();
    for file in sources::FILES.iter() {
        let functions: Vec<_> = file.functions().map(|item| item.name).collect();
        if functions.is_empty() {
            continue;
        }
        let question = question(file);
        let only = match file.items.iter().any(Item::is_precise) || !file.is_in("brdf") {
            true => " (glsl)",
            false => "",
        };
        text.push_str(&format!("{}{only}: {question}\n", file.stem()));
        text.push_str(&format!("  {}\n", functions.join(", ")));
    }
    text
}

/// The text of those functions and of all that they need, in a language; of all of `brdf/`, and in GLSL also of those that
/// keep what rounding loses, where none is named. A dash in a name stands for an underscore.
///
/// # Errors
/// There is no such function; the language cannot keep what it needs.
pub fn export(language: Language, asked: &[String]) -> Result<String, ExportError> {
    let wanted = match asked {
        [] => everything(language),
        _ => {
            let found = asked.iter().map(|name| found(name));
            found.collect::<Result<Vec<_>, _>>()?.concat()
        }
    };
    let chosen = with_needs(&wanted);
    if language != Language::Glsl {
        for name in &wanted {
            let mut needs = with_needs(&[*name])
                .into_iter()
                .flat_map(|(_, items)| items);
            if let Some(item) = needs.find(|item| item.is_precise()) {
                return Err(ExportError::Precise {
                    function: (*name).to_owned(),
                    item: item.name,
                });
            }
        }
    }
    let body = match language {
        Language::Glsl => glsl(&chosen),
        other => {
            let text = translate::translate(other, &plain(&chosen)).map_err(ExportError::Naga)?;
            comments::put_back(&text, &chosen).map_err(ExportError::Naga)?
        }
    };
    Ok(head(language, asked) + &body)
}

fn everything(language: Language) -> Vec<&'static str> {
    let kept = language == Language::Glsl;
    let wanted = |file: &&File| file.is_in("brdf") || kept && file.is_in("compensated");
    let files = sources::FILES.iter().filter(wanted);
    files
        .flat_map(File::functions)
        .map(|item| item.name)
        .collect()
}

/// The function of that name, or all of the file of that name.
fn found(asked: &str) -> Result<Vec<&'static str>, ExportError> {
    let name = asked.replace('-', "_");
    let functions = || sources::FILES.iter().flat_map(File::functions);
    if let Some(item) = functions().find(|item| item.name == name) {
        return Ok(vec![item.name]);
    }
    let mut files = sources::FILES.iter();
    let file = files.find(|file| file.is_in("brdf") && file.stem() == name);
    match file {
        Some(file) => Ok(file.functions().map(|item| item.name).collect()),
        None => Err(ExportError::Unknown(suggest::unknown(
            "function",
            asked,
            names(),
        ))),
    }
}

/// The items' code, without comments, as naga reads it.
fn plain(chosen: &[(&File, Vec<&Item>)]) -> String {
    let items = chosen.iter().flat_map(|(_, items)| items);
    items.map(|item| item.code).collect()
}

/// The items with their comments, file by file.
fn glsl(chosen: &[(&'static File, Vec<&'static Item>)]) -> String {
    let mut text = String::new();
    for (file, items) in chosen {
        text.push('\n');
        for line in heading(file) {
            text.push_str(&format!("{line}\n"));
        }
        for item in items {
            let code = item.code.replace("PRECISE", "precise");
            text.push_str(&format!("\n{}{code}", lines(&item.comment)));
        }
    }
    text
}

/// The first sentence of a file.
fn question(file: &File) -> String {
    let lines = file.head.iter().map(|line| line.trim_start_matches("// "));
    let text = lines.collect::<Vec<_>>().join(" ");
    let end = text.find('?').map_or(text.len(), |place| place + 1);
    text[..end].to_owned()
}

/// What stands over what a file defines: its head, and what the library says of its functions.
fn heading(file: &File) -> Vec<String> {
    let mut heading = vec![format!("// ==== {} ====", file.path)];
    heading.extend(file.head.iter().map(|line| (*line).to_owned()));
    let of_file = |function: &&Function| {
        file.is_in("brdf") && home(function.name).is_some_and(|stem| stem == file.stem())
    };
    for function in FUNCTIONS.iter().filter(of_file) {
        heading.extend([
            format!("// `umber eval {}`", function.name),
            format!("//   takes  {}", function.takes),
            format!("//   gives  {}", function.gives),
            format!("//   from   {}", function.source),
        ]);
    }
    heading
}

/// The file of a function of the library: that of the longest name with which the function's begins (`beckmann-d` is
/// of `beckmann`, `beckmann-smith` of `beckmann_smith`).
fn home(function: &str) -> Option<&'static str> {
    let name = function.replace('-', "_");
    let begins = |stem: &&str| {
        let rest = name.strip_prefix(stem);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    stems().filter(begins).max_by_key(|stem| stem.len())
}

fn head(language: Language, asked: &[String]) -> String {
    let mut command = format!("umber export --language {}", language.name());
    for name in asked {
        command.push(' ');
        command.push_str(name);
    }
    let (version, revision) = (env!("CARGO_PKG_VERSION"), env!("UMBER_REVISION"));
    let caution = language.caution();
    format!(
        "// Umber's lighting functions: `{command}`, umber {version}, revision {revision}.\n\
         // MIT or Apache-2.0, at your choice.\n\
         //\n\
         // N, L, E are unit vectors: normal, to the light, to the eye; NoL is N.L, and so on. The errors that are stated are\n\
         // measured (`umber stability`) in 32 bits, with Vulkan's accuracy: sums and products rounded to the nearest, quotients\n\
         // within 2.5 units in the last place, exp within 3 + 2 |x|.{caution}\n"
    )
}

fn lines(comment: &[&str]) -> String {
    comment.iter().map(|line| format!("{line}\n")).collect()
}
