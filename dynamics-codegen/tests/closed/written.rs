//! What is written.

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::{ClosedForms, closed_forms};
use dynamics_codegen::model;
use dynamics_codegen::symbolic::Graph;

use super::proof::spec_of;
use super::robots;

/// The closed forms of the robot that a struct with its attributes describes.
fn forms(source: &str) -> Option<ClosedForms> {
    let spec = spec_of(source);
    let mut diags = Diagnostics::new();
    let graph = Graph::new();
    let model = model::build(&spec, &graph, &mut diags);
    diags.check().unwrap();
    let start = std::time::Instant::now();
    let forms = closed_forms(&model.unwrap(), &graph);
    println!("{:.1} ms, {} nodes", start.elapsed().as_secs_f64() * 1e3, graph.len());
    forms.ok()
}

#[test]
fn all() {
    for (name, source) in robots::ROBOTS {
        println!("\n==== {name}");
        let Some(f) = forms(source) else {
            println!("swells");
            continue;
        };
        let n = &f.notation;
        let show = |letter: &str, m: &dynamics_codegen::closed::Matrix| {
            for line in m.unicode_entries(letter, n) {
                println!("{line}");
            }
        };
        show("M", &f.mass_matrix);
        show("C", &f.coriolis_matrix);
        show("G", &f.gravity_forces);
        for (l, x) in [("T", &f.kinetic_energy), ("V", &f.potential_energy), ("L", &f.lagrangian)] {
            println!("{l} = {}", x.unicode(n));
        }
    }
}
