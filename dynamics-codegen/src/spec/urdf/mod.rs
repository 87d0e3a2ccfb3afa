//! A URDF, read into the same types as the attributes of a struct.
//!
//! Links become bodies and joints become joints, every number exact and with its line and column. What a URDF says
//! by its form is decided here: which link is the root (it is welded to the world), and the order of coordinates,
//! which is the document's order of joints; a joint written before the one that carries it follows that one. What
//! the equations have no use for is listed in the [`Report`], never dropped silently.
//!
//! A file is hostile until it is read: size, elements, depth and attributes are bounded before the parser sees it,
//! there are no entities, and nothing here recurses.

mod elements;
mod joint;
mod link;
mod numbers;
mod overrides;
mod path;
mod reader;
mod report;
mod scan;
mod source;
mod tree;

pub use path::{FilePath, check_path};
pub use report::{Note, Report};
pub use scan::SIZE_LIMIT;
pub use source::text_of;

use super::RobotSpec;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use elements::Element;
use reader::Reader;
use source::Source;

/// The text of a URDF.
#[derive(Clone, Copy, Debug)]
pub struct Urdf<'a> {
    /// The file's name, for messages.
    pub file: &'a str,
    /// What is in it.
    pub text: &'a str,
}

/// So many mistakes are reported; a file with more is broken as a whole.
const MISTAKE_LIMIT: usize = 100;

/// Adds the robot of a URDF to a specification that so far has the struct, its options, and what stands beside the
/// file. Mistakes are reported.
pub fn read(spec: &mut RobotSpec, urdf: Urdf<'_>, diags: &mut Diagnostics) -> Report {
    let source = Source::new(urdf);
    let document = match diags.keep(scan::check(&source).and_then(|()| parse(&source))) {
        Some(document) => document,
        None => return Report::default(),
    };
    let before = diags.len();
    let mut reader = Reader::new(spec.options.is_passive(), diags);
    let robot = Element { node: document.root_element(), source: &source };
    let parts = reader.robot(robot);
    let complete = reader.diags.len() == before;
    let mut report = std::mem::take(&mut reader.report);
    if !spec.options.snaps() {
        report.snapped.clear();
    }
    if complete {
        tree::connect(spec, parts, &robot.place(), &mut report, diags);
    }
    report
}

fn parse<'s>(source: &Source<'s>) -> Result<roxmltree::Document<'s>, Diagnostic> {
    let options = roxmltree::ParsingOptions { nodes_limit: scan::NODE_LIMIT, ..Default::default() };
    roxmltree::Document::parse_with_options(source.text(), options).map_err(|error| not_xml(&error, source))
}

/// What is wrong with a file that is no XML.
fn not_xml(error: &roxmltree::Error, source: &Source<'_>) -> Diagnostic {
    use roxmltree::Error;
    let position = error.pos();
    let place = source.at(position.row, position.col);
    let text = error.to_string();
    let text = text.strip_suffix(&format!(" at {position}")).unwrap_or(&text);
    match error {
        Error::NodesLimitReached => scan::too_many_nodes(source),
        Error::DuplicatedAttribute(name, _) => {
            let message = format!("the attribute {} is given twice", source::quoted(name));
            Diagnostic::new(Code::KeyDuplicate, &place, message)
        }
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
            Diagnostic::new(Code::XacroLeft, &place, "an element of xacro is left in the file")
        }
        Error::UnknownNamespace(prefix, _) => {
            let prefix = source::quoted(prefix);
            Diagnostic::new(Code::XmlInvalid, &place, format!("the prefix {prefix} is not declared"))
                .help("declare it on `<robot>`, as in `xmlns:prefix=\"…\"`, or take the element out")
        }
        Error::NoRootNode => Diagnostic::new(Code::XmlInvalid, &place, "the file is empty")
            .help("give the path of a URDF: a file that begins with `<robot name=\"…\">`"),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            let end = source.place(source.text().len());
            Diagnostic::new(Code::XmlInvalid, &end, "the file ends within an element")
        }
        _ => Diagnostic::new(Code::XmlInvalid, &place, format!("the file is no XML: {text}")),
    }
}
