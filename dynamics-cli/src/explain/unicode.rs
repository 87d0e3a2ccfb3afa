//! A document for a terminal.

use dynamics_codegen::closed::{Matrix, Notation};

use super::document::{Block, Piece, Side, lowered};

/// Lines of words are no longer than this, and sums are broken at it.
const WIDTH: usize = 100;
/// Wider matrices are written entry by entry.
const WIDEST: usize = 160;
const INDENT: &str = "    ";

/// Writes a document.
pub(super) fn written(blocks: &[Block], notation: &Notation) -> String {
    let mut text = String::new();
    for (k, block) in blocks.iter().enumerate() {
        match block {
            Block::Title(pieces) => {
                let title = line(pieces, notation);
                text += &format!("{title}\n{}\n", "═".repeat(width(&title)));
            }
            Block::Heading(title) => text += &format!("\n\n{title}\n{}\n", "─".repeat(width(title))),
            Block::Text(pieces) => text += &format!("\n{}", filled(&line(pieces, notation), "", "")),
            Block::List(items) => {
                text.push('\n');
                for item in items {
                    text += &filled(&line(item, notation), "  • ", "    ");
                }
            }
            Block::Equation(sides) => {
                // Equations that follow each other on single lines stand together.
                let lines = equation(sides, notation);
                let is_joined = lines.len() == 1
                    && matches!(blocks.get(k.wrapping_sub(1)), Some(Block::Equation(before)) if equation(before, notation).len() == 1);
                if !is_joined {
                    text.push('\n');
                }
                for line in lines {
                    text += format!("{INDENT}{line}").trim_end();
                    text.push('\n');
                }
            }
        }
    }
    text
}

fn line(pieces: &[Piece], notation: &Notation) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Words(words) => words.clone(),
        Piece::Name(name) => format!("`{name}`"),
        Piece::Math(math) => math.unicode.clone(),
        Piece::Form(form) => form.unicode(notation),
        Piece::Vector(vector) => {
            let entries = vector.entries().map(|(_, _, form)| form.unicode(notation));
            format!("({})", entries.collect::<Vec<_>>().join(", "))
        }
    };
    pieces.iter().map(piece).collect()
}

/// Words in lines, the first one behind `first`, the others behind `next`.
fn filled(text: &str, first: &str, next: &str) -> String {
    let mut lines = String::new();
    let mut line = first.to_owned();
    let mut is_begun = false;
    for word in text.split(' ') {
        if is_begun && width(&line) + 1 + width(word) > WIDTH {
            lines += &format!("{line}\n");
            line = next.to_owned();
            is_begun = false;
        }
        if is_begun {
            line.push(' ');
        }
        line += word;
        is_begun = true;
    }
    lines + &line + "\n"
}

/// Sides beside each other, matrices over several lines, and sums that are too long.
fn equation(sides: &[Side], notation: &Notation) -> Vec<String> {
    let columns: Vec<Vec<String>> = sides.iter().map(|side| self::side(side, notation)).collect();
    let is_flat = columns.iter().all(|column| column.len() == 1);
    if is_flat {
        return broken(&columns.iter().map(|column| column[0].as_str()).collect::<Vec<_>>());
    }
    if let (Some(Side::Math(name)), Some(Side::Matrix(matrix))) = (sides.first(), sides.last())
        && columns
            .iter()
            .map(|column| column.iter().map(|line| width(line)).max().unwrap_or(0))
            .sum::<usize>()
            > WIDEST
    {
        return entries(&name.unicode, matrix, notation);
    }
    let height = columns.iter().map(Vec::len).max().unwrap_or(1);
    let mut lines = vec![String::new(); height];
    for (k, column) in columns.iter().enumerate() {
        let wide = column.iter().map(|line| width(line)).max().unwrap_or(0);
        let above = (height - column.len()) / 2;
        for (row, line) in lines.iter_mut().enumerate() {
            let sign = match (k, row == (height - 1) / 2) {
                (0, _) => "",
                (_, true) => " = ",
                (_, false) => "   ",
            };
            let part = row.checked_sub(above).and_then(|row| column.get(row)).map_or("", String::as_str);
            *line += sign;
            *line += part;
            line.extend(std::iter::repeat_n(' ', wide - width(part)));
        }
    }
    lines
}

