//! `codemeta.json`, from `Cargo.toml` and `CITATION.cff`.

use crate::command::{Result, read, write};

/// Where an address says that the project has no public home yet.
const PLACEHOLDER: &str = "https://example.org/";

/// Writes the file. With `check` it is compared instead, and a stale one is an error.
pub(crate) fn run(check: bool) -> Result<()> {
    let text = text(&read("Cargo.toml")?, &read("CITATION.cff")?)?;
    if !check {
        return write("codemeta.json", text);
    }
    if read("codemeta.json")? == text {
        return Ok(());
    }
    Err("codemeta.json is not what Cargo.toml and CITATION.cff say: run `cargo xtask generate`".to_owned())
}

/// Makes the file's text.
fn text(cargo: &str, citation: &str) -> Result<String> {
    let of_cargo = |key| value(cargo, &format!("{key} = ")).ok_or_else(|| format!("Cargo.toml has no {key}"));
    let cited =
        |key| value(citation, &format!("{key}: ")).ok_or_else(|| format!("CITATION.cff has no {key}"));
    let (own, article) = citation.split_once("preferred-citation:").ok_or("CITATION.cff cites no article")?;
    let licences =
        items(own, "license").into_iter().map(|name| quoted(&format!("https://spdx.org/licenses/{name}")));
    let mut lines = vec![
        field("@context", &quoted("https://w3id.org/codemeta/3.0")),
        field("@type", &quoted("SoftwareSourceCode")),
        field("name", &quoted(of_cargo("name")?)),
        field("headline", &quoted(cited("title")?)),
        field("description", &quoted(of_cargo("description")?)),
        field("version", &quoted(cited("version")?)),
        field("datePublished", &quoted(cited("date-released")?)),
        field("license", &list(licences)),
        field("programmingLanguage", &list(["Rust", "Python"].map(quoted))),
        field("runtimePlatform", &quoted(&format!("Rust {}", of_cargo("rust-version")?))),
        field("keywords", &list(items(own, "keywords").into_iter().map(quoted))),
        field("author", &list(items(own, "authors").into_iter().filter_map(organization))),
        field("readme", &quoted("README.md")),
        field("softwareHelp", &quoted(".github/SUPPORT.md")),
    ];
    let address = of_cargo("repository")?;
    if !address.starts_with(PLACEHOLDER) {
        lines.push(field("codeRepository", &quoted(address)));
    }
    lines.push(field("referencePublication", &publication(article)?));
    Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
}

fn organization(item: &str) -> Option<String> {
    let name = item.strip_prefix("name: ")?;
    Some(format!("{{\"@type\": \"Organization\", \"name\": {}}}", quoted(name)))
}

/// Describes the paper whose model the software computes.
fn publication(article: &str) -> Result<String> {
    let title = value(article, "  title: ").ok_or("CITATION.cff: the article has no title")?;
    let lines: Vec<_> = article.lines().map(str::trim).collect();
    let people = lines.windows(2).filter_map(|pair| {
        let (family, given) =
            (pair[0].strip_prefix("- family-names: ")?, pair[1].strip_prefix("given-names: ")?);
        let (family, given) = (quoted(family), quoted(given));
        Some(format!("{{\"@type\": \"Person\", \"familyName\": {family}, \"givenName\": {given}}}"))
    });
    let people = people.collect::<Vec<_>>().join(",\n      ");
    let fields = [
        "\"@type\": \"ScholarlyArticle\"".to_owned(),
        format!("\"name\": {}", quoted(title)),
        format!("\"author\": [\n      {people}\n    ]"),
    ];
    Ok(format!("{{\n    {}\n  }}", fields.join(",\n    ")))
}

/// Returns what follows a key at the start of a line, without quotes.
fn value<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.lines().find_map(|line| line.strip_prefix(key)).map(|value| value.trim_matches('"'))
}

/// Returns the items of a list at the top level of a YAML file.
fn items<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
    let lines = text.lines().skip_while(|line| *line != format!("{key}:")).skip(1);
    lines.map_while(|line| line.strip_prefix("  - ")).collect()
}

fn field(name: &str, value: &str) -> String {
    format!("  {}: {value}", quoted(name))
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}

/// Quotes a text of one line as JSON.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
