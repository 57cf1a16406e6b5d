//! The verification manual with its results, as a page: `wall verify --html`.

use std::fmt::Write;

use report::{escaped, template};

use super::{Counts, Formula};

/// Writes the manual with the results of `subject`.
pub fn page(subject: &str, formulas: &[Formula], counts: &Counts) -> String {
    let mut sections = String::new();
    for (index, Formula { title, statement, reference, why, checks, .. }) in formulas.iter().enumerate() {
        let [title, statement, reference, why] = [title, statement, reference, why].map(|text| escaped(text));
        let _ = write!(
            sections,
            "<section><h2>{}. {title}</h2>\n<p>{statement}.</p>\n\
             <p>Reference: {reference}. Bound: {why}.</p>\n\
             <div class=\"scroll\"><table><tr><th>case</th><th>quantity</th><th>unit</th>\
             <th>reference</th><th>computed</th><th>error</th><th>bound</th><th>result</th></tr>\n",
            index + 1
        );
        for check in checks {
            let word = check.word();
            let _ = writeln!(
                sections,
                "<tr class=\"{word}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
                 <td>{}</td><td>{word}</td></tr>",
                escaped(&check.case),
                escaped(&check.quantity),
                check.unit,
                number(Some(check.reference)),
                number(check.computed),
                short(check.error()),
                short(Some(check.bound))
            );
        }
        sections.push_str("</table></div></section>\n");
    }
    let (subject, counts) = (escaped(subject), counts.words());
    let parts = [("title", "Verification manual"), ("subject", &*subject), ("counts", &counts)];
    let parts = [&parts[..], &[("sections", &sections)]].concat();
    template::page(include_str!("page.html"), &parts)
}

/// Formats a number of a formula; a missing one is a dash.
pub fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.9e}"))
}

/// Formats an error or a bound; a missing one is a dash.
pub fn short(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.0e}"))
}
