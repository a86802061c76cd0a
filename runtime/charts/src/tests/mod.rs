mod awkward;
mod charts;
mod films;
mod parts;
