//! What is said of a robot before all else.

use std::path::Path;

use dynamics_codegen::mechanics::equations::Method;
use dynamics_view::page::Page;

use super::{Subject, stage};
use crate::absence::Absence;
use crate::check;

/// The page with a sentence or two below its title.
pub(super) fn put(page: Page, subject: &Subject<'_, '_>) -> Page {
    let robot = subject.robot;
    let has_bodies = !stage::is_empty(robot);
    let parts = match subject.input.is_of_file() {
        true => check::counted(robot.report.links, "link", "links"),
        false => check::counted(robot.report.links, "body", "bodies"),
    };
    let joints = check::joints(subject.input, &robot.spec, robot.report.joints);
    let first = match has_bodies {
        true => format!("{}: {parts}, {joints}.", check::freedom(robot)),
        false => format!("{}, described by energies, without bodies.", check::freedom(robot)),
    };
    let flags = subject.input.flags();
    let beside = if flags.is_empty() { String::new() } else { format!(" with `{}`", flags.trim_start()) };
    let why = || Absence::of_method(Method::Regressor, robot).fact();
    let parameters = check::parameters(robot).unwrap_or_else(|| format!("no regressor, since {}", why()));
    let file = file(subject);
    let second = match has_bodies {
        true => format!(
            "It weighs {}; {}; {parameters}. Read from `{file}`{beside}.",
            check::mass(robot),
            check::base(subject.input, robot)
        ),
        false => format!("It has {parameters}. Read from `{file}`{beside}."),
    };
    page.summary(&first).summary(&second)
}

/// The file, without the folders that are of no concern to readers.
pub(super) fn file(subject: &Subject<'_, '_>) -> String {
    let name = Path::new(&subject.input.name).file_name();
    name.map_or(subject.input.name.clone(), |name| name.to_string_lossy().into_owned())
}
