//! A page about a robot: text, tables, equations and pictures in sections, and the robot itself, to be moved by hand.
//!
//! The page is one file of HTML, which asks no network for anything. It is read by people, in print too, and by screen
//! readers; without scripts all of it is there but the moving robot. Same input, same bytes.

mod html;
mod number;
mod stage;
mod table;

pub use number::number;
pub use stage::{Handle, HandleKind, Stage};
pub use table::{Cell, Matrix, Pattern, Table};

use crate::embed::{embedded, filled, script};
use crate::error::Error;
use crate::figure::Figure;
use crate::{style, svg};
use html::Html;

const PAGE: &str = include_str!("../viewer/report.html");
/// What the script has that is of such pages alone; the rest is shared with films.
const OF_PAGES: [&str; 2] = [include_str!("../viewer/linkage.js"), include_str!("../viewer/report.js")];

/// A page of sections.
///
/// # Example
///
/// ```
/// use dynamics_view::page::{Page, Section, Table};
///
/// let masses = Table::new("Masses", "lr").head(["body", "mass, kg"]).row(["pole", "0.1"]);
/// let section = Section::new("parameters", "Parameters").text("Of the `pole` alone.").table(masses);
/// let html = Page::new("A pole").section(section).html()?;
/// assert!(html.contains("<code>pole</code>") && html.contains(r##"<a href="#parameters">"##));
/// # Ok::<(), dynamics_view::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    summary: Vec<String>,
    sections: Vec<Section>,
    stage: Option<Stage>,
    footer: String,
}

/// A part of a page, with a heading.
#[derive(Clone, Debug)]
pub struct Section {
    id: String,
    title: String,
    parts: Vec<Part>,
}

/// What a section is made of. In text, what stands between backticks is set as code.
#[derive(Clone, Debug)]
enum Part {
    Text(String),
    Remark(String),
    Heading(String),
    Facts(Vec<[String; 2]>),
    List(Vec<String>),
    Preformatted { label: String, text: String },
    Table(Table),
    Matrix(Matrix),
    Pattern(Pattern),
    Equation(Equation),
    Figure { title: String, figure: Figure },
    Robot,
    Swing,
}

/// An equation, displayed, and its source.
#[derive(Clone, Debug)]
pub struct Equation {
    /// What it is, in words.
    pub title: String,
    /// The element `<math>`. It goes into the page as it is.
    pub mathml: String,
    /// The same in LaTeX.
    pub latex: String,
}

impl Page {
    /// An empty page.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self {
            title: title.to_owned(),
            summary: vec![],
            sections: vec![],
            stage: None,
            footer: String::new(),
        }
    }

    /// With one more paragraph below the title.
    #[must_use]
    pub fn summary(mut self, text: &str) -> Self {
        self.summary.push(text.to_owned());
        self
    }

    /// With a robot, for [`Section::robot`] and [`Section::swing`].
    #[must_use]
    pub fn with_stage(mut self, stage: Stage) -> Self {
        self.stage = Some(stage);
        self
    }

    /// With a section below those before it.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// With a line at the end: what made the page.
    #[must_use]
    pub fn footer(mut self, text: &str) -> Self {
        text.clone_into(&mut self.footer);
        self
    }

    /// The page.
    ///
    /// # Errors
    ///
    /// Those of [`Figure::svg`] for its figures; [`Error::Empty`] of a page without sections, or with a place for a robot
    /// and none to stand there; those of the robot: [`Error::LinkUnconnected`], [`Error::BodyUnconnected`],
    /// [`Error::BodyUnknown`], [`Error::LengthsDiffer`], [`Error::NotDrawable`], [`Error::TimesNotIncreasing`].
    pub fn html(&self) -> Result<String, Error> {
        if self.sections.is_empty() {
            return Err(Error::Empty { what: format!("the page `{}`", self.title) });
        }
        let (data, script) = match &self.stage {
            Some(stage) => (embedded(&stage.data()?), script(OF_PAGES)),
            None => ("null".to_owned(), String::new()),
        };
        let mut contents = Html::default();
        let mut sections = Html::default();
        for section in &self.sections {
            contents.contents_entry(&section.id, &section.title);
            self.put(section, &mut sections)?;
        }
        let mut summary = Html::default();
        self.summary.iter().for_each(|text| summary.text(text));
        let style = [style::PALETTE, style::CHART, include_str!("../viewer/stage.css"), STYLE].concat();
        let parts = [
            ("{title}", svg::escaped(&self.title)),
            ("{style}", style),
            ("{summary}", summary.done()),
            ("{contents}", contents.done()),
            ("{sections}", sections.done()),
            ("{footer}", html::inline(&self.footer)),
            ("{data}", data),
            ("{script}", script),
        ];
        Ok(filled(PAGE, &parts))
    }

    fn put(&self, section: &Section, html: &mut Html) -> Result<(), Error> {
        html.begin(&section.id, &section.title);
        let robot = || {
            let what = format!("the robot of the page `{}`", self.title);
            self.stage.as_ref().ok_or(Error::Empty { what })
        };
        for (k, part) in section.parts.iter().enumerate() {
            let id = format!("{}-{}", section.id, k + 1);
            match part {
                Part::Text(text) => html.text(text),
                Part::Remark(text) => html.remark(text),
                Part::Heading(text) => html.heading(text),
                Part::Facts(facts) => html.facts(facts),
                Part::List(items) => html.list(items),
                Part::Preformatted { label, text } => html.preformatted(label, text),
                Part::Table(table) => table.write(html),
                Part::Matrix(matrix) => matrix.write(html, &id)?,
                Part::Pattern(pattern) => pattern.write(html)?,
                Part::Equation(equation) => html.equation(equation, &id),
                Part::Figure { title, figure } => html.figure(&figure.fragment(title)?),
                Part::Robot => robot()?.write_bench(html),
                Part::Swing => robot()?.write_swing(html)?,
            }
        }
        html.end();
        Ok(())
    }
}

