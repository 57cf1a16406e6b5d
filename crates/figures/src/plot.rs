//! Lines and marks over two axes, drawn by kuva.
//!
//! ```
//! use figures::palette::{BLUE, RED};
//! use figures::plot::{Axis, Plot, Series};
//!
//! let points = vec![(0.0, 0.0), (1.0, 2.0), (2.0, -1.0)];
//! let plot = Plot {
//!     limits: vec![(1.5, RED)],
//!     ..Plot::new(
//!         [460.0, 300.0],
//!         [Axis::over("time (s)", [0.0, 2.0]), Axis::over("u (m)", [-2.0, 3.0])],
//!         vec![Series::line(BLUE, 1.2, points)],
//!     )
//! };
//! assert!(plot.svg().starts_with("<svg"));
//! ```

use std::sync::Arc;

#[cfg(not(target_arch = "wasm32"))]
use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{LegendPosition, LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot as Drawn;
use kuva::render::render::{Scene, render_multiple};

pub use study::chart::Axis;

use crate::axes::number;
use crate::palette::Mark;

/// Margins around the plot area of an inline plot \[px\]: left, right, top, bottom.
pub(crate) const MARGINS: [f64; 4] = [70.0, 18.0, 14.0, 48.0];

/// Points that belong together, and how they look.
#[derive(Clone, Debug)]
pub struct Series {
    /// x and y.
    pub points: Vec<(f64, f64)>,
    /// A colour of the [palette](crate::palette).
    pub color: &'static str,
    /// A line, or marks.
    pub look: Look,
    /// Width of a line or size of a mark \[px\].
    pub width: f64,
    /// Name in the legend of a [picture](Plot::picture); empty for none.
    pub name: String,
    /// For marks: the text shown when each one is pointed at.
    pub titles: Vec<String>,
}

/// How a series looks.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Look {
    Solid,
    Dashed,
    Dotted,
    Marks(Mark),
}

impl Series {
    /// A solid line of a width \[px\].
    pub fn line(color: &'static str, width: f64, points: Vec<(f64, f64)>) -> Self {
        Self { points, color, look: Look::Solid, width, name: String::new(), titles: Vec::new() }
    }

    fn drawn(&self) -> Drawn {
        let style = match self.look {
            Look::Solid => LineStyle::Solid,
            Look::Dashed => LineStyle::Dashed,
            Look::Dotted => LineStyle::Dotted,
            Look::Marks(mark) => {
                let marks = ScatterPlot::new().with_data(self.points.clone());
                let mut marks = marks.with_color(self.color).with_marker(mark).with_size(self.width);
                if !self.name.is_empty() {
                    marks = marks.with_legend(self.name.as_str());
                }
                return Drawn::Scatter(if self.titles.is_empty() {
                    marks
                } else {
                    marks.with_tooltips().with_tooltip_labels(self.titles.clone())
                });
            }
        };
        let line = LinePlot::new().with_data(self.points.clone()).with_color(self.color);
        let line = line.with_stroke_width(self.width).with_line_style(style);
        Drawn::Line(if self.name.is_empty() { line } else { line.with_legend(self.name.as_str()) })
    }
}

/// What the axes count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Both count the values.
    Linear,
    /// x counts the values, spaced by their logarithms. y counts exponents of ten, because kuva's
    /// logarithmic axis ends at 1e-10.
    Logarithmic,
}

/// A pair of axes and what is on it.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Width and height \[px\].
    pub size: [f64; 2],
    /// Title in a [picture](Plot::picture); empty for none.
    pub title: String,
    /// The horizontal and the vertical axis.
    pub axes: [Axis; 2],
    /// What the axes count.
    pub scale: Scale,
    /// Lines and marks, the last one on top.
    pub series: Vec<Series>,
    /// Dashed horizontal lines and their colours.
    pub limits: Vec<(f64, &'static str)>,
}

impl Plot {
    /// A plot without a title, of linear axes and no limits.
    pub fn new(size: [f64; 2], axes: [Axis; 2], series: Vec<Series>) -> Self {
        Self { size, title: String::new(), axes, scale: Scale::Linear, series, limits: Vec::new() }
    }

