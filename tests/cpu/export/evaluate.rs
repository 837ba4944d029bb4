//! What does a function of a naga module give, evaluated in 32 bits?

use std::collections::HashMap;

use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, LocalVariable, MathFunction,
    Module, Statement, TypeInner, UnaryOperator,
};

/// A value of WGSL.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, or the numbers of a vector.
    Numbers(Vec<f32>),
    /// True or false.
    Bool(bool),
    /// A struct's members.
    Struct(Vec<Self>),
}

impl Value {
    /// The number, or the first of a vector.
    pub fn first(&self) -> f32 {
        self.numbers()[0]
    }

    fn numbers(&self) -> &[f32] {
        match self {
            Self::Numbers(numbers) => numbers,
            other => panic!("{other:?} is no number"),
        }
    }

    fn truth(&self) -> bool {
        match self {
            Self::Bool(truth) => *truth,
            other => panic!("{other:?} is neither true nor false"),
        }
    }

    fn part(&self, index: u32) -> Self {
        match self {
            Self::Numbers(numbers) => Self::Numbers(vec![numbers[index as usize]]),
            Self::Struct(members) => members[index as usize].clone(),
            Self::Bool(_) => panic!("a bool has no parts"),
        }
    }

    fn set_part(&mut self, index: u32, part: Self) {
        match self {
            Self::Numbers(numbers) => numbers[index as usize] = part.first(),
            Self::Struct(members) => members[index as usize] = part,
            Self::Bool(_) => panic!("a bool has no parts"),
        }
    }

    fn each(&self, f: impl Fn(f32) -> f32) -> Self {
        Self::Numbers(self.numbers().iter().map(|x| f(*x)).collect())
    }

    /// By components; a number beside a vector stands for all of them.
    fn with(&self, other: &Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let (a, b) = (self.numbers(), other.numbers());
        let at = |numbers: &[f32], i: usize| numbers[if numbers.len() == 1 { 0 } else { i }];
        let length = a.len().max(b.len());
        Self::Numbers((0..length).map(|i| f(at(a, i), at(b, i))).collect())
    }
}

/// The value of the function of that name.
pub fn call(module: &Module, name: &str, arguments: &[Value]) -> Value {
    let found = module
        .functions
        .iter()
        .find(|(_, f)| f.name.as_deref() == Some(name));
    let (_, function) = found.unwrap_or_else(|| panic!("there is no {name}"));
    let mut run = Run {
        module,
        function,
        arguments,
        locals: HashMap::new(),
        known: HashMap::new(),
    };
    for (handle, local) in function.local_variables.iter() {
        let value = match local.init {
            Some(init) => run.value(init),
            None => run.zero(&module.types[local.ty].inner),
        };
        run.locals.insert(handle, value);
    }
    run.block(&function.body).expect("a value")
}

/// A call that is under way.
struct Run<'m> {
    module: &'m Module,
    function: &'m Function,
    arguments: &'m [Value],
    locals: HashMap<Handle<LocalVariable>, Value>,
    /// Expressions that have been evaluated, as they were then.
    known: HashMap<Handle<Expression>, Value>,
}

impl Run<'_> {
    /// What a block returns, if it returns.
    fn block(&mut self, block: &Block) -> Option<Value> {
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        let value = self.compute(&self.function.expressions[handle]);
                        self.known.insert(handle, value);
                    }
                }
                Statement::Store { pointer, value } => {
                    let value = self.value(*value);
                    self.store(*pointer, value);
                }
                Statement::Call {
                    function,
                    arguments,
                    result,
                } => {
                    let arguments: Vec<_> = arguments.iter().map(|a| self.value(*a)).collect();
                    let name = self.module.functions[*function]
                        .name
                        .as_deref()
                        .expect("a name");
                    let value = call(self.module, name, &arguments);
                    self.known.insert(result.expect("a result"), value);
                }
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let branch = if self.value(*condition).truth() {
                        accept
                    } else {
                        reject
                    };
                    if let Some(value) = self.block(branch) {
                        return Some(value);
                    }
                }
                Statement::Block(inner) => {
                    if let Some(value) = self.block(inner) {
                        return Some(value);
                    }
                }
                Statement::Return { value } => return Some(self.value(value.expect("a value"))),
                other => panic!("a statement that this does not know: {other:?}"),
            }
        }
        None
    }

    fn value(&self, handle: Handle<Expression>) -> Value {
        match self.known.get(&handle) {
            Some(value) => value.clone(),
            None => self.compute(&self.function.expressions[handle]),
        }
    }

    fn store(&mut self, pointer: Handle<Expression>, value: Value) {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(local) => {
                self.locals.insert(local, value);
            }
            Expression::AccessIndex { base, index } => {
                let mut whole = self.load(base);
                whole.set_part(index, value);
                self.store(base, whole);
            }
            ref other => panic!("a place that this does not know: {other:?}"),
        }
    }

    fn load(&self, pointer: Handle<Expression>) -> Value {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(local) => self.locals[&local].clone(),
            Expression::AccessIndex { base, index } => self.load(base).part(index),
            ref other => panic!("a place that this does not know: {other:?}"),
        }
    }

    fn compute(&self, expression: &Expression) -> Value {
        match expression {
            Expression::Literal(literal) => of_literal(literal),
            Expression::Constant(handle) => self.constant(self.module.constants[*handle].init),
            Expression::ZeroValue(ty) => self.zero(&self.module.types[*ty].inner),
            Expression::FunctionArgument(index) => self.arguments[*index as usize].clone(),
            Expression::Compose { ty, components } => {
                let parts: Vec<_> = components.iter().map(|part| self.value(*part)).collect();
                composed(&self.module.types[*ty].inner, parts)
            }
            Expression::Splat { size, value } => {
                Value::Numbers(vec![self.value(*value).first(); *size as usize])
            }
            // A place is no value until it is loaded; what is computed for it is not looked at.
            Expression::AccessIndex { base, index } => match self.is_place(*base) {
                true => self.load(*base).part(*index),
                false => self.value(*base).part(*index),
            },
            Expression::Load { pointer } => self.load(*pointer),
            Expression::Unary { op, expr } => match op {
                UnaryOperator::Negate => self.value(*expr).each(|x| -x),
                UnaryOperator::LogicalNot => Value::Bool(!self.value(*expr).truth()),
                other => panic!("an operator that this does not know: {other:?}"),
            },
            Expression::Binary { op, left, right } => {
                binary(*op, &self.value(*left), &self.value(*right))
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => self.value(if self.value(*condition).truth() {
                *accept
            } else {
                *reject
            }),
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let [b, c] = [arg1, arg2].map(|arg| arg.map(|arg| self.value(arg)));
                math(*fun, &self.value(*arg), b.as_ref(), c.as_ref())
            }
            other => panic!("an expression that this does not know: {other:?}"),
        }
    }

    fn is_place(&self, handle: Handle<Expression>) -> bool {
        match self.function.expressions[handle] {
            Expression::LocalVariable(_) => true,
            Expression::AccessIndex { base, .. } => self.is_place(base),
            _ => false,
        }
    }

    fn constant(&self, init: Handle<Expression>) -> Value {
        match &self.module.global_expressions[init] {
            Expression::Literal(literal) => of_literal(literal),
            other => panic!("a constant that this does not know: {other:?}"),
        }
    }

    fn zero(&self, ty: &TypeInner) -> Value {
        match ty {
            TypeInner::Scalar(_) => Value::Numbers(vec![0.0]),
            TypeInner::Vector { size, .. } => Value::Numbers(vec![0.0; *size as usize]),
            TypeInner::Struct { members, .. } => {
                let types = members
                    .iter()
                    .map(|member| &self.module.types[member.ty].inner);
                Value::Struct(types.map(|ty| self.zero(ty)).collect())
            }
            other => panic!("a type that this does not know: {other:?}"),
        }
    }
}

