//! The derive macro of `dynamics-core`, which re-exports it. All thought is in `dynamics-codegen`.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use proc_macro::TokenStream;

/// Equations of motion from a robot that is written on a struct.
///
/// ```
/// use dynamics_core::prelude::*;
///
/// /// A pendulum on a cart that slides along x.
/// #[derive(Dynamics)]
/// #[joint(slider: prismatic(x), world -> cart)]
/// #[body(cart, solid = point(m_cart))]
/// #[joint(hinge: revolute(y), cart -> pole, limits = [-90deg, 90deg])]
/// #[body(pole, mass = m, com = [0, 0, l / 2], inertia = diag(m * l*l / 12, m * l*l / 12, 0))]
/// #[joint(tip_joint: fixed, pole -> tip, at = [0, 0, l])]
/// struct CartPole<T> {
///     m_cart: T,
///     m: T,
///     l: T,
/// }
///
/// let robot = CartPole { m_cart: 1.0, m: 0.1, l: 1.0 };
/// let q = SVector::from([0.0, 0.3]);
/// assert_eq!(robot.mass_matrix(&q)[(0, 0)], 1.1);
/// assert!((robot.pose::<Tip>(&q).translation[2] - f64::cos(0.3)).abs() < 1e-15);
/// assert_eq!(CartPole::<f64>::JOINT_NAMES, ["slider", "hinge"]);
/// ```
///
/// The attributes stand **after** the derive: before it, rustc rejects them (`legacy_derive_helpers`). Their order
/// among each other is free, but for two things: coordinates are numbered in the order of the moving joints, each
/// joint behind the one that carries it, and bodies are listed in the order of their lines. A joint may stand before
/// the one that it follows.
///
/// # The struct
///
/// | | the equations are implemented for |
/// |---|---|
/// | `struct Robot<T> { … }` | every `T: Scalar`; other bounds of `T` are kept |
/// | fields of type `f64`, or of type `f32` | that type |
/// | `struct Robot;` | every scalar; the type of `q` decides |
///
/// A number in an attribute is folded into the code; the name of a field there makes it a parameter, given at run
/// time. All fields that are named must have the same type; others may have any.
///
/// # Values
///
/// Wherever a number may stand:
///
/// ```text
/// value   = term (("+" | "-") term)*
/// term    = factor (("*" | "/") factor)*
/// factor  = "-" factor | atom ["^" whole number]
/// atom    = "(" value ")" | ("sin" | "cos" | "sqrt") "(" value ")" | field | pi | number
/// pi      = "pi" | "PI" | "π"
/// number  = a decimal literal of Rust, directly followed by a unit or by nothing
/// unit    = m cm mm um km  kg g t  s ms  rad deg  N Nm  Nms N_per_m Ns_per_m kg_m2 J W
/// vector  = "[" value "," value "," value "]"
/// axis    = "x" | "y" | "z" | "-x" | "-y" | "-z" | vector of numbers, of any length but zero
/// ```
///
/// Everything is in SI units and radians. Values are exact while the compiler works with them (`0.1` is a tenth,
/// `90deg` is π/2) and are rounded once, in the generated code.
///
/// **Values have units.** A literal with a suffix has its unit; one without takes that of its place if it is a whole
/// value or a summand, and none if it is a factor or divisor. The unit of a field is inferred from its uses. What does
/// not fit is an error: `inertia = diag(m * r, …)` needs a second `r`. An angle of more than a full turn (a limit of
/// more than three) must say `deg` or `rad`.
///
/// `pi`, `PI` and `π` are the number: no field and no joint that a formula could mean has such a name. Names of functions
/// are free, for a function is followed by a parenthesis.
///
/// # `#[joint(name: kind(axis), parent -> child, …)]`
///
/// The joint carries `child`, which moves on `parent`: the `world` or a body that another joint carries. Every body is
/// carried by one joint.
///
/// | kind | coordinates q | speeds v, where they are not q̇ |
/// |---|---|---|
/// | `revolute(axis)` | the angle about the axis, rad | |
/// | `continuous(axis)` | the same, without limits | |
/// | `prismatic(axis)` | the distance along the axis, m | |
/// | `helical(axis, pitch)` | the angle; it slides by `pitch`, in m/rad, for each radian: `helical(z, 5mm / (2*pi))` | |
/// | `cylindrical(axis)` | the angle, the distance | |
/// | `universal(axis, axis)` | the angle about the first axis, that about the second, which the first turn carries | |
/// | `planar(normal)` | the distances along two axes across the normal, the angle about it | |
/// | `translation` | the distances along x, y and z | |
/// | `ball` | a unit quaternion i, j, k, w: the child's axes in the joint's frame | the angular velocity in the child's axes, 3 |
/// | `free` | the position in the joint's frame, then a quaternion as that of a ball | the child's twist in its own axes, linear first, 6 |
/// | `fixed` | none: `child` is welded to `parent`, and needs no `#[body]` if it is a mere frame | |
///
/// The two axes across a normal go on in the cycle x, y, z: for z they are x and y, for x y and z, for y z and x; for a
/// negative one they change places. For an oblique normal n the first is `e × n`, of unit length, and the second
/// `n × (e × n)`; e is the axis to which n is the least inclined, and is itself the first one if n is across it.
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// A drone with a load that swings below it.
/// #[derive(Dynamics)]
/// #[joint(base: free, world -> hull)]
/// #[body(hull, solid = cuboid(1.2kg, [0.3, 0.3, 0.1]))]
/// #[joint(swing: universal(x, y), hull -> load, at = [0, 0, -5cm])]
/// #[body(load, com = [0, 0, -0.2], solid = cylinder(200g, 10mm, 0.4))]
/// struct Drone;
///
/// assert_eq!((Drone::NQ, Drone::NV, Drone::NU), (9, 8, 2));
/// // Five metres up, upright, the load at rest: the hull carries the weight of both.
/// let q = SVector::from([0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
/// assert!(f64::abs(Drone.gravity_forces(&q)[2] - 1.4 * 9.81) < 1e-13);
/// ```
///
/// Where it is, at zero. Without any of these keys it is at the parent's frame:
///
/// | key | the child's frame in the parent's | default |
/// |---|---|---|
/// | `at = [x, y, z]` | its origin | zero |
/// | `rpy = [roll, pitch, yaw]` | its axes: `Rz(yaw)·Ry(pitch)·Rx(roll)`, as in a URDF | parallel |
/// | `dh(a, alpha, d, theta)` | `Rz(θ)·Tz(d)·Tx(a)·Rx(α)`, standard Denavit–Hartenberg | |
/// | `mdh(a, alpha, d, theta)` | `Rx(α)·Tx(a)·Rz(θ)·Tz(d)`, modified (Khalil, Craig) | |
/// | `screw(axis, through = [x, y, z])` | a line in the parent's frame at zero; `at` and `rpy` may place the frame | |
///
/// The axes of a joint are in the child's frame, and are constant. `dh`, `mdh` and `screw` define one themselves: then the
/// kind has none, as in `revolute`, or `helical(pitch)`. `dh` and `mdh` are for `revolute`, `continuous`, `prismatic` and
/// `fixed`; the coordinate is added to `theta` (`d`, if prismatic), and with `dh` the child's frame is the distal one,
/// behind `a` and `alpha`. `screw` is for the kinds of one axis.
///
/// The keys that follow are for joints of one degree of freedom: revolute, continuous, prismatic, helical. What others
/// need of them they have where they are composed of such joints, with bodies without mass between them.
///
/// What it is allowed, for `Mechanism::LIMITS`; numbers only, infinite without the key:
///
/// | key | |
/// |---|---|
/// | `limits = [lower, upper]` | rad or m; not for `continuous` |
/// | `velocity = v` | rad/s or m/s |
/// | `effort = f` | N·m or N |
///
/// What moves it. Without these keys it has a coordinate of its own, and an input:
///
/// | key | | default |
/// |---|---|---|
/// | `actuated = on`, `off` | whether its speeds have inputs, `Mechanism::NU`; for joints of several degrees of freedom too | `on`; `off` of `free` joints |
/// | `mimic = leader` | follows another joint of one degree of freedom: it has no coordinate, speed, input or limits | |
/// | `ratio = r` | of a follower's coordinate to the leader's: a number, or m/rad, or rad/m | 1 |
/// | `offset = c` | the follower's coordinate where the leader's is zero, rad or m | 0 |
/// | `locked = value` | is welded at this coordinate, rad or m, and its followers with it; what else its line says of motion and forces waits until it is unlocked | |
///
/// A follower moves at exactly `ratio · q + offset`: all that it carries is in the equations of its leader. It may follow
/// another follower, in no circle.
///
/// What acts in it by itself, at the coordinate p and the speed s of the joint; on the left-hand side of the equations,
/// as part of `bias_forces` and `inverse_dynamics`. The energy of its spring is `elastic_energy`, and no part of `V`; a spring
/// that is to be in `V` is a `#[potential(k / 2 * (theta - rest)^2)]`:
///
/// | key | force | unit | default |
/// |---|---|---|---|
/// | `damping = d` | `d·s` | N·m·s/rad, N·s/m | 0 |
/// | `friction = f` | `f·s / √(s² + friction_speed²)` | N·m, N | 0 |
/// | `friction_speed = s` | where friction has 71 % of its size | rad/s, m/s | 0.01 |
/// | `stiffness = k` | `k·(p − rest)` | N·m/rad, N/m | 0 |
/// | `rest = p` | where the spring is slack | rad, m | 0 |
/// | `armature = a` | `a·ṡ`, of what turns with the joint and is no body | kg·m², kg | 0 |
/// | `rotor = i` | with `gear` instead of `armature`: the inertia of a motor about its shaft, `a = i·gear²` | kg·m² | |
/// | `gear = n` | turns of the motor for one of the joint; radians for a metre, if prismatic; with `rotor` | 1, rad/m | |
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// A motor with a gear and a spring, and a rack that it drives by a pinion of radius `r`.
/// #[derive(Dynamics)]
/// #[joint(motor: revolute(y), world -> pinion, rotor = 2e-5, gear = 50, damping = 0.1, stiffness = k, rest = 90deg)]
/// #[body(pinion)]
/// #[joint(teeth: prismatic(x), world -> rack, mimic = motor, ratio = r)]
/// #[body(rack, solid = point(2kg))]
/// struct RackAndPinion<T> {
///     k: T,
///     r: T,
/// }
///
/// let (robot, q, v) = (RackAndPinion { k: 3.0, r: 0.1 }, SVector::from([0.0]), SVector::from([2.0]));
/// assert!(f64::abs(robot.mass_matrix(&q)[(0, 0)] - (2e-5 * 50.0 * 50.0 + 2.0 * 0.1 * 0.1)) < 1e-15);
/// let passive = 0.1 * 2.0 - 3.0 * core::f64::consts::FRAC_PI_2;
/// assert!(f64::abs(robot.bias_forces(&q, &v)[0] - passive) < 1e-14);
/// assert_eq!(RackAndPinion::<f64>::JOINT_NAMES, ["motor"]);
/// ```
///
/// # `#[body(name, …)]`
///
/// In the frame of the joint that carries it. Without any key the body has no mass, which is fine between joints.
///
/// | key | | default |
/// |---|---|---|
/// | `mass = m` | kg, with `inertia`; zero is a body without mass | none |
/// | `com = [x, y, z]` | the centre of mass, m | the origin |
/// | `inertia = …` | about the **centre of mass**, kg·m²: `diag(ixx, iyy, izz)`, `tensor(ixx, ixy, ixz, iyy, iyz, izz)` or `[[…], […], […]]` | |
/// | `inertia_rpy = [r, p, y]` | turns the axes of `inertia` or `solid` | the body's |
/// | `solid = …` | instead of mass and inertia, a homogeneous solid with its centre at `com` | |
/// | `allow(nonphysical_inertia)` | takes an inertia that no distribution of mass has | an error |
///
/// Products of inertia are entries of the tensor, `ixy = −∫xy dm`. The solids:
///
/// | | |
/// |---|---|
/// | `cuboid(m, [x, y, z])` | the lengths of its edges |
/// | `cylinder(m, radius, length, axis)` | `axis` is `x`, `y` or `z`, the default |
/// | `sphere(m, radius)` | |
/// | `rod(m, length, axis)` | without thickness; `axis` as above |
/// | `point(m)` | |
///
/// # `#[potential(…)]`, `#[dissipation(…)]`, `#[kinetic(…)]`
///
/// Terms of a Lagrangian of one's own, beside the bodies' energies, as many lines of each as there are terms:
///
/// | | adds to | unit | in the equations |
/// |---|---|---|---|
/// | `potential(…)` | `V`, of coordinates alone | J | `∂V/∂q` is in `G` |
/// | `dissipation(…)` | Rayleigh's `D`, of speeds, and coordinates | W | `∂D/∂v` is in the passive forces |
/// | `kinetic(…)` | `T`, quadratic in speeds, coefficients of coordinates | J | `M`, and Levi-Civita's `C` of all of `T` |
///
/// Values as above, and besides in the place of an atom:
///
/// | | |
/// |---|---|
/// | `theta` | the coordinate of a joint of one degree of freedom, rad or m; of one that follows another or is locked too |
/// | `base.x` | one of several: by the parts in `Mechanism::COORDINATE_NAMES`, but for quaternions |
/// | `z(body)`, `x(body)`, `y(body)` | where the origin of a body's frame is in the world, m |
/// | `distance(a, b)` | between the origins of two bodies' frames, or of one and `world`, m |
/// | `dot(…)` | how fast any of these, or an expression of them, changes: `dot(r)`, `dot(r * sin(theta))` |
/// | `base.wx` | a speed of a ball or a free joint, by the parts in `Mechanism::SPEED_NAMES` |
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// A trolley on a rail, and a load below it that a spring holds: a bungee from the hook to the load.
/// #[derive(Dynamics)]
/// #[joint(x: prismatic(x), world -> trolley)]
/// #[body(trolley, solid = point(10kg))]
/// #[joint(hook_joint: fixed, trolley -> hook, at = [0, 0, -0.2])]
/// #[joint(bob: translation, world -> load)]
/// #[body(load, solid = point(m))]
/// #[potential(k / 2 * (distance(hook, load) - 1m)^2)]
/// #[dissipation(0.4Ns_per_m / 2 * dot(distance(hook, load))^2)]
/// struct Bungee<T> {
///     m: T,
///     k: T,
/// }
///
/// let (robot, below) = (Bungee { m: 2.0, k: 50.0 }, 0.2 + 1.0 + 2.0 * 9.81 / 50.0);
/// let at_rest = robot.gravity_forces(&SVector::from([0.0, 0.0, 0.0, -below]));
/// assert!(at_rest.norm() < 1e-12);
/// ```
///
/// Bodies of any kind may be named, also frames that a fixed joint carries. A distance has no derivative where its two
/// points are one; its even powers have: a spring of no length is `k / 2 * distance(a, b)^2`. Numbers that are no plain
/// ones have a unit, as `0.4Ns_per_m` has: a factor without one is a plain number.
///
/// Fields must be such that `M` is positive definite, and that dissipation takes energy. Terms have no mass: centres of
/// mass, momenta and frames know nothing of them. In `τ = Y·π` each has a column, `potential.1` and so on in the order of
/// the lines, whose parameter is 1; with it the regressor explains all forces, without it only those of bodies and joints.
/// (It may be a combination of others, also among base parameters: a kinetic term can be as the mass of a body is.)
/// Robots that are so long that a method is a recursion over a table of links take no terms in it.
///
/// # `#[coordinate(name: angle)]`, `#[coordinate(name: length)]`
///
/// A coordinate without a body, for systems that are no tree: what moves is said by terms. It has the keys of a joint of
/// one degree of freedom, but no place. `armature` is an inertia that is constant.
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// A bob on a spring that swings: the elastic pendulum, by its Lagrangian.
/// #[derive(Dynamics)]
/// #[coordinate(theta: angle)]
/// #[coordinate(r: length, damping = 0.1)]
/// #[kinetic(m / 2 * (dot(r)^2 + r^2 * dot(theta)^2))]
/// #[potential(k / 2 * (r - l)^2 - m * g * r * cos(theta))]
/// struct ElasticPendulum<T> {
///     m: T,
///     k: T,
///     l: T,
///     g: T,
/// }
///
/// let robot = ElasticPendulum { m: 1.0, k: 40.0, l: 0.5, g: 9.81 };
/// let (q, v) = (SVector::from([0.3, 0.7]), SVector::from([2.0, -0.5]));
/// let coriolis = robot.coriolis_matrix(&q, &v) * v;
/// assert!((coriolis - SVector::from([2.0 * 0.7 * -0.5 * 2.0, -0.7 * 4.0])).norm() < 1e-14); // 2 m r r' θ', −m r θ'²
/// ```
///
/// # `#[dynamics(…)]`
///
/// | key | | default |
/// |---|---|---|
/// | `gravity = [x, y, z]` | the acceleration of free fall in the world, m/s²; of fields, if it is another in each call, as on a vehicle | `[0, 0, -9.81]` |
/// | `outputs(mass_matrix, …)` | the methods to emit, by their names; one of a frame stands for all that frames have, one of a regressor for its parameters as well | all |
/// | `allow(nonphysical_inertia)` | for all bodies | |
/// | `urdf = "path"` | the file that has the robot, by its path from the crate's root | |
/// | `base = fixed`, `free` | how the root of the file is in the world: welded, or by a joint `root_joint` of kind `free`, the first one | `fixed` |
/// | `passive = on`, `off` | whether the damping and friction of the file act | `on` |
/// | `snap = on`, `off` | whether entries of rotations within 1e-11 of 0 and ±1 become these | `on` |
/// | `crate = "path"` | where the crate `dynamics-core` is found | `"::dynamics_core"` |
///
/// # A robot from a URDF
///
/// ```ignore
/// #[derive(Dynamics)]
/// #[dynamics(urdf = "robots/iiwa14.urdf")]
/// pub struct Iiwa14;
/// ```
///
/// Links are bodies, each with its frame. The link that no joint carries is welded to the world, or with `base = free` it
/// moves freely; it is the world if its name is `world`. Coordinates follow the order of joints in the file; a joint
/// written before the one that carries it comes after that. Of `floating` joints the kind is `free`; the axis of a `planar`
/// one is its normal. `<mimic>` is `mimic`, `ratio` and `offset`, `<dynamics>` is `damping` and `friction`, `<limit>` is
/// kept as constants; the limits of joints that follow others, `<transmission>`, `<safety_controller>`, `<visual>`,
/// `<collision>` and what else the equations have no use for are left out, and `dynamics check` lists them. An edit of the
/// file rebuilds the crate.
///
/// Lines on the struct say more than the file. Each key of a `#[body]` with the name of a link replaces what the file says
/// of it (`solid` all of its `<inertial>`, `inertia` the tensor and its `rpy`), each key of a `#[joint(name, …)]` without
/// kind and bodies what it says of the joint, and further joints and bodies are added. A line may be of several joints:
/// `#[joint([name, name], …)]`. (Clippy takes two lines with the same plain number for one too many; in a list it does not.)
/// So a payload is a field:
///
/// ```ignore
/// #[derive(Dynamics)]
/// #[dynamics(urdf = "robots/iiwa14.urdf")]
/// #[joint([iiwa_joint_1, iiwa_joint_2], rotor = 1e-4, gear = 160, friction = 0.3)]
/// #[joint(iiwa_joint_7, locked = 30deg)]
/// #[joint(grip: fixed, iiwa_link_ee -> payload)]
/// #[body(payload, solid = point(m))]
/// pub struct Iiwa14WithPayload<T> { pub m: T }
///
/// /// A robot that stands on nothing: q is its position, its quaternion, and the angles of its joints.
/// #[derive(Dynamics)]
/// #[dynamics(urdf = "robots/hyq.urdf", base = free)]
/// pub struct Hyq;
/// ```
///
/// # What is generated
///
/// For the robot, and again for its companion:
///
/// - `Mechanism`: sizes, names, limits, operation counts;
/// - `Dynamics` and `DynamicsDerivatives`: the equations, as straight-line code;
/// - `CentroidalDynamics`: the centre of mass and the momentum about it;
/// - `Regressor` and `BaseRegressor`: joint forces by the parameters of bodies and joints; not of robots so large that
///   their regressor would be longer than 20,000 statements;
/// - `Configuration` and `StateSpaceModel`: for simulation and linearisation;
/// - `Frame`, on a type for each body and each bare frame: `tool0` is `Tool0`, in the module `robot_frames` of a `Robot`
///   and re-exported beside it. A name that would hide a common type gets `Frame` behind it: `BoxFrame`.
///
/// `prepare()` does all work that depends on parameters alone and returns the companion, `RobotPrepared`. The methods of
/// the robot itself prepare in each call, so in a loop use the companion. A robot without parameters is its own.
/// `check()` says whether every field that the equations read is finite, and every mass positive.
///
/// The equations themselves, as a lecture writes them, are in the documentation of `mass_matrix` and the other methods
/// (an editor shows it on the method's name), and in constants: `equations()` has M, C, G, P, T, V and L in Unicode and LaTeX.
/// Fields and joints that are letters keep them: `theta1` is θ₁, `m_cart` is m with an index. Other coordinates are θ or d,
/// or what fields leave. A letter of the equations gives way to a field's: beside a field `M` the mass matrix is 𝐌.
/// A robot of more than four links has no such method, nor has one whose equations are too long to be read; `dynamics
/// explain`, of the command line, says how far it gets.
///
/// ```
/// # use dynamics_core::prelude::*;
/// #[derive(Dynamics)]
/// #[joint(theta: revolute(y), world -> bob)]
/// #[body(bob, com = [0, 0, -l], solid = point(m))]
/// struct Pendulum<T> {
///     m: T,
///     l: T,
/// }
///
/// const EQUATIONS: dynamics_core::Equations = Pendulum::<f64>::equations();
/// assert_eq!(EQUATIONS.mass_matrix.unicode, "[m l²]");
/// assert!(EQUATIONS.gravity_forces.latex.contains(r"m l \sin \theta"));
/// println!("{EQUATIONS}");
/// ```
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// A rod on a hinge, in single precision.
/// #[derive(Dynamics)]
/// #[dynamics(gravity = [0, -9.81, 0])]
/// #[joint(hinge: revolute(z), world -> rod, limits = [-45deg, 45deg], effort = 12)]
/// #[body(rod, com = [length / 2, 0, 0], solid = rod(250g, length, x))]
/// struct Lever {
///     length: f32,
/// }
///
/// let prepared = Lever { length: 0.8 }.prepare();
/// for k in 0..8 {
///     let q = SVector::from([0.1 * k as f32]);
///     let hold = prepared.gravity_forces(&q)[0];
///     assert!((hold - 0.25 * 9.81 * 0.4 * q[0].cos()).abs() < 1e-6);
/// }
/// assert_eq!(Lever::LIMITS[0].effort, 12.0);
/// ```
///
/// # Errors
///
/// Each mistake is one error at its own tokens, with what to do and its name, as `dynamics::MassNegative`. All
/// mistakes of a phase are reported at once; a later phase runs on sound input only.
///
/// Clippy's `duplicated_attributes` takes two attributes for one where these have nothing but names and plain numbers, as in
/// `#[body(a, mass = 1)]` and `#[body(b, mass = 1)]`. No derive can prevent that; a unit does, `mass = 1kg`, and so does
/// `#[allow(clippy::duplicated_attributes)]` on the struct.
///
/// | of | |
/// |---|---|
/// | syntax | `Syntax`, `NestingTooDeep`, `AttributeMisplaced`, `KeyUnknown`, `KeyDuplicate`, `KeysConflict`, `KeyMissing`, `CountWrong`, `NumberOutOfRange`, `UnitUnknown`, `FunctionUnknown`, `ExponentInvalid`, `FieldUnknown` |
/// | the struct | `StructNeeded`, `FieldTypeUnsupported`, `FieldTypesDiffer` |
/// | names | `NameDuplicate`, `NamesCollide`, `NameReserved` |
/// | the tree | `JointMissing`, `DegreesOfFreedomMissing`, `JointsTooMany`, `ParentUnknown`, `BodyMissing`, `WorldIsChild`, `ParentTwice`, `Cycle`, `BodyUnreachable`, `ParentAfterChild` |
/// | joints | `JointKindUnknown`, `JointUnknown`, `KeyNotOfKind`, `AxisMissing`, `AxisUnneeded`, `AxisZero`, `AxesParallel`, `AxisNotConstant`, `RatioZero`, `MimicUnknown`, `MimicUnfit`, `MimicCycle`, `PassiveNegative`, `LimitsUnneeded`, `LimitsInverted`, `LimitNegative`, `ConstantNeeded`, `AngleLooksLikeDegrees` |
/// | bodies | `InertiaMissing`, `MassMissing`, `MassNegative`, `SizeNegative`, `InertiaNotSymmetric`, `InertiaOrder`, `InertiaNonphysical`, `MovesNoMass`, `MovesNoInertia`, `MassMatrixSingular` |
/// | quantities | `UnitMismatch`, `UnitsDiffer`, `DivisionByZero`, `RootOfNegative` |
/// | terms | `NameUnknown`, `NameAmbiguous`, `FrameUnknown`, `CoordinateUnfit`, `SpeedMisplaced`, `NotQuadratic`, `KineticNegative`, `ForceAtRest`, `TermIdle`, `TermsUnsupported` |
/// | options | `OutputUnknown`, `AllowUnknown` |
/// | files | `FileUnreadable`, `PathOutside`, `FileTooLarge`, `XmlInvalid`, `RobotMissing`, `XacroLeft`, `ElementMissing`, `NumberInvalid`, `ChildUnknown`, `RootsSeveral`, `LimitsMissing`, `PassiveUnsupported`; with the file's line and column |
/// | the compiler | `SelfCheckFailed`: the finished code is compared with a plain recursion, and differs |
///
/// ```compile_fail
/// # use dynamics_core::prelude::*;
/// #[derive(Dynamics)]
/// #[joint(hinge: revolute(z), world -> rod)]
/// #[body(rod, mass = m, com = [r, 0, 0], inertia = diag(0, 0, m * r))] // UnitMismatch: kg·m where kg·m² is needed
/// struct Lever<T> {
///     m: T,
///     r: T,
/// }
/// ```
#[proc_macro_derive(Dynamics, attributes(dynamics, joint, body, coordinate, potential, dissipation, kinetic))]
pub fn derive_dynamics(input: TokenStream) -> TokenStream {
    dynamics_codegen::derive(input.into(), read).into()
}

/// Reads a file of the crate that is being compiled: as much of it as is allowed, and one byte.
fn read(path: &str) -> Result<Vec<u8>, String> {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").ok_or("`CARGO_MANIFEST_DIR` is not set")?;
    let path = Path::new(&root).join(path);
    let limit = dynamics_codegen::spec::urdf::SIZE_LIMIT as u64 + 1;
    let mut bytes = vec![];
    let result = File::open(&path).and_then(|file| file.take(limit).read_to_end(&mut bytes));
    match result {
        Ok(_) => Ok(bytes),
        Err(error) => Err(format!("{}: {error}", path.display())),
    }
}
