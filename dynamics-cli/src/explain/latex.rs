//! A document in LaTeX, whole, or in Markdown with LaTeX's mathematics.

use dynamics_codegen::closed::{Form, Notation, ascii};

use super::document::{Block, Piece, Side};

/// What is around the parts of a document.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A file for `pdflatex`.
    Whole,
    /// As GitHub and others show it.
    Markdown,
}

const HEAD: &str = "\
\\documentclass[11pt]{article}
\\usepackage[a4paper,margin=22mm]{geometry}
\\usepackage{amsmath,amssymb,graphicx}
\\usepackage[T1]{fontenc}
\\usepackage[utf8]{inputenc}
\\setlength{\\parindent}{0pt}
\\setlength{\\parskip}{1ex}
\\allowdisplaybreaks
\\setcounter{MaxMatrixCols}{20}
% What is wider than the page is made smaller.
\\newcommand{\\fitted}[1]{\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{#1}}
\\begin{document}
";

/// So many letters of a sum stand on a line.
const LINE: usize = 110;

/// Writes a document.
pub(super) fn written(blocks: &[Block], notation: &Notation, kind: Kind) -> String {
    let mut text = if kind == Kind::Whole { HEAD.to_owned() } else { String::new() };
    for block in blocks {
        match (block, kind) {
            (Block::Title(pieces), Kind::Whole) => {
                text += &format!("\\section*{{{}}}\n\n", line(pieces, notation, kind));
            }
            (Block::Title(pieces), Kind::Markdown) => {
                text += &format!("# {}\n\n", line(pieces, notation, kind))
            }
            (Block::Heading(title), Kind::Whole) => text += &format!("\\subsection*{{{title}}}\n\n"),
            (Block::Heading(title), Kind::Markdown) => text += &format!("## {title}\n\n"),
            (Block::Text(pieces), _) => text += &format!("{}\n\n", line(pieces, notation, kind)),
            (Block::List(items), Kind::Whole) => {
                text += "\\begin{itemize}\n";
                for item in items {
                    text += &format!("\\item {}\n", line(item, notation, kind));
                }
                text += "\\end{itemize}\n\n";
            }
            (Block::List(items), Kind::Markdown) => {
                for item in items {
                    text += &format!("- {}\n", line(item, notation, kind));
                }
                text.push('\n');
            }
            (Block::Equation(sides), Kind::Whole) => {
                let equation = equation(sides, notation);
                text += &format!("\\[\n\\fitted{{$\\displaystyle {equation}$}}\n\\]\n\n");
            }
            (Block::Equation(sides), Kind::Markdown) => {
                text += &format!("$$\n{}\n$$\n\n", equation(sides, notation));
            }
        }
    }
    if kind == Kind::Whole {
        text += "\\end{document}\n";
    }
    text
}

fn line(pieces: &[Piece], notation: &Notation, kind: Kind) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Words(words) => words.clone(),
        Piece::Name(name) if kind == Kind::Whole => format!("\\texttt{{{}}}", escaped(name)),
        Piece::Name(name) => format!("`{name}`"),
        Piece::Math(math) => format!("${}$", math.latex),
        Piece::Form(form) => format!("${}$", form.latex(notation)),
        Piece::Vector(vector) => {
            let entries = vector.entries().map(|(_, _, form)| form.latex(notation));
            format!("$({})$", entries.collect::<Vec<_>>().join(",\\, "))
        }
    };
    pieces.iter().map(piece).collect()
}

/// A name without what commands are made of. What the font has not is mathematics, or its number.
fn escaped(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match c {
            '\\' => text += "\\textbackslash{}",
            '~' => text += "\\textasciitilde{}",
            '^' => text += "\\textasciicircum{}",
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => text.extend(['\\', c]),
            c if c.is_ascii() || matches!(c, 'À'..='ÿ') => text.push(c),
            _ => text += &format!("\\ensuremath{{\\mathrm{{{}}}}}", ascii(c)),
        }
    }
    text
}

/// Sides on one line, or below each other where a sum is long.
fn equation(sides: &[Side], notation: &Notation) -> String {
    let texts: Vec<String> = sides.iter().map(|side| self::side(side, notation)).collect();
    let one = texts.join(" = ");
    let has_long_sum =
        sides.iter().zip(&texts).any(|(side, text)| matches!(side, Side::Form(_)) && text.len() > LINE);
    let (Some((first, others)), true) = (texts.split_first(), has_long_sum) else { return one };
    let mut lines = Vec::new();
    for (k, (text, side)) in others.iter().zip(&sides[1..]).enumerate() {
        let left = if k == 0 { format!("{first} ={{}}& ") } else { "={}& ".to_owned() };
        match side {
            Side::Form(Form::Sum(terms)) => lines.extend(sum(&left, terms, notation)),
            _ => lines.push(left + text),
        }
    }
    format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", lines.join(" \\\\\n"))
}

/// The terms of a sum in lines.
fn sum(left: &str, terms: &[Form], notation: &Notation) -> Vec<String> {
    let (mut lines, mut line) = (Vec::new(), left.to_owned());
    let mut length = 0;
    for (k, term) in terms.iter().enumerate() {
        let text = term.latex(notation);
        let (sign, text) = match text.strip_prefix('-') {
            Some(rest) => ("-", rest.to_owned()),
            None => ("+", text),
        };
        if k > 0 && length + text.len() > LINE {
            lines.push(std::mem::replace(&mut line, "&\\quad ".to_owned()));
            length = 0;
        }
        line += &match (k, sign) {
            (0, "+") => text.clone(),
            (0, sign) => format!("{sign}{text}"),
            (_, sign) => format!(" {sign} {text}"),
        };
        length += text.len();
    }
    lines.push(line);
    lines
}

fn side(side: &Side, notation: &Notation) -> String {
    match side {
        Side::Math(math) => math.latex.clone(),
        Side::Form(form) => form.latex(notation),
        Side::Matrix(matrix) => matrix.latex(notation),
    }
}
