//! Names as they are written: a letter, its index, its dots.

/// What a symbol is called on paper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    base: Base,
    /// Letters of the index, as the `y` of `I_y₂`.
    axis: String,
    /// Digits of the index.
    digits: String,
    dots: u8,
    /// Marks by which it differs from another one.
    primes: u8,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Base {
    Latin(char),
    /// By its place in [`GREEK`].
    Greek(usize),
    /// Upright.
    Word(String),
}

/// The Greek letters that differ from Latin ones, by name and letter. π is a number.
const GREEK: &[(&str, char)] = &[
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];

/// What marks a letter.
const PRIME: char = '′';

impl Name {
    /// A letter or a word of the program, as it is written: `theta1` is θ₁, `m1` and `m_1` are m₁, `m_cart` is m with
    /// the index cart, and what is no letter with an index stays a word, upright.
    pub fn read(text: &str) -> Self {
        let (stem, digits) = split_digits(text);
        if let Some(base) = base(stem.strip_suffix('_').unwrap_or(stem)) {
            return Self::of(base, "", digits);
        }
        if let Some((letter, index)) = stem.split_once('_')
            && let Some(base) = base(letter)
            && !index.is_empty()
            && index.chars().all(char::is_alphabetic)
        {
            return Self::of(base, index, digits);
        }
        let letters = |c: char| c.is_alphabetic() || c == '_';
        if !digits.is_empty() && !stem.ends_with('_') && !stem.is_empty() && stem.chars().all(letters) {
            return Self::of(Base::Word(stem.to_owned()), "", digits);
        }
        Self::word(text)
    }

    /// A word, upright, whatever it is.
    pub fn word(text: &str) -> Self {
        Self::of(Base::Word(text.to_owned()), "", "")
    }

    /// The letter, with an index of letters and digits, as `I`, `y2`. A letter is one of Latin, or a name of Greek.
    pub fn indexed(letter: &str, index: &str) -> Self {
        let (axis, digits) = split_digits(index);
        Self::of(base(letter).unwrap_or_else(|| Base::Word(letter.to_owned())), axis, digits)
    }

    fn of(base: Base, axis: &str, digits: &str) -> Self {
        Self { base, axis: axis.to_owned(), digits: digits.to_owned(), dots: 0, primes: 0 }
    }

    /// Whether it is a letter, perhaps with an index, and not a word.
    pub fn is_letter(&self) -> bool {
        !matches!(self.base, Base::Word(_))
    }

    /// The rate of change, with one dot more.
    #[must_use]
    pub fn dotted(&self) -> Self {
        Self { dots: self.dots + 1, ..self.clone() }
    }

    /// The same with a mark more: a letter has a prime, and a word an underscore.
    #[must_use]
    pub fn marked(&self) -> Self {
        match &self.base {
            Base::Word(word) => Self { base: Base::Word(format!("{word}_")), ..self.clone() },
            _ => Self { primes: self.primes + 1, ..self.clone() },
        }
    }

    /// The letter without its index, dots and marks; none of a word of several.
    pub fn letter(&self) -> Option<char> {
        match &self.base {
            Base::Latin(letter) => Some(*letter),
            Base::Greek(place) => Some(GREEK[*place].1),
            Base::Word(word) => word.chars().next().filter(|_| word.chars().nth(1).is_none()),
        }
    }

    /// The index, if it is a number alone or nothing.
    pub fn number(&self) -> Option<&str> {
        self.axis.is_empty().then_some(&*self.digits)
    }

    /// In Unicode: `θ̇₁`, `I_y₂`, `load`.
    pub fn unicode(&self) -> String {
        let mut text = match &self.base {
            Base::Latin(letter) => letter.to_string(),
            Base::Greek(place) => GREEK[*place].1.to_string(),
            Base::Word(word) => word.clone(),
        };
        match self.dots {
            0 => {}
            1 => text.push('\u{307}'),
            2 => text.push('\u{308}'),
            _ => text.extend(std::iter::repeat_n('\u{307}', self.dots.into())),
        }
        if !self.axis.is_empty() {
            text.push('_');
            text.push_str(&self.axis);
        }
        text.extend(self.digits.bytes().map(subscript));
        text.extend(std::iter::repeat_n(PRIME, self.primes.into()));
        text
    }

    /// In LaTeX: `\dot{\theta}_1`, `I_{y_2}`, `\mathrm{load}`. It is ASCII, whatever the name is.
    pub fn latex(&self) -> String {
        let mut base = match &self.base {
            Base::Latin(letter) => letter.to_string(),
            Base::Greek(place) => format!("\\{}", GREEK[*place].0),
            Base::Word(word) => upright(word),
        };
        match self.dots {
            0 => {}
            1 => base = format!("\\dot{{{base}}}"),
            2 => base = format!("\\ddot{{{base}}}"),
            dots => base = format!("{base}^{{({dots})}}"),
        }
        let is_short = self.is_of_axes() || self.axis.len() == 1;
        let axis = match base_of(&self.axis) {
            Some(Base::Greek(place)) => format!("\\{}", GREEK[place].0),
            _ if is_short => self.axis.clone(),
            _ => upright(&self.axis),
        };
        let indexed = match (&*axis, &*self.digits) {
            ("", "") => base,
            ("", digit) if digit.len() == 1 => format!("{base}_{digit}"),
            ("", digits) => format!("{base}_{{{digits}}}"),
            (axis, "") if axis.len() == 1 => format!("{base}_{axis}"),
            (axis, "") => format!("{base}_{{{axis}}}"),
            (axis, digit) if digit.len() == 1 => format!("{base}_{{{axis}_{digit}}}"),
            (axis, digits) => format!("{base}_{{{axis}_{{{digits}}}}}"),
        };
        indexed + &"'".repeat(self.primes.into())
    }

