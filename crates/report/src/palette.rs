//! Colours and marks. Colour-blind readers can tell them apart.
//!
//! All but `PALE` have a contrast of at least 3 to a white page and, inverted, to a dark one.
//!
//! ```
//! use report::palette::{BLUE, SERIES, mixed};
//!
//! assert_eq!(SERIES[0].0, BLUE);
//! assert_eq!(mixed(&[[0.0, 0.0, 0.0], [200.0, 100.0, 0.0]], 0.5), "rgb(100,50,0)");
//! ```

#![allow(missing_docs, reason = "a colour's name says it")]

/// A mark at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Circle,
    Square,
    Triangle,
    TriangleDown,
    Diamond,
    Cross,
    Plus,
    Star,
    /// A dot that others show through: where dots of several series lie on each other, it is darker.
    Dot,
}

impl Mark {
    /// Returns its outline as a path relative to its middle, for a circle of a radius \[px\] and marks that
    /// look as large.
    pub(crate) fn outline(self, radius: f64) -> String {
        let r = radius;
        let plus = format!("m{0:.1} 0h{1:.1}m{0:.1}{0:.1}v{1:.1}", -1.2 * r, 2.4 * r);
        let cross =
            |r: f64| format!("m{0:.1}{0:.1}l{1:.1} {1:.1}m0{2:.1}l{2:.1} {1:.1}", -r, 2.0 * r, -2.0 * r);
        match self {
            Self::Circle => format!(
                "m{0:.1} 0a{r:.1} {r:.1} 0 1 0 {1:.1} 0a{r:.1} {r:.1} 0 1 0{2:.1} 0",
                -r,
                2.0 * r,
                -2.0 * r
            ),
            Self::Square => format!("m{0:.1}{0:.1}h{1:.1}v{1:.1}h{2:.1}z", -0.9 * r, 1.8 * r, -1.8 * r),
            Self::Triangle => format!("m0{:.1}l{:.1} {:.1}h{:.1}z", -1.2 * r, 1.2 * r, 2.1 * r, -2.4 * r),
            Self::TriangleDown => format!("m0 {:.1}l{:.1}{:.1}h{:.1}z", 1.2 * r, 1.2 * r, -2.1 * r, -2.4 * r),
            Self::Diamond => format!(
                "m0{0:.1}l{1:.1} {2:.1}l{3:.1} {2:.1}l{3:.1}{0:.1}z",
                -1.35 * r,
                1.2 * r,
                1.35 * r,
                -1.2 * r
            ),
            Self::Cross => cross(0.9 * r),
            Self::Plus => plus,
            Self::Dot => "h0".to_owned(),
            Self::Star => format!("{plus}m{:.1}{:.1}{}", 0.0, -1.2 * r, cross(0.8 * r)),
        }
    }
}

/// The response, and whatever comes first.
pub const BLUE: &str = "#1f5fa8";
/// Limits, and what is compared with the response.
pub const RED: &str = "#c8440f";
pub const GREEN: &str = "#009e73";
pub const PURPLE: &str = "#cc67ae";
pub const AMBER: &str = "#b57b00";
/// Ground motions.
pub const DARK_GREY: &str = "#4d4d4d";
pub const TEAL: &str = "#00838f";
pub const BROWN: &str = "#6d4c41";
/// References in the background.
pub const GREY: &str = "#777777";
/// One of many.
pub const PALE: &str = "#b5b5b5";
pub const BLACK: &str = "#000000";

/// Colour and mark of the series of a chart in turn.
pub const SERIES: [(&str, Mark); 8] = [
    (BLUE, Mark::Circle),
    (RED, Mark::Square),
    (GREEN, Mark::Triangle),
    (PURPLE, Mark::Diamond),
    (AMBER, Mark::Cross),
    (BLACK, Mark::Plus),
    (TEAL, Mark::TriangleDown),
    (BROWN, Mark::Star),
];

/// Returns a mark as a character.
pub fn character(mark: Mark) -> &'static str {
    match mark {
        Mark::Square => "■",
        Mark::Triangle => "▲",
        Mark::Diamond => "◆",
        Mark::Cross => "✕",
        Mark::Plus => "✚",
        Mark::TriangleDown => "▼",
        Mark::Star => "★",
        Mark::Circle | Mark::Dot => "●",
    }
}

/// Returns a mark in its colour for the text of a page.
///
/// ```
/// use report::palette::{BLUE, Mark, sign};
///
/// assert_eq!(sign(BLUE, Mark::Circle), "<b class=\"chip\" style=\"color:#1f5fa8\">●</b>");
/// ```
pub fn sign(color: &str, mark: Mark) -> String {
    let character = character(mark);
    format!("<b class=\"chip\" style=\"color:{color}\">{character}</b>")
}

/// Returns the sample of a line in its colour for the text of a page; `style` is solid, dashed or dotted.
pub fn stroke(color: &str, style: &str) -> String {
    format!("<i class=\"chip line\" style=\"border-top:2px {style} {color}\"></i>")
}

/// Mixes a colour from `stops` (red, green, blue from 0 to 255), evenly spaced over shares from 0 to 1.
pub fn mixed(stops: &[[f64; 3]], share: f64) -> String {
    let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the last but one")]
    let index = (place as usize).min(stops.len() - 2);
    let part = place - index as f64;
    let mix =
        |channel: usize| stops[index][channel] + (stops[index + 1][channel] - stops[index][channel]) * part;
    format!("rgb({:.0},{:.0},{:.0})", mix(0), mix(1), mix(2))
}
