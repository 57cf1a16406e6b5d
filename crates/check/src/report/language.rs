//! The languages of a report, from one table of terms and phrases: `terms.tsv`.
//!
//! Reports are written in English. Whatever a reader sees of one passes this table, a fragment of text at a
//! time: what stands between two tags other than those of formulas. `{}` in a phrase stands for anything,
//! such as a number, and is translated in turn. What the user writes is marked `translate="no"` and stays.
//! Numbers of an Italian report have decimal commas.

use std::borrow::Cow;

use ::report::escaped;
use serde::Deserialize;

use super::decimals::with_commas;
use super::markup::formula;

/// The language of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English.
    #[default]
    En,
    /// Italian.
    It,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::En, Self::It];

    /// Returns the value of the key `language`.
    pub fn name(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::It => "it",
        }
    }
}

/// Terms of the field, and behind the line `# phrases` what else a report says: English, tab, Italian.
const TABLE: &str = include_str!("terms.tsv");
/// What parts terms and phrases.
const PHRASES: &str = "# phrases\n";
/// Symbols with an index that sentences and tables have. Names of keys, files and walls may look alike.
const SYMBOLS: [&str; 42] = [
    "a_0", "a_1", "a_max", "a_g", "a_g,SLD", "a_g,cap", "a_s", "a_y", "a_Z", "C_U", "d_0", "d_1", "d_s",
    "d_SLC", "d_SLV", "d_u", "d_y", "f_d", "f_m", "N_y", "S_a", "S_d", "S_e", "S_eZ", "S_S", "S_T", "T_1",
    "T_B", "T_C", "T_D", "T_R", "T_s", "T_SLC", "T_SLV", "u_0", "u_ins", "u_r", "u_y", "k_0", "V_N", "V_R",
    "ξ_k",
];
/// Where what stays as it is begins and ends.
const SKIPPED: [(&str, &str); 5] = [
    ("<style", "</style>"),
    ("<span translate=\"no\"", "</span>"),
    ("<small translate=\"no\"", "</small>"),
    ("<title", "</title>"),
    ("<tspan", "</tspan>"),
];
/// Tags within a formula, or a sentence.
const INLINE: [&str; 4] = ["i", "b", "sub", "sup"];

/// Returns the terms of the field in English and Italian, in the order of the table.
///
/// ```
/// assert!(check::terms().any(|term| term == ("overburden", "carico in sommità")));
/// ```
pub fn terms() -> impl Iterator<Item = (&'static str, &'static str)> {
    pairs(TABLE.split_once(PHRASES).map_or(TABLE, |(terms, _)| terms))
}

fn pairs(table: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.lines().filter_map(|line| line.split_once('\t'))
}

/// Returns a page in a language.
pub(crate) fn translated(page: String, language: Language) -> String {
    if language == Language::En {
        return page;
    }
    let phrases = Phrases::new();
    let mut text = String::with_capacity(page.len() * 9 / 8);
    walk(&page, |part| {
        text.push_str(&match part {
            Part::Markup(markup) => phrases.labels(markup),
            Part::Text(fragment) => with_commas(&phrases.fragment(fragment)).into(),
        });
    });
    text.replacen("<html lang=\"en\"", &format!("<html lang=\"{}\"", language.name()), 1)
}

/// Returns a page with the symbols of its sentences as formulas: `a_g`, `zeta_E`, `alpha0`. Pictures keep
/// theirs.
pub(crate) fn with_symbols(page: &str) -> String {
    let mut text = String::with_capacity(page.len() * 9 / 8);
    let mut is_picture = false;
    walk(page, |part| match part {
        Part::Markup(markup) => {
            is_picture = !markup.starts_with("</svg") && (is_picture || markup.starts_with("<svg"));
            text.push_str(markup);
        }
        Part::Text(fragment) if is_picture => text.push_str(fragment),
        Part::Text(fragment) => symbols(fragment, &mut text),
    });
    text
}

/// Adds a text with its symbols as formulas.
fn symbols(fragment: &str, text: &mut String) {
    let belongs = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == ',';
    let mut rest = fragment;
    while let Some(from) = rest.find(|letter: char| letter.is_alphanumeric() || letter == '_') {
        text.push_str(&rest[..from]);
        rest = &rest[from..];
        let word = &rest[..rest.find(|letter| !belongs(letter)).unwrap_or(rest.len())];
        let word = word.trim_end_matches(',');
        rest = &rest[word.len()..];
        match word {
            "zeta_E" | "ζ_E" => *text += &formula("ζ_E"),
            "alpha0" | "α0" => *text += &formula("α0"),
            _ if SYMBOLS.contains(&word) => *text += &formula(word),
            _ => text.push_str(word),
        }
    }
    text.push_str(rest);
}

