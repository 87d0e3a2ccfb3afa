//! The frames: zero-sized types, and their kinematics.

use std::fmt::Write as _;

use super::Item;
use super::items::{Emitter, Host, allowed, indented};
use super::mechanism::cost;
use super::methods::Written;

impl Emitter<'_, '_> {
    /// The zero-sized types of the frames, in a module of their own and re-exported by a glob, so that two
    /// robots may have bodies of one name.
    pub(super) fn frame_types(&self) -> String {
        let Item { name, visibility, .. } = self.item;
        let module = frames_module(name);
        // The module's own visibility bounds that of its types; `pub(super)` would mean another module in it.
        let mut text = format!(
            "/// The frames of [`{name}`], for `pose` and `jacobian`.\n#[allow({}, reason = \"generated code\")]\n\
             {visibility}mod {module} {{\n",
            allowed("dead_code, unreachable_pub")
        );
        for (type_, frame) in self.frame_types.iter().zip(&self.input.model.tree.frames) {
            let _ = writeln!(text, "    /// The frame `{}`.", frame.name);
            text.push_str("    #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]\n");
            let _ = writeln!(text, "    pub struct {type_};");
        }
        let _ = writeln!(
            text,
            "}}\n#[allow({}, reason = \"two robots may share a name\")]",
            allowed("unused_imports, unreachable_pub, ambiguous_glob_reexports")
        );
        let _ = writeln!(text, "{visibility}use {module}::*;\n");
        text
    }

    pub(super) fn frames(&self, written: &[Written]) -> String {
        let mut text = String::new();
        let module = frames_module(&self.item.name);
        let frames = &self.input.model.tree.frames;
        let mut of_frames: Vec<Vec<&Written>> = vec![vec![]; frames.len()];
        for method in written {
            if let Some(frame) = method.method.frame() {
                of_frames[frame].push(method);
            }
        }
        for ((type_, frame), chosen) in self.frame_types.iter().zip(frames).zip(of_frames) {
            if chosen.is_empty() {
                continue;
            }
            let type_ = format!("{module}::{type_}");
            let (robot, prepared) = (self.robot(), self.prepared());
            let trait_ = |host: &Host| self.of_sizes("Frame").replacen('<', &format!("<{}, ", host.type_), 1);
            text.push_str(&self.open(&prepared, &trait_(&prepared), &type_));
            let _ = writeln!(text, "        const NAME: &'static str = {:?};", frame.name);
            text.push_str("        const COST: FrameCosts = FrameCosts {\n");
            for part in &chosen {
                let _ = writeln!(text, "            {}: {},", part.method.name(), cost(part.cost));
            }
            text.push_str("        };\n\n");
            let bodies: Vec<String> = chosen.iter().map(|w| indented(&w.text)).collect();
            text.push_str(&bodies.join("\n"));
            text.push_str("    }\n\n");
            if self.is_prepared() {
                text.push_str(&self.open(&robot, &trait_(&robot), &type_));
                let _ = writeln!(text, "        const NAME: &'static str = {:?};", frame.name);
                let of_prepared = format!("<Self as {}>::COST", trait_(&prepared));
                let _ = writeln!(text, "        const COST: FrameCosts = {of_prepared};\n");
                for method in &chosen {
                    let receiver = format!("robot: &{}", robot.type_);
                    let callee = format!("<Self as {}>::", trait_(&prepared));
                    let call = self.forwarding(method.method, &receiver, &callee);
                    text.push_str(&call.replace("(q", "(&robot.prepare(), q"));
                }
                text.push_str("    }\n\n");
            }
        }
        if frames.iter().enumerate().all(|(frame, _)| written.iter().any(|w| w.method.frame() == Some(frame)))
        {
            text.push_str(&self.each_frame());
        }
        text
    }

    /// The list of all frames, for each of the types.
    fn each_frame(&self) -> String {
        let module = frames_module(&self.item.name);
        let visits: String = self
            .frame_types
            .iter()
            .map(|type_| format!("            visitor.visit::<{module}::{type_}>();\n"))
            .collect();
        let v = self.item.free_type_name("V");
        let mut text = String::new();
        for host in self.types() {
            let visitor = self.of_sizes("FrameVisitor").replacen('<', "<Self, ", 1);
            text.push_str(&self.open(&host, &self.of_sizes("EachFrame"), &host.type_));
            let _ = writeln!(
                text,
                "        fn each_frame<{v}: {visitor}>(&self, visitor: &mut {v}) {{\n{visits}        }}\n    }}\n"
            );
        }
        text
    }
}

/// The module that holds a robot's frames.
pub(super) fn frames_module(robot: &str) -> String {
    crate::model::names::snake_case(robot) + "_frames"
}
