//! The contestants: programs that take the same states and print times or values by the same names.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Who races.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Contestant {
    /// Pinocchio, the faster of its conventions.
    Pinocchio,
    /// C that CasADi generated from Pinocchio.
    Casadi,
    /// Ours, built for this machine.
    Ours,
    /// Ours, built for any machine of its kind.
    Generic,
    /// Ours for this machine, several states a call, in lanes of the type of that name.
    F64x4,
    F64x8,
    F32x8,
    /// The same by `batch::map`, from slices and back.
    Batch,
}

/// Where the programs and the files of states are.
pub(crate) struct Programs {
    peers: PathBuf,
    ours: PathBuf,
    generic: PathBuf,
    lanes: PathBuf,
    folder: PathBuf,
}

/// What a contestant printed: whose it is, the output, and the numbers.
pub(crate) struct Line {
    pub(crate) contestant: Contestant,
    pub(crate) output: String,
    pub(crate) numbers: Vec<f64>,
}

impl Programs {
    pub(crate) fn new([peers, ours, generic, lanes]: [&str; 4], folder: &Path) -> Self {
        let absolute = |path: &str| {
            std::fs::canonicalize(path).unwrap_or_else(|error| panic!("{path} is not there: {error}"))
        };
        let folder = absolute(&folder.to_string_lossy());
        let [peers, ours, generic, lanes] = [peers, ours, generic, lanes].map(absolute);
        Self { peers, ours, generic, lanes, folder }
    }

    fn states(&self, robot: &str) -> PathBuf {
        self.folder.join(format!("{robot}.states"))
    }

    /// Ours chooses the states; all read or repeat them.
    pub(crate) fn write_states(&self, robot: &str) {
        let states = run(Command::new(&self.ours).args(["states", robot]));
        std::fs::write(self.states(robot), states).expect("the states can be written");
    }

    /// The states, one a line.
    pub(crate) fn read_states(&self, robot: &str) -> Vec<Vec<f64>> {
        let text = std::fs::read_to_string(self.states(robot)).expect("the states were written");
        text.lines().map(|line| line.split(' ').map(number).collect()).collect()
    }

    fn peers(&self, task: &str, robot: &str) -> Vec<Line> {
        // The program finds its models and libraries beside its own folder.
        let home = self.peers.parent().and_then(Path::parent).expect("the peers' program is in `build`");
        let mut command = Command::new(&self.peers);
        command.current_dir(home).args([task, robot]).arg(self.states(robot));
        lines(&run(&mut command), Contestant::Ours)
    }

    /// What each computes at the first states.
    pub(crate) fn values(&self, robot: &str) -> Vec<Line> {
        let ours = run(Command::new(&self.ours).args(["values", robot]));
        let generic = run(Command::new(&self.generic).args(["values", robot]));
        let mut all = self.peers("values", robot);
        all.extend(lines(&ours, Contestant::Ours));
        all.extend(lines(&generic, Contestant::Generic));
        all.extend(lines(&run(Command::new(&self.lanes).args(["values", robot])), Contestant::Ours));
        all
    }

    /// One turn of each.
    pub(crate) fn time(&self, robot: &str, times: &mut Times) {
        times.measure_clock();
        times.keep(robot, self.peers("time", robot));
        times.keep(robot, lines(&run(Command::new(&self.ours).args(["time", robot])), Contestant::Ours));
        let generic = run(Command::new(&self.generic).args(["time", robot]));
        times.keep(robot, lines(&generic, Contestant::Generic));
        times.keep(robot, lines(&run(Command::new(&self.lanes).args(["time", robot])), Contestant::Ours));
    }
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("contestants print text")
}

/// `ours` says which build a line named so is of.
fn lines(text: &str, ours: Contestant) -> Vec<Line> {
    let line = |line: &str| {
        let words: Vec<&str> = line.split('\t').collect();
        let [_, library, output, _, numbers @ ..] = words.as_slice() else { panic!("no result: {line}") };
        let contestant = match *library {
            "pinocchio" => Contestant::Pinocchio,
            "casadi" => Contestant::Casadi,
            "f64x4" => Contestant::F64x4,
            "f64x8" => Contestant::F64x8,
            "f32x8" => Contestant::F32x8,
            "batch" => Contestant::Batch,
            _ => ours,
        };
        Line {
            contestant,
            output: (*output).to_owned(),
            numbers: numbers.iter().map(|x| number(x)).collect(),
        }
    };
    text.lines().map(line).collect()
}

fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or_else(|error| panic!("`{text}` is no number: {error}"))
}

/// The least nanoseconds of all rounds, and the highest clock.
#[derive(Default)]
pub(crate) struct Times {
    least: BTreeMap<(String, String, Contestant), f64>,
    gigahertz: f64,
}

impl Times {
    fn keep(&mut self, robot: &str, lines: Vec<Line>) {
        for Line { contestant, output, numbers } in lines {
            let least = self.least.entry((robot.to_owned(), output, contestant)).or_insert(f64::INFINITY);
            *least = numbers.into_iter().fold(*least, f64::min);
        }
    }

    /// What a state takes, if the contestant has the output.
    pub(crate) fn get(&self, robot: &str, output: &str, contestant: Contestant) -> Option<f64> {
        self.least.get(&(robot.to_owned(), output.to_owned(), contestant)).copied()
    }

    /// What a call takes Pinocchio, CasADi's C, and ours.
    pub(crate) fn of(&self, robot: &str, output: &str) -> [Option<f64>; 3] {
        [Contestant::Pinocchio, Contestant::Casadi, Contestant::Ours]
            .map(|contestant| self.get(robot, output, contestant))
    }

    /// The clock, in cycles a nanosecond: integer squares one after another take three cycles each, on x86-64 since 2008.
    fn measure_clock(&mut self) {
        const SQUARES: u32 = 1_000_000;
        let start = Instant::now();
        black_box((0..SQUARES).fold(black_box(3_u64), |x, _| x.wrapping_mul(x)));
        let gigahertz = 3.0 * f64::from(SQUARES) / (start.elapsed().as_secs_f64() * 1e9);
        self.gigahertz = self.gigahertz.max(gigahertz);
    }

    pub(crate) fn gigahertz(&self) -> f64 {
        self.gigahertz
    }
}
