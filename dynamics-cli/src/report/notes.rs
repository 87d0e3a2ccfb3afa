//! What became of the file.

use dynamics_view::page::Section;

use super::Subject;

pub(super) fn section(subject: &Subject<'_, '_>) -> Section {
    let report = &subject.robot.report;
    let lists = [
        ("Suspicious", &report.suspicions, "What is taken as it is written, and looks like a mistake."),
        (
            "Merged",
            &report.merged,
            "Links without motion of their own, which are one with those that carry them.",
        ),
        ("Ignored", &report.ignored, "Elements and attributes that the equations do not use."),
        ("Snapped", &report.snapped, "Angles within 1e-11 of right ones, which are taken for these."),
        ("Remarks", &report.remarks, "What was altered or assumed, and what looks odd."),
    ];
    let section = Section::new("file", "What became of the file");
    if lists.iter().all(|(_, notes, _)| notes.is_empty()) {
        return section.text("All of it was used as it stands.");
    }
    let file = super::summary::file(subject);
    lists.into_iter().filter(|(_, notes, _)| !notes.is_empty()).fold(
        section,
        |section, (title, notes, what)| {
            let lines = subject.input.placed(notes);
            // The folder of the file is of no concern to readers.
            let shown = lines.iter().map(|line| line.replacen(&subject.input.name, &file, 1));
            let mut kept: Vec<String> = shown.take(MOST).collect();
            if lines.len() > MOST {
                kept.push(format!("and {} more, which `dynamics check` lists", lines.len() - MOST));
            }
            section.heading(title).remark(what).list(kept)
        },
    )
}

/// Lines of one list.
const MOST: usize = 100;