fn of_literal(literal: &Literal) -> Value {
    match literal {
        Literal::F32(x) => Value::Numbers(vec![*x]),
        Literal::Bool(truth) => Value::Bool(*truth),
        other => panic!("a literal that this does not know: {other:?}"),
    }
}

fn composed(ty: &TypeInner, parts: Vec<Value>) -> Value {
    match ty {
        TypeInner::Struct { .. } => Value::Struct(parts),
        _ => Value::Numbers(
            parts
                .iter()
                .flat_map(|part| part.numbers().to_vec())
                .collect(),
        ),
    }
}

fn binary(op: BinaryOperator, a: &Value, b: &Value) -> Value {
    use BinaryOperator as Op;
    let compare = |is: fn(&f32, &f32) -> bool| Value::Bool(is(&a.first(), &b.first()));
    match op {
        Op::Add => a.with(b, |a, b| a + b),
        Op::Subtract => a.with(b, |a, b| a - b),
        Op::Multiply => a.with(b, |a, b| a * b),
        Op::Divide => a.with(b, |a, b| a / b),
        Op::Less => compare(f32::lt),
        Op::LessEqual => compare(f32::le),
        Op::Greater => compare(f32::gt),
        Op::GreaterEqual => compare(f32::ge),
        Op::LogicalAnd => Value::Bool(a.truth() && b.truth()),
        Op::LogicalOr => Value::Bool(a.truth() || b.truth()),
        other => panic!("an operator that this does not know: {other:?}"),
    }
}

fn math(fun: MathFunction, a: &Value, b: Option<&Value>, c: Option<&Value>) -> Value {
    use MathFunction as Fun;
    let second = || b.expect("a second argument");
    let dot = |a: &Value, b: &Value| {
        let products = a.numbers().iter().zip(b.numbers()).map(|(a, b)| a * b);
        products.sum::<f32>()
    };
    match fun {
        Fun::Abs => a.each(f32::abs),
        Fun::Sqrt => a.each(f32::sqrt),
        Fun::Exp => a.each(loose_exp),
        Fun::InverseSqrt => a.each(|x| x.sqrt().recip()),
        Fun::Min => a.with(second(), f32::min),
        Fun::Max => a.with(second(), f32::max),
        Fun::Pow => a.with(second(), f32::powf),
        Fun::Clamp => {
            let low = a.with(second(), f32::max);
            low.with(c.expect("a third argument"), f32::min)
        }
        Fun::Dot => Value::Numbers(vec![dot(a, second())]),
        Fun::Cross => {
            let [a, b] = [a, second()].map(|v| glam::Vec3::from_slice(v.numbers()));
            Value::Numbers(a.cross(b).to_array().to_vec())
        }
        other => panic!("a function that this does not know: {other:?}"),
    }
}

/// exp(x) as far above it as a device may be: 3 + 2 |x| units in the last place (Vulkan 1.3, "Precision of core SPIR-V
/// instructions").
fn loose_exp(x: f32) -> f32 {
    let exact = x.exp();
    if !exact.is_finite() {
        return exact;
    }
    let unit = f64::from(exact.next_up()) - f64::from(exact);
    (f64::from(exact) + (3.0 + 2.0 * f64::from(x.abs())) * unit) as f32
}
