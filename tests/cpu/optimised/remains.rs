//! What is left of a shader once its constants are frozen and dead code is gone?
//!
//! SPIRV-Tools freezes the constants, inlines every function and removes what has no effect, until nothing changes
//! any more. All that is left stands in `main` then; so that it can still be told from which function it came, each
//! instruction carries an `OpLine` whose file is the function's name.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::NamedTempFile;

use crate::shader_builder::{Stage, compile::compile, include::expand};

/// What is left of an entry point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remains {
    /// Instructions in function bodies, from `OpFunction` to `OpFunctionEnd`; lines told for debugging not counted.
    pub instructions: usize,
    /// The same by name: how often each stands there.
    pub opcodes: BTreeMap<String, usize>,
    /// The same in order, each with its operands: constants, types and variables in full, other values numbered in
    /// the order in which they come. Two shaders that compute the same thing in the same way read alike.
    pub code: Vec<String>,
    /// Functions of the source of which an instruction is left, by name without parameters. Where two compute the
    /// same, the one that stands first is named.
    pub functions: BTreeSet<String>,
    /// Variables that are left, global and local; a block without a name of its own by the name of the block.
    pub variables: BTreeSet<String>,
    /// Descriptors that are left, by binding; names as above. The builder sees to it that there is only set 0.
    pub bindings: BTreeMap<u32, String>,
}

impl Remains {
    /// Functions and variables together.
    pub fn names(&self) -> BTreeSet<String> {
        self.functions.union(&self.variables).cloned().collect()
    }
}

/// Makes constants of specialization constants, and of what is computed from them.
const FREEZE: [&str; 2] = ["--freeze-spec-const", "--fold-spec-const-op-composite"];

/// Puts functions in the place of their calls: those with one return. The others wait for `--merge-return`, which
/// leaves a shell about the body, and so come second.
const INLINE: [&str; 2] = [
    "--inline-entry-points-exhaustive",
    "--eliminate-dead-functions",
];

/// Turns variables into values, values into constants, and drops what is then dead or said twice.
const CLEAN: [&str; 17] = [
    "--private-to-local",
    "--scalar-replacement=0",
    "--convert-local-access-chains",
    "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--ssa-rewrite",
    "--ccp",
    "--simplify-instructions",
    "--eliminate-dead-branches",
    "--merge-blocks",
    "--cfg-cleanup",
    "--vector-dce",
    "--eliminate-dead-inserts",
    "--redundancy-elimination",
    "--eliminate-dead-code-aggressive",
    "--eliminate-dead-variables",
    "--eliminate-dead-const",
];

/// Rounds until nothing changes: 3 are usual, the last of which shows that the one before was the end.
const MOST_ROUNDS: usize = 12;

/// Builds `entry` of `folder` with `frozen` constants, by name; the others keep their defaults, and are frozen too.
///
/// # Panics
///
/// Where the shader does not compile, a constant is not there, a tool is missing or refuses.
#[track_caller]
pub fn remains(folder: &Path, entry: &str, frozen: &[(&str, i32)]) -> Remains {
    match optimised(folder, entry, frozen) {
        Ok(assembly) => read(&assembly),
        Err(why) => panic!("{}: {why}", folder.join(entry).display()),
    }
}

fn optimised(folder: &Path, entry: &str, frozen: &[(&str, i32)]) -> Result<String, String> {
    let assembly = disassembled(&compiled(folder, entry)?)?;
    let attributed = attributed(&assembly)?;
    let target = "--target-env=vulkan1.3";
    let module = made(
        "spirv-as",
        &["--target-env", "vulkan1.3"],
        attributed.as_bytes(),
    )?;

    let values = values(&assembly, frozen)?;
    let mut freeze = vec![target];
    if !values.is_empty() {
        freeze.extend(["--set-spec-const-default-value", &values]);
    }
    freeze.extend(FREEZE);
    let round: Vec<&str> = [
        &[target][..],
        &INLINE,
        &CLEAN,
        &["--merge-return"],
        &INLINE,
        &CLEAN,
        &["--remove-duplicates", "--compact-ids"],
    ]
    .concat();
    let mut module = made("spirv-opt", &freeze, &module)?;
    for _ in 0..MOST_ROUNDS {
        let next = made("spirv-opt", &round, &module)?;
        if next == module {
            tool("spirv-val", &["--target-env", "vulkan1.3", "-"], &module)?;
            return disassembled(&module);
        }
        module = next;
    }
    Err(format!("still changes after {MOST_ROUNDS} rounds"))
}

