//! No shader leaves its picture to the rounding of a device: every float product is rounded before
//! it enters a sum, and nothing divides or takes roots but where the result is only an estimate.

use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle,
    LocalVariable, MathFunction, Module, ScalarKind, Statement,
};

use super::layout_tests::sources;

/// Functions of `shared/rounding.wgsl` that return what may enter a sum.
const BARRIERS: [&str; 6] = [
    "rounded", "rounded2", "rounded4", "exact", "exact2", "exact4",
];

/// Functions whose floats may differ among devices by a few roundings.
const ESTIMATES: [&str; 7] = [
    // They find what a line may touch, with a margin.
    "columns_between",
    "tile_columns",
    // They find a number or its neighbor, and exact arithmetic decides between both.
    "sample_near",
    "row_span",
    "segment_lines",
    // It divides by a power of two.
    "mean_paths",
    // The main function of `present`: its quotients become whole numbers by rounding.
    "present",
];

#[test]
fn pictures_do_not_depend_on_the_rounding_of_a_device() {
    let mut found: Vec<String> = Vec::new();
    for source in sources() {
        found.extend(breaches(source.name, &source.wgsl));
    }
    found.sort_unstable();
    found.dedup();
    assert!(found.is_empty(), "{}", found.join("\n"));
    let all = sources();
    for name in BARRIERS.iter().chain(&ESTIMATES) {
        let start = format!("fn {name}(");
        let mut sources = all.iter();
        let is_used = sources.any(|source| source.name == *name || source.wgsl.contains(&start));
        assert!(is_used, "no shader has `{name}`");
    }
}

#[test]
fn every_kind_of_breach_is_found() {
    let shader = |body: &str| {
        let text = format!(
            "@group(0) @binding(0) var<storage, read_write> a: array<f32>;
             var<private> kept: f32;
             fn exact(x: f32) -> f32 {{ return x; }}
             fn square(x: f32) -> f32 {{ return x * x; }}
             fn plus_one(x: f32) -> f32 {{ return x + 1.0; }}
             @compute @workgroup_size(1) fn main() {{ {body} }}"
        );
        breaches("bad", &text)
    };
    for wrong in [
        "a[0] = a[1] * a[2] + a[3];",
        "a[0] = a[3] - a[1] * a[2];",
        "a[0] = -(a[1] * a[2]) + a[3];",
        "a[0] += a[1] * a[2];",
        "a[0] = abs(a[1] * a[2]) + a[3];",
        "a[0] = square(a[1]) + a[2];",
        "a[0] = plus_one(a[1] * a[2]);",
        "var x = 0.0; x = a[1] * a[2]; a[0] = x + a[3];",
        "kept = a[1] * a[2]; a[0] = kept + a[3];",
        "let v = vec2f(a[1], a[2]) * a[3]; a[0] = v.y + 1.0;",
        "a[0] = select(a[1] * a[2], a[3], a[4] > 0.0) + a[5];",
        "a[0] = fma(a[1], a[2], a[3]);",
        "a[0] = a[1] / a[2];",
        "a[0] = sqrt(a[1]);",
        "a[0] = length(vec2f(a[1], a[2]));",
        "a[0] = dot(vec2f(a[1]), vec2f(a[2]));",
    ] {
        assert_eq!(shader(wrong).len(), 1, "{wrong}");
    }
    for right in [
        "a[0] = (a[1] + a[2]) * a[3];",
        "a[0] = exact(2.0 * a[1]) + a[2];",
        "a[0] = clamp(a[1] * a[2], 0.0, 1.0) + a[3];",
        "a[0] = min(square(a[1]), 1e30) + a[2];",
        "a[0] = bitcast<f32>(bitcast<u32>(a[1] * a[2]) & 0xfffu) + a[3];",
        "a[0] = f32(u32(a[1]) * 3u + 7u / u32(a[2])) + a[3];",
        "a[0] = a[1] * (1.0 / 3.0);",
    ] {
        assert_eq!(shader(right), [""; 0], "{right}");
    }
}

/// A sentence for each breach of the rule.
fn breaches(name: &str, text: &str) -> Vec<String> {
    let module = naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module);
    let info = info.unwrap_or_else(|error| panic!("{name}: {error:?}"));
    let bodies = bodies(&module, &info);
    let mut products = Products::default();
    // Until no further variable, argument or result is found to hold a product.
    while products.spread(&bodies) {}
    let mut found = Vec::new();
    for body in &bodies {
        let title = body.function.name.as_deref().filter(|own| *own != "main");
        let title = title.unwrap_or(name);
        if !ESTIMATES.contains(&title) {
            let own = products.breaches(body).into_iter();
            found.extend(own.map(|why| format!("{title}: {why}")));
        }
    }
    found
}

/// A function, and its handle if it is no entry point.
struct Body<'a> {
    module: &'a Module,
    function: &'a Function,
    info: &'a FunctionInfo,
    handle: Option<Handle<Function>>,
}

fn bodies<'a>(module: &'a Module, info: &'a ModuleInfo) -> Vec<Body<'a>> {
    let functions = module.functions.iter().map(|(handle, function)| Body {
        module,
        function,
        info: &info[handle],
        handle: Some(handle),
    });
    let entries = module.entry_points.iter().enumerate();
    let entries = entries.map(|(number, entry)| Body {
        module,
        function: &entry.function,
        info: info.get_entry_point(number),
        handle: None,
    });
    functions.chain(entries).collect()
}

