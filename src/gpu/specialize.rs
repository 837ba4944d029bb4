//! What is left of a module once its constants are known?
//!
//! A driver may take specialization constants at the last moment, or never look at what they decide: SwiftShader runs
//! every branch, with the lanes of a dead one switched off, and lavapipe parses every function for each pipeline. So
//! constants are frozen here, branches that they decide are cut, and functions that nobody calls are left out. Numbers
//! and sections are those of the SPIR-V specification 1.6.

mod branches;

use std::collections::{HashMap, HashSet};

use super::pipeline::Constant;
use super::spirv::{self, parts};
use branches::{Function, functions};

/// Operation codes (3.52).
mod op {
    pub const NAME: u32 = 5;
    pub const ENTRY_POINT: u32 = 15;
    pub const TYPE_BOOL: u32 = 20;
    pub const CONSTANT_TRUE: u32 = 41;
    pub const CONSTANT_FALSE: u32 = 42;
    pub const CONSTANT: u32 = 43;
    pub const CONSTANT_COMPOSITE: u32 = 44;
    pub const SPEC_CONSTANT_TRUE: u32 = 48;
    pub const SPEC_CONSTANT_FALSE: u32 = 49;
    pub const SPEC_CONSTANT: u32 = 50;
    pub const SPEC_CONSTANT_COMPOSITE: u32 = 51;
    pub const SPEC_CONSTANT_OP: u32 = 52;
    pub const FUNCTION: u32 = 54;
    pub const FUNCTION_END: u32 = 56;
    pub const FUNCTION_CALL: u32 = 57;
    pub const DECORATE: u32 = 71;
    pub const DECORATE_ID: u32 = 332;
    pub const PHI: u32 = 245;
    pub const LOOP_MERGE: u32 = 246;
    pub const SELECTION_MERGE: u32 = 247;
    pub const LABEL: u32 = 248;
    pub const BRANCH: u32 = 249;
    pub const BRANCH_CONDITIONAL: u32 = 250;
    pub const SWITCH: u32 = 251;
    pub const UNREACHABLE: u32 = 255;
}

/// `SpecId` (3.20).
const SPEC_ID: u32 = 1;

/// The module with `constants` in place of its specialization constants, and without what they rule out. One that is
/// not given keeps its default. Words that are no module come back as they are: the driver will say so.
pub(super) fn specialized(words: &[u32], constants: &[Constant]) -> Vec<u32> {
    let Some((header, body)) = parts(words) else {
        return words.to_vec();
    };
    let mut all = instructions(body);
    let first = all.iter().position(|one| one.code() == op::FUNCTION);
    let bodies = all.split_off(first.unwrap_or(all.len()));
    let mut known = freeze(&mut all, constants);
    let mut functions = functions(bodies);
    for function in &mut functions {
        function.cut(&mut known);
    }
    let called = called(&all, &functions);
    let before: HashSet<u32> = results(&functions);
    functions.retain(|function| called.contains(&function.id()));
    let gone: HashSet<u32> = before.difference(&results(&functions)).copied().collect();
    all.retain(|one| !one.is_about(&gone));
    let mut whole = header.to_vec();
    all.iter().for_each(|one| whole.extend(&one.0));
    for function in &functions {
        function.instructions().for_each(|one| whole.extend(&one.0));
        whole.extend(Instruction::new(op::FUNCTION_END, &[]).0);
    }
    whole
}

/// An instruction, its first word with it.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Instruction(Vec<u32>);

impl Instruction {
    fn new(code: u32, operands: &[u32]) -> Self {
        let first = spirv::instruction(code, operands.len() as u32 + 1);
        Self([&[first], operands].concat())
    }

    fn code(&self) -> u32 {
        spirv::code(&self.0)
    }

    fn operands(&self) -> &[u32] {
        &self.0[1..]
    }

    /// A label's or a value's number, of an instruction in a function; of one that has none, any other number.
    fn result(&self) -> Option<u32> {
        let place = match self.code() {
            op::LABEL => 0,
            _ => 1,
        };
        self.operands().get(place).copied()
    }

    /// Whether it names or decorates one of these.
    fn is_about(&self, numbers: &HashSet<u32>) -> bool {
        let about = matches!(self.code(), op::NAME | op::DECORATE | op::DECORATE_ID);
        about && numbers.contains(&self.0[1])
    }
}

