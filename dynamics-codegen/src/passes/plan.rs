//! In which form a method is written: straight line, or loops once that would be too long to compile.
//!
//! rustc takes a second for some 5,000 statements with optimisation, and more than in proportion beyond 20,000.
//! How long a straight line would be is known before anything is traced, from the joints between each joint and
//! the base.

use super::{Cost, Program};
use crate::mechanics::branches;
use crate::mechanics::columns::columns;
use crate::mechanics::coupling::elimination_parents;
use crate::mechanics::equations::{Block, Method, Trait};
use crate::model::{Drive, Link, Model, Motion, Passive};
use crate::spatial::Scalar as _;
use crate::symbolic::Expr;

/// The most statements that one method may have.
const LONGEST_STRAIGHT_LINE: usize = 20_000;
/// The most statements that the kinematics of all frames may have together.
const LONGEST_KINEMATICS: usize = 50_000;
/// The most statements of a straight line for `M⁻¹`: beyond it loops over rows are as fast.
const LONGEST_STRAIGHT_INVERSE: usize = 6_000;
/// The largest robot whose many right-hand sides are solved in a straight line.
const LARGEST_STRAIGHT_SOLVE: usize = 7;
/// The same of one whose branches are computed side by side, those that are alike counted once.
const LARGEST_STRAIGHT_SOLVE_SIDE_BY_SIDE: usize = 10;

/// Lanes over links take their time by the speeds, a straight line by the entries of a matrix: pairs of speeds of which one is
/// on the other's way to the base, those of branches that are alike once. With so many entries for every two speeds a
/// Coriolis matrix and derivatives are sooner done in lanes: a chain of twelve, or of ten on a free base.
const ENTRIES_FOR_LANES: usize = 13;
/// The same of a mass matrix, whose entries are a third of the work: a chain of twenty.
const MASSES_FOR_LANES: usize = 21;
/// What moves a free base is along and about its own axes: a straight line has its entries for so many of six speeds.
const SPEEDS_OF_FREE_BASE: usize = 4;

/// How a method is computed.
pub enum Plan<'g> {
    /// By a program of its own.
    StraightLine {
        /// What it returns, simplified; of what is solved for side by side, what it is solved from.
        blocks: Vec<Block<'g>>,
        /// The operations.
        program: Program,
    },
    /// By the run time's loops over rows and columns: derivatives of forward dynamics from those of inverse dynamics,
    /// and `M⁻¹` from `M`; a bundle by its parts.
    Loops {
        /// By which M is factored: the speed before each on its way to the base.
        parents: Vec<Option<usize>>,
    },
    /// By the run time's recursion over a table of links.
    Table {
        /// For the kinematics of a frame: its link, and the program of its pose in that link.
        frame: Option<(Option<usize>, Program)>,
        /// If in lanes over links: the speed before each on its way to the base, by which M is factored.
        lanes: Option<Vec<Option<usize>>>,
    },
}

/// The forms of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    StraightLine,
    Loops,
    Table,
    Lanes,
}

/// What the code may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunTime {
    /// The crate `dynamics-core`, with its loops, lanes and tables.
    Core,
    /// Nothing but loops over the rows of a matrix, which are written beside the code.
    None,
}

/// How each method of a robot is computed.
pub(super) struct Plans {
    /// The speed before each on its way to the base.
    pub(super) parents: Vec<Option<usize>>,
    /// All of them.
    ancestors: Vec<Vec<usize>>,
    frames: usize,
    /// For each frame the joints below it, in sum.
    frame_joints: usize,
    suits_lanes: bool,
    /// How many speeds there are if branches that are alike count as one; all of them where none are computed side by side.
    unlike: usize,
    /// So many entries of a matrix a straight line computes.
    entries: usize,
    /// Whether the mass matrix is more than the tree's, so that it must be factored.
    must_factor: bool,
}