impl Body<'_> {
    fn is_float(&self, at: Handle<Expression>) -> bool {
        let inner = self.info[at].ty.inner_with(&self.module.types);
        inner.scalar_kind() == Some(ScalarKind::Float)
    }

    /// Returns whether the compiler of the pipeline, not the device, computes an expression.
    fn is_constant(&self, at: Handle<Expression>) -> bool {
        match self.function.expressions[at] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::Override(_) => true,
            Expression::As { expr, .. } => self.is_constant(expr),
            Expression::Binary { left, right, .. } => {
                self.is_constant(left) && self.is_constant(right)
            }
            _ => false,
        }
    }

    /// The variable of a pointer. Memory that threads share holds rounded numbers and has none.
    fn variable(&self, pointer: Handle<Expression>) -> Option<Holder> {
        match self.function.expressions[pointer] {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                self.variable(base)
            }
            Expression::LocalVariable(local) => Some(Holder::Local(self.handle, local)),
            Expression::GlobalVariable(global) => {
                let space = self.module.global_variables[global].space;
                (space == AddressSpace::Private).then_some(Holder::Global(global))
            }
            _ => None,
        }
    }
}

/// A place through which floats flow without an operation. Entry points have no handle.
#[derive(PartialEq)]
enum Holder {
    Result(Handle<Function>),
    Argument(Option<Handle<Function>>, u32),
    Local(Option<Handle<Function>>, Handle<LocalVariable>),
    Global(Handle<GlobalVariable>),
}

/// The places that may hold a product that was not rounded.
#[derive(Default)]
struct Products(Vec<Holder>);

impl Products {
    /// Follows every assignment, call and return once. Returns whether it found more.
    fn spread(&mut self, bodies: &[Body<'_>]) -> bool {
        let before = self.0.len();
        for body in bodies {
            self.follow(body, &body.function.body);
        }
        before < self.0.len()
    }

    fn follow(&mut self, body: &Body<'_>, block: &Block) {
        for statement in block {
            match statement {
                Statement::Block(inner) => self.follow(body, inner),
                Statement::If { accept, reject, .. } => {
                    self.follow(body, accept);
                    self.follow(body, reject);
                }
                Statement::Loop {
                    body: first,
                    continuing,
                    ..
                } => {
                    self.follow(body, first);
                    self.follow(body, continuing);
                }
                Statement::Switch { cases, .. } => {
                    cases.iter().for_each(|case| self.follow(body, &case.body));
                }
                Statement::Store { pointer, value } => {
                    self.flow(body, *value, body.variable(*pointer));
                }
                Statement::Call {
                    function,
                    arguments,
                    ..
                } => {
                    for (index, argument) in (0..).zip(arguments) {
                        let holder = Holder::Argument(Some(*function), index);
                        self.flow(body, *argument, Some(holder));
                    }
                }
                Statement::Return { value: Some(value) } => {
                    self.flow(body, *value, body.handle.map(Holder::Result));
                }
                _ => {}
            }
        }
    }

    /// Notes the flow of a value to a place.
    fn flow(&mut self, body: &Body<'_>, value: Handle<Expression>, to: Option<Holder>) {
        if let Some(to) = to
            && !self.0.contains(&to)
            && self.has(body, value)
        {
            self.0.push(to);
        }
    }

    /// Returns whether a value may be or hold a product that was not rounded.
    fn has(&self, body: &Body<'_>, at: Handle<Expression>) -> bool {
        let holds = |holder: Holder| self.0.contains(&holder);
        match body.function.expressions[at] {
            Expression::Binary {
                op: BinaryOperator::Multiply,
                ..
            } => body.is_float(at),
            Expression::Math {
                fun: MathFunction::Abs,
                arg,
                ..
            } => self.has(body, arg),
            Expression::Unary { expr, .. } => self.has(body, expr),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                self.has(body, base)
            }
            Expression::Splat { value, .. } => self.has(body, value),
            Expression::Swizzle { vector, .. } => self.has(body, vector),
            Expression::Compose { ref components, .. } => {
                components.iter().any(|&part| self.has(body, part))
            }
            Expression::Select { accept, reject, .. } => {
                self.has(body, accept) || self.has(body, reject)
            }
            Expression::Load { pointer } => body.variable(pointer).is_some_and(holds),
            Expression::FunctionArgument(index) => holds(Holder::Argument(body.handle, index)),
            Expression::CallResult(called) => {
                let name = body.module.functions[called].name.as_deref();
                let is_barrier = name.is_some_and(|name| BARRIERS.contains(&name));
                !is_barrier && holds(Holder::Result(called))
            }
            _ => false,
        }
    }

    fn breaches(&self, body: &Body<'_>) -> Vec<String> {
        let all = body.function.expressions.iter();
        let floats = all.filter(|(at, _)| body.is_float(*at));
        let found = floats.filter_map(|(_, expression)| match *expression {
            Expression::Binary {
                op: BinaryOperator::Add | BinaryOperator::Subtract,
                left,
                right,
            } => {
                let is_wrong = self.has(body, left) || self.has(body, right);
                is_wrong.then(|| "a product enters a sum".to_owned())
            }
            Expression::Binary {
                op: BinaryOperator::Divide,
                left,
                right,
            } => {
                let is_constant = body.is_constant(left) && body.is_constant(right);
                (!is_constant).then(|| "a division".to_owned())
            }
            Expression::Math { fun, .. } => (!is_pinned(fun)).then(|| format!("{fun:?}")),
            _ => None,
        });
        found.collect()
    }
}

/// Returns whether a function of floats has one result on all devices.
fn is_pinned(function: MathFunction) -> bool {
    use MathFunction::{Abs, Clamp, Floor, Max, Min};
    matches!(function, Abs | Clamp | Floor | Max | Min)
}
