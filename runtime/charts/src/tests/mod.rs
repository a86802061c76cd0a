mod awkward;
mod charts;
mod figures;
mod films;
mod marks;
mod parts;