/// The entries of a matrix that are not zero, each on lines of its own.
fn entries(name: &str, matrix: &Matrix, notation: &Notation) -> Vec<String> {
    let name = if name.contains('·') { format!("({name})") } else { name.to_owned() };
    let given: Vec<_> = matrix.entries().filter(|(.., form)| !form.is_zero()).collect();
    let mut lines = Vec::new();
    for (row, column, form) in &given {
        let place = |i: usize, j: usize| match matrix.columns() {
            1 => lowered(i + 1),
            _ => format!("{}{}{}", lowered(i + 1), if i.max(j) > 8 { "," } else { "" }, lowered(j + 1)),
        };
        let mut left = format!("{name}{}", place(*row, *column));
        if matrix.is_symmetric() && row != column {
            left += &format!(" = {name}{}", place(*column, *row));
        }
        lines.extend(broken(&[&left, &form.unicode(notation)]));
    }
    let count = if matrix.is_symmetric() {
        given.iter().map(|(row, column, _)| if row == column { 1 } else { 2 }).sum()
    } else {
        given.len()
    };
    if count < matrix.rows() * matrix.columns() {
        lines.push(format!("The other entries of {name} are zero."));
    }
    lines
}

fn side(side: &Side, notation: &Notation) -> Vec<String> {
    match side {
        Side::Math(math) => math.unicode.split('\n').map(str::to_owned).collect(),
        Side::Form(form) => vec![form.unicode(notation)],
        Side::Matrix(matrix) => matrix.unicode(notation),
    }
}

/// Sides on one line, or each on its own, broken before signs that are in no bracket; a term that is too long by itself is
/// broken in its own, where what is in a bracket goes on below what it begins with.
fn broken(sides: &[&str]) -> Vec<String> {
    let one = sides.join(" = ");
    if width(&one) <= WIDTH || sides.len() < 2 {
        return vec![one];
    }
    let mut lines = Vec::new();
    let left = width(sides[0]);
    for (k, side) in sides[1..].iter().enumerate() {
        let head = if k == 0 { format!("{} = ", sides[0]) } else { format!("{} = ", " ".repeat(left)) };
        let mut line = head;
        let room = WIDTH.saturating_sub(left + 3);
        let parts = |term: String| if width(&term) > room { terms(&term, 1) } else { vec![term] };
        let (mut is_begun, mut open) = (false, vec![]);
        for term in terms(side, 0).into_iter().flat_map(parts) {
            if is_begun && width(&line) + width(&term) > WIDTH {
                let indent = match open.last() {
                    Some(column) if *column < WIDTH / 2 => column + 1,
                    Some(_) => left + 5,
                    None => left + 3,
                };
                lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
            }
            for letter in term.chars() {
                match letter {
                    '(' => open.push(width(&line)),
                    ')' => drop(open.pop()),
                    _ => {}
                }
                line.push(letter);
            }
            is_begun = true;
        }
        lines.push(line);
    }
    lines
}

/// The terms of a sum, each with the sign before it, where no more than so many brackets are open.
fn terms(sum: &str, most: u32) -> Vec<String> {
    let (mut terms, mut depth) = (vec![String::new()], 0_u32);
    let signs: Vec<char> = sum.chars().collect();
    for (k, &c) in signs.iter().enumerate() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ' ' if k > 0
                && depth <= most
                && matches!(signs.get(k + 1), Some('+' | '−'))
                && signs.get(k + 2) == Some(&' ') =>
            {
                terms.push(String::new());
            }
            _ => {}
        }
        if let Some(last) = terms.last_mut() {
            last.push(c);
        }
    }
    terms
}

/// How many places a text takes: dots above letters take none.
fn width(text: &str) -> usize {
    text.chars().filter(|c| !matches!(c, '\u{300}'..='\u{36f}')).count()
}
