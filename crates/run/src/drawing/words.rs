//! The words of a drawing.

/// The words of labels, each with the space that it needs.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the English of each says it")]
pub struct Words {
    pub inside: &'static str,
    pub outside: &'static str,
    pub from_the_front: &'static str,
    pub at: &'static str,
    pub to: &'static str,
    pub up_to: &'static str,
    pub tie: &'static str,
    pub thrust: &'static str,
    pub loads: &'static str,
    pub outwards: &'static str,
    /// Whether numbers have decimal commas.
    pub has_commas: bool,
}

impl Words {
    /// English.
    pub const EN: Self = Self {
        inside: "inside",
        outside: "outside",
        from_the_front: "from the front",
        at: "at",
        to: "to",
        up_to: "up to",
        tie: "tie",
        thrust: "thrust",
        loads: "loads",
        outwards: "u > 0: outwards",
        has_commas: false,
    };
    /// Italian.
    pub const IT: Self = Self {
        inside: "interno",
        outside: "esterno",
        from_the_front: "prospetto",
        at: "a",
        to: "a",
        up_to: "fino a",
        tie: "catena",
        thrust: "spinta",
        loads: "carichi",
        outwards: "u > 0: verso l'esterno",
        has_commas: true,
    };
}
