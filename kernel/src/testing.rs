//! What the unit tests share.

pub(crate) mod climb;
pub(crate) mod integers;
pub(crate) mod limbs;
pub(crate) mod toy;