impl Plans {
    pub(super) fn of(model: &Model<'_>, run_time: RunTime) -> Self {
        let links = &model.tree.links;
        let columns = columns(links.iter().map(|link| (link.parent, link.motion, link.drive)));
        let parents = elimination_parents(&columns, model.tree.dof(), &model.tree.coupled_by_terms());
        let ancestors: Vec<Vec<usize>> =
            parents.iter().map(|&parent| std::iter::successors(parent, |&k| parents[k]).collect()).collect();
        let depth = |link: usize| std::iter::successors(Some(link), |&k| links[k].parent).count();
        let below = |link: Option<usize>| link.map_or(0, depth);
        let frame_joints = model.tree.frames.iter().map(|frame| below(frame.link)).sum();
        let is_plain = model.tree.terms.is_empty();
        let suits_lanes = run_time == RunTime::Core && is_plain && suits_lanes(links);
        let must_factor = !model.tree.terms.kinetic.is_empty();
        let is_side_by_side = run_time == RunTime::Core && is_plain;
        let sets = branches::of(&model.tree).filter(|_| is_side_by_side).map_or(vec![], |(_, sets)| sets);
        let repeated: Vec<usize> = sets.iter().flat_map(|set| set[1..].concat()).collect();
        let of_link = |k: usize| match links[k].motion {
            Motion::Free => SPEEDS_OF_FREE_BASE,
            motion => motion.speeds(),
        };
        let entries_of = |link: usize| {
            let way = std::iter::successors(links[link].parent, |&k| links[k].parent);
            let own = of_link(link);
            own * way.map(of_link).sum::<usize>() + own * (own + 1) / 2
        };
        let unlike = (0..links.len()).filter(|k| !repeated.contains(k));
        Self {
            unlike: parents.len() - repeated.len(),
            entries: unlike.map(entries_of).sum(),
            frames: model.tree.frames.len(),
            frame_joints,
            parents,
            ancestors,
            suits_lanes,
            must_factor,
        }
    }

    pub(super) fn form(&self, method: Method) -> Form {
        let too_long = match method {
            _ if method.frame().is_some() => self.statements(method) * self.frames > LONGEST_KINEMATICS,
            _ => self.statements(method) > LONGEST_STRAIGHT_LINE,
        };
        match method {
            _ if self.is_sooner_in_lanes(method) => Form::Lanes,
            Method::InverseDynamicsWithDerivatives => match self.form(Method::InverseDynamicsDerivatives) {
                Form::StraightLine => Form::StraightLine,
                _ => Form::Loops,
            },
            _ if too_long => Form::Table,
            Method::ForwardDynamicsDerivatives | Method::ForwardDynamicsWithDerivatives
                if self.ancestors.len() > LARGEST_STRAIGHT_SOLVE && !self.is_solved_side_by_side() =>
            {
                Form::Loops
            }
            Method::InverseMassMatrix if self.statements_of_inverse() > LONGEST_STRAIGHT_INVERSE => {
                Form::Loops
            }
            _ => Form::StraightLine,
        }
    }

    /// Why there is no such method, if there is none.
    fn lack(&self, method: Method, model: &Model<'_>) -> Option<Lack> {
        match method.trait_() {
            Trait::Regressor | Trait::BaseRegressor => {
                (self.form(Method::Regressor) == Form::Table).then_some(Lack::TooLong)
            }
            Trait::CentroidalDynamics => {
                let has_mass = model.tree.links.iter().any(|link| !link.inertia.mass.is_zero());
                (!has_mass).then_some(Lack::Massless)
            }
            Trait::Dynamics | Trait::DynamicsDerivatives if !model.tree.terms.is_empty() => {
                match self.form(method) {
                    Form::Table => Some(Lack::LoopsWithoutTerms),
                    Form::Loops => calls(method).iter().find_map(|&called| self.lack(called, model)),
                    Form::StraightLine | Form::Lanes => None,
                }
            }
            _ => None,
        }
    }

    /// Whether branches that are alike make a straight line short enough for many right-hand sides: they must be half as
    /// many joints again.
    fn is_solved_side_by_side(&self) -> bool {
        let repeated = self.ancestors.len() - self.unlike;
        self.unlike <= LARGEST_STRAIGHT_SOLVE_SIDE_BY_SIDE && 2 * repeated >= self.unlike
    }

    /// Whether the method solves for many right-hand sides by loops.
    pub(super) fn is_solved(&self, method: Method) -> bool {
        method != Method::InverseDynamicsWithDerivatives && self.form(method) == Form::Loops
    }

    /// Whether a method is sooner done in lanes over links, and can be.
    fn is_sooner_in_lanes(&self, method: Method) -> bool {
        let entries_of_two = match method {
            Method::MassMatrix => MASSES_FOR_LANES,
            Method::CoriolisMatrix
            | Method::EquationsOfMotion
            | Method::InverseDynamicsDerivatives
            | Method::InverseDynamicsWithDerivatives => ENTRIES_FOR_LANES,
            // From M, of which a half will do. Of a chain of 20 joints it takes 0.6 of the time of a straight line, where states in
            // lanes take 1.4 times as long; of 16 joints 0.8 to 1.0, and states in lanes 1.3 times as long.
            Method::InverseMassMatrix => return self.is_sooner_in_lanes(Method::MassMatrix),
            // They begin as those do.
            Method::ForwardDynamicsDerivatives | Method::ForwardDynamicsWithDerivatives => {
                return self.is_sooner_in_lanes(Method::InverseDynamicsDerivatives);
            }
            _ => return false,
        };
        let is_sooner = 2 * self.entries >= entries_of_two * self.ancestors.len();
        self.suits_lanes && (is_sooner || self.statements(method) > LONGEST_STRAIGHT_LINE)
    }

