mod charts;
mod films;
mod parts;
