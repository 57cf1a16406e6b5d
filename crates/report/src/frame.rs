//! The axes around a plot, and its legend.

use std::fmt::Write;

use crate::axes::{Scale, label, number, ticks, write_text, write_upwards};
use crate::escaped;
use crate::points::Point;
use crate::series::{Look, Series};

/// Width of a character of 12 px, about \[px\].
pub(crate) const CHARACTER: f64 = 7.1;
/// Space that a number takes on the horizontal and the vertical axis, at least \[px\].
const BETWEEN_NUMBERS: [f64; 2] = [70.0, 30.0];
/// Exponents of ten between the numbers of a vertical axis that counts them.
const EXPONENTS: f64 = 3.0;
/// Ratio of the ends of a logarithmic axis up to which it has numbers between the powers of ten.
const FEW: f64 = 1.1e3;
/// Distance of the legend from the sides of the plot area, height of its rows, length of its samples \[px\].
pub(crate) const LEGEND: f64 = 8.0;
const ROW: f64 = 18.0;
const SAMPLE: f64 = 20.0;

/// A plot area with its axes.
pub(crate) struct Frame<'a> {
    /// Width and height of the plot \[px\].
    pub(crate) size: [f64; 2],
    /// Space around the plot area \[px\]: left, right, top, bottom.
    pub(crate) margins: [f64; 4],
    /// Ends of the axes.
    pub(crate) ranges: [[f64; 2]; 2],
    pub(crate) labels: [&'a str; 2],
    pub(crate) scale: Scale,
    /// Size of the numbers on the axes \[px\].
    pub(crate) number_size: f64,
    /// Whether numbers have a decimal comma.
    pub(crate) comma: bool,
    /// Numbers on both axes with their texts, in place of round ones.
    pub(crate) numbers: Option<[Vec<(f64, String)>; 2]>,
}

impl Frame<'_> {
    /// Sides of the plot area \[px\]: left, right, top, bottom.
    pub(crate) fn area(&self) -> [f64; 4] {
        let ([width, height], [left, right, top, bottom]) = (self.size, self.margins);
        [left, width - right, top, height - bottom]
    }

    /// Returns the place of a point \[px\].
    pub(crate) fn place(&self, (x, y): Point) -> [f64; 2] {
        let ([left, right, top, bottom], [across, up]) = (self.area(), self.ranges);
        let part = |value: f64, [low, high]: [f64; 2]| (value - low) / (high - low);
        let across = match self.scale {
            Scale::Linear => part(x, across),
            Scale::LogarithmicAcross | Scale::Logarithmic => part(x.log10(), across.map(f64::log10)),
        };
        [left + (right - left) * across, bottom - (bottom - top) * part(y, up)]
    }

    /// Returns the number of characters of the longest number on the vertical axis.
    pub(crate) fn longest_number(&self) -> f64 {
        let [_, numbers] = self.numbers();
        numbers.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0) as f64
    }

    /// Returns the numbers on both axes, with their texts.
    fn numbers(&self) -> [Vec<(f64, String)>; 2] {
        if let Some(numbers) = &self.numbers {
            return numbers.clone();
        }
        let ([left, right, top, bottom], [across, up]) = (self.area(), self.ranges);
        let count = [(right - left) / BETWEEN_NUMBERS[0], (bottom - top) / BETWEEN_NUMBERS[1]];
        let mut numbers = match self.scale {
            Scale::Linear => [ticks(across, count[0]), ticks(up, count[1])],
            Scale::LogarithmicAcross => [logarithmic(across, count[0]), ticks(up, count[1])],
            Scale::Logarithmic => {
                let powers = multiples(EXPONENTS, up);
                [decades(across, &[1.0]), powers.map(|power| (power, power_of_ten(power))).collect()]
            }
        };
        if self.comma {
            numbers.iter_mut().flatten().for_each(|(_, text)| *text = text.replace('.', ","));
        }
        numbers
    }

    /// Draws the axes with their numbers and labels around what is drawn inside, cut off at the plot area.
    pub(crate) fn around(&self, inside: &str) -> String {
        let [left, right, top, bottom] = self.area();
        let [across, up] = self.numbers();
        let (mut grid, mut notches, mut texts) = (String::new(), String::new(), String::new());
        for (value, text) in across {
            let [x, _] = self.place((value, self.ranges[1][0]));
            let _ = write!(grid, "M{x:.2} {top}V{bottom}");
            let _ = write!(notches, "M{x:.2} {bottom}v5");
            write_text(&mut texts, [x, bottom + 4.0 + self.number_size], "middle", &text);
        }
        for (value, text) in up {
            let [_, y] = self.place((self.ranges[0][0], value));
            let _ = write!(grid, "M{left:.2} {y:.2}H{right}");
            let _ = write!(notches, "M{left:.2} {y:.2}h-5");
            write_text(&mut texts, [left - 8.0, y + 0.36 * self.number_size], "end", &text);
        }
        // an area of one place and size has one name, so that several on a page may share it
        let name = format!("area-{left:.0}-{right:.0}-{top:.0}-{bottom:.0}");
        let mut labels = String::new();
        let [x_label, y_label] = self.labels.map(label);
        write_text(&mut labels, [0.5 * (left + right), self.size[1] - 8.0], "middle", &x_label);
        write_upwards(&mut labels, [17.0, 0.5 * (top + bottom)], &y_label);
        format!(
            "<clipPath id=\"{name}\"><rect x=\"{left:.2}\" y=\"{top}\" width=\"{:.2}\" height=\"{:.2}\"/>\
             </clipPath><path d=\"{grid}\" stroke=\"#ccc\" fill=\"none\"/>\
             <path d=\"M{left:.2} {top}V{bottom}H{right}{notches}\" stroke=\"#000\" fill=\"none\"/>\
             <g font-size=\"{}\">{texts}</g><g font-size=\"14\">{labels}</g>\
             <g clip-path=\"url(#{name})\">{inside}</g>",
            right - left,
            bottom - top,
            self.number_size,
        )
    }
}