    /// Draws inline SVG that takes the width of its place: it has a view box instead of a size, rounded to
    /// pixels.
    ///
    /// # Panics
    /// If kuva does not write the size of a drawing as expected.
    pub fn svg(&self) -> String {
        let [left, right, top, bottom] = MARGINS;
        let plots = self.drawn();
        let [width, height] = self.size.map(f64::round);
        let layout = self.layout(&plots, 13).with_width(width).with_height(height);
        let layout = layout.with_legend_position(LegendPosition::InsideTopRight);
        let layout = layout.with_force_margins(left, right);
        let scene = render_multiple(plots, layout.with_force_margins_y(top, bottom));
        let svg = SvgBackend::new().render_scene(&scene);
        let sized = format!("width=\"{width}\" height=\"{height}\"");
        assert!(svg.contains(&sized), "kuva writes the size as {sized}");
        svg.replacen(&sized, &format!("viewBox=\"0 0 {width} {height}\""), 1)
    }

    /// Draws a picture with title and legend, for a file of its own.
    pub fn picture(&self) -> Picture {
        let plots = self.drawn();
        let layout = self.picture_layout(&plots);
        Picture(render_multiple(plots, layout))
    }

    /// Returns the sides of the plot area of the inline SVG, as parts of its width and height: left, right,
    /// top, bottom.
    pub fn area(&self) -> [f64; 4] {
        let ([width, height], [left, right, top, bottom]) = (self.size, MARGINS);
        [left / width, 1.0 - right / width, top / height, 1.0 - bottom / height]
    }

    /// Returns the ends of the axes, of x and then of y; NaN where an axis takes its range from the data.
    pub fn ranges(&self) -> [f64; 4] {
        let [[x0, x1], [y0, y1]] = self.axes.each_ref().map(|axis| axis.range.unwrap_or([f64::NAN; 2]));
        [x0, x1, y0, y1]
    }

    fn drawn(&self) -> Vec<Drawn> {
        self.series.iter().map(Series::drawn).collect()
    }

    fn layout(&self, plots: &[Drawn], tick_size: u32) -> Layout {
        let [x, y] = &self.axes;
        let mut layout = Layout::auto_from_plots(plots)
            .with_width(self.size[0])
            .with_height(self.size[1])
            .with_x_label(x.label.as_str())
            .with_y_label(y.label.as_str())
            .with_label_size(14)
            .with_tick_size(tick_size)
            .with_tick_format(TickFormat::Custom(Arc::new(|value| number(value, 9))))
            .with_font_family("system-ui, sans-serif");
        if let Some([low, high]) = x.range {
            layout = layout.with_x_axis_min(low).with_x_axis_max(high);
        }
        if let Some([low, high]) = y.range {
            layout = layout.with_y_axis_min(low).with_y_axis_max(high);
        }
        if self.scale == Scale::Logarithmic {
            let power = TickFormat::Custom(Arc::new(|exponent| match exponent {
                0.0 => "1".to_owned(),
                _ => format!("1e{exponent:.0}"),
            }));
            layout = layout.with_log_x().with_y_tick_step(3.0).with_y_tick_format(power);
        }
        for &(limit, color) in &self.limits {
            layout = layout.with_reference_line(ReferenceLine::horizontal(limit).with_color(color));
        }
        layout
    }

    fn picture_layout(&self, plots: &[Drawn]) -> Layout {
        let layout = self.layout(plots, 12);
        if self.title.is_empty() {
            return layout.with_legend_position(LegendPosition::InsideTopRight);
        }
        layout.with_title(self.title.as_str()).with_title_size(14)
    }
}

/// A drawing for a file of its own.
pub struct Picture(Scene);

impl Picture {
    /// Draws plots of one width, one above the other.
    pub fn stacked(plots: &[Plot]) -> Self {
        let panels: Vec<_> = plots.iter().map(Plot::drawn).collect();
        let layouts = plots.iter().zip(&panels).map(|(plot, drawn)| plot.picture_layout(drawn)).collect();
        let [width, height] = plots.first().map_or([0.0; 2], |plot| plot.size);
        let mut figure = Figure::new(plots.len(), 1).with_cell_size(width, height).with_spacing(4.0);
        for (row, plot) in plots.iter().enumerate() {
            figure = figure.with_row_height(row, plot.size[1]);
        }
        Self(figure.with_plots(panels).with_layouts(layouts).render())
    }

    /// Writes it as SVG.
    pub fn svg(&self) -> String {
        SvgBackend::new().render_scene(&self.0)
    }

    /// Writes it as PNG, two pixels for one of the SVG.
    ///
    /// # Errors
    /// Kuva's reason for failing.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn png(&self) -> Result<Vec<u8>, String> {
        PngBackend::new().render_scene(&self.0)
    }
}
