//! Where the wall of a report comes from, and a picture of it.

use ::report::plot::{Locale, Plot};
use run::walls::NamedWall;

use crate::file::CheckFile;
use crate::file::project::ReportTable;
use crate::file::site::Records;
use crate::words::Language;
use crate::words::formulas::markup;
use crate::words::markup::as_written;

/// Width of a figure on a phone \[px\].
const NARROW: f64 = 390.0;

/// Where the wall of a report comes from.
#[derive(Clone, Copy)]
pub struct Origin<'a> {
    /// Title of the wall, or of the file of walls.
    pub title: &'a str,
    /// The wall, where the file has several.
    pub wall: Option<&'a NamedWall>,
    /// Its file.
    pub file: &'a CheckFile<'a>,
    /// What `--set` replaces.
    pub set: &'a [String],
    /// The records that were read.
    pub records: &'a Records,
    /// What the report says of the project, with its date and language.
    pub report: &'a ReportTable,
    /// The program that computes, with its version.
    pub program: &'a str,
}

/// A picture with its caption.
pub struct Figure {
    /// Markup.
    pub caption: String,
    /// Picture.
    pub plot: Plot,
}

impl Figure {
    /// The figure as markup with its legend, and with a form for phones.
    pub fn html(&self, language: Language) -> String {
        let Self { caption, plot } = self;
        let plot = &Plot { locale: locale(language), ..plot.clone() };
        let narrow = Plot { size: [NARROW, 300.0], ..plot.clone() };
        format!(
            "<figure><figcaption>{caption} <span class=\"key\">{}</span></figcaption><div class=\"plot \
             wide\">{}</div><div class=\"plot narrow\">{}</div></figure>\n",
            plot.key(false, markup),
            plot.svg(),
            narrow.svg()
        )
    }
}

/// How pictures write numbers in a language.
pub(crate) fn locale(language: Language) -> Locale {
    match language {
        Language::En => Locale::default(),
        Language::It => Locale { over: "in funzione di", comma: true },
    }
}

impl<'a> Origin<'a> {
    /// The wall of a scene, or the walls of a file, whose parameters nothing replaces.
    pub fn new(
        title: &'a str,
        file: &'a CheckFile<'a>,
        records: &'a Records,
        report: &'a ReportTable,
        program: &'a str,
    ) -> Self {
        Self { title, wall: None, file, set: &[], records, report, program }
    }

    /// Project, revision and wall for the foot of a page.
    pub(crate) fn footer(&self, wall: Option<&str>) -> String {
        let project = self.report.project.as_deref().unwrap_or(self.title);
        let revision = self.report.revision.as_deref().map(|revision| format!("rev. {revision}"));
        let parts = [Some(project), revision.as_deref(), wall];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
    }

    /// The date as markup, as the user gives it.
    pub(crate) fn date(&self) -> String {
        self.report.date.as_deref().map_or_else(String::new, as_written)
    }
}
