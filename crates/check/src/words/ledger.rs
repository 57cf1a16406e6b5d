//! The ledger of a check: each number once, together with what is said of it. Terminal, JSON, report, tables
//! of walls, Python and the playground render any ledger.

use std::collections::BTreeMap;
use std::fmt::Write;

use ::report::escaped;
use ::report::table::{Cell, Column, Digits, Table};
use serde_json::{Map, Value};

use super::formulas::{formula, leading, raised};
use super::names::Sides;
use super::{Language, Sentence, say, shown, side};

/// A unit in which people read a number, and the factor to it from SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Its name; empty for none.
    pub name: &'static str,
    /// How many of it one of the SI unit is.
    pub factor: f64,
}

#[allow(missing_docs, reason = "the names say it")]
impl Unit {
    pub const NONE: Self = Self { name: "", factor: 1.0 };
    pub const METRES: Self = Self { name: "m", factor: 1.0 };
    pub const MILLIMETRES: Self = Self { name: "mm", factor: 1e3 };
    pub const SQUARE_MILLIMETRES: Self = Self { name: "mm²", factor: 1e6 };
    pub const KILONEWTONS: Self = Self { name: "kN", factor: 1e-3 };
    pub const KILONEWTON_METRES: Self = Self { name: "kN m", factor: 1e-3 };
    pub const KILONEWTONS_PER_METRE: Self = Self { name: "kN/m", factor: 1e-3 };
    pub const SPECIFIC_WEIGHT: Self = Self { name: "kN/m³", factor: 1e-3 };
    pub const MEGAPASCALS: Self = Self { name: "MPa", factor: 1e-6 };
    pub const TONNES: Self = Self { name: "t", factor: 1e-3 };
    pub const SECONDS: Self = Self { name: "s", factor: 1.0 };
    pub const ACCELERATION: Self = Self { name: "m/s²", factor: 1.0 };
    pub const DEGREES: Self = Self { name: "°", factor: 1.0 };
    pub const GRAVITY: Self = Self { name: "g", factor: 1.0 };
}

/// A number, and all that is said of it.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its name in JSON; empty for one of the report alone.
    pub key: &'static str,
    /// Its symbols, such as `F_act = F0`; empty where it has none.
    pub symbol: String,
    /// In which people read it.
    pub unit: Unit,
    /// How it follows from others, whose numbers are put in where all are known; what stands in braces, such
    /// as a power of ten between units, is for the numbers alone.
    pub formula: String,
    /// Where the code has it.
    pub clause: Sentence,
    /// What it is.
    pub words: Sentence,
    /// The number in SI units; `None` where it does not exist.
    pub value: Option<f64>,
    /// The formula with its numbers; empty for none.
    numbers: Option<String>,
    in_report: bool,
    /// Its name on a terminal; empty where that leaves it out.
    name: &'static str,
}

impl Quantity {
    /// Makes a number with a name, a symbol, a formula or an equation such as `d_0 = (d/u) u_0`, a unit and
    /// words.
    pub fn new(
        key: &'static str,
        equation: impl AsRef<str>,
        unit: Unit,
        value: impl Into<Option<f64>>,
        words: Sentence,
    ) -> Self {
        let equation = equation.as_ref();
        let is_symbol = !equation.contains([' ', '/']);
        let alone = if is_symbol { (equation, "") } else { ("", equation) };
        let (symbol, formula) = equation.rsplit_once(" = ").unwrap_or(alone);
        let (symbol, formula, clause) = (symbol.to_owned(), formula.to_owned(), Sentence::default());
        let (value, numbers, in_report, name) = (value.into(), None, true, key);
        Self { key, symbol, unit, formula, clause, words, value, numbers, in_report, name }
    }

    /// Says where the code has it.
    #[must_use]
    pub fn at(self, clause: impl Into<Sentence>) -> Self {
        Self { clause: clause.into(), ..self }
    }

    /// Gives the formula with its numbers, in place of the symbols that are known; empty for none.
    #[must_use]
    pub fn with_numbers(self, numbers: impl Into<String>) -> Self {
        Self { numbers: Some(numbers.into()), ..self }
    }

    /// Leaves it out of the lines of a report: a table there has it.
    #[must_use]
    pub fn unlisted(self) -> Self {
        Self { in_report: false, ..self }
    }

