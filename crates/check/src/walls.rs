//! The check of many walls.

use std::collections::BTreeMap;
use std::convert::Infallible;

use files::FileError;
use report::page::Page;
use report::table::{Column, Digits, Table};
use run::parallel;
use run::records::NamedRecord;
use run::walls::NamedWall;
use scene::SceneError;
use serde_json::{Value, json};

use crate::code::verdict::Verdict;
use crate::code::{Code, Subject};
use crate::codes::{CODES, read};
use crate::error::CheckError;
use crate::file::CheckFile;
use crate::words::entry::Entry;
use crate::words::markup::table_as_cards;
use crate::words::names::Sides;
use crate::words::{Language, Sentence, joined, said, say, side};

/// The outcomes of walls by one code, the worst first.
pub struct WallVerdicts<'a> {
    code: Entry,
    /// Names of the walls, and their verdicts or why there is none; those come first.
    pub walls: Vec<(&'a str, Result<Verdict<'a>, CheckError>)>,
}

/// Codes of the walls of a file: that of the file, and those of walls that state something alone.
pub struct WallCodes {
    shared: Box<dyn Code>,
    /// By the places of walls in the file, and what rows of tables state.
    own: BTreeMap<Place, Box<dyn Code>>,
}

/// The place of a wall in its file, and what its row states.
type Place = (usize, Vec<(&'static str, String)>);

fn place(wall: &NamedWall) -> Place {
    (wall.entry, wall.check.clone())
}

impl WallCodes {
    /// Reads the table `[check]` of a file for each of its walls.
    ///
    /// # Errors
    /// [`SceneError`] of the first value that cannot be used, and of a key that a wall cannot state alone.
    pub fn read(file: &CheckFile<'_>, walls: &[NamedWall]) -> Result<Self, SceneError> {
        let code = CODES.into_iter().find(|code| file.code() == Some(code.name));
        let of_wall = code.map_or(&[][..], |code| code.of_wall);
        let stated = |wall: &NamedWall| file.of_wall(wall.entry, of_wall);
        let shared = read(file).or_else(|error| {
            // what every wall states need not stand in the table of the file
            let own = walls.iter().map(|wall| stated(wall).ok().flatten()).collect::<Option<Vec<_>>>();
            let own = own.and_then(|own| read(own.first()?).ok());
            own.or_else(|| of_row(file, walls.first()?, of_wall, Vec::new()).ok().flatten()).ok_or(error)
        });
        let shared = shared.map_err(|error| file.located(error))?;
        let mut own = BTreeMap::new();
        for wall in walls {
            if own.contains_key(&place(wall)) {
                continue;
            }
            let records = shared.records().named.clone();
            if let Some(code) = of_row(file, wall, of_wall, records)? {
                own.insert(place(wall), code);
            } else if let Some(file) = stated(wall)? {
                own.insert(place(wall), read(&file).map_err(|error| file.located(error))?);
            }
        }
        Ok(Self { shared, own })
    }

    /// The code of the file.
    pub fn shared(&self) -> &dyn Code {
        &*self.shared
    }

    /// The code of a wall.
    pub fn of(&self, wall: &NamedWall) -> &dyn Code {
        self.own.get(&place(wall)).map_or(&*self.shared, |own| &**own)
    }
}

/// The code of a wall whose row in a table states something of its check; `None` of others.
fn of_row(
    file: &CheckFile<'_>,
    wall: &NamedWall,
    of_wall: &[&str],
    records: Vec<NamedRecord>,
) -> Result<Option<Box<dyn Code>>, SceneError> {
    let Some(text) = file.with_row(wall)? else { return Ok(None) };
    let own = file.of_row(&text, records)?;
    let own = own.of_wall(wall.entry, of_wall)?.unwrap_or(own);
    let named =
        |error: CheckError| FileError::whole(file.name(), format!("wall {:?}: [check] {error}", wall.name));
    Ok(Some(read(&own).map_err(named)?))
}

/// Checks every wall on some threads; walls that are alike stay in their order.
pub fn check_walls<'a>(codes: &'a WallCodes, walls: &'a [NamedWall], threads: usize) -> WallVerdicts<'a> {
    let code = codes.shared();
    let one = |index: usize| {
        let NamedWall { name, parameters, floors, assumed, .. } = &walls[index];
        let subject = Subject { parameters, floors: floors.as_ref(), assumed };
        let verdict = codes.of(&walls[index]).check(subject);
        Ok::<_, Infallible>((name.as_str(), verdict))
    };
    let Ok(mut walls) = parallel::map(walls.len(), threads, one);
    let zeta = |verdict: &Result<Verdict<'_>, _>| verdict.as_ref().map_or(f64::NEG_INFINITY, |v| v.zeta);
    walls.sort_by(|a, b| zeta(&a.1).total_cmp(&zeta(&b.1)));
    WallVerdicts { code: code.entry(), walls }
}

impl WallVerdicts<'_> {
    /// Returns how many walls could not be checked.
    pub fn refused(&self) -> usize {
        self.walls.iter().filter(|(_, verdict)| verdict.is_err()).count()
    }

    /// The warnings of each wall in a line with its name, in the order of the table.
    pub fn warnings(&self, language: Language) -> impl Iterator<Item = String> {
        self.walls.iter().filter_map(move |(name, verdict)| {
            let own = &verdict.as_ref().ok()?.warnings;
            let (name, all) = (format!("{name:?}"), joined(own, "; "));
            let said = say!("warning: wall {name}: {all}", "avvertenza: parete {name}: {all}", name, all);
            (!own.is_empty()).then(|| said.of(language).to_owned())
        })
    }

    /// A row for each wall: what governs, the least ratio of each check, and why there is none.
    pub fn table(&self) -> Table {
        self.columns(Language::En)
    }

    /// The same table whose people read a language.
    pub fn table_in(&self, language: Language) -> Table {
        language.table(self.columns(language))
    }

    /// The same table as CSV of a language: Italian has semicolons and decimal commas.
    pub fn csv(&self, language: Language) -> String {
        language.csv(self.columns(language))
    }

    fn columns(&self, language: Language) -> Table {
        let Entry { symbol, checks, .. } = self.code;
        let four = Digits::Decimals(4);
        let head = |heading: Sentence| heading.of(language).to_owned();
        // programs know checks and sides by their English names
        let in_file = |name: &str, told: &Sentence| match language {
            Language::En => name.to_owned(),
            Language::It => told.of(language).to_owned(),
        };
        let both = || say!("both", "entrambi");
        let has_before = self.walls.iter().flat_map(|wall| &wall.1).any(|verdict| verdict.before.is_some());
        let [before, of_before] = if has_before {
            [format!("{symbol}_before"), head(say!("before", "stato\ndi fatto"))]
        } else {
            <[String; 2]>::default()
        };
        let is_refused = self.refused() > 0;
        let refused = if is_refused { head(say!("not checked", "non verificata")) } else { String::new() };
        let table = Table::over(self.walls.iter().map(|(name, verdict)| (*name, verdict.as_ref())))
            .column(Column::text("name", head(say!("wall", "parete"))).of_user(), |wall| wall.0.to_owned())
            .value("passed", |wall| Some(wall.1.ok()?.passed))
            .number("", head(say!("passed", "verifica\nsoddisfatta")), four, |wall| {
                Some(said(wall.1.ok()?.passed).of(language).to_owned())
            })
            .number(symbol, head(self.code.ratio()), four, |wall| Some(wall.1.ok()?.zeta))
            .number(before, of_before, four, |wall| Some(wall.1.ok()?.before.as_ref()?.zeta))
            .column(Column::text("governs", ""), |wall| {
                let check = wall.1.ok()?.governs;
                Some(in_file(check, &self.title(check)))
            })
            .text("", head(say!("governs", "determinante")), |wall| {
                Some(self.title(wall.1.ok()?.governs).of(language).to_owned())
            })
            .column(Column::text("side", ""), |wall| {
                let of = wall.1.ok()?.side;
                Some(if of == Sides::Alike { in_file("both", &both()) } else { of.name().to_owned() })
            })
            .text("", head(say!("side", "verso")), |wall| {
                let of = wall.1.ok()?.side;
                let told = if of == Sides::Alike { both() } else { side(of) };
                Some(told.of(language).to_owned())
            });
        let table = checks.iter().fold(table, |table, check| {
            let name = check.replace(" with ", "_").replace(' ', "_");
            table.number(format!("{symbol}_{name}"), head(self.title(check)), four, |wall| {
                let of_check = wall.1.ok()?.rows.iter().filter(|row| row.check == *check);
                of_check.map(|row| row.zeta).min_by(f64::total_cmp)
            })
        });
        table
            .text("not_checked", refused, |wall| Some(wall.1.err()?.to_string()))
            .column(Column::text("warnings", ""), |wall| {
                Some(joined(&wall.1.ok()?.warnings, "; ").of(language).to_owned())
            })
            .done()
    }

    /// The name of a check for people.
    fn title(&self, check: &str) -> Sentence {
        let rows = self.walls.iter().filter_map(|(_, verdict)| Some(&verdict.as_ref().ok()?.rows)).flatten();
        rows.filter(|row| row.check == check)
            .map(|row| row.title.clone())
            .next()
            .unwrap_or(Sentence::same(check))
    }

    /// The table as markup of a report, with formulas.
    pub(crate) fn markup(&self, language: Language) -> String {
        let class = |index: usize| match &self.walls[index].1 {
            Ok(verdict) if verdict.passed => "",
            _ => "fails",
        };
        table_as_cards(&self.table_in(language), class, "")
    }

    /// The verdicts by the names of the walls.
    pub fn json(&self) -> Value {
        let one = |(name, verdict): &(&str, Result<Verdict<'_>, CheckError>)| match verdict {
            Ok(verdict) => json!({ "name": name, "verdict": verdict.json() }),
            Err(error) => json!({ "name": name, "not_checked": error.to_string() }),
        };
        self.walls.iter().map(one).collect()
    }

    /// A page with the table; `file` names the file of the walls.
    pub fn page(&self, file: &str, language: Language) -> String {
        let passes = |index: usize| self.walls[index].1.as_ref().is_ok_and(|verdict| verdict.passed);
        let passed = (0..self.walls.len()).filter(|index| passes(*index)).count();
        let rows = self.table_in(language).html_with(|index| if passes(index) { "holds" } else { "fails" });
        let Entry { title, symbol, .. } = self.code;
        let (all, symbol) = (self.walls.len(), Sentence::same(symbol));
        let head = say! {
            "{file}: {passed} of {all} walls pass",
            "{file}: pareti che soddisfano la verifica: {passed} su {all}", file, passed, all
        };
        let said = say! {
            "{title}. The wall with the smallest {symbol} that decides comes first.",
            "{title}. Le pareti sono in ordine di {symbol} crescente tra quelli che decidono.", title, symbol
        };
        let page = Page::new(head.of(language))
            .styled("tr.fails td:nth-child(2), tr.fails td:nth-child(3) { font-weight: 700; }")
            .text(&format!("<p>{}</p>", said.of(language)))
            .text(&rows)
            .html();
        page.replacen("<html lang=\"en\"", &format!("<html lang=\"{}\"", language.name()), 1)
    }
}
