//! The robot where its coordinates are zero.

use dynamics_codegen::closed::Matrix;
use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::lecture::{Figure, Joint};
use dynamics_codegen::model::Motion;

use super::super::document::{Block, Piece, words};
use super::Text;

impl Text<'_, '_> {
    pub(super) fn figure(&mut self) {
        let Ok(figure) = &self.lecture.figure else {
            self.heading("The robot, where its coordinates are zero");
            return self.text("Where its joints are would be too long to be read.");
        };
        match figure.joints.iter().all(|joint| joint.is_bare) {
            true => {
                self.heading("The coordinates");
                self.text(
                    "No body is described: the energies are given as terms in the coordinates themselves.",
                );
            }
            false => {
                self.heading("The robot, where its coordinates are zero");
                if figure.joints.iter().any(|joint| !joint.is_bare && joint.motion != Motion::Free) {
                    self.text("Axes and points are given in the axes of the world.");
                }
            }
        }
        // The parts of a joint follow each other.
        let joints: Vec<&[Joint]> = figure.joints.chunk_by(|a, b| a.name == b.name).collect();
        let items = joints.iter().map(|parts| self.joint(parts)).collect();
        self.blocks.push(Block::List(items));
        if joints
            .iter()
            .any(|parts| parts.len() > 1 && parts.iter().any(|part| part.motion == Motion::Revolute))
        {
            self.text("Where a joint moves in several ways, each of them is carried by those before it.");
        }
        self.gravity_of(figure);
    }

    fn gravity_of(&mut self, figure: &Figure) {
        match (self.is_heavy(), self.has_gravity()) {
            (false, _) => {}
            (true, false) => self.text("There is no gravity."),
            (true, true) => {
                let mut gravity = words("All falls with the acceleration $g⃗|\\vec g$ = ");
                gravity.push(Piece::Vector(figure.gravity.clone()));
                gravity.extend(words("."));
                self.blocks.push(Block::Text(gravity));
            }
        }
    }

    /// A joint, by its parts.
    fn joint(&self, parts: &[Joint]) -> Vec<Piece> {
        let (first, last) = (&parts[0], &parts[parts.len() - 1]);
        if last.is_bare {
            return bare(last);
        }
        let what = last.body.as_ref().map_or("it".to_owned(), |body| format!("`{body}`"));
        let carrier = match (&first.parent, first.is_on_world) {
            (_, true) => " on the world".to_owned(),
            (Some(parent), _) => format!(" on `{parent}`"),
            (None, _) => String::new(),
        };
        let mut text = words(&format!("`{}`: {what} ", first.name));
        for (k, part) in parts.iter().enumerate() {
            let verb = match part.motion {
                Motion::Revolute => "turns",
                Motion::Prismatic => "slides",
                Motion::Ball => "turns freely",
                Motion::Free => "moves freely",
            };
            let is_same = k > 0 && parts[k - 1].motion == part.motion;
            match (k, is_same) {
                (0, _) => text.extend(words(&format!("{verb}{carrier}"))),
                (_, true) => text.extend(words(", then")),
                (_, false) => text.extend(words(&format!(", then {verb}"))),
            }
            self.motion(part, &mut text);
        }
        text.extend(words("."));
        text
    }

    /// About what a part turns or along what it slides, and by how much.
    fn motion(&self, joint: &Joint, text: &mut Vec<Piece>) {
        match joint.motion {
            Motion::Revolute => {
                text.extend(words(" about the axis "));
                text.push(Piece::Vector(joint.axis.clone()));
                text.extend(words(" through the point "));
                text.push(Piece::Vector(joint.point.clone()));
            }
            Motion::Prismatic => {
                text.extend(words(" along "));
                text.push(Piece::Vector(joint.axis.clone()));
            }
            Motion::Ball => {
                text.extend(words(" about the point "));
                text.push(Piece::Vector(joint.point.clone()));
                text.extend(self.named(", by the unit quaternion ", Argument::Q, joint.q, 4));
                text.extend(self.named(
                    ", at the angular velocity in its own axes ",
                    Argument::V,
                    joint.v,
                    3,
                ));
            }
            Motion::Free => {
                text.extend(self.named(", to the place ", Argument::Q, joint.q, 3));
                text.extend(self.named(", turned by the unit quaternion ", Argument::Q, joint.q + 3, 4));
                text.extend(self.named(", at the twist in its own axes ", Argument::V, joint.v, 6));
            }
        }
        if matches!(joint.motion, Motion::Revolute | Motion::Prismatic) {
            text.extend(words(", by "));
            text.push(Piece::Form(joint.coordinate.clone()));
        }
    }

    fn named(&self, before: &str, argument: Argument, first: usize, count: usize) -> Vec<Piece> {
        let symbols = (first..first + count).map(|k| self.symbol(argument, k));
        let mut text = words(before);
        text.push(Piece::Vector(Matrix::vector(symbols.collect())));
        text
    }
}

/// A coordinate that carries nothing.
fn bare(joint: &Joint) -> Vec<Piece> {
    let what = if joint.motion == Motion::Prismatic { "a length" } else { "an angle" };
    let mut text = words(&format!("`{}`: {what}, ", joint.name));
    text.push(Piece::Form(joint.coordinate.clone()));
    text.extend(words("."));
    text
}
