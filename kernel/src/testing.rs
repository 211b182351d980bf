//! What the unit tests share.

pub(crate) mod climb;
pub(crate) mod integers;
pub(crate) mod limbs;
pub(crate) mod polynomial;
pub(crate) mod recorded;
pub(crate) mod running_error;
pub(crate) mod toy;
pub(crate) mod work;
