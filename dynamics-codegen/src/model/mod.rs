//! What a specification means: a checked tree of bodies, its quantities expressions of the robot's fields.

mod build;
mod composition;
mod dimensions;
mod energies;
mod fields;
mod joints;
mod lines;
mod mimic;
pub mod names;
mod physics;
mod placement;
mod quantities;
mod shapes;
mod terms;
mod topology;
mod tree;
mod unit_text;
mod values;

pub use build::build;
pub use energies::{Term, Terms};
pub use lines::OUTPUTS;
pub use tree::{Drive, Frame, Link, Motion, Passive, Tree};

use std::ops::Range;

use crate::spec::JointKind;
use crate::symbolic::{Expr, Number, SymbolId};

/// A field of the robot's struct that the equations depend on.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The field's name.
    pub name: String,
    /// The input of the graph that stands for it.
    pub symbol: SymbolId,
    /// A physical value for tests of the expansion: positive, of the size of one.
    pub sample: f64,
    /// Its unit as its uses tell it, as `kg·m²`; `1` of angles and plain numbers; nothing if they do not tell.
    pub unit: Option<String>,
    /// The exponents of kg, m and s in it.
    pub exponents: Option<[Number; 3]>,
}

/// The type of the fields that the equations use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FieldType {
    /// A type parameter of the struct.
    Generic(syn::Ident),
    /// `f32`
    F32,
    /// `f64`
    F64,
    /// No field is used, and the struct has no parameter to tell: any scalar will do.
    Unused,
}

impl std::fmt::Display for FieldType {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Generic(ident) => write!(f, "{ident}"),
            Self::F32 => f.write_str("f32"),
            Self::F64 => f.write_str("f64"),
            Self::Unused => f.write_str("any scalar"),
        }
    }
}

/// The limits of a joint, as written; infinite where nothing was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest coordinate, rad or m.
    pub lower: f64,
    /// Largest coordinate, rad or m.
    pub upper: f64,
    /// Largest speed, rad/s or m/s.
    pub velocity: f64,
    /// Largest force, N·m or N.
    pub effort: f64,
}

/// A joint as users see it.
#[derive(Clone, Debug)]
pub struct JointInfo {
    /// The joint's name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Its coordinates: one, or four of a ball joint, seven of a free one.
    pub q: Range<usize>,
    /// Its speeds, one for each degree of freedom.
    pub v: Range<usize>,
    /// The limits of each of its degrees of freedom.
    pub limits: Vec<Limits>,
    /// Whether its speeds have inputs.
    pub actuated: bool,
}

impl JointInfo {
    /// What its coordinates are called: `hinge`, or where it has several `root_joint.x` to `root_joint.qw`.
    pub fn coordinate_names(&self) -> Vec<String> {
        self.named(self.kind.coordinate_parts())
    }

    /// What the directions are called in which it can be displaced: as its coordinates, but of quaternions `rx` to `rz`
    /// and of positions in the body's axes `dx` to `dz`.
    pub fn displacement_names(&self) -> Vec<String> {
        self.named(self.kind.displacement_parts())
    }

    /// What its speeds are called: `hinge`, or where it has several `root_joint.vx` to `root_joint.wz`.
    pub fn speed_names(&self) -> Vec<String> {
        self.named(self.kind.speed_parts())
    }

    fn named(&self, parts: &[&str]) -> Vec<String> {
        match parts {
            [] => vec![self.name.clone()],
            parts => parts.iter().map(|part| format!("{}.{part}", self.name)).collect(),
        }
    }
}

/// A link as users see it.
#[derive(Clone, Debug)]
pub struct LinkInfo {
    /// The name of its joint.
    pub joint: String,
    /// The frame of the body that the joint carries; none of a link between the parts of a joint.
    pub body: Option<usize>,
    /// Whether rotors, dampers, friction and springs of its joint act on it: of a joint of one degree of freedom on
    /// its first link.
    pub acts: bool,
}

/// A checked robot.
#[derive(Clone, Debug)]
pub struct Model<'g> {
    /// The robot's name.
    pub name: String,
    /// The type of the fields that the equations use.
    pub field_type: FieldType,
    /// The fields that the equations use, in order of declaration.
    pub parameters: Vec<Parameter>,
    /// The joints that have coordinates, in the order of these.
    pub joints: Vec<JointInfo>,
    /// The speeds that have an input, in order.
    pub actuated: Vec<usize>,
    /// The links, as the tree has them.
    pub links: Vec<LinkInfo>,
    /// For each body, in order of declaration, the one that it is joined to; `None` is the world.
    pub parents: Vec<Option<usize>>,
    /// The kinematics and the masses. Its frames are the bodies, in order of declaration.
    pub tree: Tree<Expr<'g>>,
}
