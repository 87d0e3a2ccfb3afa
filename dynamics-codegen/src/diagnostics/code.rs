//! The catalogue of mistakes. The wording of the help lives here, once.

use std::fmt;

macro_rules! catalogue {
    ($($(#[doc = $doc:literal])+ $name:ident => $help:expr,)+) => {
        /// A kind of mistake.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $($(#[doc = $doc])+ $name,)+
        }

        impl Code {
            /// Every kind, in the order of the catalogue.
            pub const ALL: &'static [Self] = &[$(Self::$name,)+];

            /// One sentence in the imperative: what the user can do now.
            pub fn help(self) -> &'static str {
                match self {
                    $(Self::$name => $help,)+
                }
            }

            /// The name without its prefix, as in `MassNegative`.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$name => stringify!($name),)+
                }
            }

            /// What the mistake is.
            pub fn explanation(self) -> &'static str {
                match self {
                    $(Self::$name => concat!($($doc, "\n",)+).trim_ascii(),)+
                }
            }
        }
    };
}

catalogue! {
    // Syntax
    /// Tokens that do not fit the grammar.
    Syntax => "write joints as `#[joint(q1: revolute(z), world -> a, at = [0, 0, 0.3])]`, \
         and bodies as `#[body(a, mass = 1.5, com = [0, 0, 0.1], inertia = diag(0.1, 0.1, 0.2))]`",
    /// An expression or a group nested deeper than any robot needs.
    NestingTooDeep => "give the inner parts their own fields, or write the expression with fewer parentheses",
    /// A helper attribute on a field instead of the struct.
    AttributeMisplaced => "write the attribute above the struct, after `#[derive(Dynamics)]`",
    /// A key that the attribute does not know.
    KeyUnknown => "use one of the keys that the attribute knows",
    /// A key that was given twice.
    KeyDuplicate => "keep one of the two",
    /// Keys that exclude each other.
    KeysConflict => "keep one of the two",
    /// A key without the one that it belongs to.
    KeyMissing => "add the key that is missing, or leave this one out",
    /// A list or a call with too few or too many parts.
    CountWrong => "give exactly the parts that are listed",
    /// A number too large or too small for a double.
    NumberOutOfRange => "use a number whose size is between 1e-300 and 1e300",
    /// A unit that is not known.
    UnitUnknown => "use one of m, cm, mm, um, km, kg, g, t, s, ms, rad, deg, N, Nm, Nms, N_per_m, \
         Ns_per_m, kg_m2, J, W",
    /// A function that is not known.
    FunctionUnknown => "use one of sin, cos, sqrt",
    /// A power of a fraction, of a field, or of more than 16.
    ExponentInvalid => "write a whole number from -16 to 16, as in `r^2`, and `sqrt(r)` for a root",
    /// A name that is no field of the struct.
    FieldUnknown => "name a field of the struct, or write a number",
    // The struct
    /// An enum, a union or a tuple struct.
    StructNeeded => "derive `Dynamics` for a struct with named fields, or for a unit struct",
    /// A field that the equations use is no number.
    FieldTypeUnsupported => "give the field the struct's type parameter, `f64` or `f32` as its type",
    /// The fields that the equations use have different types.
    FieldTypesDiffer => "give all fields that the robot uses the same type",
    // Names
    /// The name was given before.
    NameDuplicate => "give each joint, each coordinate and each body a name of its own",
    /// Two bodies become the same type of Rust, where Rust is written.
    NamesCollide => "choose names that differ in more than case and underscores",
    /// The name cannot be used.
    ///
    /// `pi`, `PI` and `π` are the number π in every formula: no field and no joint that a formula could mean has such a
    /// name. `sin`, `cos`, `sqrt`, and of terms `dot`, `distance`, `x`, `y` and `z`, are functions where a parenthesis
    /// follows, and free elsewhere. `world` is where every robot stands, and is no body. Where Rust is written, a body becomes
    /// a type, so that its name needs a letter. In files no name is empty, longer than 256 characters, or has characters that
    /// cannot be seen.
    NameReserved => "choose another name",
    // Topology
    /// There is no joint.
    JointMissing => "add a joint, as in `#[joint(theta1: revolute(z), world -> column)]`",
    /// No joint moves.
    DegreesOfFreedomMissing => "let a joint move: make it `revolute` or `prismatic`, or leave out its `locked`",
    /// Too many joints.
    JointsTooMany => "split the robot, or weld joints that hardly move: above 256 links its matrices fit no stack",
    /// A joint's parent is no body.
    ParentUnknown => "name a body that a joint carries, or `world`",
    /// A moving joint carries a body that is not described.
    BodyMissing => "describe the body by a `#[body(…)]`; without `mass` it is a frame without mass",
    /// The world is moved.
    WorldIsChild => "turn the joint round: the world is always the parent",
    /// Two joints carry the same body.
    ParentTwice => "let one joint carry the body; closed loops are not supported",
    /// Joints form a cycle.
    Cycle => "let the chain of parents of every body end at `world`",
    /// No joint carries the body.
    BodyUnreachable => "carry it by a joint, as in `#[joint(name: fixed, world -> body)]`",
    /// A joint comes before the joint that carries it.
    ParentAfterChild => "move this line up: coordinates are numbered in the order of the joints, parents first",
    // Joints
    /// The kind of joint is not known.
    JointKindUnknown => "use one of revolute, continuous, prismatic, helical, cylindrical, universal, planar, \
         translation, ball, free, fixed",
    /// More is said of a joint that the file does not have.
    JointUnknown => "name a `<joint>` of the file, or write the whole joint: \
         `#[joint(name: kind(axis), parent -> child, …)]`",
    /// A key that joints of this kind do not have.
    KeyNotOfKind => "leave the key out, or compose the joint of `revolute` and `prismatic` ones, \
         with bodies without mass between them",
    /// The joint has no axis.
    AxisMissing => "give an axis, as in `revolute(z)`",
    /// The axis is given by the placement already.
    AxisUnneeded => "leave the axis out: the placement defines it",
    /// The axis is no direction.
    AxisZero => "give a direction, as `z`, `-x` or `[0, 1, 1]`",
    /// The axes of a universal joint are parallel.
    AxesParallel => "give two directions that differ, as in `universal(x, y)`",
    /// The axis depends on a field.
    AxisNotConstant => "write the axis in numbers, and turn the joint's frame by `rpy`",
    /// A joint that does not move, or turns without end, has no limits.
    LimitsUnneeded => "leave the limits out, or make the joint `revolute` or `prismatic`",
    /// The limits leave no room.
    LimitsInverted => "write the smaller limit first",
    /// A limit of speed or effort is negative.
    LimitNegative => "give the limit as a magnitude",
    /// A ratio, a pitch or a gear of zero.
    RatioZero => "give a number other than zero",
    /// The joint to follow does not exist.
    MimicUnknown => "name another joint of the robot",
    /// The joint to follow has no coordinate, or more than one.
    MimicUnfit => "follow a joint of one degree of freedom: revolute, continuous, prismatic or helical",
    /// Joints follow each other in a circle.
    MimicCycle => "let one of them move by itself: leave out its `mimic`",
    /// Damping, friction, a spring or an armature of the wrong sign.
    PassiveNegative => "give damping, friction, stiffness and armature as magnitudes",
    /// A field stands where a number is needed.
    ConstantNeeded => "write a number",
    /// An angle without a unit that is more than a full turn.
    AngleLooksLikeDegrees => "angles are in radians: write `deg` after the number, or `rad` if it is meant",
    // Bodies
    /// Mass without inertia.
    InertiaMissing => "add `inertia = diag(…)`, or use `solid = point(m)` for a point mass",
    /// Inertia, or its place, without mass.
    MassMissing => "add `mass = …`",
    /// The mass is negative.
    MassNegative => "give a mass in kilograms that is not negative; zero is a body without mass",
    /// A dimension of a solid is negative.
    SizeNegative => "give a size in metres that is not negative",
    /// The tensor is not symmetric as written.
    InertiaNotSymmetric => "write the same expression in both places, or use `tensor(ixx, ixy, ixz, iyy, iyz, izz)`",
    /// The tensor looks like the first entries of a matrix by rows.
    InertiaOrder => "the order is ixx, ixy, ixz, iyy, iyz, izz; if it is meant, write the matrix `[[…], […], […]]`",
    /// No distribution of mass has this inertia.
    InertiaNonphysical => "correct the inertia, which is about the centre of mass",
    /// A joint moves no mass.
    MovesNoMass => "give a body that the joint moves a mass, or make the joint `fixed`",
    /// A joint turns no inertia.
    MovesNoInertia => "give the body an inertia about the axis, or make the joint `fixed`",
    /// Joints that can move together without moving any mass.
    MassMatrixSingular => "give a body between these joints mass or inertia, or make one of the joints `fixed`",
    // Quantities
    /// An expression has another unit than its place needs.
    UnitMismatch => "check the expression for a missing or superfluous factor",
    /// Terms of different units are added.
    UnitsDiffer => "add only terms of the same unit",
    /// A division by zero.
    DivisionByZero => "divide by something other than zero",
    /// The square root of a negative number.
    RootOfNegative => "take the root of a number that is not negative",
    // Terms of the energies
    /// A name in a term that is neither a field nor a joint.
    NameUnknown => "name a field of the struct, or a joint, whose coordinate it is then",
    /// A name in a term that is both a field and a joint.
    NameAmbiguous => "give the field or the joint another name",
    /// A body in a term that does not exist.
    FrameUnknown => "name a body, a frame that a fixed joint carries, or `world`",
    /// A joint in a term that has no such coordinate, or more than one.
    CoordinateUnfit => "name one coordinate of a joint, as in `theta` or `base.x`",
    /// A speed in a potential, or within a rate.
    SpeedMisplaced => "write what depends on speeds as `#[dissipation(…)]` or `#[kinetic(…)]`",
    /// A kinetic term that is no quadratic form of the speeds.
    NotQuadratic => "add up products of two speeds, each times anything of coordinates and fields, as in \
         `m / 2 * (dot(r)^2 + r^2 * dot(theta)^2)`; what depends on the position alone is a `#[potential(…)]`, negated",
    /// A term, or a part of one, on which nothing that moves has an influence.
    TermIdle => "let it depend on what moves, or leave it out",
    /// A dissipation whose derivative by the speeds is not zero at rest, or none.
    ForceAtRest => "let it be least at rest, as a square is, and smooth a magnitude: `sqrt(dot(r)^2 + 1e-4)`; a force that \
         does not depend on speeds is one of a potential",
    /// Kinetic terms by which some motion would have no energy, or less.
    KineticNegative => "check the signs of the kinetic terms, and whether their sum is positive for all speeds",
    /// A method that is a recursion over a table of links, in a robot with terms.
    TermsUnsupported => "leave out what is too long: name the others in `#[dynamics(outputs(…))]`",
    // Options
    /// A method that does not exist.
    OutputUnknown => "name methods of the `Dynamics` traits",
    /// A lint that does not exist.
    AllowUnknown => "the one thing to allow is `nonphysical_inertia`",
    // Files
    /// The file cannot be read.
    FileUnreadable => "give the path of a file from the root of the crate, the folder of its Cargo.toml",
    /// The path leads out of the crate.
    PathOutside => "copy the file into the crate, and give its path from the crate's root, as in `urdf = \"robots/arm.urdf\"`",
    /// The file is larger or deeper than any robot needs.
    FileTooLarge => "take out what is no link and no joint, or split the robot",
    /// The file is no XML.
    XmlInvalid => "correct the file; `xmllint --noout FILE` lists what is wrong",
    /// The file is XML, and no URDF.
    RobotMissing => "give the path of a URDF, whose root is `<robot name=\"…\">`",
    /// Macros of xacro that were not expanded.
    XacroLeft => "expand the macros first: `xacro FILE.xacro > FILE.urdf`",
    /// An element or an attribute is not there.
    ElementMissing => "add it",
    /// A text where a number should be.
    NumberInvalid => "write a decimal number",
    /// A joint's child is no link.
    ChildUnknown => "name a `<link>` of the file",
    /// Several links that no joint carries.
    RootsSeveral => "connect them by joints, of type `fixed` if they do not move",
    /// A revolute or prismatic joint without limits.
    LimitsMissing => "add `<limit lower=\"…\" upper=\"…\" effort=\"…\" velocity=\"…\"/>`",
    /// A passive force of a file that is not known.
    PassiveUnsupported => "take the attribute out of the file, or leave all passive forces of the file out by \
         `#[dynamics(passive = off)]`; what the robot has of them can stand on the struct, as in \
         `#[joint(name, stiffness = 3)]`",
    // The compiler
    /// The generated code does not compute what the plain recursion computes.
    SelfCheckFailed => "this is a mistake of the compiler, not yours: please report it with the robot's specification",
}

impl fmt::Display for Code {
    /// The stable name, as in `dynamics::MassNegative`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "dynamics::{}", self.name())
    }
}
