//! Messages to the importer, by category.

use std::fmt::Display;

/// The status of a call, and the severity of a message, with the number of `fmi2Status`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// Something is wrong, but the computation can go on.
    Warning = 1,
    /// Not available. Only the functions that ask for a status return it.
    Discard = 2,
    /// This simulation cannot go on; the instance can be reset.
    Error = 3,
    /// The instance is lost.
    Fatal = 4,
}

/// Log categories, by the names that FMI 2.0 proposes. The description must list them under `LogCategories`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Category {
    /// `logStatusWarning`
    Warning,
    /// `logStatusDiscard`
    Discard,
    /// `logStatusError`
    Error,
    /// `logStatusFatal`
    Fatal,
    /// `logEvents`
    Events,
    /// `logAll`: information of any kind. Switching it on switches every category on.
    All,
}

impl Category {
    /// Every category.
    pub const ALL: &'static [Self] =
        &[Self::Warning, Self::Discard, Self::Error, Self::Fatal, Self::Events, Self::All];

    /// Returns the name of the category in the description.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Warning => "logStatusWarning",
            Self::Discard => "logStatusDiscard",
            Self::Error => "logStatusError",
            Self::Fatal => "logStatusFatal",
            Self::Events => "logEvents",
            Self::All => "logAll",
        }
    }

    /// The category with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|category| category.name() == name)
    }
}

/// Which categories are wanted. Errors always are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Filter(u8);

impl Filter {
    /// Errors only.
    pub const ERRORS: Self = Self(1 << Category::Error as u8 | 1 << Category::Fatal as u8);
    /// Everything.
    pub const EVERYTHING: Self = Self(u8::MAX);

    /// Returns this filter with `category` added, or with every category for [`Category::All`].
    pub const fn with(self, category: Category) -> Self {
        match category {
            Category::All => Self::EVERYTHING,
            _ => Self(self.0 | 1 << category as u8),
        }
    }

    /// Returns whether messages of `category` are wanted.
    pub const fn wants(self, category: Category) -> bool {
        self.0 & 1 << category as u8 != 0
    }
}

/// Takes the messages that are wanted.
pub type Sink = dyn FnMut(Status, Category, &str);

/// Where a model writes its messages. What is not wanted is never formatted.
pub struct Log<'a> {
    sink: Option<&'a mut Sink>,
    filter: Filter,
}

impl<'a> Log<'a> {
    /// A log that passes on to `sink` what `filter` wants.
    pub fn new(sink: &'a mut Sink, filter: Filter) -> Self {
        Self { sink: Some(sink), filter }
    }

    /// A log that nobody reads.
    pub fn silent() -> Self {
        Self { sink: None, filter: Filter::ERRORS }
    }

    /// Returns whether warnings are wanted.
    pub fn wants_warnings(&self) -> bool {
        self.sink.is_some() && self.filter.wants(Category::Warning)
    }

    /// Logs an error. A call that fails returns a [`Failure`](crate::Failure) instead, which the layer logs.
    pub fn error(&mut self, message: impl Display) {
        self.write(Status::Error, Category::Error, message);
    }

    /// Logs a warning. The call returns `fmi2OK` all the same: some importers give up on `fmi2Warning`.
    pub fn warning(&mut self, message: impl Display) {
        self.write(Status::Warning, Category::Warning, message);
    }

    /// Logs an event of the simulation, such as an impact.
    pub fn event(&mut self, message: impl Display) {
        self.write(Status::Ok, Category::Events, message);
    }

    /// Logs information.
    pub fn info(&mut self, message: impl Display) {
        self.write(Status::Ok, Category::All, message);
    }

    pub(crate) fn write(&mut self, status: Status, category: Category, message: impl Display) {
        if let (true, Some(sink)) = (self.filter.wants(category), self.sink.as_mut()) {
            sink(status, category, &message.to_string());
        }
    }
}

/// The importer's logger and the categories that it wants.
pub struct Logger {
    sink: Option<Box<Sink>>,
    pub(crate) filter: Filter,
}

impl Logger {
    /// A logger that writes all, or errors alone.
    pub fn new(sink: Option<Box<Sink>>, logging_on: bool) -> Self {
        Self { sink, filter: if logging_on { Filter::EVERYTHING } else { Filter::ERRORS } }
    }

    /// Returns what a model may write to.
    pub fn log(&mut self) -> Log<'_> {
        Log { sink: self.sink.as_deref_mut(), filter: self.filter }
    }
}