/// A part of a page.
enum Part<'a> {
    /// A tag, and what is not for readers.
    Markup(&'a str),
    /// Text, with the tags of formulas.
    Text(&'a str),
}

/// Hands over the parts of a page.
fn walk<'a>(page: &'a str, mut take: impl FnMut(Part<'a>)) {
    let mut rest = page;
    while !rest.is_empty() {
        let text = if skipped(rest).is_some() { 0 } else { text_end(rest) };
        let tag = || skipped(rest).or(rest.find('>').map(|end| end + 1)).unwrap_or(rest.len());
        let (part, after) = rest.split_at(if text > 0 { text } else { tag() });
        take(if text > 0 { Part::Text(part) } else { Part::Markup(part) });
        rest = after;
    }
}

/// Where what stays as it is ends, if that begins here.
fn skipped(rest: &str) -> Option<usize> {
    SKIPPED.into_iter().find_map(|(begins, ends)| {
        let found = rest.starts_with(begins).then(|| rest.find(ends))?;
        found.map(|place| place + ends.len())
    })
}

/// Where the text that begins here ends.
fn text_end(rest: &str) -> usize {
    let (mut at, mut open) = (0, 0);
    while let Some(next) = rest[at..].find('<') {
        let tag = &rest[at + next..];
        let name = tag[1..].trim_start_matches('/');
        let name = &name[..name.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(name.len())];
        // a class makes a tag more than a formula
        let is_plain = tag[1..].trim_start_matches('/')[name.len()..].starts_with('>');
        let is_end = tag.starts_with("</");
        // the mark of a legend, a tag with a class, ends before its words
        if !(INLINE.contains(&name) && is_plain) || is_end && open == 0 {
            return at + next;
        }
        open = if is_end { open - 1 } else { open + 1 };
        at += next + tag.find('>').map_or(tag.len(), |end| end + 1);
    }
    rest.len()
}

/// The phrases of the table as they stand in markup, those with most words first.
struct Phrases(Vec<(Vec<String>, String)>);

impl Phrases {
    fn new() -> Self {
        let own = |(english, italian): (&str, &str)| {
            let pieces: Vec<String> = escaped(english).split("{}").map(str::to_owned).collect();
            (pieces, escaped(italian))
        };
        let mut phrases: Vec<_> = pairs(TABLE).map(own).collect();
        phrases.sort_by_key(|(pieces, _)| std::cmp::Reverse(pieces.iter().map(String::len).sum::<usize>()));
        Self(phrases)
    }

    /// Translates the labels of a tag.
    fn labels<'a>(&self, markup: &'a str) -> Cow<'a, str> {
        let Some((before, after)) = markup.split_once(" aria-label=\"") else { return markup.into() };
        let Some((label, after)) = after.split_once('"') else { return markup.into() };
        let label = with_commas(&self.fragment(label));
        format!("{before} aria-label=\"{label}\"{after}").into()
    }

    /// Translates a fragment; what the table does not hold stays.
    fn fragment<'a>(&self, fragment: &'a str) -> Cow<'a, str> {
        let text = fragment.trim();
        let Some(said) = self.said(text) else { return fragment.into() };
        let from = fragment.len() - fragment.trim_start().len();
        [&fragment[..from], &said, &fragment[from + text.len()..]].concat().into()
    }

    /// Returns the Italian of a text: that of the phrase that fits with most words. A phrase of small letters
    /// fits with a capital first letter, too.
    fn said(&self, text: &str) -> Option<String> {
        // numbers, and abbreviations of the code, which are Italian
        if !text.contains(char::is_lowercase) {
            return None;
        }
        // headings of numbers have spaces that do not break
        let text = text.replace('\u{a0}', " ");
        let text = text.as_str();
        let lower = lowered(text);
        for (pieces, italian) in &self.0 {
            if let Some(held) = held(pieces, text) {
                return Some(self.filled(italian, &held));
            }
            if let Some(held) = lower.as_deref().and_then(|lower| held(pieces, lower)) {
                return Some(raised(&self.filled(italian, &held)));
            }
        }
        None
    }

    /// Puts what the gaps held into the Italian phrase; `{2}` takes the second.
    fn filled(&self, italian: &str, held: &[&str]) -> String {
        let (mut text, mut rest, mut next) = (String::new(), italian, 0);
        while let Some((before, after)) = rest.split_once('{') {
            text += before;
            let Some((number, after)) = after.split_once('}') else { break };
            let place = number.parse::<usize>().map_or(next, |number| number - 1);
            next = place + 1;
            text += &held.get(place).map_or(Cow::Borrowed(""), |held| self.fragment(held));
            rest = after;
        }
        text + rest
    }
}

