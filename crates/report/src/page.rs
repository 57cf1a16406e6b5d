//! Pages of a title, an introduction and sections, where a template of its own would hold nothing else.
//!
//! ```
//! use report::page::Page;
//!
//! let page = Page::new("Walls < 3 m").text("<p>All <b>two</b>.</p>").section("Results", "<p>1, 2</p>");
//! let html = page.styled("main { max-width: 900px; }").html();
//! assert!(html.contains("<title>Walls &lt; 3 m</title>") && html.contains("<h1>Walls &lt; 3 m</h1>"));
//! assert!(html.contains("<section><h2>Results</h2>\n<p>1, 2</p></section>") && html.contains("<main>"));
//! ```

use crate::{escaped, template};

/// A page that is put together from markup.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    style: String,
    body: String,
}

impl Page {
    /// Creates a page with a title, which is plain text.
    pub fn new(title: &str) -> Self {
        Self { title: escaped(title), style: String::new(), body: String::new() }
    }

    /// Adds rules of style that only this page has.
    #[must_use]
    pub fn styled(mut self, rules: &str) -> Self {
        self.style += rules;
        self.style.push('\n');
        self
    }

    /// Adds markup.
    #[must_use]
    pub fn text(mut self, markup: &str) -> Self {
        self.body += markup;
        self.body.push('\n');
        self
    }

    /// Adds a section of markup under a heading, which is plain text.
    #[must_use]
    pub fn section(self, heading: &str, markup: &str) -> Self {
        self.text(&format!("<section><h2>{}</h2>\n{markup}</section>", escaped(heading)))
    }

    /// Returns the page.
    pub fn html(&self) -> String {
        let parts = [("style", &*self.style), ("title", &*self.title), ("body", &*self.body)];
        template::page("<style>\n{{style}}</style>\n<main>\n<h1>{{title}}</h1>\n{{body}}</main>\n", &parts)
    }
}
