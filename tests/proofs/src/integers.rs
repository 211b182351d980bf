mod long_accumulator;
mod order;
mod units;
