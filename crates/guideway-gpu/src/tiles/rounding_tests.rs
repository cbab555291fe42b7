//! No shader leaves its picture to the rounding of a device: every float product is rounded before
//! it enters a sum, and nothing divides or takes roots but where the result is only an estimate.

use naga::valid::{Capabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, ScalarKind,
    Statement,
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

/// A sentence for each function that breaks the rule.
fn breaches(name: &str, text: &str) -> Vec<String> {
    let module = naga::front::wgsl::parse_str(text)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module);
    let info = info.unwrap_or_else(|error| panic!("{name}: {error:?}"));
    let mut products = Products::default();
    // Until no further variable, argument or result is found to hold a product.
    while products.spread(&module, &info) {}
    let all = functions(&module, &info);
    let of_each = all.flat_map(|(function, info)| {
        let title = function.name.clone().unwrap_or_default();
        let title = if title == "main" {
            name.to_owned()
        } else {
            title
        };
        let lines = products.breaches(&module, function, info);
        let is_estimate = ESTIMATES.contains(&title.as_str());
        lines
            .filter(move |_| !is_estimate)
            .map(move |why| format!("{title}: {why}"))
    });
    of_each.collect()
}

fn functions<'a>(
    module: &'a Module,
    info: &'a ModuleInfo,
) -> impl Iterator<Item = (&'a Function, &'a FunctionInfo)> {
    let functions = module.functions.iter();
    let functions = functions.map(|(handle, function)| (function, &info[handle]));
    let entries = module.entry_points.iter().enumerate();
    functions.chain(entries.map(|(i, entry)| (&entry.function, info.get_entry_point(i))))
}

/// What may hold a product that was not rounded: where floats flow without an operation.
#[derive(Default, PartialEq, Clone)]
struct Products {
    results: Vec<Handle<Function>>,
    arguments: Vec<(Option<String>, u32)>,
    locals: Vec<(Option<String>, Handle<naga::LocalVariable>)>,
    globals: Vec<Handle<naga::GlobalVariable>>,
}

impl Products {
    /// Follows every assignment, call and return once. Returns whether it found more.
    fn spread(&mut self, module: &Module, info: &ModuleInfo) -> bool {
        let before = self.clone();
        for (function, info) in functions(module, info) {
            self.follow(module, function, info, &function.body);
        }
        before != *self
    }

    fn follow(&mut self, module: &Module, function: &Function, info: &FunctionInfo, block: &Block) {
        for statement in block {
            match statement {
                Statement::Block(inner) => self.follow(module, function, info, inner),
                Statement::If { accept, reject, .. } => {
                    self.follow(module, function, info, accept);
                    self.follow(module, function, info, reject);
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    self.follow(module, function, info, body);
                    self.follow(module, function, info, continuing);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.follow(module, function, info, &case.body);
                    }
                }
                Statement::Store { pointer, value } => {
                    if self.is_product(module, function, info, *value) {
                        self.mark_variable(module, function, *pointer);
                    }
                }
                Statement::Call {
                    function: called,
                    arguments,
                    ..
                } => {
                    let name = &module.functions[*called].name;
                    for (index, argument) in (0..).zip(arguments) {
                        if self.is_product(module, function, info, *argument) {
                            insert(&mut self.arguments, (name.clone(), index));
                        }
                    }
                }
                Statement::Return { value: Some(value) } => {
                    if self.is_product(module, function, info, *value) {
                        let own = module
                            .functions
                            .iter()
                            .find(|(_, f)| f.name == function.name);
                        own.into_iter()
                            .for_each(|(own, _)| insert(&mut self.results, own));
                    }
                }
                _ => {}
            }
        }
    }

    fn mark_variable(&mut self, module: &Module, function: &Function, at: Handle<Expression>) {
        match function.expressions[at] {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                self.mark_variable(module, function, base);
            }
            Expression::LocalVariable(local) => {
                insert(&mut self.locals, (function.name.clone(), local));
            }
            // Memory that threads share holds rounded numbers.
            Expression::GlobalVariable(global)
                if module.global_variables[global].space == naga::AddressSpace::Private =>
            {
                insert(&mut self.globals, global);
            }
            _ => {}
        }
    }

    /// Returns whether a float may be a product that was not rounded yet.
    fn is_product(
        &self,
        module: &Module,
        function: &Function,
        info: &FunctionInfo,
        at: Handle<Expression>,
    ) -> bool {
        let of = |at| self.is_product(module, function, info, at);
        match function.expressions[at] {
            Expression::Binary { op, .. } if op == BinaryOperator::Multiply => {
                is_float(module, info, at)
            }
            Expression::Unary { expr, .. } => of(expr),
            Expression::Math { fun, arg, .. } if fun == MathFunction::Abs => of(arg),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => of(base),
            Expression::Splat { value, .. } => of(value),
            Expression::Swizzle { vector, .. } => of(vector),
            Expression::Compose { ref components, .. } => components.iter().any(|&part| of(part)),
            Expression::Select { accept, reject, .. } => of(accept) || of(reject),
            Expression::Load { pointer } => of(pointer),
            Expression::LocalVariable(local) => {
                self.locals.contains(&(function.name.clone(), local))
            }
            Expression::GlobalVariable(global) => self.globals.contains(&global),
            Expression::FunctionArgument(index) => {
                self.arguments.contains(&(function.name.clone(), index))
            }
            Expression::CallResult(called) => {
                let name = module.functions[called].name.as_deref();
                self.results.contains(&called) && !name.is_some_and(|n| BARRIERS.contains(&n))
            }
            _ => false,
        }
    }

    fn breaches(
        &self,
        module: &Module,
        function: &Function,
        info: &FunctionInfo,
    ) -> impl Iterator<Item = String> {
        let all = function.expressions.iter();
        all.filter_map(move |(at, expression)| match *expression {
            Expression::Binary { op, left, right } if is_float(module, info, at) => match op {
                BinaryOperator::Add | BinaryOperator::Subtract => {
                    let is_product = |side| self.is_product(module, function, info, side);
                    let is_wrong = is_product(left) || is_product(right);
                    is_wrong.then(|| "a product enters a sum".to_owned())
                }
                BinaryOperator::Divide => {
                    let is_constant = is_constant(function, left) && is_constant(function, right);
                    (!is_constant).then(|| "a division".to_owned())
                }
                _ => None,
            },
            Expression::Math { fun, .. } => {
                (is_float(module, info, at) && !is_pinned(fun)).then(|| format!("{fun:?}"))
            }
            _ => None,
        })
        .collect::<Vec<_>>()
        .into_iter()
    }
}

fn insert<T: PartialEq>(list: &mut Vec<T>, item: T) {
    if !list.contains(&item) {
        list.push(item);
    }
}

/// Functions of floats with one result on all devices.
fn is_pinned(function: MathFunction) -> bool {
    use MathFunction::{Abs, Clamp, Floor, Max, Min};
    matches!(function, Abs | Clamp | Floor | Max | Min)
}

/// Returns whether the compiler of the pipeline, not the device, computes an expression.
fn is_constant(function: &Function, at: Handle<Expression>) -> bool {
    match function.expressions[at] {
        Expression::Literal(_) | Expression::Constant(_) | Expression::Override(_) => true,
        Expression::As { expr, .. } => is_constant(function, expr),
        Expression::Binary { left, right, .. } => {
            is_constant(function, left) && is_constant(function, right)
        }
        _ => false,
    }
}

fn is_float(module: &Module, info: &FunctionInfo, at: Handle<Expression>) -> bool {
    let kind = info[at].ty.inner_with(&module.types).scalar_kind();
    kind == Some(ScalarKind::Float)
}
