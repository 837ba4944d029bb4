//! Which branches of a function are decided, and what do they leave?

use std::collections::{HashMap, HashSet};

use super::{Instruction, evaluated, op};

/// A function: its head and parameters, and its blocks.
pub struct Function {
    head: Vec<Instruction>,
    blocks: Vec<Block>,
}

/// A label, what is done, and where to go then.
struct Block(Vec<Instruction>);

/// The functions that follow a module's globals.
pub fn functions(all: Vec<Instruction>) -> Vec<Function> {
    let mut functions: Vec<Function> = Vec::new();
    for one in all {
        let function = functions.last_mut();
        match (one.code(), function) {
            (op::FUNCTION_END, _) => {}
            (op::FUNCTION, _) | (_, None) => functions.push(Function {
                head: vec![one],
                blocks: Vec::new(),
            }),
            (op::LABEL, Some(function)) => function.blocks.push(Block(vec![one])),
            (_, Some(function)) => match function.blocks.last_mut() {
                Some(block) => block.0.push(one),
                None => function.head.push(one),
            },
        }
    }
    functions
}

impl Function {
    /// Its number.
    pub fn id(&self) -> u32 {
        self.head[0].operands()[1]
    }

    /// All but its end.
    pub fn instructions(&self) -> impl Iterator<Item = &Instruction> {
        let bodies = self.blocks.iter().flat_map(|block| &block.0);
        self.head.iter().chain(bodies)
    }

    /// Cuts branches that are decided, until none is.
    pub fn cut(&mut self, known: &mut HashMap<u32, u32>) {
        // What a loop's next round brings is not followed; glslang keeps it in variables.
        let looped = |block: &Block| block.has(op::LOOP_MERGE) && block.has(op::PHI);
        if self.blocks.iter().any(looped) {
            return;
        }
        loop {
            let bodies = self.blocks.iter().flat_map(|block| &block.0);
            bodies.for_each(|one| learn(one, known));
            let mut decided = false;
            for block in &mut self.blocks {
                decided |= block.decide(known);
            }
            if !decided {
                return;
            }
            self.drop_unreached();
        }
    }

    /// Drops blocks that nothing leads to; of those that a header must name an empty one stays (2.11).
    fn drop_unreached(&mut self) {
        let reached = self.reached();
        let mut named = HashMap::new();
        for block in self
            .blocks
            .iter()
            .filter(|block| reached.contains(&block.label()))
        {
            for one in &block.0 {
                match (one.code(), one.operands()) {
                    (op::SELECTION_MERGE, [merge, ..]) => {
                        named.insert(*merge, Instruction::new(op::UNREACHABLE, &[]));
                    }
                    (op::LOOP_MERGE, [merge, again, ..]) => {
                        named.insert(*merge, Instruction::new(op::UNREACHABLE, &[]));
                        named.insert(*again, Instruction::new(op::BRANCH, &[block.label()]));
                    }
                    _ => {}
                }
            }
        }
        self.blocks.retain_mut(|block| {
            let label = block.label();
            if reached.contains(&label) {
                return true;
            }
            let Some(end) = named.remove(&label) else {
                return false;
            };
            block.0.truncate(1);
            block.0.push(end);
            true
        });
        self.forget_parents();
    }

    /// Labels of the blocks that the first one leads to.
    fn reached(&self) -> HashSet<u32> {
        let blocks: HashMap<u32, &Block> = self
            .blocks
            .iter()
            .map(|block| (block.label(), block))
            .collect();
        let mut open: Vec<u32> = self.blocks.first().map(Block::label).into_iter().collect();
        let mut reached = HashSet::new();
        while let Some(label) = open.pop() {
            if reached.insert(label) {
                open.extend(blocks.get(&label).map_or(Vec::new(), |block| block.next()));
            }
        }
        reached
    }

    /// Takes from each OpPhi what came from blocks that no longer lead to it.
    fn forget_parents(&mut self) {
        let edges = self.blocks.iter().flat_map(|block| {
            let from = block.label();
            block.next().into_iter().map(move |to| (from, to))
        });
        let edges: HashSet<(u32, u32)> = edges.collect();
        for block in &mut self.blocks {
            let label = block.label();
            for one in block.0.iter_mut().filter(|one| one.code() == op::PHI) {
                let (head, pairs) = one.operands().split_at(2);
                let (pairs, _) = pairs.as_chunks::<2>();
                let left = pairs
                    .iter()
                    .filter(|[_, from]| edges.contains(&(*from, label)));
                let left: Vec<u32> = left.flatten().copied().collect();
                *one = Instruction::new(op::PHI, &[head, &left].concat());
            }
        }
    }
}

/// Notes what an instruction gives, if that is known before it runs.
fn learn(one: &Instruction, known: &mut HashMap<u32, u32>) {
    let [_, number, operands @ ..] = one.operands() else {
        return;
    };
    let value = match one.code() {
        op::PHI => {
            let mut values = operands
                .iter()
                .step_by(2)
                .map(|value| known.get(value).copied());
            let first = values.next().flatten();
            first.filter(|_| values.all(|value| value == first))
        }
        code => evaluated(code, operands, known),
    };
    if let Some(value) = value {
        known.insert(*number, value);
    }
}

impl Block {
    fn label(&self) -> u32 {
        self.0[0].operands()[0]
    }

    fn has(&self, code: u32) -> bool {
        self.0.iter().any(|one| one.code() == code)
    }

    /// Labels to which it leads.
    fn next(&self) -> Vec<u32> {
        match self.0.last().map(|one| (one.code(), one.operands())) {
            Some((op::BRANCH, [to])) => vec![*to],
            Some((op::BRANCH_CONDITIONAL, [_, yes, no, ..])) => vec![*yes, *no],
            Some((op::SWITCH, [_, default, cases @ ..])) => {
                let cases = cases.iter().skip(1).step_by(2);
                [*default].into_iter().chain(cases.copied()).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Goes straight where a known condition leads, and says whether it did not before. A loop stays one.
    fn decide(&mut self, known: &HashMap<u32, u32>) -> bool {
        let [.., merge, last] = &self.0[..] else {
            return false;
        };
        let (op::BRANCH_CONDITIONAL, &[condition, yes, no, ..]) = (last.code(), last.operands())
        else {
            return false;
        };
        let Some(value) = known.get(&condition) else {
            return false;
        };
        let to = if *value != 0 { yes } else { no };
        let dropped = match merge.code() {
            op::LOOP_MERGE => return false,
            op::SELECTION_MERGE => 2,
            _ => 1,
        };
        self.0.truncate(self.0.len() - dropped);
        self.0.push(Instruction::new(op::BRANCH, &[to]));
        true
    }
}
