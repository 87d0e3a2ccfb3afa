//! The units that may follow a literal.

/// A unit of measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    /// The suffix.
    pub name: &'static str,
    /// The exponents of kg, m and s.
    pub exponents: [i8; 3],
    /// One of it in SI units is `num / den · π^pi`.
    pub scale: (i64, i64, bool),
}

const fn unit(name: &'static str, exponents: [i8; 3], num: i64, den: i64) -> Unit {
    Unit { name, exponents, scale: (num, den, false) }
}

impl Unit {
    /// All units.
    pub const ALL: &'static [Self] = &[
        unit("m", [0, 1, 0], 1, 1),
        unit("cm", [0, 1, 0], 1, 100),
        unit("mm", [0, 1, 0], 1, 1000),
        unit("um", [0, 1, 0], 1, 1_000_000),
        unit("km", [0, 1, 0], 1000, 1),
        unit("kg", [1, 0, 0], 1, 1),
        unit("g", [1, 0, 0], 1, 1000),
        unit("t", [1, 0, 0], 1000, 1),
        unit("s", [0, 0, 1], 1, 1),
        unit("ms", [0, 0, 1], 1, 1000),
        unit("rad", [0, 0, 0], 1, 1),
        Self { name: "deg", exponents: [0, 0, 0], scale: (1, 180, true) },
        unit("N", [1, 1, -2], 1, 1),
        unit("Nm", [1, 2, -2], 1, 1),
        unit("Nms", [1, 2, -1], 1, 1),
        unit("N_per_m", [1, 0, -2], 1, 1),
        unit("Ns_per_m", [1, 0, -1], 1, 1),
        unit("kg_m2", [1, 2, 0], 1, 1),
        unit("J", [1, 2, -2], 1, 1),
        unit("W", [1, 2, -3], 1, 1),
    ];

    /// The unit with the suffix `name`.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|unit| unit.name == name).copied()
    }

    /// Whether it measures angles.
    pub fn is_angle(self) -> bool {
        self.exponents == [0; 3]
    }
}
