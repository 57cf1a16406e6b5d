//! The page of `wall study spectrum`.

use super::figure::{FALLEN, STILL, Shown, legend, map, own_words};
use report::{escaped, template};

/// What the plot area should measure \[px\].
const AREA: [f64; 2] = [960.0, 560.0];

/// Makes the page of a spectrum.
pub fn page(shown: &Shown) -> String {
    let own = shown.own.as_ref().map_or_else(String::new, |own| {
        format!("<p><b>Your wall:</b> {}.</p>", escaped(&own_words(shown, own)))
    });
    template::page(
        include_str!("page.html"),
        &[
            ("title", &escaped(&shown.title)),
            ("subtitle", &escaped(&shown.notes.join("; "))),
            ("axes", &escaped(&shown.axes)),
            ("own", &own),
            ("still", STILL),
            ("fallen", FALLEN),
            ("scale", &legend()),
            ("map", &map(shown, AREA, true).0),
        ],
    )
}