    /// Gives a number that JSON does not have its name on a terminal.
    #[must_use]
    pub fn on_terminal(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// The number for people.
    fn shown(&self) -> Option<f64> {
        Some(self.unit.factor * self.value?)
    }
}

/// A line of a ledger.
#[derive(Clone, Debug)]
enum Line {
    Quantity(Box<Quantity>),
    /// Words, and what is said, as markup.
    Said(Sentence, Sentence),
    /// What is for programs alone.
    Fact(&'static str, Value),
}

/// Lines that belong together.
#[derive(Clone, Debug)]
struct Group {
    /// Name of their object in JSON; empty where they have none of their own.
    key: &'static str,
    /// The part of a report that has them.
    part: &'static str,
    lines: Vec<Line>,
}

/// The numbers of a side in their order, in groups.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    groups: Vec<Group>,
    /// Symbols and parts of formulas, such as `(W + O)`, with their numbers as formulas take them.
    known: BTreeMap<String, f64>,
}

impl Ledger {
    /// Begins a group of lines: the name of their object in JSON, empty for none of its own, and the part of
    /// a report that has them.
    pub fn begin(&mut self, key: &'static str, part: &'static str) {
        self.groups.push(Group { key, part, lines: Vec::new() });
    }

    /// Makes symbols known, in the units in which formulas take them.
    pub fn know(&mut self, symbols: &[(&str, f64)]) {
        self.known.extend(symbols.iter().map(|(symbol, value)| ((*symbol).to_owned(), *value)));
    }

    /// The number of a known symbol.
    pub(crate) fn number(&self, symbol: &str) -> Option<f64> {
        self.known.get(symbol).copied()
    }

    fn push(&mut self, line: Line) {
        if self.groups.is_empty() {
            self.begin("", "");
        }
        self.groups.last_mut().unwrap_or_else(|| unreachable!("a group was begun")).lines.push(line);
    }

    /// Adds a number. From then on its symbols are known.
    pub fn add(&mut self, mut quantity: Quantity) {
        if let Some(value) = quantity.shown() {
            if quantity.numbers.is_none() && !quantity.formula.is_empty() {
                quantity.numbers = self.numbers_of(&quantity.formula).filter(|text| *text != shown(value));
            }
            for symbol in quantity.symbol.split(" = ").filter(|symbol| !symbol.is_empty()) {
                self.known.insert(symbol.to_owned(), value);
            }
        }
        self.push(Line::Quantity(Box::new(quantity)));
    }

    /// Adds a line of words; what is said is markup.
    pub fn say(&mut self, words: Sentence, said: Sentence) {
        self.push(Line::Said(words, said));
    }

    /// Adds what is for programs alone.
    pub fn fact(&mut self, key: &'static str, value: impl Into<Value>) {
        self.push(Line::Fact(key, value.into()));
    }

    /// A formula with the numbers of its symbols; `None` where one is not known.
    fn numbers_of(&self, formula: &str) -> Option<String> {
        let (mut text, mut rest) = (String::new(), formula);
        while let Some(first) = rest.chars().next() {
            let goes_on = |next: char| next.is_alphabetic() || next.is_ascii_digit() || next == '_';
            let is_whole =
                |symbol: &str| rest.strip_prefix(symbol).is_some_and(|after| !after.starts_with(goes_on));
            let known = self.known.iter().filter(|(symbol, _)| is_whole(symbol));
            if let Some((symbol, value)) = known.max_by_key(|(symbol, _)| symbol.len()) {
                let number = shown(*value).replace('-', "−");
                let [open, close] = if *value < 0.0 { ["(", ")"] } else { ["", ""] };
                text.extend([open, &number, close]);
                rest = &rest[symbol.len()..];
                continue;
            }
            let word = leading(rest, char::is_alphabetic);
            let (part, after) = rest.split_at(word.len().max(first.len_utf8()));
            let is_symbol = word.chars().count() == 1 && word != "π" || after.starts_with('_');
            if !word.is_empty() && is_symbol {
                return None;
            }
            let is_sign = |letter: char| "+−=·;π".contains(letter);
            text += match first {
                '{' | '}' => "",
                // a product, unless it is the space around a sign
                ' ' if !(text.ends_with(is_sign) || after.starts_with(is_sign)) => " · ",
                _ => part,
            };
            rest = after;
        }
        Some(text)
    }

    /// The numbers by their names, in SI units.
    pub fn json(&self) -> Map<String, Value> {
        let mut all = Map::new();
        for Group { key, lines, .. } in &self.groups {
            let mut own = Map::new();
            for line in lines {
                match line {
                    Line::Quantity(quantity) if !quantity.key.is_empty() => {
                        own.insert(quantity.key.to_owned(), quantity.value.into());
                    }
                    Line::Fact(key, value) => {
                        own.insert((*key).to_owned(), value.clone());
                    }
                    Line::Quantity(_) | Line::Said(..) => {}
                }
            }
            if key.is_empty() {
                all.extend(own);
            } else if !own.is_empty()
                && let Some(object) = all.entry(*key).or_insert_with(|| Map::new().into()).as_object_mut()
            {
                object.extend(own);
            }
        }
        all
    }

    /// The numbers for a terminal, each under the name of its group and its own.
    fn rows(&self) -> impl Iterator<Item = (String, &Quantity)> {
        self.groups.iter().flat_map(|Group { key, lines, .. }| {
            lines.iter().filter_map(move |line| match line {
                Line::Quantity(quantity) if !quantity.name.is_empty() => {
                    Some((format!("{key} {}", quantity.name).trim().to_owned(), &**quantity))
                }
                _ => None,
            })
        })
    }