const STYLE: &str = include_str!("../viewer/report.css");

impl Section {
    /// An empty section; `id` is what links name, of letters, digits and hyphens.
    #[must_use]
    pub fn new(id: &str, title: &str) -> Self {
        Self { id: id.to_owned(), title: title.to_owned(), parts: vec![] }
    }

    /// With a paragraph.
    #[must_use]
    pub fn text(self, text: &str) -> Self {
        self.with(Part::Text(text.to_owned()))
    }

    /// With a paragraph of less weight.
    #[must_use]
    pub fn remark(self, text: &str) -> Self {
        self.with(Part::Remark(text.to_owned()))
    }

    /// With a heading within the section.
    #[must_use]
    pub fn heading(self, text: &str) -> Self {
        self.with(Part::Heading(text.to_owned()))
    }

    /// With facts: each what it is of, and what it is.
    #[must_use]
    pub fn facts(self, facts: impl IntoIterator<Item = [String; 2]>) -> Self {
        self.with(Part::Facts(facts.into_iter().collect()))
    }

    /// With a list.
    #[must_use]
    pub fn list(self, items: impl IntoIterator<Item = String>) -> Self {
        self.with(Part::List(items.into_iter().collect()))
    }

    /// With text whose lines and columns stay as they are.
    #[must_use]
    pub fn preformatted(self, label: &str, text: &str) -> Self {
        self.with(Part::Preformatted { label: label.to_owned(), text: text.to_owned() })
    }

    /// With a table.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.with(Part::Table(table))
    }

    /// With a matrix of numbers.
    #[must_use]
    pub fn matrix(self, matrix: Matrix) -> Self {
        self.with(Part::Matrix(matrix))
    }

    /// With the structure of a matrix, drawn.
    #[must_use]
    pub fn pattern(self, pattern: Pattern) -> Self {
        self.with(Part::Pattern(pattern))
    }

    /// With an equation.
    #[must_use]
    pub fn equation(self, equation: Equation) -> Self {
        self.with(Part::Equation(equation))
    }

    /// With charts; the title is for those who do not see them.
    #[must_use]
    pub fn figure(self, title: &str, figure: Figure) -> Self {
        self.with(Part::Figure { title: title.to_owned(), figure })
    }

    /// With the robot, its handles, and where its bodies are.
    #[must_use]
    pub fn robot(self) -> Self {
        self.with(Part::Robot)
    }

    /// With the robot's motion, its charts, and what plays it.
    #[must_use]
    pub fn swing(self) -> Self {
        self.with(Part::Swing)
    }

    fn with(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }
}