/// Returns the text with a small first letter, if it begins with a capital and goes on with a small one.
fn lowered(text: &str) -> Option<String> {
    let mut letters = text.chars();
    let (first, second) = (letters.next()?, letters.next()?);
    (first.is_uppercase() && (second.is_lowercase() || second == ' '))
        .then(|| first.to_lowercase().chain([second]).chain(letters).collect())
}

fn raised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

/// Returns what stands in the gaps between pieces, if a text consists of them.
fn held<'a>(pieces: &[String], text: &'a str) -> Option<Vec<&'a str>> {
    let (first, others) = pieces.split_first()?;
    let rest = text.strip_prefix(first.as_str())?;
    let Some((piece, _)) = others.split_first() else { return rest.is_empty().then(Vec::new) };
    // the last gap reaches to the end
    if others.len() == 1 {
        return rest.strip_suffix(piece.as_str()).filter(|gap| !gap.is_empty()).map(|gap| vec![gap]);
    }
    let places = rest.match_indices(piece.as_str()).map(|(place, _)| place).filter(|place| *place > 0);
    places.into_iter().find_map(|place| {
        let mut all = vec![&rest[..place]];
        all.extend(held(others, &rest[place..])?);
        Some(all)
    })
}

#[cfg(test)]
mod tests {
    use super::{Language, SYMBOLS, TABLE, pairs, translated, with_symbols};

    #[test]
    fn gaps_are_translated_and_what_users_write_is_not() {
        let page = "<p title=\"tie\">the tie breaks</p><td>Overburden</td><small>tie</small>\
                    <small translate=\"no\">tie</small><i class=\"chip\">▲</i>demand\
                    <span translate=\"no\">overburden</span><style>tie {}</style>";
        let italian = "<p title=\"tie\">rottura della catena</p><td>Carico in sommità</td>\
                       <small>catena, tirante</small>\
                       <small translate=\"no\">tie</small><i class=\"chip\">▲</i>domanda\
                       <span translate=\"no\">overburden</span>\
                       <style>tie {}</style>";
        assert_eq!(translated(page.to_owned(), Language::It), italian);
        assert_eq!(translated(page.to_owned(), Language::En), page);
    }

    #[test]
    fn symbols_of_sentences_are_formulas() {
        let page = "<p>zeta_E of a_g,SLD, and T_C* of alpha0 by tie_strength</p><svg><text>S_e</text></svg>\
                    <small translate=\"no\">a_1</small><b>d_0</b>";
        let marked = "<p><i>ζ</i><sub>E</sub> of <i>a</i><sub>g,SLD</sub>, and <i>T</i><sub>C</sub>* of \
                      <i>α</i><sub>0</sub> by tie_strength</p><svg><text>S_e</text></svg>\
                      <small translate=\"no\">a_1</small><b><i>d</i><sub>0</sub></b>";
        assert_eq!(with_symbols(page), marked);
        assert_eq!(with_symbols("<p>u_start of g_2.csv</p>"), "<p>u_start of g_2.csv</p>");
        // none of the phrases is forgotten
        let belongs = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == ',';
        for word in TABLE.split(|letter| !belongs(letter)).map(|word| word.trim_end_matches(',')) {
            let is_like = word.split_once('_').is_some_and(|(letter, _)| letter.chars().count() == 1);
            assert!(!is_like || word == "ζ_E" || SYMBOLS.contains(&word), "{word}");
        }
    }

    /// A phrase has one translation, with as many gaps.
    #[test]
    fn phrases_are_given_once_with_their_gaps() {
        let mut seen = std::collections::BTreeSet::new();
        for (english, italian) in pairs(TABLE) {
            assert!(seen.insert(english), "{english} is given twice");
            assert_eq!(english.matches('{').count(), italian.matches('{').count(), "{english}");
            assert!(!italian.is_empty() && english.trim() == english, "{english}");
        }
    }
}
