mod bit_for_bit;
mod moves;
