//! Mistakes as text in rustc's style, with the line of the file that each is in.

use std::io::{IsTerminal, Write};
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::failure::{Problem, Spot};

/// A longer line is named and not shown.
const LONGEST_LINE: usize = 4096;

/// Writes problems to standard error, in colours if a person is watching.
pub(crate) fn to_stderr(problems: &[Problem]) {
    let stderr = std::io::stderr();
    let colours = stderr.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let renderer = if colours { Renderer::styled() } else { Renderer::plain() };
    // Nobody is left to be told that there is nobody to tell.
    let _ = stderr.lock().write_all(as_text(problems, &renderer).as_bytes());
}

fn as_text(problems: &[Problem], renderer: &Renderer) -> String {
    let mut rendered = String::new();
    for problem in problems {
        rendered += &renderer.render(&[group(problem)]);
        rendered += "\n\n";
    }
    if problems.len() > 1 {
        let summary = format!("{} mistakes were found", problems.len());
        rendered += &renderer.render(&[Group::with_title(Level::ERROR.primary_title(summary))]);
        rendered += "\n";
    } else {
        rendered.pop();
    }
    rendered
}

fn group(problem: &Problem) -> Group<'_> {
    let Problem { title, spot, help, code } = problem;
    let mut group = Group::with_title(Level::ERROR.primary_title(title.as_str()));
    if let Some(spot) = spot {
        group = match &spot.source {
            Some((line, span)) => {
                let snippet = Snippet::source(line.as_str()).path(spot.file.as_str()).line_start(spot.line);
                group.element(snippet.annotation(AnnotationKind::Primary.span(span.clone())))
            }
            None => group.element(origin(spot)),
        };
    }
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    if let Some(code) = code {
        let name = code.rsplit("::").next().unwrap_or(code);
        group = group.element(Level::NOTE.message(format!("{code}; see `dynamics explain {name}`")));
    }
    group
}

fn origin(spot: &Spot) -> Origin<'_> {
    Origin::path(spot.file.as_str()).line(spot.line).char_column(spot.column)
}

/// A line that can be shown.
pub(crate) fn line_of(text: &str, line: usize) -> Option<&str> {
    let text = text.trim_start_matches('\u{feff}');
    let found = text.split('\n').nth(line.checked_sub(1)?)?;
    let found = found.strip_suffix('\r').unwrap_or(found);
    (found.len() <= LONGEST_LINE).then_some(found)
}

/// What begins at a column, in bytes: a tag to its end, a word of a value, all of an empty value's quotes.
pub(crate) fn span_at(line: &str, column: usize) -> Range<usize> {
    let start = line.char_indices().nth(column.saturating_sub(1)).map_or(line.len(), |(start, _)| start);
    let rest = &line[start..];
    let length = if rest.starts_with('<') {
        rest.find('>').map_or(rest.trim_end().len(), |end| end + 1)
    } else {
        rest.find(|c: char| c.is_whitespace() || "\"'<>".contains(c)).unwrap_or(rest.len())
    };
    start..start + length
}

#[cfg(test)]
mod tests {
    use super::{line_of, span_at};

    #[test]
    fn what_is_marked_is_what_is_meant() {
        let marked = |line, column| &line[span_at(line, column)];
        assert_eq!(marked(r#"  <mass value="-1"/>"#, 3), r#"<mass value="-1"/>"#);
        assert_eq!(marked(r#"<axis xyz="0 ü2 1"/>"#, 14), "ü2");
        assert_eq!(marked(r#"<axis xyz="0 ü2 1"/>"#, 17), "1");
        assert_eq!(marked("<robot", 1), "<robot");
        assert_eq!(marked("", 7), "");
    }

    #[test]
    fn a_line_is_found_without_what_no_editor_shows() {
        assert_eq!(line_of("\u{feff}<a>\r\n<b>", 1), Some("<a>"));
        assert_eq!(line_of("<a>\n", 2), Some(""));
        assert_eq!(line_of("<a>", 2), None);
        assert_eq!(line_of(&"x".repeat(5000), 1), None);
    }
}
