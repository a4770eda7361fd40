//! A picture of the time that lines take.

use super::run::{Run, LINES};
use std::fmt::Write;

/// The size of the plot, and of its margins: left and bottom, right and top.
const SIZE: [f64; 2] = [760.0, 360.0];
const MARGINS: [f64; 2] = [60.0, 20.0];

/// An SVG: for each line of the picture its mean and its longest time over the frames, and the time of a row on the wire.
pub(crate) fn lines(run: &Run) -> String {
    let of_line = |y: usize| run.cycles.iter().map(move |frame| run.micros(frame[y]));
    let mean: Vec<_> = (0..LINES).map(|y| of_line(y).sum::<f64>() / run.cycles.len() as f64).collect();
    let longest: Vec<_> = (0..LINES).map(|y| of_line(y).fold(0.0, f64::max)).collect();
    let row = run.row_micros();
    let highest = (longest.iter().copied().fold(row, f64::max) / 100.0).ceil() * 100.0;

    let [near, far] = MARGINS;
    let x = |line: f64| near + line / LINES as f64 * (SIZE[0] - near - far);
    let y = |micros: f64| SIZE[1] - near - micros / highest * (SIZE[1] - near - far);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        SIZE[0], SIZE[1]
    );
    let mut text = |x: f64, y: f64, anchor: &str, text: &str| {
        let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
    };
    for line in (0..=LINES).step_by(40) {
        text(x(line as f64), y(0.0) + 18.0, "middle", &line.to_string());
    }
    for micros in (0..=highest as u32).step_by(100) {
        text(near - 6.0, y(micros.into()) + 4.0, "end", &micros.to_string());
    }
    text(x(LINES as f64 / 2.0), SIZE[1] - 16.0, "middle", "line of the picture");
    text(x(2.0), y(row) - 5.0, "start", &format!("wire: {row:.1} µs"));
    let title = format!("µs to shade a line, mean (filled) and longest of {} frames; to send one (dashed)", run.cycles.len());
    text(x(LINES as f64), far - 4.0, "end", &title);

    let points = |values: &[f64]| {
        values.iter().zip(0..).fold(String::new(), |all, (&micros, line)| {
            format!("{all} {:.1},{:.1} {:.1},{:.1}", x(line.into()), y(micros), x(f64::from(line) + 1.0), y(micros))
        })
    };
    let (left, right, bottom) = (x(0.0), x(LINES as f64), y(0.0));
    let mean = points(&mean);
    let _ = writeln!(svg, "<polygon points=\"{left},{bottom}{mean} {right},{bottom}\" fill=\"#e0a060\"/>");
    let _ = writeln!(svg, "<polyline points=\"{}\" fill=\"none\" stroke=\"#a04020\"/>", points(&longest).trim_start());
    let wire = y(row);
    let _ = writeln!(svg, "<path d=\"M{left},{wire:.1}H{right}\" stroke=\"#2060a0\" stroke-dasharray=\"6 4\"/>");
    let _ = writeln!(svg, "<path d=\"M{left},{far}V{bottom}H{right}\" fill=\"none\" stroke=\"black\"/>\n</svg>");
    svg
}