fn instructions(words: &[u32]) -> Vec<Instruction> {
    let all = spirv::instructions(words);
    all.map(|one| Instruction(one.to_vec())).collect()
}

/// Makes constants of specialization constants, and returns the bits of those of 32 bits or fewer, by number.
fn freeze(globals: &mut Vec<Instruction>, constants: &[Constant]) -> HashMap<u32, u32> {
    let numbered = |one: &Instruction| match *one.operands() {
        [target, SPEC_ID, id] if one.code() == op::DECORATE => Some((target, id)),
        _ => None,
    };
    let ids: HashMap<u32, u32> = globals.iter().filter_map(numbered).collect();
    globals.retain(|one| numbered(one).is_none());
    let booleans: HashSet<u32> = globals
        .iter()
        .filter(|one| one.code() == op::TYPE_BOOL)
        .map(|one| one.0[1])
        .collect();
    let given = |target: u32| {
        let id = ids.get(&target)?;
        let constant = constants.iter().find(|constant| constant.id == *id)?;
        Some(constant.value.cast_unsigned())
    };
    let mut known = HashMap::new();
    let mut open = HashSet::new();
    for one in globals {
        let (code, operands) = (one.code(), one.operands());
        let [kind, number, ref rest @ ..] = *operands else {
            continue;
        };
        let value = match (code, rest) {
            (op::CONSTANT_TRUE | op::SPEC_CONSTANT_TRUE, _) => given(number).unwrap_or(1),
            (op::CONSTANT_FALSE | op::SPEC_CONSTANT_FALSE, _) => given(number).unwrap_or(0),
            (op::CONSTANT | op::SPEC_CONSTANT, [default]) => given(number).unwrap_or(*default),
            (op::SPEC_CONSTANT_OP, [code, operands @ ..]) => {
                let Some(value) = evaluated(*code, operands, &known) else {
                    open.insert(number);
                    continue;
                };
                value
            }
            (op::SPEC_CONSTANT_COMPOSITE, parts) => {
                match parts.iter().any(|part| open.contains(part)) {
                    true => _ = open.insert(number),
                    false => *one = Instruction::new(op::CONSTANT_COMPOSITE, operands),
                }
                continue;
            }
            _ => continue,
        };
        known.insert(number, value);
        *one = match (booleans.contains(&kind), value) {
            (true, 0) => Instruction::new(op::CONSTANT_FALSE, &[kind, number]),
            (true, _) => Instruction::new(op::CONSTANT_TRUE, &[kind, number]),
            (false, _) => Instruction::new(op::CONSTANT, &[kind, number, value]),
        };
    }
    known
}

/// What an operation on integers of 32 bits or booleans gives, if it is one whose operands are known as far as they count.
fn evaluated(code: u32, operands: &[u32], known: &HashMap<u32, u32>) -> Option<u32> {
    let value = |place: usize| known.get(operands.get(place)?).copied();
    let signed = |place: usize| value(place).map(u32::cast_signed);
    let decides = |bit: u32| (value(0) == Some(bit) || value(1) == Some(bit)).then_some(bit);
    Some(match code {
        124 => value(0)?,                                           // OpBitcast
        128 => value(0)?.wrapping_add(value(1)?),                   // OpIAdd
        130 => value(0)?.wrapping_sub(value(1)?),                   // OpISub
        132 => value(0)?.wrapping_mul(value(1)?),                   // OpIMul
        164 => u32::from(value(0)? == value(1)?),                   // OpLogicalEqual
        165 => u32::from(value(0)? != value(1)?),                   // OpLogicalNotEqual
        166 => decides(1).or_else(|| Some(value(0)? | value(1)?))?, // OpLogicalOr
        167 => decides(0).or_else(|| Some(value(0)? & value(1)?))?, // OpLogicalAnd
        168 => u32::from(value(0)? == 0),                           // OpLogicalNot
        169 => value(if value(0)? != 0 { 1 } else { 2 })?,          // OpSelect
        170 => u32::from(value(0)? == value(1)?),                   // OpIEqual
        171 => u32::from(value(0)? != value(1)?),                   // OpINotEqual
        172 => u32::from(value(0)? > value(1)?),                    // OpUGreaterThan
        173 => u32::from(signed(0)? > signed(1)?),                  // OpSGreaterThan
        174 => u32::from(value(0)? >= value(1)?),                   // OpUGreaterThanEqual
        175 => u32::from(signed(0)? >= signed(1)?),                 // OpSGreaterThanEqual
        176 => u32::from(value(0)? < value(1)?),                    // OpULessThan
        177 => u32::from(signed(0)? < signed(1)?),                  // OpSLessThan
        178 => u32::from(value(0)? <= value(1)?),                   // OpULessThanEqual
        179 => u32::from(signed(0)? <= signed(1)?),                 // OpSLessThanEqual
        197 => value(0)? | value(1)?,                               // OpBitwiseOr
        198 => value(0)? ^ value(1)?,                               // OpBitwiseXor
        199 => value(0)? & value(1)?,                               // OpBitwiseAnd
        200 => !value(0)?,                                          // OpNot
        _ => return None,
    })
}

