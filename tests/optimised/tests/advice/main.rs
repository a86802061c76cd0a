//! Advice: whatever is chosen, it is right. Against references that the advisor has not
//! seen. Costs are measured, and differ from run to run; that the cheapest is chosen is
//! tested with costs that are made up, beside the code.

mod chaos;
mod scenes;
mod tasks;
