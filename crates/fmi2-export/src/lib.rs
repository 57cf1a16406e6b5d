//! stub
#![allow(missing_docs)]
#[derive(Debug)] pub struct Variable { pub name: &'static str, pub reference: u32, pub description: &'static str, pub causality: Causality, pub variability: Variability, pub unit: Option<&'static str>, pub kind: Kind }
#[derive(Clone,Copy,PartialEq,Debug)] pub enum Causality { Parameter, CalculatedParameter, Input, Output, Local, Independent }
#[derive(Clone,Copy,PartialEq,Debug)] pub enum Variability { Constant, Fixed, Tunable, Discrete, Continuous }
#[derive(Debug)] pub enum Kind { Real { start: Option<f64>, min: Option<f64>, max: Option<f64> }, Integer { start: Option<i32>, min: Option<i32>, max: Option<i32> }, Enumeration { start: Option<i32>, items: &'static [Item] }, Boolean { start: Option<bool> }, String { start: Option<&'static str> } }
#[derive(Debug)] pub struct Item { pub name: &'static str, pub value: i32, pub description: &'static str }
pub trait VariableId: Copy + Eq + std::fmt::Debug + 'static { const ALL: &'static [Self]; fn variable(self) -> &'static Variable; fn from_reference(reference: u32) -> Option<Self>;
 fn from_name(name: &str) -> Option<Self> { Self::ALL.iter().copied().find(|v| v.variable().name == name) } }
pub fn fnv1a_128(bytes: impl Iterator<Item = u8>) -> u128 { bytes.fold(0x6c62272e07bb014262b821756295c58d, |h, b| (h ^ u128::from(b)).wrapping_mul(0x0000000001000000000000000000013b)) }
