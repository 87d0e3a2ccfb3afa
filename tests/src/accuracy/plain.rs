//! Every output by the plain recursion, in numbers of any precision.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::plain::{
    ForwardDynamicsDerivatives, InverseDynamicsDerivatives, Oracle, inverse_dynamics, total_mass,
};
use dynamics_codegen::model::{Model, Passive, Terms, Tree};
use dynamics_codegen::spatial::{Pose, PseudoInertia, Symmetric3, Vector3};
use dynamics_codegen::symbolic::Real;

use super::Output;

/// All outputs at `q`, `v`, `a` and `τ`.
pub(super) fn outputs<S: Real>(model: &Model<'_>, tree: &Tree<S>, at: [&[S]; 4]) -> Vec<Output<S>> {
    let [q, v, a, _] = at;
    let mut outputs = equations(&Oracle::new(tree), at);
    outputs.extend(derivatives(&Oracle::new(tree), at));
    outputs.extend(whole(&Oracle::new(tree), at));
    let one = |name, block| Output { name, blocks: vec![block] };
    outputs.extend([
        one("Y", regressor(model, tree, [q, v, a]).concat()),
        one("π", parameters(model, tree)),
        one("Y_b·π_b", inverse_dynamics(tree, q, v, a)),
    ]);
    outputs.extend(frames(&Oracle::new(tree), at));
    outputs
}

fn equations<S: Real>(oracle: &Oracle<'_, S>, [q, v, a, tau]: [&[S]; 4]) -> Vec<Output<S>> {
    let one = |name, block| Output { name, blocks: vec![block] };
    let (M, C, G) =
        (oracle.mass_matrix(q).concat(), oracle.coriolis_matrix(q, v).concat(), oracle.gravity_forces(q));
    let bundle = Output { name: "M, C, G in one", blocks: vec![M.clone(), C.clone(), G.clone()] };
    vec![
        one("M", M),
        one("C", C),
        one("G", G),
        bundle,
        one("passive forces", oracle.passive_forces(q, v)),
        one("h", oracle.bias_forces(q, v)),
        one("τ", oracle.inverse_dynamics(q, v, a)),
        one("a", oracle.forward_dynamics(q, v, tau).expect("M is positive definite")),
        one("T", vec![oracle.kinetic_energy(q, v)]),
        one("V", vec![oracle.potential_energy(q)]),
        one("T − V", vec![oracle.lagrangian(q, v)]),
        one("energy of springs", vec![oracle.elastic_energy(q)]),
    ]
}

fn derivatives<S: Real>(oracle: &Oracle<'_, S>, [q, v, a, tau]: [&[S]; 4]) -> Vec<Output<S>> {
    let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
        oracle.inverse_dynamics_derivatives(q, v, a);
    let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
        oracle.forward_dynamics_derivatives(q, v, tau).expect("M is positive definite");
    let inverse = da_dtau.clone();
    [
        ("∂τ/∂q", dtau_dq),
        ("∂τ/∂v", dtau_dv),
        ("∂τ/∂a", dtau_da),
        ("∂a/∂q", da_dq),
        ("∂a/∂v", da_dv),
        ("∂a/∂τ", da_dtau),
        ("M⁻¹", inverse),
    ]
    .map(|(name, rows)| Output { name, blocks: vec![rows.concat()] })
    .into()
}

fn whole<S: Real>(oracle: &Oracle<'_, S>, [q, v, ..]: [&[S]; 4]) -> Vec<Output<S>> {
    [
        ("mass", vec![total_mass(oracle.tree)]),
        ("c", oracle.center_of_mass(q)),
        ("J of c", oracle.center_of_mass_jacobian(q).concat()),
        ("A·v", oracle.centroidal_momentum(q, v)),
        ("A", oracle.centroidal_momentum_matrix(q).concat()),
    ]
    .map(|(name, block)| Output { name, blocks: vec![block] })
    .into()
}

fn frames<S: Real>(oracle: &Oracle<'_, S>, [q, v, a, _]: [&[S]; 4]) -> Vec<Output<S>> {
    let each = |name, block: &dyn Fn(usize) -> Vec<S>| {
        let blocks = (0..oracle.tree.frames.len()).map(block).collect();
        Output { name, blocks }
    };
    vec![
        each("R", &|frame| oracle.pose(frame, q).rotation.0.concat()),
        each("p", &|frame| oracle.pose(frame, q).translation.0.to_vec()),
        each("J", &|frame| oracle.body_jacobian(frame, q).concat()),
        each("J in world axes", &|frame| oracle.world_jacobian(frame, q).concat()),
        each("J·v", &|frame| oracle.velocity(frame, q, v)),
        each("J·a + J̇·v", &|frame| oracle.acceleration(frame, q, v, a)),
    ]
}