    /// In MathML.
    pub fn mathml(&self) -> String {
        let mut base = match &self.base {
            Base::Latin(letter) => format!("<mi>{letter}</mi>"),
            Base::Greek(place) => format!("<mi>{}</mi>", GREEK[*place].1),
            Base::Word(word) => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(word)),
        };
        if self.dots > 0 {
            let dots = match self.dots {
                1 => "\u{2d9}".to_owned(),
                2 => "\u{a8}".to_owned(),
                n => "\u{2d9}".repeat(n.into()),
            };
            base = format!("<mover accent=\"true\">{base}<mo>{dots}</mo></mover>");
        }
        let digits = format!("<mn>{}</mn>", self.digits);
        let axis = match self.axis.chars().count() {
            0 => String::new(),
            1 => format!("<mi>{}</mi>", escaped(&self.axis)),
            _ => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(&self.axis)),
        };
        let indexed = match (axis.is_empty(), self.digits.is_empty()) {
            (true, true) => base,
            (true, false) => format!("<msub>{base}{digits}</msub>"),
            (false, true) => format!("<msub>{base}{axis}</msub>"),
            (false, false) => format!("<msub>{base}<msub>{axis}{digits}</msub></msub>"),
        };
        match self.primes {
            0 => indexed,
            n => format!("<msup>{indexed}<mo>{}</mo></msup>", PRIME.to_string().repeat(n.into())),
        }
    }

    /// Whether the index is one of components, as `xy`.
    fn is_of_axes(&self) -> bool {
        self.axis.chars().all(|c| matches!(c, 'x'..='z'))
    }
}

/// What stands before the last digits of a text, and these.
fn split_digits(text: &str) -> (&str, &str) {
    text.split_at(text.trim_end_matches(|c: char| c.is_ascii_digit()).len())
}

/// An index that is one letter.
fn base_of(axis: &str) -> Option<Base> {
    base(axis).filter(|_| axis.chars().nth(1).is_none())
}

/// A letter by itself or by its name.
fn base(text: &str) -> Option<Base> {
    let mut letters = text.chars();
    match (letters.next(), letters.next()) {
        (Some(letter), None) if letter.is_ascii_alphabetic() => Some(Base::Latin(letter)),
        (Some(letter), None) => GREEK.iter().position(|(_, greek)| *greek == letter).map(Base::Greek),
        _ => GREEK.iter().position(|(name, _)| *name == text).map(Base::Greek),
    }
}

/// A digit, lowered.
pub(super) fn subscript(digit: u8) -> char {
    const LOWERED: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    LOWERED[usize::from(digit - b'0')]
}

/// A word in LaTeX, upright, and of ASCII alone.
fn upright(word: &str) -> String {
    format!("\\mathrm{{{}}}", word.chars().map(ascii).collect::<String>())
}

/// A letter of a word in LaTeX's mathematics, in ASCII. What its fonts do not have is written by its number.
pub fn ascii(letter: char) -> String {
    let greek = GREEK.iter().chain(MORE_GREEK).find(|(_, greek)| *greek == letter);
    let accented = ACCENTS.iter().find_map(|(accent, accented, plain)| {
        let place = accented.chars().position(|known| known == letter)?;
        Some((accent, plain.chars().nth(place)?))
    });
    match (letter, greek, accented) {
        ('_' | '#' | '$' | '%' | '&' | '{' | '}', ..) => format!("\\{letter}"),
        ('\\' | '^' | '~' | ' ' | '\'', ..) => format!("U{{+}}{:X}", u32::from(letter)),
        ('ß', ..) => "ss".to_owned(),
        ('æ', ..) => "ae".to_owned(),
        ('Æ', ..) => "AE".to_owned(),
        ('œ', ..) => "oe".to_owned(),
        ('Œ', ..) => "OE".to_owned(),
        (letter, ..) if letter.is_ascii_graphic() => letter.to_string(),
        (_, Some((name, _)), _) => format!("{{\\{name}}}"),
        (_, _, Some((accent, plain))) => format!("\\{accent}{{{plain}}}"),
        _ => format!("U{{+}}{:X}", u32::from(letter)),
    }
}

/// Greek letters that are no letters of ours, for they are numbers, sums or Latin to the eye: they stand in words.
const MORE_GREEK: &[(&str, char)] = &[
    ("iota", 'ι'),
    ("upsilon", 'υ'),
    ("pi", 'π'),
    ("Xi", 'Ξ'),
    ("Pi", 'Π'),
    ("Sigma", 'Σ'),
    ("Upsilon", 'Υ'),
];

/// Accents of LaTeX's mathematics, the letters that have them, and these without.
const ACCENTS: &[(&str, &str, &str)] = &[
    ("grave", "àèìòùÀÈÌÒÙ", "aeiouAEIOU"),
    ("acute", "áéíóúýćńśźÁÉÍÓÚÝĆŃŚŹ", "aeiouycnszAEIOUYCNSZ"),
    ("hat", "âêîôûÂÊÎÔÛ", "aeiouAEIOU"),
    ("ddot", "äëïöüÿÄËÏÖÜ", "aeiouyAEIOU"),
    ("tilde", "ãñõÃÑÕ", "anoANO"),
    ("mathring", "åůÅŮ", "auAU"),
    ("check", "čďěňřšťžČĎĚŇŘŠŤŽ", "cdenrstzCDENRSTZ"),
    ("dot", "żŻ", "zZ"),
    ("bar", "āēīōūĀĒĪŌŪ", "aeiouAEIOU"),
    ("breve", "ăğŭĂĞŬ", "aguAGU"),
];

/// Text in XML.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
