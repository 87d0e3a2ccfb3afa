//! What coordinates and speeds are called on paper: their own letters first, and then those that are left.

use crate::closed::{Name, Notation, Role};
use crate::model::{JointInfo, Model};
use crate::spec::JointKind;
use crate::symbolic::Expr;

/// The names of coordinates and speeds, in the order of both.
pub(super) struct JointNames {
    pub(super) coordinates: Vec<Name>,
    pub(super) speeds: Vec<Name>,
}

impl JointNames {
    /// The names that are free beside those of the fields.
    pub(super) fn of(model: &Model<'_>, fields: &Notation) -> Self {
        let mut choice = Choice {
            model,
            fields,
            taken: fields.clone(),
            coordinates: vec![None; model.tree.coordinates()],
            speeds: vec![None; model.tree.dof()],
        };
        choice.own_letters();
        choice.parts_of_joints();
        choice.axes_of_the_world();
        choice.generic();
        let named =
            |names: Vec<Option<Name>>| names.into_iter().map(|name| name.unwrap_or_else(|| Name::word("q")));
        Self { coordinates: named(choice.coordinates).collect(), speeds: named(choice.speeds).collect() }
    }
}

/// Letters of joints that turn, the first choice first: those of angles.
const TURNING: [&str; 7] = ["theta", "phi", "psi", "alpha", "beta", "gamma", "q"];
/// Letters of joints that slide: of distances.
const SLIDING: [&str; 5] = ["d", "s", "r", "y", "q"];

/// Joints of several coordinates try no more indices: no robot has so many.
const INDICES: usize = 1000;

/// What was chosen so far.
struct Choice<'m, 'g> {
    model: &'m Model<'g>,
    fields: &'m Notation,
    /// Fields, coordinates, speeds and accelerations.
    taken: Notation,
    coordinates: Vec<Option<Name>>,
    speeds: Vec<Option<Name>>,
}

impl<'m> Choice<'m, '_> {
    /// Joints of one coordinate that have no name yet.
    fn nameless(&self) -> Vec<&'m JointInfo> {
        let is_open = |joint: &&JointInfo| joint.q.len() == 1 && self.coordinates[joint.q.start].is_none();
        self.model.joints.iter().filter(is_open).collect()
    }

    /// Whether a coordinate can have a name, with its rates.
    fn is_free(&self, name: &Name) -> bool {
        is_free(&self.taken, name)
    }

    fn take(&mut self, joint: &JointInfo, name: Name) {
        for (dots, role) in [Role::Coordinate, Role::Speed, Role::Acceleration].into_iter().enumerate() {
            self.taken.add((0..dots).fold(name.clone(), |name, _| name.dotted()), role);
        }
        self.speeds[joint.v.start] = Some(name.dotted());
        self.coordinates[joint.q.start] = Some(name);
    }

    /// Joints that are called by a letter: also a slide that is called θ₄, as some lectures have it.
    fn own_letters(&mut self) {
        for joint in self.nameless() {
            let name = Name::read(&joint.name);
            if name.is_letter() && self.is_free(&name) {
                self.take(joint, name);
            }
        }
    }

    /// Joints of several coordinates: two of one kind have indices, for their parts have one name.
    fn parts_of_joints(&mut self) {
        let several = || self.model.joints.iter().filter(|joint| joint.v.len() != 1);
        let is_ball = |joint: &JointInfo| joint.q.len() != joint.v.len();
        let is_ambiguous =
            [true, false].iter().any(|kind| several().filter(|joint| is_ball(joint) == *kind).count() > 1);
        let mut last = 0;
        for joint in several() {
            let first = if is_ambiguous { last + 1 } else { 0 };
            for index in (first..INDICES).chain([0]) {
                let text = if index == 0 { String::new() } else { index.to_string() };
                let coordinates = parts(&joint.coordinate_names(), joint, &text);
                let speeds: Vec<Name> = match is_ball(joint) {
                    true => parts(&joint.speed_names(), joint, &text),
                    false => coordinates.iter().map(Name::dotted).collect(),
                };
                let rates = speeds.iter().map(Name::dotted);
                let all: Vec<Name> = coordinates.iter().chain(&speeds).cloned().chain(rates).collect();
                // The last index is no choice: names that are taken get marks.
                if all.iter().all(|name| self.taken.is_free(name)) || index == 0 && last + 1 >= INDICES {
                    for name in all {
                        self.taken.add(name, Role::Coordinate);
                    }
                    for (names, (chosen, at)) in [
                        (coordinates, (&mut self.coordinates, joint.q.start)),
                        (speeds, (&mut self.speeds, joint.v.start)),
                    ] {
                        names.into_iter().enumerate().for_each(|(k, name)| chosen[at + k] = Some(name));
                    }
                    last = index;
                    break;
                }
            }
        }
    }

    /// Joints that slide along an axis of the world are x, y or z, with indices where several slide along one.
    fn axes_of_the_world(&mut self) {
        for letter in ["x", "y", "z"] {
            let along: Vec<&JointInfo> = self.nameless();
            let along =
                along.into_iter().filter(|joint| axis_of_the_world(self.model, joint) == Some(letter));
            let along: Vec<&JointInfo> = along.collect();
            let index = |k: usize| if along.len() > 1 { (k + 1).to_string() } else { String::new() };
            let names: Vec<Name> = (0..along.len()).map(|k| Name::indexed(letter, &index(k))).collect();
            if names.iter().all(|name| self.is_free(name)) {
                along.into_iter().zip(names).for_each(|(joint, name)| self.take(joint, name));
            }
        }
    }

    /// All others: the first letters for which no field is in the way.
    fn generic(&mut self) {
        let joints = self.nameless();
        let letters =
            TURNING.iter().flat_map(|turning| SLIDING.iter().map(move |sliding| [*turning, *sliding]));
        let names = letters.map(|letters| self.indexed(&joints, letters, self.fields));
        // If fields have all of them, their indices are left out.
        let names = names
            .flatten()
            .next()
            .or_else(|| self.indexed(&joints, [TURNING[0], SLIDING[0]], &Notation::new()));
        for (joint, name) in joints.into_iter().zip(names.into_iter().flatten()) {
            self.take(joint, name);
        }
    }

    /// Names of these letters, with the indices that other coordinates leave; nothing if one is that of a field.
    fn indexed(&self, joints: &[&JointInfo], letters: [&str; 2], fields: &Notation) -> Option<Vec<Name>> {
        let letter_of = |joint: &JointInfo| letters[usize::from(slides(joint))];
        let is_used = |letter: &str| {
            let letter = Name::indexed(letter, "").letter();
            self.coordinates.iter().flatten().any(|name| name.letter() == letter)
        };
        if let [joint] = joints
            && !is_used(letter_of(joint))
        {
            let name = Name::indexed(letter_of(joint), "");
            return is_free(fields, &name).then(|| vec![name]);
        }
        let mut index = 0;
        let mut names = Vec::new();
        for joint in joints {
            if !is_free(fields, &Name::indexed(letter_of(joint), "")) {
                return None;
            }
            loop {
                index += 1;
                let name = Name::indexed(letter_of(joint), &index.to_string());
                if !is_free(fields, &name) {
                    return None;
                }
                if self.is_free(&name) {
                    names.push(name);
                    break;
                }
            }
        }
        Some(names)
    }
}

