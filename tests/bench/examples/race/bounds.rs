//! What the operations of our programs take at least, on one core, one state at a time.

use std::collections::BTreeMap;

use dynamics_bench::contest::entry;
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::passes::{Plan, RunTime};
use dynamics_codegen::spec::{self, urdf::Urdf};
use dynamics_codegen::symbolic::Graph;

/// How many products, fused or not, a core begins in a cycle, and how many sums beside them: AMD's have two pipes for each
/// (Agner Fog, *The microarchitecture of Intel, AMD and VIA CPUs*, Zen 3), others two for both.
const PIPES: f64 = 2.0;

/// How many of them are one instruction where loops run in lanes: registers of 256 bits, as the table of lanes counts, too.
const LANES: f64 = 4.0;

/// In cycles, or at a clock in nanoseconds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bound {
    /// By the number of instructions, however many calls overlap.
    pub(crate) operations: f64,
    /// By the longest chain of operations, of one call on its own; of straight lines only.
    pub(crate) chain: Option<f64>,
    /// By the number of instructions of a state that has a lane for itself: branches one after the other.
    pub(crate) in_a_lane: f64,
}

impl Bound {
    /// In nanoseconds.
    pub(crate) fn at(self, gigahertz: f64) -> Self {
        Self {
            operations: self.operations / gigahertz,
            chain: self.chain.map(|chain| chain / gigahertz),
            in_a_lane: self.in_a_lane / gigahertz,
        }
    }
}

/// The bounds of all methods, in cycles.
pub(crate) fn of(robot: &str) -> BTreeMap<&'static str, Bound> {
    let entry = entry(robot).unwrap_or_else(|| panic!("there is no robot `{robot}`"));
    let item: syn::DeriveInput = syn::parse_str(entry.source).expect("the robots are Rust");
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(&item, &mut diags);
    if let Some(path) = spec.options.urdf.clone() {
        let file = format!("{}/{}", env!("CARGO_MANIFEST_DIR"), path.text);
        let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{file}: {error}"));
        spec::urdf::read(&mut spec, Urdf { file: &path.text, text: &text }, &mut diags);
    }
    let mistakes = diags.into_text();
    assert!(mistakes.is_empty(), "{robot}: {mistakes}");
    let graph = Graph::new();
    let compiled = match dynamics_codegen::checked(&spec, &graph, RunTime::Core) {
        Ok((_, compiled)) => compiled,
        Err(mistakes) => panic!("{robot}: {}", mistakes.into_text()),
    };
    let cycles =
        |instructions: u32, sums: u32| f64::from(instructions.saturating_sub(sums).max(sums)) / PIPES;
    let bound = |plan: &Plan<'_>, cost: dynamics_codegen::passes::Cost| match plan {
        Plan::StraightLine { program, .. } => Bound {
            operations: cycles(program.instructions(), program.sums()),
            chain: Some(f64::from(program.latency())),
            in_a_lane: {
                let program = program.one_by_one();
                cycles(program.instructions(), program.sums())
            },
        },
        _ => {
            // Every product in the loops may have its sum, and they run in lanes over rows, columns or links.
            let sums = cost.additions.saturating_sub(cost.multiplications);
            let one_by_one = cycles(cost.multiplications + sums, sums);
            Bound { operations: one_by_one / LANES, chain: None, in_a_lane: one_by_one }
        }
    };
    let methods = compiled.methods.iter();
    methods.map(|compiled| (compiled.method.name(), bound(&compiled.plan, compiled.cost))).collect()
}