    /// About how many statements a straight line would have, as measured on general chains and trees.
    fn statements(&self, method: Method) -> usize {
        let n = self.ancestors.len();
        let pairs = n + self.ancestors.iter().map(Vec::len).sum::<usize>();
        match method {
            Method::MassMatrix => 4 * pairs,
            Method::CoriolisMatrix | Method::EquationsOfMotion => 16 * pairs,
            Method::InverseDynamicsDerivatives | Method::InverseDynamicsWithDerivatives => 36 * pairs,
            Method::GravityForces | Method::PotentialEnergy => 10 * n,
            Method::PassiveForces | Method::ElasticEnergy => 6 * n,
            Method::TotalMass | Method::InertialParameters | Method::BaseParameters => 10 * n,
            Method::CenterOfMass | Method::CentroidalMomentum => 30 * n,
            Method::CenterOfMassJacobian | Method::CentroidalMomentumMatrix => 50 * n,
            Method::Regressor | Method::BaseRegressor => 50 * pairs,
            Method::BiasForces | Method::InverseDynamics => 40 * n,
            Method::KineticEnergy | Method::Lagrangian => 20 * n,
            Method::ForwardDynamics if self.must_factor => {
                80 * n
                    + self.ancestors.iter().map(|ancestors| ancestors.len() * ancestors.len()).sum::<usize>()
            }
            Method::ForwardDynamics => 80 * n,
            // By loops: the two methods it calls have their own forms.
            Method::ForwardDynamicsDerivatives
            | Method::ForwardDynamicsWithDerivatives
            | Method::InverseMassMatrix => 0,
            Method::Pose(_) => 12 * self.frame_joints / self.frames.max(1),
            Method::Jacobian(_) | Method::WorldJacobian(_) => 16 * self.frame_joints / self.frames.max(1),
            Method::Velocity(_) => 20 * self.frame_joints / self.frames.max(1),
            Method::Acceleration(_) => 30 * self.frame_joints / self.frames.max(1),
        }
    }

    /// About how many statements factoring M and solving for half of each unit column takes.
    fn statements_of_inverse(&self) -> usize {
        let mut before = 0;
        let column = |ancestors: &Vec<usize>| {
            before += ancestors.len();
            ancestors.len() * ancestors.len() + before
        };
        self.ancestors.iter().map(column).sum()
    }

    /// What the loops of the run time cost, without the methods that they call: of factors, of each half of M⁻¹ once, and of
    /// two products with a factor for each column that is solved for.
    pub(super) fn cost_of_loops(&self, method: Method) -> Cost {
        let count = |value: usize| u32::try_from(value).unwrap_or(u32::MAX);
        let products =
            |value| Cost { multiplications: count(value), additions: count(value), ..Cost::default() };
        let (n, depths) = (self.ancestors.len(), self.ancestors.iter().map(Vec::len));
        let factors = products(depths.clone().map(|depth| depth * depth).sum());
        let factors = Cost { divisions: count(n), ..factors };
        let inverse = depths.clone().enumerate().map(|(k, depth)| (n - k) * (depth + 1)).sum();
        let solved = 2 * n * (2 * depths.sum::<usize>() + n);
        match method {
            Method::InverseDynamicsWithDerivatives => Cost::default(),
            Method::InverseMassMatrix => factors + products(inverse),
            _ => factors + products(inverse + solved),
        }
    }

    /// What the recursion costs, to the leading order: about three straight-line statements' worth each, since
    /// nothing is known to be zero. Derivatives of forward dynamics begin as those of the inverse do, and M⁻¹ as M.
    pub(super) fn cost_of_table(&self, method: Method) -> Cost {
        match method {
            Method::ForwardDynamicsDerivatives | Method::ForwardDynamicsWithDerivatives => {
                return self.cost_of_loops(method) + self.cost_of_table(Method::InverseDynamicsDerivatives);
            }
            Method::InverseMassMatrix => {
                return self.cost_of_loops(method) + self.cost_of_table(Method::MassMatrix);
            }
            _ => {}
        }
        let count = u32::try_from(3 * self.statements(method)).unwrap_or(u32::MAX);
        let joints = u32::try_from(self.ancestors.len()).unwrap_or(u32::MAX);
        Cost { multiplications: count, additions: count, sines_and_cosines: joints, ..Cost::default() }
    }
}

