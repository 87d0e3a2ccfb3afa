//! Elements of a page, written from top to bottom.

use std::fmt::Write as _;

use super::Equation;
use crate::svg::escaped;

/// HTML in the making.
#[derive(Default)]
pub(super) struct Html(String);

/// Text within a line: escaped, and code where it stands between backticks.
pub(super) fn inline(text: &str) -> String {
    let mut out = String::new();
    for (k, part) in text.split('`').enumerate() {
        // The last backtick of an odd number has no partner, and is none.
        let is_code = k % 2 == 1 && text.matches('`').count() > k;
        match is_code {
            true => out += &format!("<code>{}</code>", escaped(part)),
            false if k % 2 == 1 => out += &format!("`{}", escaped(part)),
            false => out += &escaped(part),
        }
    }
    out
}

impl Html {
    /// An element as it is.
    pub(super) fn put(&mut self, element: &str) {
        let _ = writeln!(self.0, "{element}");
    }

    pub(super) fn done(self) -> String {
        self.0
    }

    pub(super) fn begin(&mut self, id: &str, title: &str) {
        self.put(&format!(r#"<section id="{id}" aria-labelledby="{id}-title">"#));
        self.put(&format!(r#"<h2 id="{id}-title">{}</h2>"#, inline(title)));
    }

    pub(super) fn end(&mut self) {
        self.put("</section>");
    }

    pub(super) fn contents_entry(&mut self, id: &str, title: &str) {
        self.put(&format!(r##"<li><a href="#{id}">{}</a></li>"##, inline(title)));
    }

    pub(super) fn text(&mut self, text: &str) {
        self.put(&format!("<p>{}</p>", inline(text)));
    }

    pub(super) fn remark(&mut self, text: &str) {
        self.put(&format!(r#"<p class="remark">{}</p>"#, inline(text)));
    }

    pub(super) fn heading(&mut self, text: &str) {
        self.put(&format!("<h3>{}</h3>", inline(text)));
    }

    pub(super) fn facts(&mut self, facts: &[[String; 2]]) {
        self.put(r#"<dl class="facts">"#);
        for [what, fact] in facts {
            self.put(&format!("<div><dt>{}</dt><dd>{}</dd></div>", inline(what), inline(fact)));
        }
        self.put("</dl>");
    }

    pub(super) fn list(&mut self, items: &[String]) {
        self.put("<ul>");
        items.iter().for_each(|item| self.put(&format!("<li>{}</li>", inline(item))));
        self.put("</ul>");
    }

    pub(super) fn preformatted(&mut self, label: &str, text: &str) {
        let lines: Vec<String> = text.lines().map(escaped).collect();
        self.put(&format!(
            r#"<pre tabindex="0" role="group" aria-label="{}">{}</pre>"#,
            escaped(label),
            lines.join("\n")
        ));
    }

    /// The equation, to be scrolled where it is too wide, and its source below.
    pub(super) fn equation(&mut self, Equation { title, mathml, latex }: &Equation, id: &str) {
        let lines: Vec<String> = latex.lines().map(escaped).collect();
        self.put(&format!(
            r#"<div class="equation"><p class="name" id="{id}-name">{title} <button type="button" class="copy script-only" data-of="{id}" aria-label="copy the LaTeX of: {title}">copy LaTeX</button></p>
<div class="display" role="group" tabindex="0" aria-labelledby="{id}-name">
{mathml}
</div>
<details><summary>LaTeX<span class="unseen"> of: {title}</span></summary>
<pre tabindex="0"><code id="{id}">{}</code></pre>
</details></div>"#,
            lines.join("\n"),
            title = escaped(title),
        ));
    }

    pub(super) fn figure(&mut self, svg: &str) {
        self.put(&format!(r#"<div class="figure beside">{svg}</div>"#));
    }
}

#[cfg(test)]
mod tests {
    use super::inline;

    #[test]
    fn code_is_between_two_backticks() {
        assert_eq!(inline("a `b<` c"), "a <code>b&lt;</code> c");
        assert_eq!(inline("a ` b"), "a ` b");
        assert_eq!(inline("`a` `b"), "<code>a</code> `b");
    }
}