/// Whether a coordinate can have a name, with its rates.
fn is_free(taken: &Notation, name: &Name) -> bool {
    let rate = name.dotted();
    [name, &rate, &rate.dotted()].into_iter().all(|name| taken.is_free(name))
}

fn slides(joint: &JointInfo) -> bool {
    joint.kind == JointKind::Prismatic
}

/// The axis of the world that a joint slides along.
fn axis_of_the_world(model: &Model<'_>, joint: &JointInfo) -> Option<&'static str> {
    let place = model.links.iter().position(|link| link.joint == joint.name)?;
    let link = model.tree.links.get(place)?;
    if !slides(joint) || link.parent.is_some() {
        return None;
    }
    let axis = link.placement.rotation.0.map(|row| row[2]);
    let along = axis.iter().position(|&component| component == Expr::ONE)?;
    Some(["x", "y", "z"][along])
}

/// Parts of joints that are words, and their letters.
const WORDS: [(&str, &str); 2] = [("angle", "theta"), ("distance", "d")];

/// The names of a joint's several coordinates or speeds: the last parts of what they are called, as `x`, `qw`, `wz`.
fn parts(names: &[String], joint: &JointInfo, index: &str) -> Vec<Name> {
    let part = |name: &String| {
        let part = name.strip_prefix(&joint.name).unwrap_or(name).trim_start_matches('.').to_owned();
        if let Some((_, letter)) =
            WORDS.iter().find(|(word, _)| part.trim_end_matches(|c: char| c.is_ascii_digit()) == *word)
        {
            let digits = part.trim_start_matches(|c: char| !c.is_ascii_digit());
            return Name::indexed(letter, &format!("{digits}{index}"));
        }
        let (letter, axis) = part.split_at(part.chars().next().map_or(0, char::len_utf8));
        let letter = if letter == "w" && !axis.is_empty() { "omega" } else { letter };
        Name::indexed(letter, &format!("{axis}{index}"))
    };
    names.iter().map(part).collect()
}