fn compiled(folder: &Path, entry: &str) -> Result<Vec<u8>, String> {
    let stage = Stage::of(entry).ok_or("no stage")?;
    let expanded = expand(folder, entry).map_err(|error| error.to_string())?;
    let words = compile(&expanded, stage).map_err(|errors| {
        let lines: Vec<String> = errors.iter().map(ToString::to_string).collect();
        lines.join("\n")
    })?;
    Ok(words.iter().flat_map(|word| word.to_ne_bytes()).collect())
}

fn disassembled(module: &[u8]) -> Result<String, String> {
    let text = made("spirv-dis", &["--raw-id", "--no-header"], module)?;
    String::from_utf8(text).map_err(|error| format!("spirv-dis: {error}"))
}

/// What a tool of SPIRV-Tools makes of `input`: the file that it writes, for spirv-opt prints its warnings to the
/// same stream.
pub fn made(name: &str, arguments: &[&str], input: &[u8]) -> Result<Vec<u8>, String> {
    let broken = |error: std::io::Error| format!("{name}: {error}");
    let output = NamedTempFile::new().map_err(broken)?;
    let path = output.path().to_string_lossy();
    tool(name, &[arguments, &["-", "-o", &path]].concat(), input)?;
    // The name is read again, since a tool may have put a new file there.
    fs::read(output.path()).map_err(broken)
}

/// Runs a tool of SPIRV-Tools on `input`.
fn tool(name: &str, arguments: &[&str], input: &[u8]) -> Result<(), String> {
    let mut child = Command::new(name)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| match error.kind() {
            ErrorKind::NotFound => {
                format!("{name} is not here: `make test` installs it (apt-get install spirv-tools)")
            }
            _ => format!("{name}: {error}"),
        })?;
    if let Some(mut stdin) = child.stdin.take() {
        // A tool that refuses its arguments never reads; its status says so.
        let _ = stdin.write_all(input);
    }
    let output = child
        .wait_with_output()
        .map_err(|error| format!("{name}: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    let said = [output.stderr, output.stdout].concat();
    let said = String::from_utf8_lossy(&said);
    let errors: Vec<&str> = said
        .lines()
        .filter(|line| !line.starts_with("warning"))
        .collect();
    Err(format!("{name}: {}", errors.join("; ")))
}

/// One instruction: its result, `%12`; its name, `OpLoad`; its operands.
#[derive(Clone, Copy)]
struct Instruction<'a> {
    line: &'a str,
    result: &'a str,
    opcode: &'a str,
    operands: &'a str,
}

fn instructions(assembly: &str) -> impl Iterator<Item = Instruction<'_>> {
    assembly.lines().filter_map(|line| {
        let text = line.trim();
        let (result, rest) = match text.split_once(" = ") {
            Some((result, rest)) if text.starts_with('%') => (result, rest),
            _ => ("", text),
        };
        let (opcode, operands) = rest.split_once(' ').unwrap_or((rest, ""));
        opcode.starts_with("Op").then_some(Instruction {
            line,
            result,
            opcode,
            operands,
        })
    })
}

/// The names that the source has for ids; a function's without its parameters.
fn names(assembly: &str) -> HashMap<&str, &str> {
    instructions(assembly)
        .filter(|one| one.opcode == "OpName")
        .filter_map(|one| one.operands.split_once(' '))
        .map(|(id, name)| (id, name.trim_matches('"')))
        .map(|(id, name)| (id, name.split('(').next().unwrap_or_default()))
        .collect()
}

/// The operands `id kind number` of `OpDecorate`, as id and number.
fn decorated<'a>(assembly: &'a str, kind: &str) -> Vec<(&'a str, u32)> {
    instructions(assembly)
        .filter(|one| one.opcode == "OpDecorate")
        .filter_map(|one| one.operands.split_once(' '))
        .filter_map(|(id, rest)| Some((id, rest.strip_prefix(kind)?.trim().parse().ok()?)))
        .collect()
}

/// The values as spirv-opt wants them: `id:value`, with spaces between.
fn values(assembly: &str, frozen: &[(&str, i32)]) -> Result<String, String> {
    let names = names(assembly);
    let ids: HashMap<&str, u32> = decorated(assembly, "SpecId")
        .into_iter()
        .filter_map(|(id, number)| Some((*names.get(id)?, number)))
        .collect();
    let pairs: Vec<String> = frozen
        .iter()
        .map(|(name, value)| match ids.get(name) {
            Some(id) => Ok(format!("{id}:{value}")),
            None => Err(format!("no constant_id belongs to {name}")),
        })
        .collect::<Result<_, _>>()?;
    Ok(pairs.join(" "))
}

