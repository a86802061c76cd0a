mod charts;
mod parts;
