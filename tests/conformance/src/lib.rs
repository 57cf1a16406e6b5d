//! The C boundary against independent authorities.
