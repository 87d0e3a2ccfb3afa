//! What is said of a robot before all else.

use std::path::Path;

use dynamics_view::page::Page;

use super::Subject;
use crate::check;

/// The page with a sentence or two below its title.
pub(super) fn put(page: Page, subject: &Subject<'_, '_>) -> Page {
    let robot = subject.robot;
    let first = format!(
        "{}: {}, {}.",
        check::freedom(robot),
        check::counted(robot.report.links, "link", "links"),
        check::joints(subject.input, &robot.spec, robot.report.joints)
    );
    let flags = subject.input.flags();
    let beside = if flags.is_empty() { String::new() } else { format!(" with `{}`", flags.trim_start()) };
    let second = format!(
        "It weighs {}; {}; {}. Read from `{}`{beside}.",
        check::mass(robot),
        check::base(subject.input, robot),
        check::parameters(robot),
        file(subject)
    );
    page.summary(&first).summary(&second)
}

/// The file, without the folders that are of no concern to readers.
pub(super) fn file(subject: &Subject<'_, '_>) -> String {
    let name = Path::new(&subject.input.name).file_name();
    name.map_or(subject.input.name.clone(), |name| name.to_string_lossy().into_owned())
}