/// Returns the multiples of a whole number within a range.
fn multiples(step: f64, [low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let first = (low / step - 1e-9).ceil();
    let multiples = (0..400).map(move |k| (first + f64::from(k)) * step);
    multiples.take_while(move |value| *value <= high + 1e-9)
}

/// Powers of ten within a range, times each of some factors, with their texts.
fn decades(range: [f64; 2], factors: &[f64]) -> Vec<(f64, String)> {
    let [low, high] = range.map(f64::log10);
    let of = |power: f64| factors.iter().map(move |factor| factor * 10.0_f64.powf(power));
    let values = multiples(1.0, [low.floor(), high]).flat_map(of);
    let inside = values.filter(|value| (low - 1e-9..=high + 1e-9).contains(&value.log10()));
    inside.map(|value| (value, number(value, 9))).collect()
}

/// Numbers of a logarithmic axis: 1, 2 and 5 times powers of ten over a few decades, over many the powers.
/// Between two of these, round numbers, about `count` of them.
fn logarithmic(range: [f64; 2], count: f64) -> Vec<(f64, String)> {
    let factors: &[f64] = if range[1] > FEW * range[0] { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let numbers = decades(range, factors);
    if numbers.len() < 2 { ticks(range, count) } else { numbers }
}

fn power_of_ten(exponent: f64) -> String {
    if exponent == 0.0 { "1".to_owned() } else { format!("1e{exponent:.0}") }
}

/// The height of a legend of some rows \[px\].
pub(crate) fn legend_height(rows: usize) -> f64 {
    ROW * rows as f64 + 10.0
}

/// Adds a legend of the series that have names, at the top right of a plot area.
pub(crate) fn legend(svg: &mut String, series: &[Series], [_, right, top, _]: [f64; 4]) {
    let named: Vec<_> = series.iter().filter(|series| !series.name.is_empty()).collect();
    let Some(longest) = named.iter().map(|series| series.name.chars().count()).max() else { return };
    let width = CHARACTER * longest as f64 + SAMPLE + 3.0 * LEGEND;
    let (left, top) = (right - LEGEND - width, top + LEGEND);
    let _ = write!(
        svg,
        "<rect x=\"{left:.2}\" y=\"{top}\" width=\"{width:.2}\" height=\"{:.0}\" fill=\"#fff\" \
         stroke=\"#000\"/><g font-size=\"12\">",
        legend_height(named.len())
    );
    for (index, series) in named.into_iter().enumerate() {
        let y = top + 5.0 + ROW * (index as f64 + 0.5);
        let start = left + LEGEND;
        let places = match series.look {
            Look::Marks(_) => vec![[start + 0.5 * SAMPLE, y]],
            _ => vec![[start, y], [start + SAMPLE, y]],
        };
        let sample = Series { width: series.width.max(1.6), titles: Vec::new(), ..series.clone() };
        sample.write(svg, &places);
        let (x, name) = (start + SAMPLE + LEGEND, escaped(&series.name));
        let _ = write!(svg, "<text x=\"{x:.2}\" y=\"{:.2}\">{name}</text>", y + 4.4);
    }
    svg.push_str("</g>");
}

#[cfg(test)]
mod tests {
    use super::logarithmic;

    #[test]
    fn logarithmic_axes_have_round_numbers() {
        let texts = |range| logarithmic(range, 5.0).into_iter().map(|(_, text)| text).collect::<Vec<_>>();
        assert_eq!(texts([0.06, 12.0]), ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        // the ends belong to the axis
        assert_eq!(texts([1.0, 1e4]), ["1", "10", "100", "1000", "10000"]);
        // between 2 and 5, as around one value
        assert_eq!(texts([2.4, 3.75]), ["2.5", "3.0", "3.5"]);
    }
}
