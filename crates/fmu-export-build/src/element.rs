//! XML elements with their lines, read and written by quick-xml.

use crate::error::Fault;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, Event};
use quick_xml::{Reader, Writer, XmlVersion};
use std::fmt::Display;

/// Deeper nesting than any description needs is refused.
const MAX_DEPTH: usize = 32;

/// An element: attributes in their order, child elements in theirs. Comments and texts are not kept; an FMI
/// 2.0 description has no texts outside vendor annotations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Element {
    pub(crate) name: String,
    /// 1-based line of the opening tag.
    pub(crate) line: usize,
    pub(crate) attributes: Vec<(String, String)>,
    pub(crate) children: Vec<Element>,
}

impl Element {
    /// An element without children, on no line of a text.
    pub(crate) fn new(name: &str, attributes: &[(&str, &str)]) -> Self {
        let owned = |&(name, value): &(&str, &str)| (name.to_owned(), value.to_owned());
        let attributes = attributes.iter().map(owned).collect();
        Self { name: name.to_owned(), line: 0, attributes, children: Vec::new() }
    }

    /// Reads the root element of the document `text`.
    pub(crate) fn parse(text: &str) -> Result<Self, Fault> {
        let mut reader = Reader::from_str(text);
        let mut lines = LineCounter { text, offset: 0, line: 1 };
        let mut open: Vec<Element> = Vec::new();
        // Bounded by the text: each event consumes some of it.
        loop {
            // A tag's line is the one its `<` is on: text before it is an event of its own.
            let line = lines.line_at(reader.buffer_position());
            let event = reader.read_event().map_err(|error| {
                let mut lines = LineCounter { text, offset: 0, line: 1 };
                malformed(lines.line_at(reader.error_position()), error)
            })?;
            let closed = match event {
                Event::Start(tag) => {
                    if open.len() == MAX_DEPTH {
                        return Err(malformed(line, format!("more than {MAX_DEPTH} nested elements")));
                    }
                    open.push(Element::from_tag(&tag, line)?);
                    None
                }
                Event::Empty(tag) => Some(Element::from_tag(&tag, line)?),
                Event::End(_) => open.pop(),
                Event::DocType(_) => return Err(malformed(line, "a document type is not allowed")),
                Event::Eof => return Err(malformed(line, "the document ends before its root element")),
                // texts, comments and declarations
                _ => None,
            };
            if let Some(element) = closed {
                match open.last_mut() {
                    Some(parent) => parent.children.push(element),
                    None => return Ok(element),
                }
            }
        }
    }

