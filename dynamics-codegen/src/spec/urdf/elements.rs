//! Elements and attributes with their places.

use super::source::{Source, quoted};
use crate::diagnostics::Place;

/// An element of the document.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    pub(super) node: roxmltree::Node<'a, 'a>,
    pub(super) source: &'a Source<'a>,
}

/// The value of an attribute.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    /// The attribute.
    pub(super) name: &'a str,
    /// Its element.
    pub(super) tag: &'a str,
    /// As written, unless references like `&lt;` stand for something else.
    pub(super) value: &'a str,
    offset: usize,
    is_as_written: bool,
    source: &'a Source<'a>,
}

impl<'a> Element<'a> {
    /// Its name, without a prefix.
    pub(super) fn tag(&self) -> &'a str {
        self.node.tag_name().name()
    }

    /// Where it begins.
    pub(super) fn place(&self) -> Place {
        self.source.place(self.node.range().start)
    }

    /// Whether it belongs to xacro.
    pub(super) fn is_xacro(&self) -> bool {
        self.node.tag_name().namespace().is_some_and(|uri| uri.contains("xacro"))
    }

    /// Whether it has the prefix of the document's root, mostly none.
    pub(super) fn is_plain(&self) -> bool {
        self.node.tag_name().namespace() == self.node.document().root_element().tag_name().namespace()
    }

    /// The elements directly within.
    pub(super) fn children(&self) -> impl Iterator<Item = Element<'a>> + use<'a> {
        let source = self.source;
        self.node.children().filter(|node| node.is_element()).map(move |node| Element { node, source })
    }

    /// The elements within, however deep, and this one.
    pub(super) fn descendants(&self) -> impl Iterator<Item = Element<'a>> + use<'a> {
        let source = self.source;
        self.node.descendants().filter(|node| node.is_element()).map(move |node| Element { node, source })
    }

    /// The text within.
    pub(super) fn content(&self) -> &'a str {
        self.node.text().unwrap_or_default().trim()
    }

    /// Its attributes without prefix.
    pub(super) fn texts(&self) -> impl Iterator<Item = Text<'a>> + use<'a> {
        let (source, tag) = (self.source, self.tag());
        self.node.attributes().filter(|attribute| attribute.namespace().is_none()).map(move |attribute| {
            let range = attribute.range_value();
            let offset = range.start;
            let raw = source.text().get(range).unwrap_or_default();
            let value = attribute.value();
            Text {
                name: attribute.name(),
                tag,
                value,
                offset,
                is_as_written: raw.len() == value.len(),
                source,
            }
        })
    }
}

impl<'a> Text<'a> {
    /// Where the value begins.
    pub(super) fn place(&self) -> Place {
        self.source.place(self.offset)
    }

    /// The words of the value, each with its place.
    pub(super) fn words(&self) -> impl Iterator<Item = (&'a str, Place)> + use<'a> {
        let Self { value, offset, is_as_written, source, .. } = *self;
        value.split_ascii_whitespace().map(move |word| {
            let within = if is_as_written { word.as_ptr() as usize - value.as_ptr() as usize } else { 0 };
            (word, source.place(offset + within))
        })
    }

    /// As in "`xyz` in `<origin>`".
    pub(super) fn what(&self) -> String {
        format!("{} in `<{}>`", quoted(self.name), self.tag)
    }
}
