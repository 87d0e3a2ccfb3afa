//! Colours, light and dark.
//!
//! Text in each colour has a contrast of 4.5 on the paper at least (WCAG 2.1), and any two colours are 14 apart (CIE 1976)
//! for those who see no red, no green, or no blue too, as G. Machado, M. Oliveira and L. Fernandes (2009) have it.

/// How many series have a colour of their own; the next ones are dashed.
pub(crate) const COLOURS: usize = 6;

/// The variables of all pictures.
pub(crate) const PALETTE: &str = "\
:root{--paper:#ffffff;--ink:#1c2126;--muted:#5c6670;--line:#b4bcc4;--grid:#e6e9ec;--tint:#f7ece8;\
--c0:#0443c2;--c1:#c04a00;--c2:#2f7550;--c3:#743a70;--c4:#7a1400;--c5:#3378c4}
@media(prefers-color-scheme:dark){:root{--paper:#14181c;--ink:#e8ebee;--muted:#9aa5af;--line:#5a646e;--grid:#2a3138;\
--tint:#2c2020;--c0:#5ba0ff;--c1:#f58256;--c2:#3fe0a4;--c3:#c48cab;--c4:#f1d142;--c5:#a5e5ff}}
";

/// What of a chart looks how.
pub(crate) const CHART: &str = "\
svg{background:var(--paper);font:12px system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif}
text{fill:var(--muted)}.h{font-size:15px;font-weight:600;fill:var(--ink)}.q{font-weight:600;fill:var(--ink)}\
.e{text-anchor:end}.m{text-anchor:middle}.b{fill:var(--paper)}.g{stroke:var(--grid);fill:none}\
.a{stroke:var(--line);fill:none}.t{fill:var(--tint)}.n{stroke:var(--muted);fill:none}.x{stroke-dasharray:3 3}\
.l{fill:none;stroke-width:1.75;stroke-linejoin:round;stroke-linecap:round}.d1{stroke-dasharray:7 4}\
.d2{stroke-dasharray:2 4}.k{stroke-width:2.25}.halo{paint-order:stroke;stroke:var(--paper);stroke-width:3px}
.s0{stroke:var(--c0)}.s1{stroke:var(--c1)}.s2{stroke:var(--c2)}.s3{stroke:var(--c3)}.s4{stroke:var(--c4)}\
.s5{stroke:var(--c5)}.f0{fill:var(--c0)}.f1{fill:var(--c1)}.f2{fill:var(--c2)}.f3{fill:var(--c3)}\
.f4{fill:var(--c4)}.f5{fill:var(--c5)}
";

/// The classes of a series' line.
pub(crate) fn stroke(series: usize) -> String {
    let dash = ["", " d1", " d2"][series / COLOURS % 3];
    format!("l s{}{dash}", series % COLOURS)
}

/// The class of its text and dots.
pub(crate) fn fill(series: usize) -> String {
    format!("f{}", series % COLOURS)
}

#[cfg(test)]
mod tests {
    use super::*;

    type Rgb = [f64; 3];

    /// What people see who lack a kind of cone, from and to linear colours (Machado, Oliveira and Fernandes 2009).
    const SIGHTS: [[Rgb; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
    ];

    fn times(m: [Rgb; 3], x: Rgb) -> Rgb {
        m.map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
    }

    /// The linear colours of a variable, light and dark.
    fn linear(name: &str) -> [Rgb; 2] {
        let declared = format!("--{name}:#");
        let mut found = PALETTE.split(&declared).skip(1).map(|rest| {
            [0, 2, 4].map(|k| {
                let byte = u8::from_str_radix(&rest[k..k + 2], 16).expect("two digits");
                let x = f64::from(byte) / 255.0;
                if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
            })
        });
        [0, 1].map(|_| found.next().expect("a colour for light, and one for dark"))
    }

    fn luminance([r, g, b]: Rgb) -> f64 {
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn lab(rgb: Rgb) -> Rgb {
        let xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let [x, y, z] = times(xyz, rgb.map(|x| x.clamp(0.0, 1.0)));
        let [x, y, z] = [x / 0.9505, y, z / 1.089]
            .map(|t| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn colours_are_read_and_told_apart_by_all() {
        let paper = linear("paper");
        let colours: Vec<[Rgb; 2]> = (0..COLOURS).map(|k| linear(&format!("c{k}"))).collect();
        for mode in [0, 1] {
            for (k, one) in colours.iter().enumerate() {
                let mut both = [luminance(one[mode]), luminance(paper[mode])];
                both.sort_by(f64::total_cmp);
                let contrast = (both[1] + 0.05) / (both[0] + 0.05);
                assert!(contrast >= 4.5, "c{k} has a contrast of {contrast}");
                for (other, sight) in colours[..k].iter().flat_map(|other| SIGHTS.map(|sight| (other, sight)))
                {
                    let [a, b] = [one, other].map(|colour| lab(times(sight, colour[mode])));
                    let apart = (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt();
                    assert!(apart >= 14.0, "c{k} is {apart} from another colour");
                }
            }
        }
    }
}
