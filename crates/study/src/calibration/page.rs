//! The page of a calibration.

use report::escaped;
use report::page::Page;
use report::plot::Plot;

use super::figure::charts;
use super::{Calibration, table};

/// What the page says before its figures.
const INTRODUCTION: &str = "\
<p>For each coefficient of restitution e, the page shows the damping ξ whose free vibration is closest on the
same force law. The difference is the sum of squares of |u|/u<sub>ins</sub> (Eq. 18). x is the coefficient of
ξ = −x ln e (Eq. 19), fitted by least squares through the origin. Dashed lines are Eqs. (20) to (22) as
printed.</p>";

/// Makes the page of the calibrations of a wall, by the title of its scene.
pub fn page(title: &str, found: &[Calibration]) -> String {
    let figures: String = charts(found).iter().map(Plot::figure).collect();
    let text: String = found.iter().map(table::text).collect();
    Page::new(&format!("Calibration: {title}"))
        .text(INTRODUCTION)
        .text(&format!(
            "<div class=\"figures\">\n{figures}</div>\n<pre tabindex=\"0\">{}</pre>",
            escaped(&text)
        ))
        .html()
}