/// Whether the run time can compute the robot's matrices in lanes over links: those of a tree of joints with a coordinate
/// and a speed each, of which the first may move freely.
fn suits_lanes(links: &[Link<Expr<'_>>]) -> bool {
    let is_free = links.first().is_some_and(|link| link.motion == Motion::Free);
    let before = if is_free { [6, 5] } else { [0, 0] };
    let is_own = |(k, link): (usize, &Link<Expr<'_>>)| {
        let Drive { q, v, ratio, offset } = link.drive;
        match link.motion {
            Motion::Free => [k, q, v] == [0, 0, 0],
            Motion::Ball => false,
            _ => ratio.as_sign() == Some(1) && offset.is_zero() && [q, v] == before.map(|before| before + k),
        }
    };
    // In the order of a walk each link's parent is on the way from the link before it to the base.
    let follows = |k: usize| {
        let before = k.checked_sub(1);
        links[k].parent.is_none_or(|p| std::iter::successors(before, |&b| links[b].parent).any(|b| b == p))
    };
    links.iter().enumerate().all(is_own) && (0..links.len()).all(follows)
}

/// The methods to compile: those named and what they call, or all that the robot has.
pub fn methods(wanted: Option<&[&str]>, model: &Model<'_>, run_time: RunTime) -> Vec<Method> {
    let plans = Plans::of(model, run_time);
    let of_frames = (0..model.tree.frames.len()).flat_map(Method::of_frame);
    // A frame has all of its kinematics or none, and a regressor has its parameters.
    let together = |method: Method| match method.trait_() {
        Trait::Frame => Method::of_frame(0).map(Method::name).to_vec(),
        Trait::Regressor => vec!["regressor", "inertial_parameters"],
        Trait::BaseRegressor => vec!["base_regressor", "base_parameters"],
        _ => vec![method.name()],
    };
    let is_wanted = |method: Method| match wanted {
        Some(wanted) => together(method).iter().any(|name| wanted.contains(name)),
        None => has_of_itself(method, model),
    };
    let calls = |caller: Method| match plans.form(caller) {
        Form::Loops => calls(caller),
        _ => &[],
    };
    let called: Vec<Method> = (Method::OF_ROBOT.into_iter().filter(|&method| is_wanted(method)))
        .flat_map(|caller| calls(caller).iter().flat_map(move |&called| [&[called], calls(called)].concat()))
        .collect();
    let is_called = |method: Method| called.contains(&method);
    let is_there = |method: Method| matches!(plans.lack(method, model), None | Some(Lack::LoopsWithoutTerms));
    let all = Method::OF_ROBOT.into_iter().chain(of_frames);
    all.filter(|&method| (is_wanted(method) || is_called(method)) && is_there(method)).collect()
}

/// Those of these methods that the robot would have if it had no terms: it must not ask for them.
pub fn without_terms(methods: &[Method], model: &Model<'_>, run_time: RunTime) -> Vec<Method> {
    let lacks = lacks(model, run_time);
    methods.iter().copied().filter(|method| lacks.contains(&(*method, Lack::LoopsWithoutTerms))).collect()
}

/// Why a robot has no method of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lack {
    /// A straight line would be too long, and there is no other form: of regressors.
    TooLong,
    /// A straight line would be too long, and a recursion over a table of links has no terms: of what terms have a part in.
    LoopsWithoutTerms,
    /// It is about mass, and no body that moves has any: all inertia is in terms of the kinetic energy.
    Massless,
}

/// The methods of robots that this one has not, with the reason of each. Those of frames it has.
pub fn lacks(model: &Model<'_>, run_time: RunTime) -> Vec<(Method, Lack)> {
    let plans = Plans::of(model, run_time);
    let lack = |method| plans.lack(method, model).map(|lack| (method, lack));
    Method::OF_ROBOT.into_iter().filter_map(lack).collect()
}

/// Whether the robot has more to say than the trait's default does.
fn has_of_itself(method: Method, model: &Model<'_>) -> bool {
    let any = |acts: fn(&Passive<Expr<'_>>) -> bool| model.tree.links.iter().any(|link| acts(&link.passive));
    match method {
        Method::PassiveForces => {
            !model.tree.terms.dissipation.is_empty()
                || any(|p| !(p.damping.is_zero() && p.friction.is_zero() && p.stiffness.is_zero()))
        }
        Method::ElasticEnergy => any(|p| !p.stiffness.is_zero()),
        _ => true,
    }
}

/// What a method in the form of loops calls.
pub(super) fn calls(method: Method) -> &'static [Method] {
    match method {
        Method::ForwardDynamicsDerivatives | Method::ForwardDynamicsWithDerivatives => {
            &[Method::ForwardDynamics, Method::InverseDynamicsDerivatives]
        }
        Method::InverseDynamicsWithDerivatives => {
            &[Method::InverseDynamics, Method::InverseDynamicsDerivatives]
        }
        Method::InverseMassMatrix => &[Method::MassMatrix],
        _ => &[],
    }
}
