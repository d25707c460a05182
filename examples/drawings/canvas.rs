//! SVG, just enough: filled polygons, lines, arrows, dots and texts, in pixels.

use std::fmt::Write;

/// A point of the drawing, y downwards.
pub(crate) type Point = [f64; 2];

/// The colours, one for each meaning.
pub(crate) mod ink {
    pub(crate) const LINE: &str = "#9aa5b1";
    pub(crate) const DARK: &str = "#1f2933";
    pub(crate) const PAPER: &str = "#f5f7fa";
    pub(crate) const BLUE: &str = "#2b6cb0";
    pub(crate) const PALE_BLUE: &str = "#bee3f8";
    pub(crate) const FAINT_BLUE: &str = "#e6f3fc";
    pub(crate) const ORANGE: &str = "#dd6b20";
    pub(crate) const PALE_ORANGE: &str = "#fbd9b5";
    pub(crate) const WHITE: &str = "#ffffff";
}

/// A drawing in the making.
pub(crate) struct Canvas {
    width: f64,
    height: f64,
    body: String,
}

impl Canvas {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new() }
    }

    pub(crate) fn polygon(&mut self, corners: &[Point], fill: &str, edges: &str, width: f64) {
        let mut path = String::new();
        for (k, &[x, y]) in corners.iter().enumerate() {
            let _ = write!(path, "{}{} {}", if k == 0 { 'M' } else { 'L' }, short(x), short(y));
        }
        self.put(&format!(r#"<path d="{path}z" fill="{fill}" stroke="{edges}" stroke-width="{width}"/>"#));
    }

    pub(crate) fn line(&mut self, [a, b]: [Point; 2], ink: &str, width: f64) {
        self.put(&format!(r#"<path d="{}" stroke="{ink}" stroke-width="{width}"/>"#, segment(a, b)));
    }

    pub(crate) fn dashes(&mut self, [a, b]: [Point; 2], ink: &str, width: f64) {
        let path = segment(a, b);
        self.put(&format!(r#"<path d="{path}" stroke="{ink}" stroke-width="{width}" stroke-dasharray="4 3"/>"#));
    }

    /// A line with a head at its end.
    pub(crate) fn arrow(&mut self, [a, b]: [Point; 2], ink: &str, width: f64) {
        self.line([a, b], ink, width);
        self.head(b, (b[1] - a[1]).atan2(b[0] - a[0]), ink);
    }

    /// An arrow counter-clockwise around a point, between two angles from the x axis.
    pub(crate) fn turn(&mut self, center: Point, radius: f64, [from, to]: [f64; 2], ink: &str) {
        let at = |angle: f64| [center[0] + radius * angle.cos(), center[1] - radius * angle.sin()];
        let (a, b) = (at(from), at(to));
        let large = u8::from(to - from > std::f64::consts::PI);
        let ends = [a[0], a[1], radius, b[0], b[1]].map(short);
        let path = format!("M{} {}A{} {r} 0 {large} 0 {} {}", ends[0], ends[1], ends[2], ends[3], ends[4], r = ends[2]);
        self.put(&format!(r#"<path d="{path}" fill="none" stroke="{ink}" stroke-width="1.6"/>"#));
        self.head(b, -to - std::f64::consts::FRAC_PI_2 + 6.0 / radius, ink);
    }

    fn head(&mut self, [x, y]: Point, angle: f64, ink: &str) {
        let at = |back: f64, side: f64| {
            let (sin, cos) = angle.sin_cos();
            [x + back * cos - side * sin, y + back * sin + side * cos]
        };
        self.polygon(&[at(1.0, 0.0), at(-8.0, 3.6), at(-8.0, -3.6)], ink, "none", 0.0);
    }

    pub(crate) fn dot(&mut self, [x, y]: Point, radius: f64, fill: &str, edge: &str) {
        let [x, y] = [x, y].map(short);
        self.put(&format!(
            r#"<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}" stroke="{edge}" stroke-width="1.5"/>"#
        ));
    }

    /// A text with the middle of its base line at a point.
    pub(crate) fn text(&mut self, [x, y]: Point, text: &str, ink: &str) {
        let [x, y] = [x, y].map(short);
        self.put(&format!(r#"<text x="{x}" y="{y}" fill="{ink}" stroke="none" text-anchor="middle">{text}</text>"#));
    }

    /// Any element.
    pub(crate) fn put(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// The file; no empty line is in it, so that it may stand inside Markdown.
    pub(crate) fn finish(self) -> String {
        let (width, height) = (self.width.ceil(), self.height.ceil());
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" \
             font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{width}\" height=\"{height}\" rx=\"6\" \
             fill=\"{}\"/>\n{}</svg>\n",
            ink::WHITE,
            self.body
        )
    }
}

fn segment([ax, ay]: Point, [bx, by]: Point) -> String {
    let [ax, ay, bx, by] = [ax, ay, bx, by].map(short);
    format!("M{ax} {ay}L{bx} {by}")
}

/// A number to a tenth: the same on every machine, whatever the last bits of its sines are.
fn short(number: f64) -> f64 {
    // Adding zero turns -0 into 0.
    (number * 10.0).round() / 10.0 + 0.0
}
