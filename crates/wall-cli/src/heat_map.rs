//! Heat maps as inline SVG: cells in colours with a title each, two axes, and the scale of the colours.

use std::fmt::Write;

/// Margins around the cells \[px\].
const LEFT: f64 = 62.0;
const RIGHT: f64 = 8.0;
const BOTTOM: f64 = 44.0;
const TOP: f64 = 6.0;

/// A map of cells, the first row at the bottom.
pub(crate) struct HeatMap<'a> {
    /// What it shows, for those who cannot see it.
    pub(crate) label: String,
    pub(crate) columns: Axis,
    pub(crate) rows: Axis,
    /// Width and height of a cell \[px\].
    pub(crate) cell: [f64; 2],
    /// The cell of a row and a column.
    pub(crate) paint: &'a dyn Fn(usize, usize) -> Paint,
}

/// An axis: its label, the number of cells along it, and marks at places counted in cells from its start.
pub(crate) struct Axis {
    pub(crate) label: String,
    pub(crate) count: usize,
    pub(crate) ticks: Vec<(f64, String)>,
}

/// How a cell looks and what it says when pointed at.
pub(crate) struct Paint {
    pub(crate) fill: String,
    pub(crate) title: String,
    pub(crate) crossed: bool,
}

impl Axis {
    /// An axis of evenly spaced values at the middles of its cells, marked at round numbers.
    pub(crate) fn even(label: &str, values: &[f64]) -> Self {
        let count = values.len();
        let mut ticks = Vec::new();
        if let [first, .., last] = *values {
            let step = round_step((last - first) / 7.0);
            let mut tick = (first / step - 1e-9).ceil() * step;
            while tick <= last + 1e-9 * step && ticks.len() < 20 {
                let place = (tick - first) / (last - first) * (count as f64 - 1.0) + 0.5;
                ticks.push((place, shortened(tick, step)));
                tick += step;
            }
        }
        Self { label: label.to_owned(), count, ticks }
    }
}

/// 1, 2 or 5 times a power of ten, at least `least`.
pub(crate) fn round_step(least: f64) -> f64 {
    let power = 10.0_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= least)
        .unwrap_or(least)
}

/// A tick with as many decimals as its step has.
fn shortened(tick: f64, step: f64) -> String {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 12 decimals")]
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    format!("{tick:.decimals$}")
}

impl HeatMap<'_> {
    pub(crate) fn draw(&self) -> String {
        let [width, height] = self.cell;
        let bottom = TOP + height * self.rows.count as f64;
        let right = LEFT + width * self.columns.count as f64;
        let mut svg = format!(
            "<svg viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" aria-label=\"{}\">",
            right + RIGHT,
            bottom + BOTTOM,
            self.label
        );
        for row in 0..self.rows.count {
            let y = bottom - height * (row + 1) as f64;
            for column in 0..self.columns.count {
                self.draw_cell(&mut svg, [LEFT + width * column as f64, y], (self.paint)(row, column));
            }
        }
        let _ = write!(
            svg,
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{:.0}\" height=\"{:.0}\" class=\"frame\"/>",
            right - LEFT,
            bottom - TOP
        );
        for (place, text) in &self.rows.ticks {
            let (x, y) = (LEFT - 5.0, bottom - height * place + 4.0);
            let _ = write!(svg, "<text x=\"{x:.0}\" y=\"{y:.1}\" text-anchor=\"end\">{text}</text>");
        }
        for (place, text) in &self.columns.ticks {
            let (x, y) = (LEFT + width * place, bottom + 15.0);
            let _ = write!(svg, "<text x=\"{x:.1}\" y=\"{y:.0}\" text-anchor=\"middle\">{text}</text>");
        }
        let _ = write!(
            svg,
            "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\">{}</text><text transform=\"translate(12 {:.0}) rotate(-90)\" \
             text-anchor=\"middle\">{}</text></svg>",
            0.5 * (LEFT + right),
            bottom + 34.0,
            self.columns.label,
            0.5 * (TOP + bottom),
            self.rows.label
        );
        svg
    }

    fn draw_cell(&self, svg: &mut String, [x, y]: [f64; 2], paint: Paint) {
        let [width, height] = self.cell;
        let Paint { fill, title, crossed } = paint;
        let _ = write!(
            svg,
            "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"><title>{title}</title></rect>"
        );
        if crossed {
            let _ = write!(
                svg,
                "<path d=\"M{:.0} {:.0}l{:.0} {:.0}m0 {:.0}l{:.0} {:.0}\" class=\"cross\"/>",
                x + 8.0,
                y + 5.0,
                width - 16.0,
                height - 10.0,
                10.0 - height,
                16.0 - width,
                height - 10.0
            );
        }
    }
}

/// A colour between those of `stops`, evenly spaced over shares from 0 to 1.
pub(crate) fn mixed(stops: &[[f64; 3]], share: f64) -> String {
    let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the last but one")]
    let index = (place as usize).min(stops.len() - 2);
    let part = place - index as f64;
    let mix =
        |channel: usize| stops[index][channel] + (stops[index + 1][channel] - stops[index][channel]) * part;
    format!("rgb({:.0},{:.0},{:.0})", mix(0), mix(1), mix(2))
}

/// The scale of colours: swatches side by side, some with a text below.
pub(crate) fn scale(label: &str, swatches: &[(String, Option<String>)]) -> String {
    let width = 26.0;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {:.0} 44\" class=\"scale\" role=\"img\" aria-label=\"{label}\">",
        width * swatches.len() as f64 + 30.0
    );
    for (index, (fill, text)) in swatches.iter().enumerate() {
        let x = 10.0 + width * index as f64;
        let _ =
            write!(svg, "<rect x=\"{x:.0}\" y=\"2\" width=\"{width:.0}\" height=\"18\" fill=\"{fill}\"/>");
        if let Some(text) = text {
            let middle = x + 0.5 * width;
            let _ = write!(svg, "<text x=\"{middle:.0}\" y=\"38\" text-anchor=\"middle\">{text}</text>");
        }
    }
    svg + "</svg>"
}
