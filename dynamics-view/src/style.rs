//! Colours, light and dark.
//!
//! The series are told apart by people who see no red or no green too: neighbours differ in lightness, and the palette
//! is that of M. Okabe and K. Ito (*Color universal design*, 2008), darkened until text in it can be read on white, and
//! lightened until it can be read on black.

/// How many series have a colour of their own; the next ones are dashed.
pub(crate) const COLOURS: usize = 6;

/// The variables of all pictures.
pub(crate) const PALETTE: &str = "\
:root{--paper:#ffffff;--ink:#1c2126;--muted:#5c6670;--line:#b4bcc4;--grid:#e6e9ec;--tint:#f7ece8;\
--c0:#0b62a8;--c1:#c04a00;--c2:#00795a;--c3:#a63c8c;--c4:#8a6800;--c5:#3a8fd0}
@media(prefers-color-scheme:dark){:root{--paper:#14181c;--ink:#e8ebee;--muted:#9aa5af;--line:#5a646e;--grid:#2a3138;\
--tint:#2c2020;--c0:#58aef2;--c1:#ff8c4d;--c2:#34c698;--c3:#e68ad0;--c4:#dcb63e;--c5:#a9d7f7}}
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