/// `Y(q,v,a)` by columns, laid out by rows: `τ` is linear in the parameters, so a column is the `τ` of the robot in
/// which one parameter is one and the others are zero.
fn regressor<S: Real>(model: &Model<'_>, tree: &Tree<S>, [q, v, a]: [&[S]; 3]) -> Vec<Vec<S>> {
    let mut empty = tree.clone();
    empty.terms = Terms::none();
    for link in &mut empty.links {
        let Passive { friction_speed, rest, .. } = link.passive;
        (link.inertia, link.passive) =
            (PseudoInertia::zero(), Passive { friction_speed, rest, ..Passive::none() });
    }
    let mut columns = Vec::new();
    let mut column = |change: &dyn Fn(&mut Tree<S>)| {
        let mut tree = empty.clone();
        change(&mut tree);
        columns.push(inverse_dynamics(&tree, q, v, a));
    };
    for (link, pose) in bodies(model, tree) {
        for k in 0..10 {
            column(&|tree| tree.links[link].inertia = unit_inertia(k).transformed(pose));
        }
    }
    for (link, sprung) in acting(model) {
        column(&|tree| tree.links[link].passive.armature = S::from(1));
        column(&|tree| tree.links[link].passive.damping = S::from(1));
        column(&|tree| tree.links[link].passive.friction = S::from(1));
        if sprung {
            column(&|tree| tree.links[link].passive.stiffness = S::from(1));
        }
    }
    let Terms { potential, dissipation, kinetic } = &tree.terms;
    for term in potential {
        column(&|tree| tree.terms.potential.push(term.clone()));
    }
    for term in dissipation {
        column(&|tree| tree.terms.dissipation.push(term.clone()));
    }
    for term in kinetic {
        column(&|tree| tree.terms.kinetic.push(term.clone()));
    }
    (0..v.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
}

/// The regressor's parameters: of each body mass, first moments and rotational inertia about its frame's origin, of
/// each joint of one degree of freedom armature, damping, friction, and the stiffness of a spring; of each term of the
/// energies one.
fn parameters<S: Real>(model: &Model<'_>, tree: &Tree<S>) -> Vec<S> {
    let ten = |(link, pose): (usize, Pose<S>)| {
        let inertia = tree.links[link].inertia.transformed(pose.inverse());
        let [x, y, z] = inertia.first.0;
        let Symmetric3 { xx, yy, zz, xy, xz, yz } = inertia.rotational();
        [inertia.mass, x, y, z, xx, xy, yy, xz, yz, zz]
    };
    let of_bodies = bodies(model, tree).into_iter().flat_map(ten);
    let of_joints = acting(model).into_iter().flat_map(|(link, sprung)| {
        let Passive { armature, damping, friction, stiffness, .. } = tree.links[link].passive;
        [armature, damping, friction].into_iter().chain(sprung.then_some(stiffness))
    });
    of_bodies.chain(of_joints).chain(tree.terms.all().map(|_| S::from(1))).collect()
}

/// The moments of a body of which parameter `k` is one and the others are zero.
fn unit_inertia<S: Real>(k: usize) -> PseudoInertia<S> {
    let entry = |at: usize| S::from(i32::from(at == k));
    let first = Vector3::new(entry(1), entry(2), entry(3));
    let (xx, xy, yy) = (entry(4), entry(5), entry(6));
    let (xz, yz, zz) = (entry(7), entry(8), entry(9));
    // About the origin: of a mass of zero the centre does not matter.
    let tensor = Symmetric3 { xx, yy, zz, xy, xz, yz };
    let moments = PseudoInertia::new(S::from(0), Vector3::zero(), tensor);
    PseudoInertia { mass: entry(0), first, ..moments }
}

/// The links that are bodies, and the frames of these in them.
fn bodies<S: Copy>(model: &Model<'_>, tree: &Tree<S>) -> Vec<(usize, Pose<S>)> {
    let links = model.links.iter().enumerate();
    links.filter_map(|(link, info)| Some((link, tree.frames[info.body?].pose))).collect()
}

/// The links whose joints may have rotors and friction, and whether these have springs.
fn acting(model: &Model<'_>) -> Vec<(usize, bool)> {
    let links = model.links.iter().zip(&model.tree.links).enumerate();
    links
        .filter(|(_, (info, _))| info.acts)
        .map(|(link, (_, symbolic))| (link, !symbolic.passive.stiffness.is_zero()))
        .collect()
}