    /// The lines of a part of a report as a table of markup; empty without any.
    pub(crate) fn markup(&self, part: &str, language: Language) -> String {
        let mut text = String::new();
        let of_part = self.groups.iter().filter(|group| group.part == part);
        for line in of_part.flat_map(|group| &group.lines) {
            // writing to a String cannot fail
            let _ = match line {
                Line::Quantity(quantity) => match quantity.value.filter(|_| quantity.in_report) {
                    Some(_) => writeln!(text, "{}", quantity.markup(language)),
                    None => continue,
                },
                Line::Said(words, said) => {
                    let words = words.markup(language);
                    writeln!(text, "<tr><td>{words}</td><td>{}</td></tr>", said.of(language))
                }
                Line::Fact(..) => continue,
            };
        }
        if text.is_empty() { text } else { format!("<table class=\"calculation\">\n{text}</table>\n") }
    }
}

impl Quantity {
    /// A row of a calculation: words and clause; symbol, formula, its numbers, and the result.
    fn markup(&self, language: Language) -> String {
        let some = |text: &str, shown: String| if text.is_empty() { String::new() } else { shown };
        let clause = self.clause.of(language);
        let clause = some(clause, format!(" <small>{}</small>", escaped(clause)));
        let mut bare = self.formula.clone();
        while let Some((from, to)) = bare.find('{').zip(bare.find('}')) {
            bare = bare[..from].trim_end().to_owned() + &bare[to + 1..];
        }
        let sides = [&*self.symbol, &*bare].into_iter().filter(|side| !side.is_empty()).collect::<Vec<_>>();
        let left = formula(&language.decimal(&sides.join(" = ")));
        let numbers = self.numbers.as_deref().unwrap_or_default();
        let numbers = some(numbers, format!(" = {}", raised(&escaped(&language.decimal(numbers)))));
        let value = language.or_dash(self.shown());
        let unit = some(self.unit.name, format!(" {}", self.unit.name));
        let words = self.words.markup(language);
        format!("<tr><td>{words}{clause}</td><td>{left}{numbers} = <b>{value}</b>{unit}</td></tr>")
    }
}

/// The numbers of sides as a table: a row for each that one of them has, a column for each side.
pub fn numbers(sides: &[(Sides, Ledger)], language: Language) -> Table {
    let head = |said: Sentence| said.of(language).to_owned();
    let heads = [
        Column::text("quantity", head(say!("quantity", "grandezza"))),
        Column::text("unit", head(say!("unit", "unità"))),
    ];
    let sides_of = sides
        .iter()
        .map(|(of, _)| Column::number(of.name(), side(*of).of(language).to_owned(), Digits::Significant(4)));
    let words = [Column::text("meaning", head(say!("meaning", "significato")))];
    let mut table = Table::new(heads.into_iter().chain(sides_of).chain(words));
    // in the order of each side
    let mut names: Vec<String> = Vec::new();
    for (_, ledger) in sides {
        let mut at = 0;
        for (name, _) in ledger.rows().filter(|(_, quantity)| quantity.value.is_some()) {
            if let Some(place) = names.iter().position(|own| *own == name) {
                at = place;
            } else {
                names.insert(at, name);
            }
            at += 1;
        }
    }
    for name in names {
        let named = sides.iter().map(|(_, ledger)| ledger.rows().find(|(own, _)| *own == name));
        let own: Vec<Option<&Quantity>> = named.map(|found| Some(found?.1)).collect();
        let values = own.iter().map(|own| Cell::from(own.and_then(Quantity::shown)));
        // what is said may differ by sides
        let mut meanings: Vec<&str> = own.iter().flatten().map(|own| own.words.of(language)).collect();
        meanings.dedup();
        let unit = own.iter().flatten().map(|own| own.unit.name).find(|unit| !unit.is_empty());
        let name = match language {
            Language::En => name,
            Language::It => symbol_of(&name, own.iter().flatten().next().map_or("", |own| &own.symbol)),
        };
        let row = [name.into(), Cell::from(unit.unwrap_or("-"))].into_iter().chain(values);
        table.row(row.chain([meanings.join(" / ").replace('`', "").into()]));
    }
    table
}

/// The symbol of a number with its check, for readers who do not know its English name.
fn symbol_of(name: &str, symbol: &str) -> String {
    let check = match name.split(' ').next() {
        Some("SLV_q") => "SLV con q ",
        Some("SLD") => "SLD ",
        Some("SLV") => "SLV ",
        Some("SLC") => "SLC ",
        _ => "",
    };
    format!("{check}{}", symbol.rsplit(" = ").next().unwrap_or_default())
}