/// Functions that entry points reach, by number.
fn called(globals: &[Instruction], functions: &[Function]) -> HashSet<u32> {
    let entry = |one: &Instruction| (one.code() == op::ENTRY_POINT).then(|| one.0[2]);
    let mut open: Vec<u32> = globals.iter().filter_map(entry).collect();
    let mut called = HashSet::new();
    while let Some(id) = open.pop() {
        if !called.insert(id) {
            continue;
        }
        let bodies = functions.iter().filter(|function| function.id() == id);
        let calls = bodies
            .flat_map(Function::instructions)
            .filter(|one| one.code() == op::FUNCTION_CALL)
            .map(|one| one.0[3]);
        open.extend(calls);
    }
    called
}

fn results(functions: &[Function]) -> HashSet<u32> {
    let all = functions.iter().flat_map(Function::instructions);
    all.filter_map(Instruction::result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::reflected::constants;
    use crate::interface::spirv::SURFACE_FRAG;

    /// Numbers of a made module. Types and values stand for themselves: nothing here looks into them.
    const BOOL: u32 = 1;
    const INT: u32 = 2;
    const MODE: u32 = 3; // a specialization constant, 7, whose id is 40
    const FIVE: u32 = 4;
    const IS_FIVE: u32 = 5; // MODE == FIVE
    const MAIN: u32 = 10;
    const HELPER: u32 = 20;

    const HEADER: [u32; 5] = [0x0723_0203, 0x0001_0600, 0, 100, 0];

    fn one(code: u32, operands: &[u32]) -> Instruction {
        Instruction::new(code, operands)
    }

    fn words(all: &[Instruction]) -> Vec<u32> {
        let body = all.iter().flat_map(|one| one.0.iter().copied());
        HEADER.into_iter().chain(body).collect()
    }

    /// Names, decorations, types and constants before a body, and the helper behind it.
    fn module(body: &[Instruction]) -> Vec<u32> {
        let globals = [
            one(op::ENTRY_POINT, &[4, MAIN, 0]),
            one(op::NAME, &[HELPER, 0x0070_6c68]),
            one(op::NAME, &[MODE, 0x0065_646d]),
            one(op::DECORATE, &[MODE, SPEC_ID, 40]),
            one(op::TYPE_BOOL, &[BOOL]),
            one(op::SPEC_CONSTANT, &[INT, MODE, 7]),
            one(op::CONSTANT, &[INT, FIVE, 5]),
            one(op::SPEC_CONSTANT_OP, &[BOOL, IS_FIVE, 170, MODE, FIVE]),
        ];
        let helper = [
            one(op::FUNCTION, &[90, HELPER, 0, 91]),
            one(op::LABEL, &[21]),
            one(RETURN, &[]),
            one(op::FUNCTION_END, &[]),
        ];
        words(&[&globals, body, &helper].concat())
    }

    fn with_mode(module: &[u32], value: i32) -> Vec<Instruction> {
        let constant = Constant { id: 40, value };
        instructions(&specialized(module, &[constant])[HEADER.len()..])
    }

    fn codes(all: &[Instruction]) -> Vec<u32> {
        all.iter().map(Instruction::code).collect()
    }

    const FUNCTION: [u32; 4] = [90, MAIN, 0, 91];
    const RETURN: u32 = 253;

    /// `if (MODE == 5) helper();`.
    fn guarded() -> Vec<u32> {
        module(&[
            one(op::FUNCTION, &FUNCTION),
            one(op::LABEL, &[11]),
            one(op::SELECTION_MERGE, &[13, 0]),
            one(op::BRANCH_CONDITIONAL, &[IS_FIVE, 12, 13]),
            one(op::LABEL, &[12]),
            one(op::FUNCTION_CALL, &[90, 14, HELPER]),
            one(op::BRANCH, &[13]),
            one(op::LABEL, &[13]),
            one(RETURN, &[]),
            one(op::FUNCTION_END, &[]),
        ])
    }

    #[test]
    fn constants_are_frozen_and_what_they_decide_is_followed() {
        let all = with_mode(&guarded(), 5);
        assert!(all.contains(&one(op::CONSTANT, &[INT, MODE, 5])));
        assert!(all.contains(&one(op::CONSTANT_TRUE, &[BOOL, IS_FIVE])));
        assert!(all.contains(&one(op::BRANCH, &[12])));
        assert!(all.contains(&one(op::NAME, &[HELPER, 0x0070_6c68])));
        for gone in [op::SELECTION_MERGE, op::BRANCH_CONDITIONAL, op::DECORATE] {
            assert!(!codes(&all).contains(&gone), "{gone}");
        }
    }

    #[test]
    fn what_nobody_calls_is_left_out_with_its_name() {
        let all = with_mode(&guarded(), 6);
        let expected = [
            op::ENTRY_POINT,
            op::NAME,
            op::TYPE_BOOL,
            op::CONSTANT,
            op::CONSTANT,
            op::CONSTANT_FALSE,
            op::FUNCTION,
            op::LABEL,
            op::BRANCH,
            op::LABEL,
            RETURN,
            op::FUNCTION_END,
        ];
        assert_eq!(codes(&all), expected);
        // Without a value of its own a constant keeps its default, and that is not 5 either.
        let default = specialized(&guarded(), &[]);
        assert_eq!(codes(&instructions(&default[HEADER.len()..])), expected);
        assert!(
            default
                .windows(4)
                .any(|w| *w == one(op::CONSTANT, &[INT, MODE, 7]).0[..])
        );
    }

    #[test]
    fn a_decided_or_is_decided_behind_its_phi() {
        // `if (MODE == 5 || x) helper();`, where nobody knows x.
        let (x, either) = (30, 31);
        let shortcut = module(&[
            one(op::FUNCTION, &FUNCTION),
            one(op::LABEL, &[11]),
            one(op::SELECTION_MERGE, &[13, 0]),
            one(op::BRANCH_CONDITIONAL, &[IS_FIVE, 13, 12]),
            one(op::LABEL, &[12]),
            one(61, &[BOOL, x, 99]), // OpLoad
            one(op::BRANCH, &[13]),
            one(op::LABEL, &[13]),
            one(op::PHI, &[BOOL, either, IS_FIVE, 11, x, 12]),
            one(op::SELECTION_MERGE, &[15, 0]),
            one(op::BRANCH_CONDITIONAL, &[either, 14, 15]),
            one(op::LABEL, &[14]),
            one(op::FUNCTION_CALL, &[90, 16, HELPER]),
            one(op::BRANCH, &[15]),
            one(op::LABEL, &[15]),
            one(RETURN, &[]),
            one(op::FUNCTION_END, &[]),
        ]);
        let decided = with_mode(&shortcut, 5);
        assert!(decided.contains(&one(op::PHI, &[BOOL, either, IS_FIVE, 11])));
        assert!(!codes(&decided).contains(&op::BRANCH_CONDITIONAL));
        let open = with_mode(&shortcut, 6);
        assert!(open.contains(&one(op::PHI, &[BOOL, either, x, 12])));
        assert!(open.contains(&one(op::BRANCH_CONDITIONAL, &[either, 14, 15])));
    }

    #[test]
    fn a_header_keeps_the_blocks_that_it_names() {
        // `for (;;) { if (MODE == 5) return; }`, and a `y ? return : return` that nobody decides behind it.
        let looped = module(&[
            one(op::FUNCTION, &FUNCTION),
            one(op::LABEL, &[11]),
            one(op::BRANCH, &[12]),
            one(op::LABEL, &[12]),
            one(op::LOOP_MERGE, &[16, 15, 0]),
            one(op::BRANCH, &[13]),
            one(op::LABEL, &[13]),
            one(op::SELECTION_MERGE, &[17, 0]),
            one(op::BRANCH_CONDITIONAL, &[IS_FIVE, 14, 17]),
            one(op::LABEL, &[14]),
            one(RETURN, &[]),
            one(op::LABEL, &[17]),
            one(op::BRANCH, &[15]),
            one(op::LABEL, &[15]),
            one(61, &[BOOL, 30, 99]), // OpLoad
            one(op::BRANCH, &[12]),
            one(op::LABEL, &[16]),
            one(RETURN, &[]),
            one(op::FUNCTION_END, &[]),
        ]);
        let ends = with_mode(&looped, 5);
        let tail = [
            one(op::LABEL, &[14]),
            one(RETURN, &[]),
            one(op::LABEL, &[15]),
            one(op::BRANCH, &[12]),
            one(op::LABEL, &[16]),
            one(op::UNREACHABLE, &[]),
            one(op::FUNCTION_END, &[]),
        ];
        assert_eq!(ends[ends.len() - tail.len()..], tail);
        let turns = with_mode(&looped, 6);
        assert!(turns.contains(&one(61, &[BOOL, 30, 99])));
        assert!(!turns.contains(&one(op::LABEL, &[14])));
    }

    #[test]
    fn a_loop_stays_one_though_its_condition_is_known() {
        // `while (MODE == 5) {}`
        let header = one(op::BRANCH_CONDITIONAL, &[IS_FIVE, 13, 14]);
        let looped = module(&[
            one(op::FUNCTION, &FUNCTION),
            one(op::LABEL, &[11]),
            one(op::BRANCH, &[12]),
            one(op::LABEL, &[12]),
            one(op::LOOP_MERGE, &[14, 13, 0]),
            header.clone(),
            one(op::LABEL, &[13]),
            one(op::BRANCH, &[12]),
            one(op::LABEL, &[14]),
            one(RETURN, &[]),
            one(op::FUNCTION_END, &[]),
        ]);
        for value in [5, 6] {
            assert!(with_mode(&looped, value).contains(&header), "{value}");
        }
    }

    #[test]
    fn operations_are_those_of_the_specification() {
        let known: HashMap<u32, u32> = [(1, 1), (2, 0), (3, 3), (4, u32::MAX)].into();
        let both = |code| evaluated(code, &[3, 4], &known);
        // 3 and -1, signed and unsigned.
        assert_eq!([173, 177, 175, 179].map(both), [1, 0, 1, 0].map(Some));
        assert_eq!([172, 176, 174, 178].map(both), [0, 1, 0, 1].map(Some));
        assert_eq!([170, 171].map(both), [0, 1].map(Some));
        assert_eq!([128, 130, 132].map(both), [2, 4, u32::MAX - 2].map(Some));
        assert_eq!(
            [197, 198, 199].map(both),
            [u32::MAX, u32::MAX - 3, 3].map(Some)
        );
        assert_eq!(evaluated(169, &[2, 3, 4], &known), Some(u32::MAX));
        assert_eq!(evaluated(168, &[2], &known), Some(1));
        // One operand decides, where the other is not known.
        assert_eq!(evaluated(166, &[9, 1], &known), Some(1));
        assert_eq!(evaluated(167, &[2, 9], &known), Some(0));
        assert_eq!(evaluated(166, &[9, 2], &known), None);
        assert_eq!(evaluated(167, &[1, 9], &known), None);
        assert_eq!(evaluated(129, &[3, 4], &known), None);
    }

    #[test]
    fn an_effect_that_nobody_calls_for_leaves_no_function_in_the_surfaces_shader() {
        let with_shadow = |value| {
            let id = constants::EFFECT_SHADOW;
            let words = specialized(SURFACE_FRAG, &[Constant { id, value }]);
            let names = words.iter().flat_map(|word| word.to_le_bytes());
            String::from_utf8_lossy(&names.collect::<Vec<_>>()).contains("lit_share(")
        };
        assert_eq!([-1, 0, 1].map(with_shadow), [true, false, true]);
    }

    #[test]
    fn words_that_are_no_module_stay_as_they_are() {
        assert_eq!(specialized(&[1, 2, 3], &[]), [1, 2, 3]);
        assert_eq!(specialized(&HEADER[..1], &[]), HEADER[..1]);
        assert!(specialized(&[], &[]).is_empty());
    }
}