    fn from_tag(tag: &BytesStart<'_>, line: usize) -> Result<Self, Fault> {
        let mut attributes = Vec::new();
        for attribute in tag.attributes() {
            let attribute = attribute.map_err(|error| malformed(line, error))?;
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|error| malformed(line, error))?;
            attributes.push((attribute.key.into_inner().to_owned(), value.into_owned()));
        }
        let name = tag.name().into_inner().to_owned();
        Ok(Self { name, line, attributes, children: Vec::new() })
    }

    /// The document with this root: two blanks per level, no comments, `\n` line ends.
    pub(crate) fn to_xml(&self) -> String {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        let written = writer
            .write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))
            .and_then(|()| self.write(&mut writer));
        assert!(written.is_ok(), "writing to memory does not fail");
        let mut text = String::from_utf8_lossy(&writer.into_inner()).into_owned();
        text.push('\n');
        text
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> std::io::Result<()> {
        let mut tag = BytesStart::new(self.name.as_str());
        for (name, value) in &self.attributes {
            tag.push_attribute((name.as_str(), value.as_str()));
        }
        if self.children.is_empty() {
            return writer.write_event(Event::Empty(tag));
        }
        writer.write_event(Event::Start(tag))?;
        for child in &self.children {
            child.write(writer)?;
        }
        writer.write_event(Event::End(BytesEnd::new(self.name.as_str())))
    }

    /// The value of the attribute `name`.
    pub(crate) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The value of the attribute `name`, which must be there.
    pub(crate) fn required(&self, name: &str) -> Result<&str, Fault> {
        let missing = || self.fault(format!("<{}> needs the attribute `{name}`", self.name));
        self.attribute(name).ok_or_else(missing)
    }

    /// The value of the attribute `name`, if it is there, as a `T`; `expected` describes a `T` in the error.
    pub(crate) fn parsed<T: std::str::FromStr>(
        &self,
        name: &str,
        expected: &str,
    ) -> Result<Option<T>, Fault> {
        let Some(text) = self.attribute(name) else { return Ok(None) };
        text.trim().parse().map(Some).map_err(|_| self.bad_value(name, text, expected))
    }

    /// The value `text` of an attribute is not what is expected.
    pub(crate) fn bad_value(&self, name: &str, text: &str, expected: &str) -> Fault {
        self.fault(format!("{name}=\"{text}\" is not {expected}"))
    }

    /// The index that a checked attribute states.
    pub(crate) fn index(&self, attribute: &str) -> Option<usize> {
        self.attribute(attribute)?.trim().parse().ok()
    }

    /// Sets the attribute `name` to a value. A new attribute goes to the end.
    pub(crate) fn set_attribute(&mut self, name: &str, value: impl Into<String>) {
        match self.attributes.iter_mut().find(|(key, _)| key == name) {
            Some((_, old)) => *old = value.into(),
            None => self.attributes.push((name.to_owned(), value.into())),
        }
    }

    /// The first child element called `name`.
    pub(crate) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    /// The first child element called `name`, which must be there.
    pub(crate) fn required_child(&self, name: &str) -> Result<&Element, Fault> {
        self.child(name).ok_or_else(|| self.missing(name))
    }

    /// A child element called `name` is missing.
    pub(crate) fn missing(&self, name: &str) -> Fault {
        self.fault(format!("<{name}> is missing"))
    }

    /// The children of the first child element called `name`; none if there is no such element.
    pub(crate) fn children_of(&self, name: &str) -> &[Element] {
        self.child(name).map_or(&[], |child| &child.children)
    }

    /// The first child element called `name`, to be changed.
    pub(crate) fn child_mut(&mut self, name: &str) -> Option<&mut Element> {
        self.children.iter_mut().find(|child| child.name == name)
    }

    /// Puts `child` before the first of the children with these names, or else at the end.
    pub(crate) fn insert_before(&mut self, names: &[&str], child: Element) {
        let at = self.children.iter().position(|other| names.contains(&other.name.as_str()));
        self.children.insert(at.unwrap_or(self.children.len()), child);
    }

    /// Refuses an element that is not called `expected`.
    pub(crate) fn expect(&self, expected: &str) -> Result<(), Fault> {
        if self.name == expected { Ok(()) } else { Err(self.unexpected(expected)) }
    }

    /// This element stands where one called `expected` should.
    pub(crate) fn unexpected(&self, expected: &str) -> Fault {
        self.fault(format!("expected <{expected}>, found <{}>", self.name))
    }

    /// A problem on this element's line.
    pub(crate) fn fault(&self, problem: impl Into<String>) -> Fault {
        Fault::new(self.line, problem)
    }
}

fn malformed(line: usize, message: impl Display) -> Fault {
    Fault::new(line, format!("not well-formed XML: {message}"))
}

/// Turns growing byte offsets into line numbers, reading the text once.
struct LineCounter<'a> {
    text: &'a str,
    offset: usize,
    line: usize,
}

impl LineCounter<'_> {
    fn line_at(&mut self, offset: u64) -> usize {
        let offset = usize::try_from(offset).unwrap_or(usize::MAX).min(self.text.len());
        // Only a position inside a character gives no text, and the reader has none.
        self.line += self.text.get(self.offset..offset).unwrap_or_default().matches('\n').count();
        self.offset = offset.max(self.offset);
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_keeps_lines_and_writing_is_canonical() {
        let text =
            "<?xml version=\"1.0\"?>\n<!-- a -->\n<a  x='1'\n y=\"&lt;2\">\n\n  <b/>\n  <c></c>\n</a>\n";
        let root = Element::parse(text).unwrap();
        assert_eq!((root.line, root.children[0].line, root.children[1].line), (3, 6, 7));
        assert_eq!(root.attribute("y"), Some("<2"));
        let written = root.to_xml();
        assert_eq!(
            written,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"1\" y=\"&lt;2\">\n  <b/>\n  <c/>\n</a>\n"
        );
        assert_eq!(Element::parse(&written).unwrap().to_xml(), written);
    }

    #[test]
    fn what_is_not_well_formed_is_refused_with_its_line() {
        for (text, line) in [
            ("<a>\n<b>\n</a>", 3),
            ("<a>\n", 2),
            ("", 1),
            ("<a>\n<b x=1/></a>", 2),
            ("<a>\n<b x='1' x='2'/></a>", 2),
            ("<!DOCTYPE a>\n<a/>", 1),
        ] {
            let fault = Element::parse(text).unwrap_err();
            assert!(fault.problem.starts_with("not well-formed XML"), "{text}: {fault}");
            assert_eq!(fault.line, line, "{text}: {fault}");
        }
    }

    #[test]
    fn nesting_is_bounded() {
        let fault = Element::parse(&"<a>".repeat(MAX_DEPTH + 1)).unwrap_err();
        assert!(fault.to_string().contains("32 nested"), "{fault}");
    }
}
