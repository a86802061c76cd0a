//! Trajectories of one pendulum in the lanes of vector registers.
//!
//! Stages and their sums are computed for all lanes at once; every lane has its
//! own time, step, error and control, by the rules of the plain method. A lane
//! whose step is rejected keeps its state, and a lane whose trajectory has ended
//! gets the next start. Lanes without a trajectory stand still.

mod memory;
mod step;
#[cfg(test)]
mod tests;
mod trajectory;

use alloc::vec::Vec;

use self::memory::{Memory, Numbers, WIDEST, numbers, register};
use self::step::Rates;
use self::trajectory::{Finite, Request, Trajectory, Verdict};
use super::arithmetic::Span;
use super::dop853::tables::STAGES;
use crate::integrate::error::{InputError, IntegrationError};
use crate::integrate::options::Options;
use crate::integrate::report::{Report, Solution};
use crate::integrate::request::{check_start, check_times};
use crate::scalar::dispatch::{self, RegisterKernel};
use crate::scalar::register::Register;
use crate::scalar::{InstructionSet, Lane};
use crate::system::{AbsoluteAngles, Rescale, State};

/// The end of a trajectory.
pub(crate) type End<T> = Result<Solution<T>, IntegrationError<T>>;

/// What is asked of all trajectories.
pub(crate) struct Task<'a, P, T> {
    pub(crate) instructions: InstructionSet,
    pub(crate) pendulum: &'a P,
    pub(crate) options: &'a Options<T>,
    pub(crate) starts: &'a [State<T>],
    pub(crate) end: T,
}

/// Integrates the starts whose indices `next` gives, until it gives none, and
/// hands each end to `done` with its index.
///
/// Allocates its registers once; a trajectory allocates where it begins and
/// where it ends, and no step does.
pub(crate) fn integrate<P: Rescale<T>, T: Lane>(
    task: &Task<'_, P, T>,
    next: impl FnMut() -> Option<usize>,
    done: impl FnMut(usize, End<T>),
) {
    let kernel = Lanes { task, next, done };
    dispatch::run_in_registers(task.instructions, kernel);
}

struct Lanes<'a, P, T, N, D> {
    task: &'a Task<'a, P, T>,
    next: N,
    done: D,
}

/// The trajectories under way, each in its lane.
type Slots<T> = [Option<Trajectory<T>>; WIDEST];

impl<P, T, N, D> RegisterKernel<T> for Lanes<'_, P, T, N, D>
where
    P: Rescale<T>,
    T: Lane,
    N: FnMut() -> Option<usize>,
    D: FnMut(usize, End<T>),
{
    type Output = ();

    #[inline(always)]
    fn run<R: Register<Lane = T>>(mut self) {
        let options = self.task.options;
        let request = Request {
            options,
            end: self.task.end,
        };
        let model = Rates(self.task.pendulum.rescale(R::splat));
        // Known to the compiler, as the lengths of all loops.
        let n = 2 * P::LINKS;
        if let Err(error) = options.validate(n) {
            self.refuse_all(&error);
            return;
        }
        let mut memory = Memory::<R>::new(options, n);
        let mut slots: Slots<T> = [const { None }; WIDEST];
        loop {
            let fresh = self.fill(&request, &mut memory, &mut slots);
            if slots.iter().all(Option::is_none) {
                // No start is left either.
                return;
            }
            if fresh.contains(&true) {
                self.begin(&request, &mut memory, &mut slots, (&model, &fresh));
            }
            let Some((span, size)) = self.plan(&request, &mut memory, &mut slots) else {
                continue;
            };
            let end = memory.step(&model, span, options.compensated);
            let errors = numbers(memory.error(n, size));
            let finite = Finite {
                stages: numbers(memory.checks[STAGES - 1]),
                end: numbers(end),
                end_rates: numbers(memory.checks[STAGES]),
            };
            let mut accepted = [false; WIDEST];
            let mut ended = false;
            for (lane, slot) in slots.iter_mut().enumerate() {
                let Some(trajectory) = slot else { continue };
                match trajectory.judge(&request, &memory, lane, (errors[lane], &finite)) {
                    Verdict::Rejected => {}
                    Verdict::Accepted { last } => {
                        accepted[lane] = true;
                        ended |= last;
                    }
                    Verdict::Failed(error) => {
                        (self.done)(trajectory.index, Err(error));
                        *slot = None;
                        memory.set(lane, None);
                    }
                }
            }
            memory.advance(n, R::mask(|lane| accepted[lane]), options.compensated);
            if ended {
                self.finish(&request, &mut memory, &mut slots);
            }
        }
    }
}