/// The module with an `OpLine` that names the function before each instruction of a body.
fn attributed(assembly: &str) -> Result<String, String> {
    let names = names(assembly);
    let (mut strings, mut text) = (String::new(), String::new());
    let mut debug = None;
    let mut function = "";
    let mut tied = false;
    for one in instructions(assembly) {
        if matches!(one.opcode, "OpSource" | "OpSourceExtension" | "OpName") {
            // Strings stand with the first of these.
            debug.get_or_insert(text.len());
        }
        if one.opcode == "OpFunction" {
            function = one.result.trim_start_matches('%');
            let name = names.get(one.result).copied().unwrap_or_default();
            strings.push_str(&format!("%of{function} = OpString \"{name}\"\n"));
        }
        let head = [
            "OpFunction",
            "OpFunctionParameter",
            "OpFunctionEnd",
            "OpLabel",
            "OpVariable",
        ];
        // Nothing may come between a merge and its branch.
        if !function.is_empty() && !tied && !head.contains(&one.opcode) {
            text.push_str(&format!("OpLine %of{function} 1 1\n"));
        }
        tied = matches!(one.opcode, "OpSelectionMerge" | "OpLoopMerge");
        text.push_str(one.line);
        text.push('\n');
    }
    text.insert_str(debug.ok_or("the module has no names")?, &strings);
    Ok(text)
}

/// Writes ids so that they mean the same in each module.
struct Ids<'a> {
    names: HashMap<&'a str, &'a str>,
    /// What defines an id outside the functions.
    globals: HashMap<&'a str, Instruction<'a>>,
    seen: HashMap<&'a str, usize>,
}

impl<'a> Ids<'a> {
    fn new(assembly: &'a str) -> Self {
        let globals = instructions(assembly)
            .take_while(|one| one.opcode != "OpFunction")
            .filter(|one| !one.result.is_empty())
            .map(|one| (one.result, one))
            .collect();
        Self {
            names: names(assembly),
            globals,
            seen: HashMap::new(),
        }
    }

    fn instruction(&mut self, one: Instruction<'a>) -> String {
        let mut text = match one.result {
            "" => one.opcode.to_owned(),
            result => format!("{} = {}", self.word(result), one.opcode),
        };
        for word in one.operands.split(' ').filter(|word| !word.is_empty()) {
            text.push(' ');
            text.push_str(&self.word(word));
        }
        text
    }

    fn word(&mut self, word: &'a str) -> String {
        if !word.starts_with('%') {
            return word.to_owned();
        }
        let Some(one) = self.globals.get(word).copied() else {
            let next = self.seen.len();
            return format!("%{}", self.seen.entry(word).or_insert(next));
        };
        let mut text = format!("({}", one.opcode);
        // Constants of one value are one, whichever of them it is named after.
        let names = match one.opcode {
            "OpConstant" => None,
            _ => self.names.get(word),
        };
        if let Some(name) = names.filter(|name| !name.is_empty()) {
            text.push_str(&format!(" {name}"));
        }
        for word in one.operands.split(' ').filter(|word| !word.is_empty()) {
            text.push_str(&format!(" {}", self.word(word)));
        }
        text + ")"
    }
}

fn read(assembly: &str) -> Remains {
    let names = names(assembly);
    let strings: HashMap<&str, &str> = instructions(assembly)
        .filter(|one| one.opcode == "OpString")
        .map(|one| (one.result, one.operands.trim_matches('"')))
        .collect();
    let mut opcodes = BTreeMap::new();
    let mut functions = BTreeSet::new();
    let mut code = Vec::new();
    let mut ids = Ids::new(assembly);
    let body = |one: &Instruction| one.opcode != "OpFunction";
    for one in instructions(assembly).skip_while(body) {
        if one.opcode == "OpLine" {
            let file = one.operands.split(' ').next().unwrap_or_default();
            functions.extend(strings.get(file).map(|name| (*name).to_owned()));
        } else if one.opcode != "OpNoLine" {
            *opcodes.entry(one.opcode.to_owned()).or_default() += 1;
            code.push(ids.instruction(one));
        }
    }
    let pointees: HashMap<&str, &str> = instructions(assembly)
        .filter(|one| one.opcode == "OpTypePointer")
        .filter_map(|one| Some((one.result, one.operands.rsplit(' ').next()?)))
        .collect();
    let variables: HashMap<&str, String> = instructions(assembly)
        .filter(|one| one.opcode == "OpVariable")
        .map(|one| {
            let own = names.get(one.result).filter(|name| !name.is_empty());
            let pointer = one.operands.split(' ').next().unwrap_or_default();
            let block = || names.get(pointees.get(pointer)?);
            let name = own.or_else(block).copied().unwrap_or_default();
            (one.result, name.to_owned())
        })
        .collect();
    let bindings = decorated(assembly, "Binding")
        .into_iter()
        .filter_map(|(id, binding)| Some((binding, variables.get(id)?.clone())))
        .collect();
    Remains {
        instructions: opcodes.values().sum(),
        opcodes,
        code,
        functions,
        variables: variables.into_values().collect(),
        bindings,
    }
}
