//! Tests that need unsafe code: on a painted stack, and in another floating-point environment.

mod float_control;
mod painted_stack;
mod stack;

fn main() {
    stack::measure();
    float_control::prove();
}
