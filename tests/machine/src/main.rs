//! What only unsafe code can set up: a stack that is painted, another floating-point environment.

mod float_control;
mod painted_stack;
mod stack;

fn main() {
    stack::measure();
    float_control::prove();
}