impl<P, T, N, D> Lanes<'_, P, T, N, D>
where
    P: Rescale<T>,
    T: Lane,
    N: FnMut() -> Option<usize>,
    D: FnMut(usize, End<T>),
{
    fn refuse_all(&mut self, error: &InputError<T>) {
        while let Some(index) = (self.next)() {
            // What is wrong with the start comes first, as in the plain method.
            let error = match self.task.starts.get(index).map(|start| self.check(start)) {
                Some(Err(error)) => error,
                _ => error.clone(),
            };
            (self.done)(index, Err(error.into()));
        }
    }

    fn check(&self, start: &State<T>) -> Result<(), InputError<T>> {
        check_start(&AbsoluteAngles(self.task.pendulum), start)?;
        check_times(start.time, &[self.task.end])
    }

    /// Gives a start to every lane without a trajectory. Returns which have got
    /// one.
    fn fill<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &mut Memory<R>,
        slots: &mut Slots<T>,
    ) -> [bool; WIDEST] {
        let mut fresh = [false; WIDEST];
        for (lane, slot) in slots.iter_mut().enumerate().take(R::LANES) {
            while slot.is_none()
                && let Some(index) = (self.next)()
                && let Some(start) = self.task.starts.get(index)
            {
                if let Err(error) = self.check(start) {
                    (self.done)(index, Err(error.into()));
                } else if start.time == request.end {
                    let state = start.clone();
                    let report = Report::new();
                    (self.done)(index, Ok(Solution { state, report }));
                } else {
                    memory.set(lane, Some(&start.values));
                    *slot = Some(Trajectory::new(request, index, start.time));
                    fresh[lane] = true;
                }
            }
        }
        fresh
    }

    /// The first stage and the first step of fresh trajectories. The other lanes
    /// go through it too, and keep what they have.
    fn begin<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &mut Memory<R>,
        slots: &mut Slots<T>,
        (model, fresh): (&Rates<P::Of<R>>, &[bool; WIDEST]),
    ) {
        let n = memory.start.len();
        let mut span = Span {
            time: [T::ZERO; WIDEST],
            step: [T::ZERO; WIDEST],
        };
        for (time, slot) in span.time.iter_mut().zip(&*slots) {
            *time = slot.as_ref().map_or(T::ZERO, |trajectory| trajectory.time);
        }
        let others: Vec<R> = memory.rates[..n].to_vec();
        memory.stage.copy_from_slice(&memory.start);
        memory.evaluate(model, register(&span.time), 1);
        let mask = R::mask(|lane| fresh[lane]);
        for (rate, other) in memory.rates.iter_mut().zip(others) {
            *rate = rate.choose(other, mask);
        }
        self.each_fresh(memory, slots, fresh, |trajectory, memory, lane| {
            span.step[lane] = trajectory.euler(request, memory, lane)?;
            span.time[lane] += span.step[lane];
            Ok(())
        });
        let step = register::<R>(&span.step);
        for i in 0..n {
            memory.stage[i] = step.mul_add(memory.rates[i], memory.start[i]);
        }
        memory.evaluate(model, register(&span.time), 2);
        self.each_fresh(memory, slots, fresh, |trajectory, memory, lane| {
            trajectory.first_step(request, memory, lane)
        });
    }

    /// Calls `work` for every fresh trajectory; those that fail leave their lanes.
    fn each_fresh<R: Register<Lane = T>>(
        &mut self,
        memory: &mut Memory<R>,
        slots: &mut Slots<T>,
        fresh: &[bool; WIDEST],
        mut work: impl FnMut(&mut Trajectory<T>, &Memory<R>, usize) -> Result<(), IntegrationError<T>>,
    ) {
        for (lane, slot) in slots.iter_mut().enumerate() {
            if let Some(trajectory) = slot.as_mut().filter(|_| fresh[lane])
                && let Err(error) = work(trajectory, memory, lane)
            {
                (self.done)(trajectory.index, Err(error));
                *slot = None;
                memory.set(lane, None);
            }
        }
    }

    /// Time and step of every lane, and the lengths of the steps; none if there
    /// is no trajectory. Those that may not go on leave their lanes.
    fn plan<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &mut Memory<R>,
        slots: &mut Slots<T>,
    ) -> Option<(Span<R>, R)> {
        let (mut time, mut step, mut size): (Numbers<T>, Numbers<T>, Numbers<T>) =
            ([T::ZERO; WIDEST], [T::ZERO; WIDEST], [T::ZERO; WIDEST]);
        let mut any = false;
        for (lane, slot) in slots.iter_mut().enumerate() {
            let Some(trajectory) = slot else { continue };
            match trajectory.plan(request, memory, lane) {
                Ok(span) => {
                    any = true;
                    time[lane] = span.time;
                    step[lane] = span.step;
                    size[lane] = span.step.abs();
                }
                Err(error) => {
                    (self.done)(trajectory.index, Err(error));
                    *slot = None;
                    memory.set(lane, None);
                }
            }
        }
        let span = Span {
            time: register(&time),
            step: register(&step),
        };
        any.then(|| (span, register(&size)))
    }

    /// Hands over the trajectories that have reached the end.
    fn finish<R: Register<Lane = T>>(
        &mut self,
        request: &Request<'_, T>,
        memory: &mut Memory<R>,
        slots: &mut Slots<T>,
    ) {
        for (lane, slot) in slots.iter_mut().enumerate() {
            if let Some(trajectory) = slot
                && trajectory.time == request.end
            {
                let state = memory.state(lane, trajectory.time);
                (self.done)(trajectory.index, Ok(trajectory.solution(state)));
                *slot = None;
                memory.set(lane, None);
            }
        }
    }
}
