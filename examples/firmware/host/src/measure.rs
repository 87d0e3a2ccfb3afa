//! What a call of each method takes: instructions, stack and flash.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::Result;
use crate::cargo::Target;
use crate::clang::ROBOTS;
use crate::cycles::{Timing, cycles, timing};
use crate::elf::{Function, Program};
use crate::qemu::{Log, Machine, Moment, trace};
use crate::table::METHODS;
use crate::thumb::straight_line;

/// Of one method, over all its calls.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cost {
    /// The instructions of the cheapest call.
    pub(crate) least: usize,
    /// The instructions of the dearest call.
    pub(crate) most: usize,
    /// Whether no other number is possible: there is one way through the code, and its length was executed.
    pub(crate) straight: bool,
    /// The most cycles of a Cortex-M4F, where no other number of instructions is possible.
    pub(crate) cycles: Option<u32>,
    /// Bytes on the stack, return address and saved registers among them.
    pub(crate) stack: u32,
    /// Bytes of code and constants, of the method and of all that it called.
    pub(crate) flash: usize,
}

/// The costs of all functions of the program `methods` in modules of its own, by their names without it:
/// `puma560::inverse_dynamics`.
pub(crate) fn measure(machine: Machine, path: &Path) -> Result<BTreeMap<String, Cost>> {
    let program = Program::read(path)?;
    let mut calls = Calls::new(&program);
    match machine.target() {
        Target::Arm => trace(machine, path, Log::Registers, |moment| calls.see(moment))?,
        // Its registers are forty lines each time.
        Target::RiscV => {
            trace(machine, path, Log::Addresses, |moment| calls.see(moment))?;
            let mut blocks = Calls::new(&program);
            trace(machine, path, Log::RegistersOfBlocks, |moment| blocks.see(moment))?;
            for (call, blocks) in calls.done.iter_mut().zip(&blocks.done) {
                call.stack = blocks.stack;
            }
        }
    }
    calls.costs(machine.target())
}

/// A call while it lasts, and when it is over.
#[derive(Clone, Debug)]
struct Call<'p> {
    method: &'p Function,
    /// The function that it returns to.
    caller: u32,
    instructions: usize,
    cycles: Option<u32>,
    /// What was executed last.
    timing: Option<Timing>,
    stack_before: u32,
    stack: u32,
    visited: BTreeSet<u32>,
}

/// Finds calls in a trace.
struct Calls<'p> {
    program: &'p Program,
    methods: BTreeMap<u32, &'p Function>,
    /// The function of the moment before.
    before: u32,
    current: Option<Call<'p>>,
    done: Vec<Call<'p>>,
}

impl<'p> Calls<'p> {
    fn new(program: &'p Program) -> Self {
        let methods = program.functions.iter().filter(|function| method_name(function).is_some());
        let methods = methods.map(|function| (function.address, function)).collect();
        Self { program, methods, before: 0, current: None, done: vec![] }
    }

    fn see(&mut self, Moment { pc, sp }: Moment) {
        let function = self.program.function_at(pc);
        let code = function.and_then(|function| function.code.get((pc - function.address) as usize..));
        let function = function.map_or(0, |function| function.address);
        let sp = sp.unwrap_or_default();
        if let Some(call) = self.current.take_if(|call| call.caller == function) {
            self.done.push(call);
        }
        if self.current.is_none()
            && let Some(&method) = self.methods.get(&pc)
        {
            let visited = BTreeSet::new();
            let caller = self.before;
            self.current = Some(Call {
                method,
                caller,
                instructions: 0,
                cycles: Some(0),
                timing: None,
                stack_before: sp,
                stack: 0,
                visited,
            });
        }
        if let Some(call) = &mut self.current {
            call.instructions += 1;
            let now = code.and_then(timing);
            call.cycles = call.cycles.zip(now).map(|(sum, now)| sum + cycles(now, call.timing));
            call.timing = now;
            call.stack = call.stack.max(call.stack_before.wrapping_sub(sp));
            call.visited.insert(function);
        }
        self.before = function;
    }

    fn costs(self, target: Target) -> Result<BTreeMap<String, Cost>> {
        let mut costs = BTreeMap::<String, Cost>::new();
        for call in &self.done {
            let name = method_name(call.method).unwrap_or_default();
            let cost = costs.entry(name).or_insert_with(|| Cost { least: usize::MAX, ..Cost::default() });
            cost.least = cost.least.min(call.instructions);
            cost.most = cost.most.max(call.instructions);
            cost.stack = cost.stack.max(call.stack);
            let visited = call.visited.iter().filter_map(|&address| self.program.function_at(address));
            cost.flash = cost.flash.max(visited.map(|function| function.code.len()).sum());
            let Function { address, code, .. } = call.method;
            let length = || straight_line(*address, code, &|callee| self.program.code_at(callee));
            cost.straight = target == Target::Arm && length() == Some(call.instructions);
            cost.cycles = call.cycles.filter(|_| cost.straight);
        }
        for method in self.methods.values() {
            let name = method_name(method).unwrap_or_default();
            if !costs.contains_key(&name) {
                return Err(format!("`{name}` was not called"));
            }
        }
        Ok(costs)
    }
}

/// `puma560::inverse_dynamics` of `methods::puma560::inverse_dynamics` in Rust, of `puma560_inverse_dynamics` in C.
fn method_name(function: &Function) -> Option<String> {
    let name = function.name.as_str();
    if let Some(name) = name.strip_prefix("methods::") {
        let is_method = name.contains("::") && !name.ends_with("::all") && !name.contains(['<', '{']);
        return is_method.then(|| name.to_owned());
    }
    let mut robots = ROBOTS.iter().map(|(prefix, _)| prefix);
    let (robot, method) =
        robots.find_map(|robot| Some((robot, name.strip_prefix(robot)?.strip_prefix('_')?)))?;
    let method = match method {
        "inverse_derivatives" => "inverse_dynamics_derivatives",
        "forward_derivatives" => "forward_dynamics_derivatives",
        other => other,
    };
    METHODS.contains(&method).then(|| format!("{robot}::{method}"))
}
